#include "cli/jobs.h"

#include "cli/command.h"
#include "cli/output_check.h"
#include "cli/picture.h"
#include "report/spectrum_plot.h"
#include "store/figures_file.h"

#include <stdio.h>

void ps_print_profile(const ps_profile_row *rows, size_t num_rows) {
    fprintf(stderr, "%-24s %9s %12s %10s %8s\n", "kernel", "launches", "seconds", "GFLOP/s",
            "GB/s");
    for (size_t i = 0; i < num_rows; i++) {
        const double giga = 1e-9;
        const double seconds = rows[i].seconds > 0 ? rows[i].seconds : giga; /* a clock's tick */
        fprintf(stderr, "%-24s %9llu %12.6f %10.1f %8.1f\n", rows[i].kernel,
                (unsigned long long)rows[i].launches, rows[i].seconds,
                rows[i].flops / seconds * giga, rows[i].bytes / seconds * giga);
    }
}

void ps_print_plan(const ps_plan *plan) {
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        fprintf(stderr, "%s (%s): %s\n", candidate->engine->name,
                ps_precision_name(candidate->precision), candidate->reason);
    }
}

/* Lattices of many dimensions, and degrees, which cost their square, are more than people think. */
static void warn_of_hours(const ps_power_job *job, unsigned offers) {
    const double hour = 3600;    /* seconds */
    enum { FEW_DIMENSIONS = 3 }; /* where K has a default, and time is a matter of realizations */
    const ps_candidate *chosen = ps_power_job_plan(job)->chosen;
    const ps_frequencies *set = ps_power_job_problem(job)->frequencies;
    if (chosen == NULL || chosen->seconds <= hour) {
        return;
    }
    const double hours = chosen->seconds / hour;
    if (set->kind == PS_FREQUENCIES_DEGREES) {
        fprintf(stderr,
                "pointspec: %s will take about %.2g hours to degree %d; fewer degrees "
                "(--max-degree) take less\n",
                chosen->engine->name, hours, (int)set->max_frequency);
    } else if (set->kind != PS_FREQUENCIES_LIST && set->dimension > FEW_DIMENSIONS) {
        fprintf(stderr, "pointspec: %.3g frequencies will take about %.2g hours%s\n",
                (double)set->num, hours,
                offers & PS_OFFER_RINGS ? "; a random subset of every ring (--per-ring) takes less"
                                        : "");
    }
}

static void warn_of_standard_error(const ps_power_job *job, double standard_error) {
    const ps_sequential_look *look = ps_power_job_look(job);
    if (look != NULL && look->corrected > standard_error) {
        fprintf(stderr,
                "pointspec: the standard error %.3g was not reached in %llu realizations: it is "
                "%.3g of bin %lld\n",
                standard_error, (unsigned long long)ps_power_job_spectrum(job)->num_realizations,
                look->corrected, (long long)look->bin);
    }
}

static pspec_status run_job(const ps_request *arguments, const ps_power_question *question,
                            ps_power_job **job, ps_error *error) {
    PS_TRY(ps_power_job_create(job, question, error));
    if (!arguments->quiet) {
        warn_of_hours(*job, question->constraints.offers);
    }
    if (arguments->verbose) {
        ps_print_plan(ps_power_job_plan(*job));
    }
    return ps_power_job_run(*job, error);
}

pspec_status ps_jobs_run_one(const ps_request *arguments, ps_power_question *question,
                             const ps_answer_hooks *hooks, ps_power_job **job, ps_error *error) {
    question->watch = hooks->watch;
    question->open_device = hooks->device;
    PS_TRY(run_job(arguments, question, job, error));
    if (!arguments->quiet) {
        warn_of_standard_error(*job, arguments->standard_error);
    }
    if (arguments->profile) {
        size_t num_rows = 0;
        const ps_profile_row *const rows = ps_power_job_profile(*job, &num_rows);
        ps_print_profile(rows, num_rows);
    }
    return PSPEC_OK;
}

pspec_status ps_jobs_open_device(ps_device **out, const ps_request *arguments,
                                 const ps_plan_constraints *constraints, size_t num_jobs,
                                 ps_error *error) {
    *out = NULL;
    return num_jobs > 1 && !arguments->profile && ps_plan_may_need_device(constraints)
               ? ps_figures_open_device(out, arguments->device, false, arguments->cache_folder,
                                        error)
               : PSPEC_OK;
}

static pspec_status run_shown(const ps_request *arguments, ps_power_question *question,
                              ps_device *device, ps_power_job **job, ps_error *error) {
    ps_progress *const progress = ps_progress_begin(arguments, "realizations");
    const ps_answer_hooks hooks = {.watch = {ps_progress_tell, progress}, .device = device};
    const pspec_status status = ps_jobs_run_one(arguments, question, &hooks, job, error);
    ps_progress_end(progress);
    return status;
}

static pspec_status check_outputs(const ps_request *arguments, ps_table_format *format,
                                  ps_error *error) {
    PS_TRY(ps_picture_check(arguments, error));
    PS_TRY(ps_table_choose_format(format, arguments->format, arguments->output, error));
    return ps_outputs_check(arguments, true, error);
}

static pspec_status write_results(const ps_request *arguments, const ps_power_job *const *jobs,
                                  size_t num, const ps_jobs_output *output, ps_table_format format,
                                  ps_error *error) {
    ps_table *table = NULL;
    if (output->write_others != NULL) {
        PS_TRY(output->write_others(arguments, jobs, error));
    }
    PS_TRY(output->make_table(&table, arguments, jobs, num, error));
    pspec_status status =
        ps_table_write(table, arguments->output != NULL ? arguments->output : "-", format, error);
    ps_table_destroy(table);
    if (status == PSPEC_OK && arguments->plot != NULL) {
        status = ps_picture_settle(arguments, ps_spectrum_plot(arguments, jobs, num, error), error);
    }
    return status;
}

pspec_status ps_jobs_run(const ps_request *arguments, ps_question_kind kind,
                         const ps_jobs_output *output, ps_error *error) {
    ps_power_job *jobs[PS_MAX_SAMPLERS] = {NULL};
    ps_question_list list;
    ps_table_format format = PS_FORMAT_CSV;
    pspec_status status = PSPEC_OK;
    PS_TRY(check_outputs(arguments, &format, error));
    ps_device *device = NULL;
    PS_TRY(ps_questions_make(&list, arguments, kind, error));
    PS_TRY(
        ps_jobs_open_device(&device, arguments, &list.questions[0].constraints, list.num, error));
    for (size_t i = 0; i < list.num; i++) {
        PS_TRY_OUT(status, run_shown(arguments, &list.questions[i], device, &jobs[i], error));
    }
    status = write_results(arguments, (const ps_power_job *const *)jobs, list.num, output, format,
                           error);
out:
    for (size_t i = 0; i < list.num; i++) {
        ps_power_job_destroy(jobs[i]);
    }
    ps_device_close(device);
    return status;
}
