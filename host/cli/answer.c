#include "cli/answer.h"

#include "cli/command.h"

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

static void end_line(void *payload) {
    listener *const ear = payload;
    ps_progress_end(ear->progress);
    ear->progress = NULL;
}

static bool is_interrupted(void *payload) {
    (void)payload;
    return ps_interrupted != 0;
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

pspec_status ps_answer_print(const ps_result_kind *kind, const ps_request *arguments,
                             ps_error *error) {
    listener ear = {arguments, kind->counted, NULL};
    const ps_answer_hooks hooks = {.watch = {tell, &ear},
                                   .payload = &ear,
                                   .next = begin_line,
                                   .end = end_line,
                                   .warn = arguments->quiet ? NULL : print_warning,
                                   .tell_missing = print_warning,
                                   .is_interrupted = is_interrupted,
                                   .tell_plan = arguments->verbose ? print_plan : NULL,
                                   .tell_profile =
                                       arguments->limits.profile ? print_profile : NULL};
    ps_answer answer = {0};
    pspec_status status = ps_answer_produce(&answer, kind, arguments, &hooks, error);
    if (status == PSPEC_OK && answer.verdict.status != PSPEC_OK) {
        *error = answer.verdict;
        status = answer.verdict.status;
    }
    ps_answer_free(&answer);
    return status;
}
