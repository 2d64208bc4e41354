/* How good point sets are: distances, capacity, discrepancies, what their spectra say. */
#include "answers/measure/measure.h"

#include "answers/kept_rows.h"
#include "answers/ranges/row_ranges.h"
#include "base/memory.h"
#include "jobs/spectrum/power_phases.h"

#include <stdlib.h>

static void discard(void *computed) {
    ps_measures_asked *const self = computed;
    if (self == NULL) {
        return;
    }
    for (size_t i = 0; self->results != NULL && i < self->list.num; i++) {
        ps_measure_result_free(&self->results[i]);
    }
    free(self->results);
    free(self->questions);
    ps_questions_free(&self->list);
    if (self->owns_device) {
        ps_device_close(self->device);
    }
    free(self);
}

/* ---- question ------------------------------------------------------------------------------ */

/* Oscillations end a normalized frequency of 5 behind the first peak, which is near 1. Of large
 * sets that would be more frequencies than take a second. */
static const double reach = 6.5, most_reached = 1 << 23;

/* Points of the hemisphere fill half of the sphere, and morphed ones what their lobe has. */
static pspec_status check_points(const ps_power_question *spectrum, const ps_request *request,
                                 size_t i, ps_error *error) {
    const bool is_half = spectrum->sampler != NULL ? ps_sampler_is_on_hemisphere(spectrum->sampler)
                                                   : request->reading.lift == PS_LIFT_TO_HEMISPHERE;
    return !is_half
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "measures are of the torus and the whole sphere, and points of %s are on "
                         "the hemisphere",
                         spectrum->sampler != NULL ? ps_request_sampler(request, i) : "the files");
}

static pspec_status make_one(ps_measures_asked *self, const ps_request *request, size_t i,
                             ps_error *error) {
    ps_power_question *const spectrum = &self->list.questions[i];
    ps_measure_question *const question = &self->questions[i];
    spectrum->bins_alone = true;
    spectrum->wants_full_array = false;
    spectrum->keeps_first = false;
    spectrum->reach = reach;
    spectrum->most_reached = most_reached;
    spectrum->limits.constraints.offers = 0;
    spectrum->point_options.ignore_weights = true;
    *question = (ps_measure_question){.spectrum = *spectrum,
                                      .checkpoint = spectrum->limits.checkpoint,
                                      .are_named = request->measures != NULL};
    question->checkpoint.part += (unsigned)self->list.num;
    PS_TRY(check_points(spectrum, request, i, error));
    return ps_measures_parse(&question->wanted, request->measures, error);
}

static pspec_status make_questions(ps_measures_asked *self, const ps_request *request,
                                   ps_error *error) {
    bool on_sphere = false;
    PS_TRY(ps_option_pairs_check(request, PS_COMMAND_measure, error));
    PS_TRY(ps_questions_find_domain(&on_sphere, request, error));
    PS_TRY(ps_option_domains_check(request, on_sphere, error));
    self->own = *request;
    self->own.range = (ps_realization_range){0};
    PS_TRY(ps_questions_make(&self->list, &self->own,
                             on_sphere ? PS_QUESTION_ANGULAR : PS_QUESTION_POWER, error));
    PS_TRY(PS_NEW(&self->questions, self->list.num, "questions", error));
    PS_TRY(PS_NEW(&self->results, self->list.num, "answers", error));
    for (size_t i = 0; i < self->list.num; i++) {
        PS_TRY(make_one(self, request, i, error));
    }
    return PSPEC_OK;
}

static pspec_status check_question(const ps_request *request, ps_error *error) {
    ps_measures_asked *self = NULL;
    PS_TRY(PS_NEW(&self, 1, "a question", error));
    const pspec_status status = make_questions(self, request, error);
    discard(self);
    return status;
}

/* A spectrum, and the sets themselves. */
static size_t count_jobs(const ps_request *request) {
    return 2 * ps_request_num_questions(request);
}

/* ---- plan ---------------------------------------------------------------------------------- */

static void add_measures(const void *question, ps_phases *phases) {
    ps_measure_phases(question, phases);
}

static pspec_status plan_sets(ps_planner *planner, const ps_measure_question *question,
                              ps_error *error) {
    ps_phases phases = ps_plan_table_begin_phases(planner);
    const ps_only_way way = {question->spectrum.open_device, "measures", 0,
                             "no measure that was named is of the spectrum"};
    ps_phases_start(&phases, NULL, NULL);
    ps_measure_phases(question, &phases);
    return ps_plan_table_add_only(planner, &phases, &way, error);
}

