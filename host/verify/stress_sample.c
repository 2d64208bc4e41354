#include "verify/stress_sample.h"

#include "base/memory.h"
#include "base/workers.h"
#include "engines/host/host_direct.h"
#include "verify/stress_shapes.h"

#include <math.h>
#include <stdlib.h>

/* Points and listed frequencies are drawn from these. */
static const uint64_t points_seed = 7, list_seed = 3;

/* What engines that work as exactly as they are asked to are asked for, by precision: near the best
 * that they can. */
static const double tolerances[] = {1e-5, 1e-12};
/* Pair sums are asked for more, since their errors are smaller by about sqrt(N). */
static const double pair_tolerances[] = {1e-6, 1e-13};

/* ---- making -------------------------------------------------------------------------------- */

static pspec_status make_list(ps_stress_sample *self, ps_error *error) {
    const ps_stress_case *what = self->what;
    const size_t num = what->num_listed;
    uint64_t state = list_seed;
    int32_t *vectors = NULL;
    PS_TRY(PS_NEW(&vectors, num * what->dimension, "frequencies", error));
    for (size_t i = 0; i < num * what->dimension; i++) {
        vectors[i] = (int32_t)((2 * ps_stress_uniform(&state) - 1) * what->reach);
    }
    return ps_frequencies_list(&self->frequencies, what->dimension, num, vectors, error);
}

static pspec_status make_frequencies(ps_stress_sample *self, ps_error *error) {
    const ps_stress_case *what = self->what;
    if (what->kind != PS_STRESS_TORUS) {
        PS_TRY(ps_frequencies_degrees(&self->frequencies, what->reach, what->is_hemisphere, error));
    } else if (what->num_listed > 0) {
        return make_list(self, error);
    } else {
        PS_TRY(
            ps_frequencies_lattice(&self->frequencies, what->dimension, what->reach, false, error));
    }
    return ps_frequencies_enumerate(&self->frequencies, error);
}

/* Evenly spread, the last one among them. */
static pspec_status choose_checked(ps_stress_sample *self, ps_error *error) {
    const size_t num = self->frequencies.num;
    const size_t wanted = self->what->num_checked;
    self->num_checked = wanted > 0 && wanted < num ? wanted : num;
    PS_TRY(PS_NEW(&self->checked, self->num_checked, "frequencies", error));
    for (size_t i = 0; i < self->num_checked; i++) {
        self->checked[i] = (uint32_t)((i + 1) * num / self->num_checked - 1);
    }
    return PSPEC_OK;
}

/* Points below the horizon become their antipodes. */
static void lift_above_horizon(pspec_pattern *pattern) {
    double *const points = (double *)(uintptr_t)pattern->points; /* our own */
    for (size_t j = 0; j < pattern->num_points; j++) {
        double *const u = points + j * PS_SPHERE_DIMENSION;
        for (int axis = 0; axis < PS_SPHERE_DIMENSION && u[2] < 0; axis++) {
            u[axis] = -u[axis]; /* the height last */
        }
    }
}

pspec_status ps_stress_points_make(const ps_stress_case *what, uint64_t realization,
                                   pspec_pattern *out, ps_error *error) {
    const bool on_torus = what->kind == PS_STRESS_TORUS;
    PS_TRY(ps_stress_shape_make(
        ps_stress_shape_find(on_torus ? ps_torus_shapes : ps_vector_shapes, what->shape),
        on_torus ? what->dimension : PS_SPHERE_DIMENSION, (size_t)what->num_points,
        points_seed + realization, out, error));
    if (what->is_hemisphere) {
        lift_above_horizon(out);
    }
    return PSPEC_OK;
}

pspec_status ps_stress_sample_create(ps_stress_sample *out, const ps_stress_case *what,
                                     ps_error *error) {
    *out = (ps_stress_sample){.what = what};
    pspec_status status = make_frequencies(out, error);
    if (status == PSPEC_OK) {
        status = choose_checked(out, error);
    }
    if (status == PSPEC_OK) {
        status = ps_stress_points_make(what, 0, &out->pattern, error);
    }
    if (status == PSPEC_OK) {
        status = ps_pattern_check(&out->pattern, &out->frequencies, PSPEC_NORMALIZATION_EFFECTIVE,
                                  0, &out->sums, error);
    }
    if (status != PSPEC_OK) {
        ps_stress_sample_free(out);
    }
    return status;
}

void ps_stress_sample_free(ps_stress_sample *sample) {
    ps_stress_pattern_free(&sample->pattern);
    ps_frequencies_free(&sample->frequencies);
    free(sample->checked);
    free(sample->truth);
    free(sample->harmonics);
    *sample = (ps_stress_sample){0};
}

double ps_stress_modes(const ps_stress_sample *sample, size_t frequency) {
    return sample->what->kind == PS_STRESS_TORUS ? 1
                                                 : 2.0 * sample->frequencies.vectors[frequency] + 1;
}

ps_problem ps_stress_problem(const ps_stress_sample *sample, ps_precision precision) {
    const ps_pattern_sums *sums = &sample->sums;
    const bool is_pairs = sample->what->kind == PS_STRESS_PAIRS;
    const double share = sums->weight_square_sum / (sums->weight_size_sum * sums->weight_size_sum);
    return (ps_problem){.frequencies = &sample->frequencies,
                        .num_points = sample->pattern.num_points,
                        .num_realizations = 1,
                        .has_weights = sample->pattern.weights != NULL,
                        .measure = is_pairs ? PS_OF_PAIR_SUMS : PS_OF_AMPLITUDES,
                        .weight_share = is_pairs ? share : 0,
                        .tolerance = is_pairs ? pair_tolerances[precision] : tolerances[precision]};
}

