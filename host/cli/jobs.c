#include "cli/jobs.h"

#include "cli/output_check.h"
#include "io/plot.h"

#include <stdio.h>

static int on_progress(uint64_t done, uint64_t total, void *payload) {
    ps_progress_update(payload, done, total);
    return ps_interrupted;
}

static void print_profile(const ps_power_job *job) {
    size_t num_rows = 0;
    const ps_profile_row *rows = ps_power_job_profile(job, &num_rows);
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

static void print_plan(const ps_power_job *job) {
    const ps_plan *plan = ps_power_job_plan(job);
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        fprintf(stderr, "%s (%s): %s\n", candidate->engine->name,
                ps_precision_name(candidate->precision), candidate->reason);
    }
}

/* Lattices of many dimensions are larger than people think. */
static void warn_of_hours(const ps_power_job *job) {
    const double hour = 3600;    /* seconds */
    enum { FEW_DIMENSIONS = 3 }; /* where K has a default, and time is a matter of realizations */
    const ps_candidate *chosen = ps_power_job_plan(job)->chosen;
    const ps_frequencies *set = ps_power_job_problem(job)->frequencies;
    if (chosen != NULL && chosen->seconds > hour && set->kind != PS_FREQUENCIES_LIST &&
        set->dimension > FEW_DIMENSIONS) {
        fprintf(stderr,
                "pointspec: %.3g frequencies will take about %.2g hours; a random subset of "
                "every ring (--per-ring) takes less\n",
                (double)set->num, chosen->seconds / hour);
    }
}

static pspec_status run_job(const ps_arguments *arguments, ps_power_question *question,
                            ps_power_job **job, ps_error *error) {
    ps_progress *progress = ps_progress_begin(arguments, "realizations");
    question->progress = on_progress;
    question->payload = progress;
    pspec_status status = ps_power_job_create(job, question, error);
    if (status == PSPEC_OK && !arguments->quiet) {
        warn_of_hours(*job);
    }
    if (status == PSPEC_OK && arguments->verbose) {
        print_plan(*job);
    }
    if (status == PSPEC_OK) {
        status = ps_power_job_run(*job, error);
    }
    ps_progress_end(progress);
    if (status == PSPEC_OK && arguments->profile) {
        print_profile(*job);
    }
    return status;
}

static pspec_status check_outputs(const ps_arguments *arguments, ps_table_format *format,
                                  ps_error *error) {
    if (arguments->plot != NULL && !ps_plot_is_supported(arguments->plot)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--plot draws .png, .svg and .pdf, not \"%s\"", arguments->plot);
    }
    PS_TRY(ps_table_choose_format(format, arguments->format, arguments->output, error));
    return ps_outputs_check(arguments, true, error);
}

pspec_status ps_jobs_run(const ps_arguments *arguments, ps_domain domain, ps_jobs_write write,
                         ps_error *error) {
    ps_power_job *jobs[PS_MAX_SAMPLERS] = {NULL};
    ps_question_list list;
    ps_table_format format = PS_FORMAT_CSV;
    pspec_status status = PSPEC_OK;
    PS_TRY(check_outputs(arguments, &format, error));
    PS_TRY(ps_questions_make(&list, arguments, domain, error));
    for (size_t i = 0; i < list.num; i++) {
        PS_TRY_OUT(status, run_job(arguments, &list.questions[i], &jobs[i], error));
    }
    status = write(arguments, (const ps_power_job *const *)jobs, list.num, format, error);
out:
    for (size_t i = 0; i < list.num; i++) {
        ps_power_job_destroy(jobs[i]);
    }
    return status;
}