static pspec_status plan_one(ps_planner *planner, const ps_request *request,
                             ps_measure_question *question, size_t i, ps_error *error) {
    ps_power_job *job = NULL;
    ps_power_question *const spectrum = &question->spectrum;
    PS_TRY(ps_plan_table_begin_question(planner, request, i, &spectrum->limits.constraints,
                                        &spectrum->open_device, &spectrum->may_lack_device, error));
    if (!ps_measure_has_spectrum(question)) {
        return plan_sets(planner, question, error);
    }
    PS_TRY(ps_power_job_create(&job, spectrum, error));
    ps_power_job_rate_skips(job);
    const ps_plan_more more = {add_measures, question};
    const pspec_status status = ps_spectra_plan_job(planner, request, job, &more, i, error);
    ps_power_job_destroy(job);
    return status;
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    ps_measures_asked *self = NULL;
    PS_TRY(PS_NEW(&self, 1, "a plan", error));
    pspec_status status = make_questions(self, request, error);
    for (size_t i = 0; status == PSPEC_OK && i < self->list.num; i++) {
        status = plan_one(planner, request, &self->questions[i], i, error);
    }
    discard(self);
    return status;
}

/* ---- work ---------------------------------------------------------------------------------- */

static pspec_status open_device(ps_measures_asked *self, const ps_request *request, ps_device *open,
                                ps_error *error) {
    PS_TRY(ps_limits_open_device(&request->limits, open, false, &self->device, &self->owns_device,
                                 error));
    return self->device != NULL && ps_device_get_limits(self->device)->has_fp64
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_NO_DEVICE,
                         "measures need an OpenCL device with double precision");
}

static pspec_status run_one(ps_measures_asked *self, size_t i, const ps_answer_hooks *hooks,
                            ps_error *error) {
    ps_measure_question *const question = &self->questions[i];
    ps_device *unused = NULL;
    ps_answer_begin_job(hooks, &question->spectrum.watch, &unused);
    question->spectrum.open_device = self->device;
    PS_TRY(ps_measure_run(&self->results[i], question, error));
    const ps_mean *const coincident = &self->results[i].values[PS_MEASURE_COINCIDENT_POINTS];
    if (coincident->mean > 0) {
        ps_answer_warn(hooks,
                       "%.3g of %.6g points of a set are at the place of another one, in the mean",
                       coincident->mean, self->results[i].mean_points);
    }
    return PSPEC_OK;
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    PS_TRY(ps_allocate(out, 1, sizeof(ps_measures_asked), "an answer", error));
    ps_measures_asked *const self = *out;
    PS_TRY(make_questions(self, request, error));
    PS_TRY(open_device(self, request, hooks->device, error));
    for (size_t i = 0; i < self->list.num; i++) {
        PS_TRY(run_one(self, i, hooks, error));
    }
    ps_answer_tell_profile(hooks, self->device);
    return PSPEC_OK;
}

/* ---- what tables mean ------------------------------------------------------------------------ */

static const char *const summary[] = {"points", "points_smallest", "points_largest", "realizations",
                                      NULL};

static const ps_picture_kind pictures[] = {{.suffix = "-near",
                                            .what = "pair correlation and number variance",
                                            .make = ps_measure_figure,
                                            .dealing = PS_OF_CURVES,
                                            .by = PS_BY_SCENE | PS_BY_COMMAND,
                                            .needs = PS_NEEDS_NOTHING,
                                            .x_label = "distance r N^{1/d}",
                                            .y_label = "pair correlation g"},
                                           {.make = NULL}};

static const ps_field_row *const fields[] = {ps_fields_asked,
                                             ps_fields_points,
                                             ps_fields_measure,
                                             ps_fields_ranges,
                                             ps_fields_kept_rows,
                                             ps_fields_computed,
                                             NULL};

static const ps_compared_field compared[] = {
    {"value", "standard_error", false, ps_compared_rule_bound}, {.value = NULL}};

const ps_kind ps_kind_measure = {
    .name = "measure",
    .purpose = "quality of point sets: distances, capacity, discrepancies, what spectra say",
    .usage = "measure [options] --sampler NAME | measure [options] FILE...",
    .description =
        "Measures of point sets on the torus or the sphere, averaged over realizations, with "
        "standard errors: the least and the mean distance to a nearest neighbour relative to the "
        "densest packing, how far Voronoi cells are from equal areas, discrepancies in the square "
        "mean, on the sphere separation and Stolarsky's sum; of the mean spectrum the exponent at "
        "low frequencies, the hyperuniformity index, the peak, the effective Nyquist frequency and "
        "the oscillation. The pair correlation g(r) and the variance of the number of points in "
        "balls are arrays of -o FILE.npz, and the picture.",
    .examples = {"pointspec measure --sampler jittered --sampler poisson-disk -n 256 -m 10",
                 "pointspec sample --sampler fibonacci -n 256 | pointspec measure --domain sphere "
                 "--measures separation,cap_discrepancy -"},
    .takes = PS_COMMAND_BIT(measure),
    .samples = PS_DOMAIN_ANY,
    .counted = "realizations",
    .has_words = true,
    .check_question = check_question,
    .plan = plan,
    .count_jobs = count_jobs,
    .look_at_shares = ps_answer_look_at_rows,
    .merge = ps_row_ranges_merge,
    .compute = compute,
    .tabulate = ps_measure_tabulate,
    .discard = discard,
    .fields = fields,
    .summary = summary,
    .pictures = pictures,
    .has_few_rows = true,
    .row_name = "measure",
    .compared = compared,
};