/* ---- the truth ----------------------------------------------------------------------------- */

/* One entry after the other, in threads: of the torus a sum each, of the sphere a degree each. */
typedef struct inquiry {
    ps_stress_sample *sample;
    bool (*should_stop)(void *payload);
    void *payload;
    unsigned num_threads;
    pspec_status *statuses; /* [num_threads] */
} inquiry;

enum { MOST_THREADS = 16 };

static void ask_torus(ps_stress_sample *self, size_t i) {
    long double re = 0;
    long double im = 0;
    ps_host_sum(&self->pattern,
                self->frequencies.vectors + (size_t)self->checked[i] * self->frequencies.dimension,
                &re, &im);
    self->truth[i] = ldexpl(hypotl(re, im), -self->sums.exponent);
}

/* Where the orders of checked degree i begin. */
static size_t first_order(const ps_stress_sample *self, size_t i) {
    size_t first = 0;
    for (size_t before = 0; before < i; before++) {
        first += (size_t)self->frequencies.vectors[self->checked[before]] + 1;
    }
    return first;
}

/* Sums of pairs, too: one degree at a time costs much less than all pairs. */
static pspec_status ask_degree(ps_stress_sample *self, size_t i) {
    const int32_t l = self->frequencies.vectors[self->checked[i]];
    long double(*const out)[2] =
        self->harmonics != NULL ? self->harmonics + first_order(self, i) : NULL;
    ps_host_degree degree;
    PS_TRY(ps_host_degree_create(&degree, l, NULL));
    ps_host_degree_sum(&degree, &self->pattern);
    for (int32_t m = 0; out != NULL && m <= l; m++) {
        out[m][0] = ldexpl(degree.sums[m][0], -self->sums.exponent);
        out[m][1] = ldexpl(degree.sums[m][1], -self->sums.exponent);
    }
    const long double power = ps_host_degree_power(&degree);
    self->truth[i] = self->what->kind == PS_STRESS_PAIRS
                         ? ldexpl(power, -2 * self->sums.exponent)
                         : ldexpl(sqrtl(power), -self->sums.exponent);
    ps_host_degree_free(&degree);
    return PSPEC_OK;
}

static void ask(void *payload, unsigned index) {
    const inquiry *self = payload;
    ps_stress_sample *sample = self->sample;
    for (size_t i = index; i < sample->num_checked; i += self->num_threads) {
        if (self->should_stop != NULL && self->should_stop(self->payload)) {
            self->statuses[index] = PSPEC_ERROR_CANCELLED;
            return;
        }
        if (sample->what->kind == PS_STRESS_TORUS) {
            ask_torus(sample, i);
        } else if (self->statuses[index] == PSPEC_OK) {
            self->statuses[index] = ask_degree(sample, i);
        }
    }
}

static pspec_status ask_all(ps_stress_sample *self, bool (*should_stop)(void *payload),
                            void *payload, ps_error *error) {
    pspec_status statuses[MOST_THREADS] = {PSPEC_OK};
    ps_workers *workers = ps_workers_create(MOST_THREADS);
    inquiry all = {self, should_stop, payload, ps_workers_count(workers), statuses};
    ps_workers_run(workers, ask, &all);
    ps_workers_destroy(workers);
    for (size_t i = 0; i < MOST_THREADS; i++) {
        if (statuses[i] == PSPEC_ERROR_CANCELLED) {
            return ps_fail(error, statuses[i], "cancelled");
        }
        if (statuses[i] != PSPEC_OK) {
            return ps_fail(error, statuses[i], "not enough memory for a degree of the referee");
        }
    }
    return PSPEC_OK;
}

static pspec_status ask_pairs(ps_stress_sample *self, ps_error *error) {
    const int32_t last = self->frequencies.max_frequency;
    long double *sums = NULL;
    PS_TRY(PS_NEW(&sums, (size_t)last + 1, "degrees", error));
    const pspec_status status =
        ps_host_pairs(&self->pattern, self->sums.exponent, last, sums, error);
    for (size_t i = 0; status == PSPEC_OK && i < self->num_checked; i++) {
        self->truth[i] = sums[self->frequencies.vectors[self->checked[i]]];
    }
    free(sums);
    return status;
}

static double measure_power(const ps_stress_sample *self) {
    const bool is_pairs = self->what->kind == PS_STRESS_PAIRS;
    double sum = 0;
    double num = 0;
    for (size_t i = 0; i < self->num_checked; i++) {
        const double modes = ps_stress_modes(self, self->checked[i]);
        const long double power = is_pairs ? self->truth[i] : self->truth[i] * self->truth[i];
        sum += modes * (double)power;
        num += modes;
    }
    return sum / num / self->sums.weight_square_sum;
}

pspec_status ps_stress_sample_judge(ps_stress_sample *sample, bool (*should_stop)(void *payload),
                                    void *payload, ps_error *error) {
    if (sample->truth != NULL) {
        return PSPEC_OK;
    }
    PS_TRY(PS_NEW(&sample->truth, sample->num_checked, "degrees", error));
    if (sample->what->kind == PS_STRESS_SPHERE) {
        PS_TRY(
            PS_NEW(&sample->harmonics, first_order(sample, sample->num_checked), "orders", error));
    }
    const bool is_whole = sample->num_checked == sample->frequencies.num;
    PS_TRY(is_whole && sample->what->kind == PS_STRESS_PAIRS
               ? ask_pairs(sample, error)
               : ask_all(sample, should_stop, payload, error));
    sample->mean_power = is_whole ? measure_power(sample) : 0;
    return PSPEC_OK;
}
