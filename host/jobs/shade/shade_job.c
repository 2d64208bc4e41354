#include "jobs/shade/shade_job.h"

#include "base/memory.h"
#include "math/pi.h"
#include "math/random/random.h"
#include "math/random/rotation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { USUAL_ORIENTATIONS = 1000 };
/* Values of one call: half a second of a processor, after which somebody may stop the work. */
enum { CALL_VALUES = 1 << 24 };

/* ---- one rule ------------------------------------------------------------------------------ */

static uint64_t choose_orientations(const ps_shade_job *self, const ps_quadrature_job *rules) {
    const ps_quadrature_setup *const setup = &rules->setup;
    const uint64_t num =
        setup->needs.one_realization || setup->num_realizations == 0 ? 1 : setup->num_realizations;
    return self->wanted_orientations != PS_USUAL_ORIENTATIONS
               ? self->wanted_orientations
               : (USUAL_ORIENTATIONS + num - 1) / num;
}

static void begin(void *payload, const ps_quadrature_job *rules) {
    ps_shade_job *const self = payload;
    self->rules = rules;
    self->num_orientations = choose_orientations(self, rules);
    self->squares = self->predictions = self->parts_beyond = self->orientations = (ps_sums){0};
    self->num_rules = 0;
}

/* Trials for sets of so many points, which files may have more of than was known. */
static pspec_status make_room(ps_shade_job *self, size_t num_points, ps_error *error) {
    ps_device *const device = self->rules->setup.device;
    const bool has_doubles = device == NULL || ps_device_get_limits(device)->has_fp64;
    if (self->trials != NULL && num_points <= self->most_points) {
        return PSPEC_OK;
    }
    const uint64_t fit = CALL_VALUES / num_points + 1;
    const uint64_t num = self->num_orientations;
    ps_shade_job_free(self);
    self->most_points = num_points;
    self->trials_of_call = (size_t)(num < fit ? num : fit);
    PS_TRY(PS_NEW(&self->moves, self->trials_of_call * (PS_ROTATION_NUMBERS + 1), "orientations",
                  error));
    self->estimates = self->moves + self->trials_of_call * PS_ROTATION_NUMBERS;
    const ps_trials_options options = {has_doubles ? PS_DOUBLE : PS_SINGLE, 1, num_points,
                                       self->trials_of_call, false};
    return ps_trials_create(&self->trials, self->light->integrand, &options, device, error);
}

/* Means of squares of a rule; the sums over its orientations count where there is one rule. */
typedef struct rule_row {
    double square, prediction, beyond;
    ps_sums orientations;
} rule_row;

/* Squares of the errors of some orientations; those behind the last are there, and not counted. */
static pspec_status measure_some(ps_shade_job *self, const pspec_pattern *pattern,
                                 double weight_sum, ps_random *random, size_t num, ps_sums *squares,
                                 ps_error *error) {
    for (size_t i = 0; i < self->trials_of_call; i++) {
        const ps_rotation rotation = ps_rotation_random(random);
        memcpy(self->moves + i * PS_ROTATION_NUMBERS, rotation.matrix, sizeof rotation.matrix);
    }
    PS_TRY(ps_trials_run(self->trials, &(ps_batch){.num_patterns = 1, .patterns = pattern},
                         self->moves, self->estimates, error));
    for (size_t i = 0; i < num; i++) {
        const double *const move = self->moves + i * PS_ROTATION_NUMBERS;
        const double normal[3] = {move[2], move[5], move[8]}; /* R z */
        const double estimate = self->estimates[i] * weight_sum / PS_FOUR_PI;
        const double off = estimate - ps_light_shading(self->light, normal);
        ps_sums_add(squares, off * off);
    }
    return PSPEC_OK;
}

static pspec_status measure(ps_shade_job *self, uint64_t rule, const pspec_pattern *pattern,
                            double weight_sum, rule_row *row, ps_error *error) {
    const uint64_t num = self->num_orientations;
    ps_random random = ps_random_init(self->seed, PS_STREAM_TRIALS, rule);
    double unused = 0;
    PS_TRY(make_room(self, pattern->num_points, error));
    for (uint64_t done = 0; done < num; done += self->trials_of_call) {
        const uint64_t left = num - done;
        PS_TRY(
            ps_watch_tell(&self->rules->question->watch, "orientations", done, num, NULL, error));
        PS_TRY(measure_some(self, pattern, weight_sum, &random,
                            left < self->trials_of_call ? (size_t)left : self->trials_of_call,
                            &row->orientations, error));
    }
    ps_sums_finish(&row->orientations, num, &row->square, &unused);
    return PSPEC_OK;
}

/* (Q5) up to the degrees that both have; beyond, V/(4 pi) of the energy. */
static void predict(const ps_light *light, const ps_degree_error *degrees, size_t max_degree,
                    double weight_square, rule_row *row) {
    const size_t last = max_degree < light->max_degree ? max_degree : light->max_degree;
    double sum = 0;
    for (size_t l = 0; l <= last; l++) {
        sum += light->powers[l] * (degrees[l].d2 + degrees[l].c2);
    }
    row->beyond = weight_square / PS_FOUR_PI * ps_light_beyond(light, last);
    row->prediction = sum + row->beyond;
}

