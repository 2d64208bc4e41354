#include "answers/homogeneity/homogeneity.h"

#include "answers/spectra/spectra.h"
#include "base/memory.h"
#include "request/options.h"

#include <math.h>
#include <stdlib.h>

/* On the sphere turns about the z axis and about the x axis, which make all rotations. */
enum { MOST_PARTS = 2 };

void ps_homogeneity_discard(ps_homogeneity *computed) {
    if (computed == NULL) {
        return;
    }
    ps_power_job_destroy(computed->job);
    ps_questions_free(&computed->list);
    ps_invariance_destroy(computed->invariance);
    free(computed->labels);
    free(computed->tests);
    free(computed);
}

/* ---- the question: amplitudes of every realization ------------------------------------------ */

/* Unless -m is given: enough to find what jitter of 256 points does to the products. */
enum { DEFAULT_REALIZATIONS = 128 };

/* Frequencies up to 2 N^(1/d): see spectra/phases/shift_products.h. */
static const double reach = 2;

/* What is asked with the defaults of this question. */
static ps_request request_of(const ps_request *arguments) {
    ps_request own = *arguments;
    if (!own.is_given[PS_OPTION_REALIZATIONS]) {
        own.num_realizations = DEFAULT_REALIZATIONS;
    }
    return own;
}

static pspec_status check_request(const ps_request *own, ps_error *error) {
    PS_TRY(ps_option_pairs_check(own, PS_COMMAND_check, error));
    PS_TRY(ps_request_check_one_count(own, "and sets of one are checked at a time", error));
    return own->num_sources <= 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "one sampler is checked at a time, but %zu were given", own->num_sources);
}

/* One question; it borrows from `own`. */
static pspec_status make_question(ps_question_list *out, const ps_request *own, ps_error *error) {
    bool on_sphere = false;
    PS_TRY(check_request(own, error));
    PS_TRY(ps_questions_find_domain(&on_sphere, own, error));
    PS_TRY(ps_option_domains_check(own, on_sphere, error));
    PS_TRY(ps_questions_make(out, own, on_sphere ? PS_QUESTION_ANGULAR : PS_QUESTION_POWER, error));
    ps_power_question *const question = &out->questions[0];
    question->harmonics = on_sphere ? PS_SPHERICAL_HARMONICS : PS_EXPONENTIALS;
    question->keeps_sets = true;
    question->wants_full_array = true;
    question->has_rings_of_box = false; /* phases are of the torus */
    question->reach = reach;
    question->limits.constraints.offers = 0;
    return PSPEC_OK;
}

/* ---- before the work --------------------------------------------------------------------- */

static pspec_status check_realizations(const ps_homogeneity *self, uint64_t num, ps_error *error) {
    const double rate = self->own.false_alarm_rate;
    const uint64_t least = ps_phase_tests_least(self->num_tests, rate);
    return num >= least
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "%llu realization%s cannot tell: among %zu phases even equal ones would "
                         "not be an alarm at a rate of %g; at least %llu realizations are needed",
                         (unsigned long long)num, num == 1 ? "" : "s", self->num_tests, rate,
                         (unsigned long long)least);
}

/* Of a sampler everything is known that the number of phases takes, and too few realizations are
 * refused before hours of work. Of files it is known when they have been read. */
static pspec_status ask(ps_homogeneity *self, const ps_request *request, ps_error *error) {
    self->own = request_of(request);
    PS_TRY(make_question(&self->list, &self->own, error));
    const ps_power_question *const question = &self->list.questions[0];
    self->num_parts = question->on_sphere ? MOST_PARTS : 1;
    if (question->sampler == NULL) {
        return PSPEC_OK;
    }
    ps_frequencies set = {0};
    PS_TRY(ps_power_frequencies(&set, question, question->sampler->dimension,
                                (size_t)question->sampler->num_points, &(ps_box){0}, error));
    self->num_tests = self->num_parts * ps_invariance_count(&set);
    return check_realizations(self, self->own.num_realizations, error);
}

pspec_status ps_homogeneity_check(const ps_request *request, ps_error *error) {
    ps_homogeneity self = {0};
    const pspec_status status = ask(&self, request, error);
    ps_questions_free(&self.list);
    return status;
}

pspec_status ps_homogeneity_plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    ps_homogeneity self = {0};
    pspec_status status = ask(&self, request, error);
    for (size_t part = 0; status == PSPEC_OK && part < self.num_parts; part++) {
        self.list.questions[0].is_turned = part > 0;
        status = ps_spectra_plan_list(planner, &self.own, &self.list, error);
    }
    ps_questions_free(&self.list);
    return status;
}

/* ---- one part ---------------------------------------------------------------------------- */

static const ps_frequencies *frequencies_of(const ps_homogeneity *self) {
    return self->job->problem.frequencies;
}

