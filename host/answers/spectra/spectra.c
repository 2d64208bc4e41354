#include "answers/spectra/spectra.h"

#include "base/memory.h"
#include "jobs/spectrum/power_phases.h"
#include "store/figures_file.h"

#include <stdlib.h>
#include <string.h>

const char *const ps_spectra_summary[] = {
    "points",     "points_smallest", "points_largest", "realizations",
    "weight_sum", "predicted_error", "self_check",     NULL};

/* ---- warnings ------------------------------------------------------------------------------ */

/* Lattices of many dimensions, and degrees, which cost their square, are more than people think. */
static void warn_of_hours(const ps_power_job *job, unsigned offers, const ps_answer_hooks *hooks) {
    const double hour = 3600;    /* seconds */
    enum { FEW_DIMENSIONS = 3 }; /* where K has a default, and time is a matter of realizations */
    const ps_candidate *chosen = job->plan.chosen;
    const ps_frequencies *set = job->problem.frequencies;
    if (chosen == NULL || chosen->seconds <= hour) {
        return;
    }
    const double hours = chosen->seconds / hour;
    if (set->kind == PS_FREQUENCIES_DEGREES) {
        ps_answer_warn(hooks,
                       "%s will take about %.2g hours to degree %d; fewer degrees (--max-degree) "
                       "take less",
                       chosen->engine->name, hours, (int)set->max_frequency);
    } else if (set->kind != PS_FREQUENCIES_LIST && set->dimension > FEW_DIMENSIONS) {
        ps_answer_warn(
            hooks, "%.3g frequencies will take about %.2g hours%s", (double)set->num, hours,
            offers & PS_OFFER_RINGS ? "; a random subset of every ring (--per-ring) takes less"
                                    : "");
    }
}

static void warn_of_standard_error(const ps_power_job *job, double standard_error,
                                   const ps_answer_hooks *hooks) {
    const ps_sequential_look *look = &job->look;
    if (job->has_look && look->corrected > standard_error) {
        ps_answer_warn(
            hooks,
            "the standard error %.3g was not reached in %llu realizations: it is %.3g of bin %lld",
            standard_error, (unsigned long long)job->spectrum.num_realizations, look->corrected,
            (long long)look->bin);
    }
}

/* Nobody plans the range again: the other ranges have the same plan. */
static void warn_of_tolerance(const ps_power_job *job, const ps_answer_hooks *hooks) {
    if (job->runner.is_part && !hooks->is_shared &&
        !(job->runner.accuracy.error <= job->problem.tolerance)) {
        ps_answer_warn(hooks,
                       "the powers of these realizations need a more exact plan: the error is "
                       "%.2g, above the tolerance %g, and merge will refuse this range; give all "
                       "ranges a smaller --tol, or --precision double",
                       job->runner.accuracy.error, job->problem.tolerance);
    }
}

/* ---- jobs ---------------------------------------------------------------------------------- */

static pspec_status get_ready(ps_power_job **job, const ps_power_question *question,
                              ps_error *error) {
    bool is_ready = false;
    if (*job != NULL) {
        PS_TRY(ps_power_job_renew(*job, question, &is_ready, error));
    }
    if (is_ready) {
        return PSPEC_OK;
    }
    ps_power_job_destroy(*job);
    return ps_power_job_create(job, question, error);
}

pspec_status ps_spectra_run_one(ps_power_job **job, ps_power_question *question,
                                const ps_answer_hooks *hooks, ps_error *error) {
    ps_answer_begin_job(hooks, &question->watch, &question->open_device);
    PS_TRY(get_ready(job, question, error));
    warn_of_hours(*job, question->limits.constraints.offers, hooks);
    if (hooks->tell_plan != NULL) {
        hooks->tell_plan(hooks->payload, &(*job)->plan);
    }
    PS_TRY(ps_power_job_run(*job, error));
    warn_of_standard_error(*job, question->accuracy.standard_error, hooks);
    warn_of_tolerance(*job, hooks);
    ps_answer_warn_of(hooks, ps_source_trouble((*job)->sets.source));
    ps_answer_tell_profile(hooks, (*job)->device);
    return PSPEC_OK;
}

pspec_status ps_answer_open_device(ps_device **out, const ps_request *request,
                                   const ps_plan_constraints *constraints, size_t num_jobs,
                                   const ps_answer_hooks *hooks, ps_error *error) {
    *out = NULL;
    return num_jobs > 1 && hooks->device == NULL && !request->limits.profile &&
                   ps_plan_may_need_device(constraints)
               ? ps_figures_open_device(out, request->limits.device, false,
                                        request->limits.cache_folder, error)
               : PSPEC_OK;
}

static void destroy_jobs(ps_spectra *self) {
    for (size_t i = 0; i < self->num_jobs; i++) {
        ps_power_job_destroy(self->jobs[i]);
    }
    free(self->jobs);
    self->jobs = NULL;
    self->num_jobs = 0;
}

