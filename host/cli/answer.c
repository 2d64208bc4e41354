#include "cli/answer.h"

#include "cli/command.h"
#include "cli/output_check.h"
#include "cli/picture.h"

#include <stdio.h>

/* ---- what is said meanwhile ------------------------------------------------------------------ */

/* Who hears of the work: a progress line for each sampler. */
typedef struct listener {
    const ps_request *arguments;
    const char *counted;
    ps_progress *progress;
} listener;

static int tell(const ps_watch_report *report, void *payload) {
    const listener *const ear = payload;
    return ps_progress_tell(report, ear->progress);
}

static void begin_line(void *payload) {
    listener *const ear = payload;
    ps_progress_end(ear->progress);
    ear->progress = ps_progress_begin(ear->arguments, ear->counted);
}

static void print_warning(void *payload, const char *sentence) {
    const listener *const ear = payload;
    ps_progress_hide(ear->progress);
    fprintf(stderr, "pointspec: %s\n", sentence);
}

static void print_plan(void *payload, const ps_plan *plan) {
    const listener *const ear = payload;
    ps_progress_hide(ear->progress);
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        fprintf(stderr, "%s (%s): %s\n", candidate->engine->name,
                ps_precision_name(candidate->precision), candidate->reason);
    }
}

static void print_profile(void *payload, const ps_profile_row *rows, size_t num_rows) {
    const listener *const ear = payload;
    ps_progress_hide(ear->progress);
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

static pspec_status compute_shown(void **computed, const ps_result_kind *kind,
                                  const ps_request *arguments, ps_error *error) {
    listener ear = {arguments, kind->counted, NULL};
    const ps_answer_hooks hooks = {.watch = {tell, &ear},
                                   .payload = &ear,
                                   .next = begin_line,
                                   .warn = arguments->quiet ? NULL : print_warning,
                                   .tell_plan = arguments->verbose ? print_plan : NULL,
                                   .tell_profile =
                                       arguments->limits.profile ? print_profile : NULL};
    const pspec_status status = kind->compute(computed, arguments, &hooks, error);
    ps_progress_end(ear.progress);
    return status;
}

/* ---- before and after ------------------------------------------------------------------------ */

static pspec_status check_outputs(const ps_result_kind *kind, const ps_request *arguments,
                                  ps_table_format *format, ps_error *error) {
    PS_TRY(ps_picture_check(arguments, error));
    PS_TRY(ps_table_choose_format(format, arguments->format, arguments->output, error));
    if (kind->has_verdict && *format == PS_FORMAT_NPY) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "verdicts are no numbers: .csv and .json, not .npy");
    }
    return ps_outputs_check(arguments, true, error);
}

static pspec_status write_table(const ps_result_kind *kind, const void *computed,
                                const ps_request *arguments, ps_table_format format,
                                ps_error *verdict, ps_error *error) {
    ps_answer answer = {0};
    pspec_status status = kind->tabulate(&answer, computed, arguments, error);
    if (status == PSPEC_OK) {
        status = ps_table_write(answer.table, arguments->output != NULL ? arguments->output : "-",
                                format, error);
    }
    *verdict = answer.verdict;
    ps_answer_free(&answer);
    return status;
}

static pspec_status write_all(const ps_result_kind *kind, const void *computed,
                              const ps_request *arguments, ps_table_format format,
                              ps_error *error) {
    ps_error verdict = {0};
    if (kind->write_others != NULL) {
        PS_TRY(kind->write_others(computed, arguments, error));
    }
    PS_TRY(write_table(kind, computed, arguments, format, &verdict, error));
    if (arguments->plot != NULL) {
        PS_TRY(ps_picture_settle(arguments, kind->draw(computed, arguments, error), error));
    }
    if (verdict.status != PSPEC_OK) {
        *error = verdict;
    }
    return verdict.status;
}

pspec_status ps_answer_print(const ps_result_kind *kind, const ps_request *arguments,
                             ps_error *error) {
    void *computed = NULL;
    ps_table_format format = PS_FORMAT_CSV;
    if (kind->check_arguments != NULL) {
        PS_TRY(kind->check_arguments(arguments, error));
    }
    PS_TRY(check_outputs(kind, arguments, &format, error));
    pspec_status status = compute_shown(&computed, kind, arguments, error);
    if (status == PSPEC_OK) {
        status = write_all(kind, computed, arguments, format, error);
    }
    kind->discard(computed);
    return status;
}