/* Of an amplitude: the job's is a multiple of the root mean square. */
static double find_error(const ps_power_job *job) {
    const double margin = 10; /* the error is a root mean square */
    const ps_spectrum *const spectrum = &job->spectrum;
    return margin * job->runner.accuracy.error * fabs(spectrum->mean_weight_sum) /
           sqrt(spectrum->sample_size.mean);
}

static pspec_status begin_tests(ps_homogeneity *self, ps_error *error) {
    self->num_tests = self->num_parts * ps_invariance_count(frequencies_of(self));
    PS_TRY(check_realizations(self, self->job->spectrum.num_realizations, error));
    PS_TRY(PS_NEW(&self->labels, self->num_tests, "phases", error));
    return PS_NEW(&self->tests, self->num_tests, "phases", error);
}

static pspec_status add_sets(ps_homogeneity *self, ps_phase_test *tests,
                             const ps_answer_hooks *hooks, ps_error *error) {
    const size_t num_sets = self->job->num_kept;
    const size_t most = ps_invariance_sets(self->invariance);
    for (size_t first = 0; first < num_sets; first += most) {
        const size_t num = num_sets - first < most ? num_sets - first : most;
        PS_TRY(ps_watch_tell(&hooks->watch, "phases", first, num_sets, NULL, error));
        ps_invariance_add(self->invariance, num, self->job->kept, first, tests);
    }
    return PSPEC_OK;
}

/* The job of the part before is not needed any more. */
static pspec_status run_part(ps_homogeneity *self, size_t part, const ps_answer_hooks *hooks,
                             ps_error *error) {
    ps_power_question *const question = &self->list.questions[0];
    ps_power_job_destroy(self->job);
    ps_invariance_destroy(self->invariance);
    self->job = NULL;
    self->invariance = NULL;
    question->is_turned = part > 0;
    PS_TRY(ps_spectra_run_one(&self->job, question, hooks, error));
    if (part == 0) {
        PS_TRY(begin_tests(self, error));
    }
    const size_t first = part * (self->num_tests / self->num_parts);
    PS_TRY(ps_invariance_create(&self->invariance, frequencies_of(self), find_error(self->job),
                                error));
    ps_invariance_label(self->invariance, question->is_turned, self->labels + first);
    return add_sets(self, self->tests + first, hooks, error);
}

pspec_status ps_homogeneity_compute(ps_homogeneity **out, const ps_request *request,
                                    const ps_answer_hooks *hooks, ps_error *error) {
    PS_TRY(PS_NEW(out, 1, "a check of homogeneity", error));
    ps_homogeneity *const self = *out;
    PS_TRY(ask(self, request, error));
    for (size_t part = 0; part < self->num_parts; part++) {
        PS_TRY(run_part(self, part, hooks, error));
    }
    PS_TRY(ps_phase_tests_judge(self->tests, self->num_tests, self->own.false_alarm_rate, error));
    for (size_t i = 0; i < self->num_tests; i++) {
        self->num_different += self->tests[i].differs;
    }
    return PSPEC_OK;
}

/* ---- the answer -------------------------------------------------------------------------- */

static size_t find_worst(const ps_homogeneity *self) {
    size_t worst = 0;
    for (size_t i = 1; i < self->num_tests; i++) {
        worst = self->tests[i].p_value < self->tests[worst].p_value ? i : worst;
    }
    return worst;
}

static pspec_status judge(const ps_homogeneity *self, ps_error *error) {
    const ps_frequencies *const set = frequencies_of(self);
    const size_t worst = find_worst(self);
    ps_text label = {0};
    if (self->num_different == 0) {
        return PSPEC_OK;
    }
    pspec_status status = ps_phase_label_write(&self->labels[worst], set, &label, error);
    if (status == PSPEC_OK) {
        status = ps_fail(error, PSPEC_ERROR_CHECK,
                         "not homogeneous: %s change the law of these realizations; %zu of %zu "
                         "phases are not uniform at a false alarm rate of %g, first of all %s "
                         "(their mean has the length %.3g, p = %.2g)",
                         set->kind == PS_FREQUENCIES_DEGREES ? "rotations" : "translations",
                         self->num_different, self->num_tests, self->own.false_alarm_rate,
                         ps_text_string(&label), self->tests[worst].resultant,
                         self->tests[worst].p_value);
    }
    ps_text_free(&label);
    return status;
}

pspec_status ps_verdict_take(ps_answer *out, pspec_status judged, ps_error *error) {
    if (judged != PSPEC_ERROR_CHECK) {
        return judged;
    }
    out->verdict = *error;
    *error = (ps_error){0};
    return PSPEC_OK;
}

pspec_status ps_homogeneity_tabulate(ps_answer *out, const ps_homogeneity *computed,
                                     ps_error *error) {
    PS_TRY(ps_homogeneity_table(&out->table, computed, error));
    return ps_verdict_take(out, judge(computed, error), error);
}
