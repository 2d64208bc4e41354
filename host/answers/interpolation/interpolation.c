/* Kernel interpolation of functions of the sphere: errors against numbers of points, and images. */
#include "answers/kept_rows.h"
#include "answers/ranges/row_ranges.h"
#include "answers/interpolation/interpolation.h"

#include "answers/spectra/spectra.h"
#include "base/memory.h"
#include "math/sobolev.h"
#include "request/point_source.h"

#include <stdlib.h>

_Static_assert((int)PS_MAX_INTEGRANDS <= (int)PS_SOBOLEV_MOST_SUMS, "all functions are one call");

static void release(ps_interpolation_list *list) {
    for (size_t i = 0; list->jobs != NULL && i < list->num; i++) {
        ps_interpolation_job_destroy(list->jobs[i]);
    }
    free(list->jobs);
    free(list->questions);
    free(list->requests);
    ps_file_lists_free(list->files, list->num);
    ps_panorama_free(&list->panorama);
    ps_device_close(list->device);
}

static void discard(void *computed) {
    ps_interpolation_list *const self = computed;
    if (self != NULL) {
        release(self);
        free(self);
    }
}

/* ---- question ------------------------------------------------------------------------------ */

static pspec_status check_arguments(const ps_request *request, ps_error *error) {
    if (request->num_integrands == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--integrand NAME is what is interpolated, as in --integrand "
                       "map:file=sky.hdr, and none was given");
    }
    if (request->reading.lift == PS_LIFT_TO_HEMISPHERE) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--lift hemisphere takes points to the hemisphere, and functions of the "
                       "whole sphere are interpolated; --lift sphere takes them there");
    }
    PS_TRY(ps_sources_check(request, "nothing to interpolate at", error));
    PS_TRY(ps_point_options_check(request, error));
    return ps_option_pairs_check(request, PS_COMMAND_interpolation, error);
}

static pspec_status check_sampler(const ps_sampler_request *sampler, const char *text,
                                  ps_error *error) {
    if (!ps_sampler_is_on_sphere(sampler)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--sampler %s makes points of the torus; " PS_LIFT_KEY
                       "=sphere takes them to directions",
                       text);
    }
    return !ps_sampler_is_on_hemisphere(sampler)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "--sampler %s makes points of the hemisphere, and functions of the whole "
                         "sphere are interpolated",
                         text);
}

/* NPZ has all arrays; of several numbers of points the picture is another. */
static bool wants_images(const ps_request *request) {
    const bool is_npz = request->wants_state;
    const bool is_drawn = request->plot != NULL && request->num_counts == 1;
    return request->wants_array || request->wants_picture || is_npz || is_drawn;
}

static pspec_status fill_question(ps_interpolation_list *self, size_t index,
                                  const ps_request *request, ps_error *error) {
    ps_interpolation_question *const out = &self->questions[index];
    const bool has_tolerance = request->is_given[PS_OPTION_TOLERANCE];
    *out = (ps_interpolation_question){.panorama = &self->panorama,
                                       .num_smoothness = request->num_smoothness,
                                       .smoothness = request->smoothness,
                                       .paths = self->files[index].paths,
                                       .num_paths = self->files[index].num,
                                       .point_options = ps_point_options_make(request),
                                       .residual = has_tolerance ? request->accuracy.tolerance : 0,
                                       .keeps_images = wants_images(request) &&
                                                       ps_interpolation_is_shown(request, index),
                                       .no_skip = request->accuracy.no_skip,
                                       .limits = request->limits};
    out->limits.checkpoint.part += (unsigned)index;
    out->point_options.domain = PS_DOMAIN_SPHERE;
    out->point_options.ignore_weights = true;
    if (out->num_paths > 0) {
        return PSPEC_OK;
    }
    out->sampler = &self->requests[index];
    out->num_realizations = ps_num_realizations_asked(request);
    PS_TRY(ps_sampler_request_read(&self->requests[index], request, index, error));
    PS_TRY(check_sampler(out->sampler, ps_request_sampler(request, index), error));
    return ps_sampler_request_resolve(&self->requests[index], request, error);
}

static pspec_status ask(ps_interpolation_list *self, const ps_request *request, ps_error *error) {
    const size_t num = ps_request_num_questions(request);
    PS_TRY(check_arguments(request, error));
    PS_TRY(PS_NEW(&self->questions, num, "questions", error));
    PS_TRY(PS_NEW(&self->requests, num, "questions", error));
    self->num = num;
    PS_TRY(ps_file_lists_make(&self->files, request, error));
    for (size_t i = 0; i < num; i++) {
        PS_TRY(fill_question(self, i, request, error));
    }
    return ps_panorama_make(&self->panorama, request->integrands_made, &request->integrands_given,
                            request->integrands, request->num_integrands, error);
}