/* The questions, with the jobs that have answered the same of other sets, if there are as many. */
static pspec_status begin(ps_spectra *self, const ps_request *request, ps_question_kind kind,
                          ps_error *error) {
    ps_questions_free(&self->list);
    PS_TRY(ps_questions_make(&self->list, request, kind, error));
    if (self->num_jobs != self->list.num) {
        destroy_jobs(self);
        PS_TRY(PS_NEW(&self->jobs, self->list.num, "jobs", error));
        self->num_jobs = self->list.num;
    }
    return PSPEC_OK;
}

pspec_status ps_spectra_compute(void **out, const ps_request *request, ps_question_kind kind,
                                const ps_answer_hooks *hooks, ps_error *error) {
    PS_TRY(*out == NULL ? ps_allocate(out, 1, sizeof(ps_spectra), "jobs", error) : PSPEC_OK);
    ps_spectra *const spectra = *out;
    PS_TRY(begin(spectra, request, kind, error));
    ps_question_list *const list = &spectra->list;
    if (spectra->device == NULL) {
        PS_TRY(ps_answer_open_device(&spectra->device, request,
                                     &list->questions[0].limits.constraints, list->num, hooks,
                                     error));
    }
    for (size_t i = 0; i < list->num; i++) {
        list->questions[i].open_device = spectra->device;
        PS_TRY(ps_spectra_run_one(&spectra->jobs[i], &list->questions[i], hooks, error));
    }
    return PSPEC_OK;
}

void ps_spectra_discard(void *computed) {
    ps_spectra *const spectra = computed;
    if (spectra == NULL) {
        return;
    }
    destroy_jobs(spectra);
    ps_questions_free(&spectra->list);
    ps_device_close(spectra->device);
    free(spectra);
}

/* ---- before and after the work --------------------------------------------------------------- */

pspec_status ps_spectra_check(const ps_request *request, ps_question_kind kind, ps_error *error) {
    ps_question_list list;
    const pspec_status status = ps_questions_make(&list, request, kind, error);
    ps_questions_free(&list);
    return status;
}

pspec_status ps_spectra_plan_job(ps_planner *planner, const ps_request *request,
                                 const ps_power_job *job, const ps_plan_more *more, size_t index,
                                 ps_error *error) {
    ps_phases phases = ps_plan_table_begin_phases(planner);
    const double repeats = ps_power_job_phases(job, &phases);
    if (more != NULL) {
        more->add(more->job, &phases);
    }
    ps_plan_table_add_picture(&phases, request);
    const ps_planned planned = {.problem = &job->problem,
                                .needs = &job->needs,
                                .limits = ps_device_get_limits(job->device),
                                .plan = &job->plan,
                                .phases = &phases,
                                .repeats = repeats};
    return ps_plan_table_add_job(planner, request, &planned, index, error);
}

pspec_status ps_spectra_plan_list(ps_planner *planner, const ps_request *request,
                                  ps_question_list *list, ps_error *error) {
    for (size_t i = 0; i < list->num; i++) {
        ps_power_job *job = NULL;
        ps_power_question *const question = &list->questions[i];
        PS_TRY(ps_plan_table_begin_question(planner, request, i, &question->limits.constraints,
                                            &question->open_device, &question->may_lack_device,
                                            error));
        PS_TRY(ps_power_job_create(&job, question, error));
        ps_power_job_rate_skips(job);
        const pspec_status status = ps_spectra_plan_job(planner, request, job, NULL, i, error);
        ps_power_job_destroy(job);
        PS_TRY(status);
    }
    return PSPEC_OK;
}

pspec_status ps_spectra_plan(ps_planner *planner, const ps_request *request, ps_question_kind kind,
                             ps_error *error) {
    ps_question_list list;
    pspec_status status = ps_questions_make(&list, request, kind, error);
    if (status == PSPEC_OK) {
        status = ps_spectra_plan_list(planner, request, &list, error);
    }
    ps_questions_free(&list);
    return status;
}

/* For its picture. */
static pspec_status add_first_set(ps_table *table, const ps_point_set *set, ps_error *error) {
    const size_t shape[] = {set->num_points, set->dimension};
    ps_npy_array array;
    PS_TRY(ps_npy_make_array(&array, 2, shape, false, error));
    memcpy(array.data, set->points, array.num * sizeof *array.data);
    return ps_table_add_array(table, "first_set", false, &array, error);
}

pspec_status ps_spectra_tabulate(ps_answer *out, const void *computed, const ps_request *request,
                                 const ps_spectra_table *kind, ps_error *error) {
    const ps_spectra *const spectra = computed;
    const ps_point_set *const first = &spectra->jobs[0]->sets.first;
    const size_t num = spectra->list.num;
    ps_measured *all = NULL;
    pspec_status status =
        ps_measured_of_jobs(&all, request, (const ps_power_job *const *)spectra->jobs, num, error);
    if (status == PSPEC_OK) {
        status = ps_spectra_make_table(&out->table, kind, request, all, num, error);
    }
    ps_measured_free(all, num);
    if (status == PSPEC_OK && first->num_points > 0) {
        status = add_first_set(out->table, first, error);
    }
    return status == PSPEC_OK ? ps_spectra_add_state(out->table, spectra, request, error) : status;
}
