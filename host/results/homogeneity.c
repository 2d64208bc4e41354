#include "results/homogeneity.h"

#include "base/memory.h"
#include "questions/homogeneity_question.h"
#include "report/check/homogeneity_table.h"
#include "results/spectra.h"
#include "spectra/phases/shift_products.h"
#include "spectra/phases/turn_products.h"

#include <math.h>
#include <stdlib.h>

/* On the sphere turns about the z axis and about the x axis, which make all rotations. */
enum { MOST_PARTS = 2 };

struct ps_homogeneity {
    ps_request own;
    ps_question_list list;
    size_t num_parts;
    ps_power_job *job; /* of the part that came last */
    /* What has a character other than 0 in a part: amplitudes, then as many sums of products. */
    size_t num_places;
    size_t *places;         /* [num_places], of amplitudes: which complex number */
    ps_phase_label *labels; /* [num_parts][2][num_places] */
    ps_phase_test *tests;   /* the same */
};

void ps_homogeneity_discard(ps_homogeneity *computed) {
    if (computed == NULL) {
        return;
    }
    ps_power_job_destroy(computed->job);
    free(computed->places);
    free(computed->labels);
    free(computed->tests);
    free(computed);
}

/* ---- before the work --------------------------------------------------------------------- */

static pspec_status check_realizations(const ps_request *own, uint64_t num, size_t num_tests,
                                       ps_error *error) {
    const uint64_t least = ps_phase_tests_least(num_tests, own->false_alarm_rate);
    return num >= least
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "%llu realization%s cannot tell: among %zu phases even equal ones would "
                         "not be an alarm at a rate of %g; at least %llu realizations are needed",
                         (unsigned long long)num, num == 1 ? "" : "s", num_tests,
                         own->false_alarm_rate, (unsigned long long)least);
}

/* The fewest that any number of phases needs are asked for before hours of work. */
static pspec_status ask(ps_homogeneity *self, const ps_request *request, ps_error *error) {
    self->own = ps_homogeneity_request(request);
    PS_TRY(ps_homogeneity_question_make(&self->list, &self->own, error));
    self->num_parts = self->list.questions[0].on_sphere ? MOST_PARTS : 1;
    return self->own.num_samplers > 0
               ? check_realizations(&self->own, self->own.num_realizations, 1, error)
               : PSPEC_OK;
}

pspec_status ps_homogeneity_check(const ps_request *request, ps_error *error) {
    ps_homogeneity self = {0};
    return ask(&self, request, error);
}

pspec_status ps_homogeneity_plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    ps_homogeneity self = {0};
    PS_TRY(ask(&self, request, error));
    for (size_t part = 0; part < self.num_parts; part++) {
        self.list.questions[0].is_turned = part > 0;
        PS_TRY(ps_spectra_plan_list(planner, &self.own, &self.list, error));
    }
    return PSPEC_OK;
}

/* ---- which phases ------------------------------------------------------------------------ */

static const ps_frequencies *frequencies_of(const ps_homogeneity *self) {
    return ps_power_job_problem(self->job)->frequencies;
}

/* Orders 1 .. l of every degree; order 0 has no phase. */
static size_t count_orders(const ps_frequencies *set) {
    size_t num = 0;
    for (size_t i = 0; i < set->num; i++) {
        num += (size_t)set->vectors[i];
    }
    return num;
}

static void list_orders(ps_homogeneity *self, const ps_frequencies *set) {
    const size_t last = (size_t)set->max_frequency;
    size_t at = 0;
    for (size_t i = 0; i < set->num; i++) {
        const int32_t l = set->vectors[i];
        for (int32_t m = 1; m <= l; m++, at++) {
            self->places[at] = (size_t)m * (2 * last + 1 - (size_t)m) / 2 + (size_t)l;
            self->labels[at].k[0] = l;
            self->labels[at].k[1] = m;
        }
    }
}

/* S(0) stands before the frequencies, and has no phase. */
static void list_frequencies(ps_homogeneity *self, const ps_frequencies *set) {
    for (size_t i = 0; i < set->num; i++) {
        self->places[i] = i;
        for (unsigned axis = 0; axis < set->dimension; axis++) {
            self->labels[i].k[axis] = set->vectors[i * set->dimension + axis];
        }
    }
}