static pspec_status check_question(const ps_request *request, ps_error *error) {
    ps_interpolation_list self = {0};
    const pspec_status status = ask(&self, request, error);
    release(&self);
    return status;
}

/* ---- plan ---------------------------------------------------------------------------------- */

static pspec_status plan_one(ps_planner *planner, const ps_request *request,
                             ps_interpolation_question *question, size_t index, ps_error *error) {
    ps_interpolation_job *job = NULL;
    ps_phases phases = ps_plan_table_begin_phases(planner);
    PS_TRY(ps_plan_table_begin_question(planner, request, index, &question->limits.constraints,
                                        &question->open_device, &question->may_lack_device, error));
    PS_TRY(ps_interpolation_job_create(&job, question, error));
    ps_interpolation_job_phases(job, &phases);
    ps_plan_table_add_picture(&phases, request);
    const bool is_dense = ps_interpolation_is_dense(question, job->first_points);
    const double bytes = (double)ps_interpolation_bytes(question, job->first_points);
    ps_interpolation_job_destroy(job);
    return ps_plan_table_add_host(planner, &phases, bytes,
                                  is_dense ? "a factor of the kernel matrix, in double precision"
                                           : "conjugate gradients, products in double precision",
                                  error);
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    ps_interpolation_list self = {0};
    pspec_status status = ask(&self, request, error);
    for (size_t i = 0; status == PSPEC_OK && i < self.num; i++) {
        status = plan_one(planner, request, &self.questions[i], i, error);
    }
    release(&self);
    return status;
}

/* ---- work ---------------------------------------------------------------------------------- */

static pspec_status run_one(ps_interpolation_list *self, size_t i, const ps_answer_hooks *hooks,
                            ps_error *error) {
    ps_interpolation_question *const question = &self->questions[i];
    question->open_device = self->device;
    ps_answer_begin_job(hooks, &question->watch, &question->open_device);
    PS_TRY(ps_interpolation_job_create(&self->jobs[i], question, error));
    ps_interpolation_job *const job = self->jobs[i];
    PS_TRY(ps_interpolation_job_run(job, error));
    ps_answer_tell_profile(hooks, job->device);
    ps_answer_warn_of(hooks, ps_source_trouble(job->sets.source));
    ps_interpolation_job_release(job);
    return PSPEC_OK;
}

/* The device is opened once, and where a number of points is large. */
static pspec_status open_device(ps_interpolation_list *self, const ps_request *request,
                                const ps_answer_hooks *hooks, ps_error *error) {
    size_t num_large = 0;
    for (size_t i = 0; i < self->num; i++) {
        const ps_sampler_request *const sampler = self->questions[i].sampler;
        num_large += sampler != NULL && !ps_interpolation_is_dense(&self->questions[i],
                                                                   ps_sampler_most_points(sampler));
    }
    return ps_kind_without_device(&ps_kind_interpolation,
                                  ps_answer_open_device(&self->device, request,
                                                        &request->limits.constraints, num_large,
                                                        hooks, error));
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    PS_TRY(ps_allocate(out, 1, sizeof(ps_interpolation_list), "an answer", error));
    ps_interpolation_list *const self = *out;
    PS_TRY(ask(self, request, error));
    PS_TRY(ps_panorama_fill(&self->panorama, error));
    PS_TRY(PS_NEW(&self->jobs, self->num, "jobs", error));
    PS_TRY(open_device(self, request, hooks, error));
    for (size_t i = 0; i < self->num; i++) {
        PS_TRY(run_one(self, i, hooks, error));
    }
    return PSPEC_OK;
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    return ps_interpolation_table(&out->table, computed, request, error);
}

/* ---- what tables mean ------------------------------------------------------------------------ */