static pspec_status hear(void *payload, uint64_t rule, const pspec_pattern *pattern,
                         const ps_degree_error *degrees, size_t max_degree, void *row,
                         ps_error *error) {
    ps_shade_job *const self = payload;
    rule_row *const own = row;
    const ps_rule view = {pattern->num_points, pattern->points, pattern->weights};
    const ps_weight_sums weights = ps_rule_weight_sums(&view);
    *own = (rule_row){0};
    predict(self->light, degrees, max_degree, weights.square, own);
    return self->num_orientations > 0 ? measure(self, rule, pattern, weights.sum, own, error)
                                      : PSPEC_OK;
}

static void take(void *payload, const void *row) {
    ps_shade_job *const self = payload;
    const rule_row *const own = row;
    if (self->num_orientations > 0) {
        ps_sums_add(&self->squares, own->square);
        self->orientations = own->orientations;
    }
    ps_sums_add(&self->predictions, own->prediction);
    ps_sums_add(&self->parts_beyond, own->beyond);
    self->num_rules++;
}

static pspec_status walk(void *payload, ps_snapshot *snapshot, ps_error *error) {
    ps_shade_job *const self = payload;
    ps_sums *const all[] = {&self->squares, &self->predictions, &self->parts_beyond,
                            &self->orientations};
    static const char *const names[] = {"light_squares", "light_predictions", "light_beyond",
                                        "light_orientations"};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        PS_TRY(ps_snapshot_doubles(snapshot, names[i], (double *)all[i],
                                   sizeof(ps_sums) / sizeof(double), error));
    }
    return ps_snapshot_counts(snapshot, "light_rules", &self->num_rules, 1, error);
}

/* ---- all of them --------------------------------------------------------------------------- */

static ps_mean finish(const ps_sums *sums, uint64_t num) {
    ps_mean out;
    ps_sums_finish(sums, num, &out.mean, &out.standard_error);
    return out;
}

static void end(void *payload) {
    ps_shade_job *const self = payload;
    self->measured = finish(&self->squares, self->num_rules);
    self->predicted = finish(&self->predictions, self->num_rules);
    self->beyond = finish(&self->parts_beyond, self->num_rules).mean;
    if (self->num_orientations == 0) {
        self->measured = (ps_mean){NAN, NAN};
    } else if (self->num_rules == 1) {
        self->measured = finish(&self->orientations, self->num_orientations);
    }
    if (self->num_rules == 1) {
        self->predicted.standard_error = 0;
    }
    ps_shade_job_free(self);
}

/* Of a processor: 16384 points, double precision, AVX-512, PoCL 3.1; of a harmonic of I(r). */
static const double value_seconds = 2e-8;
static const double harmonic_seconds = 2.3e-9;

static double orientation_seconds(const ps_light *light, double num_points) {
    const double degrees = (double)light->max_degree + 1;
    return num_points * value_seconds + degrees * degrees / 2 * harmonic_seconds;
}

/* Of rules that take some seconds, for checkpoints come between two batches; 0: they take little.
 */
static size_t choose_batch(const ps_light *light, uint64_t num_orientations,
                           const ps_sampler_request *sampler) {
    const double most_seconds = 2;
    const bool is_little =
        sampler == NULL || num_orientations == 0 || num_orientations == PS_USUAL_ORIENTATIONS;
    return is_little ? 0
                     : 1 + (size_t)(most_seconds / (double)num_orientations /
                                    orientation_seconds(light, (double)sampler->num_points));
}

static void add_phases(void *payload, const ps_quadrature_job *job, ps_phases *phases) {
    const ps_shade_job *const self = payload;
    const ps_quadrature_setup *const setup = &job->setup;
    const double rules = setup->needs.one_realization ? 1 : (double)setup->num_realizations;
    const double num = rules * (double)choose_orientations(self, job);
    const double values = num * (double)job->shape.num_points;
    ps_phases_add(phases, "trials",
                  num * orientation_seconds(self->light, (double)job->shape.num_points));
    ps_phases_say(phases, "trials", "%.4g values of light at %.4g orientations", values, num);
}

/* Samplers and numbers of points have orientations of their own. */
pspec_status ps_shade_job_make(ps_shade_job *out, const ps_light *light, uint64_t num_orientations,
                               uint64_t seed, ps_quadrature_question *rules, ps_error *error) {
    ps_text text = {0};
    ps_text_append(&text, "shade\n");
    if (rules->sampler != NULL) {
        ps_sampler_identify(rules->sampler, &text);
    }
    const pspec_status status = ps_text_check(&text, error);
    *out = (ps_shade_job){.light = light,
                          .wanted_orientations = num_orientations,
                          .seed = ps_random_seed_of(seed, PS_STREAM_TRIALS, ps_text_string(&text))};
    rules->batch = choose_batch(light, num_orientations, rules->sampler);
    rules->observer =
        (ps_rule_observer){begin, hear, take, sizeof(rule_row), walk, end, add_phases, out};
    ps_text_free(&text);
    return status;
}

void ps_shade_job_free(ps_shade_job *self) {
    ps_trials_destroy(self->trials);
    free(self->moves);
    self->trials = NULL;
    self->moves = NULL;
}