/* Once the frequencies are known. */
static pspec_status list_tests(ps_homogeneity *self, ps_error *error) {
    const ps_frequencies *const set = frequencies_of(self);
    const bool on_sphere = set->kind == PS_FREQUENCIES_DEGREES;
    self->num_places = on_sphere ? count_orders(set) : set->num;
    const size_t num_tests = self->num_parts * 2 * self->num_places;
    PS_TRY(PS_NEW(&self->places, self->num_places, "phases", error));
    PS_TRY(PS_NEW(&self->labels, num_tests, "phases", error));
    PS_TRY(PS_NEW(&self->tests, num_tests, "phases", error));
    (on_sphere ? list_orders : list_frequencies)(self, set);
    for (size_t i = 0; i < num_tests; i++) {
        self->labels[i] = self->labels[i % self->num_places];
        self->labels[i].is_product = i / self->num_places % 2 > 0;
        self->labels[i].is_turned = i / self->num_places / 2 > 0;
    }
    return PSPEC_OK;
}

/* ---- one part ---------------------------------------------------------------------------- */

/* What makes the products of a set. */
typedef struct products {
    ps_shift_products *shifts; /* on the torus */
    ps_turn_products *turns;   /* on the sphere */
    size_t num;                /* complex numbers of a set */
    size_t most_sets;          /* that are made together */
    double *values;            /* [most_sets][num][2] */
    double error;              /* of an amplitude, a multiple of its root mean square */
} products;

static void free_products(products *made) {
    ps_shift_products_destroy(made->shifts);
    ps_turn_products_destroy(made->turns);
    free(made->values);
}

static pspec_status begin_products(products *made, const ps_homogeneity *self, ps_error *error) {
    const double margin = 10; /* the error is a root mean square */
    const ps_frequencies *const set = frequencies_of(self);
    const ps_spectrum *const spectrum = ps_power_job_spectrum(self->job);
    made->error = margin * ps_power_job_accuracy(self->job)->error *
                  fabs(spectrum->mean_weight_sum) / sqrt(spectrum->sample_size.mean);
    made->num = ps_num_coefficients_at(set) / 2;
    made->most_sets = set->kind == PS_FREQUENCIES_DEGREES ? PS_TURN_SETS : 1;
    PS_TRY(PS_NEW(&made->values, made->most_sets * 2 * made->num, "sums of products", error));
    return set->kind == PS_FREQUENCIES_DEGREES
               ? ps_turn_products_create(&made->turns, set->max_frequency, error)
               : ps_shift_products_create(&made->shifts, set, error);
}

/* A sum of products S conj S' has the error of S and S' times the root of the sum of squares. */
static double error_of_products(const products *made, const double *amplitudes) {
    double sum = 0;
    for (size_t i = 0; i < 2 * made->num; i++) {
        sum += amplitudes[i] * amplitudes[i];
    }
    return 2 * made->error * sqrt(2 * sum);
}

static void add_set(const ps_homogeneity *self, const products *made, const double *amplitudes,
                    const double *values, ps_phase_test *tests) {
    const double error = error_of_products(made, amplitudes);
    for (size_t i = 0; i < self->num_places; i++) {
        const size_t place = self->places[i];
        ps_phase_test_add(&tests[i], amplitudes + 2 * place, made->error);
        ps_phase_test_add(&tests[self->num_places + i], values + 2 * place, error);
    }
}

static pspec_status add_sets(const ps_homogeneity *self, products *made, ps_phase_test *tests,
                             const ps_answer_hooks *hooks, ps_error *error) {
    size_t num_sets = 0;
    const double *const kept = ps_power_job_amplitudes(self->job, &num_sets);
    const size_t before = made->turns != NULL ? 0 : 1; /* S(0) */
    const size_t stride = 2 * (before + made->num);
    for (size_t first = 0; first < num_sets; first += made->most_sets) {
        const double *const amplitudes = kept + first * stride + 2 * before;
        const size_t left = num_sets - first;
        const size_t num = left < made->most_sets ? left : made->most_sets;
        PS_TRY(ps_watch_tell(&hooks->watch, "phases", first, num_sets, NULL, error));
        if (made->turns != NULL) {
            ps_turn_products_run(made->turns, num, amplitudes, made->values);
        } else {
            ps_shift_products_run(made->shifts, amplitudes, made->values);
        }
        for (size_t r = 0; r < num; r++) {
            add_set(self, made, amplitudes + r * stride, made->values + r * 2 * made->num, tests);
        }
    }
    return PSPEC_OK;
}