static const char *const summary[] = {"points", "realizations", "engine", NULL};
static const ps_picture_kind pictures[] = {
    {.suffix = "-image",
     .make = ps_interpolation_figure,
     .dealing = PS_OF_SETS,
     .by = PS_BY_SCENE | PS_BY_COMMAND,
     .needs = PS_NEEDS_PICTURES,
     .arrays = {{"light", PS_FRAME_LIGHT}, {"image", PS_FRAME_LIGHT}}},
    {.suffix = "-rmse",
     .what = "error of interpolation",
     .make = ps_lines_figure,
     .dealing = PS_OF_COUNTS,
     .by = PS_BY_SCENE | PS_BY_COMMAND,
     .needs = PS_NEEDS_COUNTS,
     .panels = "integrand",
     .x = "points",
     .lines = {{.y = "rmse", .error = "rmse_error"}},
     .x_label = "points N",
     .y_label = "RMSE",
     .is_log_x = true,
     .is_log_y = true},
    {.make = NULL}};

static const ps_field_row own_fields[] = {
    {"integrand", "", PS_ENTRIES, 0, "", "a function that was interpolated"},
    {"integral", "", PS_ENTRIES, 0, "where it is known", "its integral over the sphere"},
    {"integrand_note", "", PS_ENTRIES, 0, "where there is something to say",
     "what else there is to know of it"},
    {"pixels", "", PS_ENTRY, 0, "", "width x height of the image at whose pixels errors are taken"},
    {"points", "", PS_COLUMN, 0, "", "N; of sets with different N their mean"},
    {"smoothness", "", PS_COLUMN, 0, "", "s of the kernel"},
    {"rmse", "", PS_COLUMN, 0, "",
     "root of the mean square error over the sphere, by the solid angles of the pixels, and over "
     "realizations"},
    {"rmse_error", "", PS_COLUMN, 0, "", "its standard error; missing of one realization"},
    {"largest_error", "", PS_COLUMN, 0, "", "the largest at the centre of any pixel"},
    {"norm", "", PS_COLUMN, 0, "",
     "root of the mean of f.alpha, the norm of the interpolant in its space"},
    {"residual", "", PS_COLUMN, 0, "",
     "the largest error at a point itself, over the largest value at points"},
    {"condition", "", PS_COLUMN, 0, "",
     "condition number of the kernel matrix, estimated; of conjugate gradients no less than this"},
    {"iterations", "", PS_COLUMN, 0, "", "of conjugate gradients, at most; 0 by a factor"},
    {"image", "", PS_ARRAY, 0, "NPZ, pictures, arrays",
     "interpolants of the first realization at all pixels, in the order of the rows of the largest "
     "number of points: images x height x width"},
    {"light", "", PS_ARRAY, 0, "NPZ, pictures, arrays",
     "the functions at the same pixels: integrands x height x width"},
    {.name = NULL}};

static const ps_field_row *const fields[] = {
    ps_fields_asked,     ps_fields_points,   own_fields, ps_fields_ranges,
    ps_fields_kept_rows, ps_fields_computed, NULL};

static const ps_compared_field compared[] = {{"rmse", "rmse_error", false, ps_compared_rule_bound},
                                             {.value = NULL}};

const ps_kind ps_kind_interpolation = {
    .name = "interpolation",
    .purpose = "errors of kernel interpolation on the sphere, and interpolated maps",
    .usage = "interpolation --integrand map:file=FILE [options] --sampler NAME | interpolation "
             "--integrand map:file=FILE [options] FILE...",
    .description =
        "Takes the values of a function of the sphere at the points of a set, interpolates them "
        "by the kernel of the Sobolev space H^S, f^(u) = sum_i alpha_i K(u, u_i) with K alpha = "
        "f, and prints the root of the mean square of f^ - f over the pixels of an image of all "
        "directions, that of the map, else 512 x 256. Up to 4096 points K is factored; beyond, "
        "conjugate gradients solve the equations without storing it.",
    .examples = {"echo 1,0,1,0 >light.txt; pointspec interpolation --integrand "
                 "coefficients:file=light.txt --sampler fibonacci -n 64..256",
                 "echo 2,0,1,0 >light.txt; pointspec interpolation --integrand "
                 "coefficients:file=light.txt --sampler white-sphere -n 100 -m 4 --smoothness "
                 "1.1,1.5,1.9"},
    .takes = PS_COMMAND_BIT(interpolation),
    .samples = PS_DOMAIN_SPHERE,
    .counted = "realizations",
    .may_lack_device = true,
    .has_images = true,
    .has_arrays = true,
    .check_arguments = check_arguments,
    .check_question = check_question,
    .plan = plan,
    .look_at_shares = ps_answer_look_at_rows,
    .merge = ps_row_ranges_merge,
    .compute = compute,
    .tabulate = tabulate,
    .discard = discard,
    .fields = fields,
    .summary = summary,
    .has_few_rows = true,
    .pictures = pictures,
    .compared = compared,
};