/* The job of the part before is not needed any more. */
static pspec_status run_part(ps_homogeneity *self, size_t part, const ps_answer_hooks *hooks,
                             ps_error *error) {
    ps_power_question *const question = &self->list.questions[0];
    products made = {0};
    ps_power_job_destroy(self->job);
    self->job = NULL;
    question->is_turned = part > 0;
    PS_TRY(ps_spectra_run_one(&self->job, question, hooks, error));
    if (part == 0) {
        PS_TRY(list_tests(self, error));
        PS_TRY(check_realizations(&self->own, ps_power_job_spectrum(self->job)->num_realizations,
                                  self->num_parts * 2 * self->num_places, error));
    }
    pspec_status status = begin_products(&made, self, error);
    if (status == PSPEC_OK) {
        ps_phase_test *const tests = self->tests + part * 2 * self->num_places;
        status = add_sets(self, &made, tests, hooks, error);
    }
    free_products(&made);
    return status;
}

pspec_status ps_homogeneity_compute(ps_homogeneity **out, const ps_request *request,
                                    const ps_answer_hooks *hooks, ps_error *error) {
    PS_TRY(PS_NEW(out, 1, "a check of homogeneity", error));
    ps_homogeneity *const self = *out;
    PS_TRY(ask(self, request, error));
    for (size_t part = 0; part < self->num_parts; part++) {
        PS_TRY(run_part(self, part, hooks, error));
    }
    return ps_phase_tests_judge(self->tests, self->num_parts * 2 * self->num_places,
                                self->own.false_alarm_rate, error);
}

/* ---- the answer -------------------------------------------------------------------------- */

static size_t find_worst(const ps_homogeneity_results *results) {
    size_t worst = 0;
    for (size_t i = 1; i < results->num_tests; i++) {
        worst = results->tests[i].p_value < results->tests[worst].p_value ? i : worst;
    }
    return worst;
}

static pspec_status judge(const ps_homogeneity *self, const ps_homogeneity_results *results,
                          ps_error *error) {
    const ps_frequencies *const set = frequencies_of(self);
    const size_t worst = find_worst(results);
    ps_text label = {0};
    if (results->num_different == 0) {
        return PSPEC_OK;
    }
    pspec_status status = ps_phase_label_write(&results->labels[worst], set, &label, error);
    if (status == PSPEC_OK) {
        status = ps_fail(error, PSPEC_ERROR_CHECK,
                         "not homogeneous: %s change the law of these realizations; %zu of %zu "
                         "phases are not uniform at a false alarm rate of %g, first of all %s "
                         "(their mean has the length %.3g, p = %.2g)",
                         set->kind == PS_FREQUENCIES_DEGREES ? "rotations" : "translations",
                         results->num_different, results->num_tests, self->own.false_alarm_rate,
                         ps_text_string(&label), results->tests[worst].resultant,
                         results->tests[worst].p_value);
    }
    ps_text_free(&label);
    return status;
}

pspec_status ps_homogeneity_tabulate(ps_answer *out, const ps_homogeneity *computed,
                                     ps_error *error) {
    ps_homogeneity_results results = {.job = computed->job,
                                      .num_tests = computed->num_parts * 2 * computed->num_places,
                                      .labels = computed->labels,
                                      .tests = computed->tests};
    for (size_t i = 0; i < results.num_tests; i++) {
        results.num_different += results.tests[i].differs;
    }
    PS_TRY(ps_homogeneity_table(&out->table, &computed->own, &results, error));
    const pspec_status status = judge(computed, &results, error);
    if (status != PSPEC_ERROR_CHECK) {
        return status;
    }
    out->verdict = *error;
    *error = (ps_error){0};
    return PSPEC_OK;
}
