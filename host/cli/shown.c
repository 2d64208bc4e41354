#include "answers/devices/devices_work.h"
#include "answers/ranks/ranks_work.h"
#include "cli/command.h"
#include "device/choice.h"
#include "fields/table_cells.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* ---- progress -------------------------------------------------------------------------------- */

/* A line for each sampler, or other phase. */
static void begin_line(void *payload) {
    ps_shown *const shown = payload;
    const bool shares_terminal = shown->is_streamed && shown->arguments->output != NULL &&
                                 strcmp(shown->arguments->output, "-") == 0 &&
                                 isatty(STDOUT_FILENO);
    ps_progress_end(shown->progress);
    shown->progress = shares_terminal ? NULL : ps_progress_begin(shown->arguments, shown->counted);
}

static void begin_question(void *payload, const char *result, size_t number, size_t num) {
    const ps_shown *const shown = payload;
    ps_progress_part(shown->progress, "%s, question %zu of %zu: ", result, number, num);
}

static void end_line(void *payload) {
    ps_shown *const shown = payload;
    ps_progress_end(shown->progress);
    shown->progress = NULL;
}

static int tell(const ps_watch_report *report, void *payload) {
    const ps_shown *const shown = payload;
    return ps_progress_tell(report, shown->progress);
}

static bool is_interrupted(void *payload) {
    (void)payload;
    return ps_interrupted != 0;
}

/* ---- sentences ------------------------------------------------------------------------------- */

static void hide(void *payload) {
    const ps_shown *const shown = payload;
    ps_progress_hide(shown->progress);
}

static void print_warning(void *payload, const char *sentence) {
    const ps_shown *const shown = payload;
    hide(payload);
    fprintf(stderr, "%s: %s\n", shown->speaker, sentence);
}

/* Names of files may hold anything. */
static void print_finding(void *payload, const char *word, const char *topic,
                          const char *sentence) {
    ps_shown *const shown = payload;
    printf("%-6s %-8s ", word, topic);
    ps_places_print(sentence, strlen(sentence), stdout);
    putchar('\n');
    shown->has_printed = true;
}

static void print_plan(void *payload, const ps_plan *plan) {
    hide(payload);
    for (size_t i = 0; i < plan->num_candidates; i++) {
        const ps_candidate *candidate = &plan->candidates[i];
        fprintf(stderr, "%s (%s): %s\n", candidate->engine->name,
                ps_precision_name(candidate->precision), candidate->reason);
    }
}

static void print_profile(void *payload, const ps_profile_row *rows, size_t num_rows) {
    hide(payload);
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

/* ---- all of it ------------------------------------------------------------------------------- */

ps_answer_hooks ps_shown_hooks(ps_shown *shown) {
    const ps_request *const arguments = shown->arguments;
    return (ps_answer_hooks){.watch = {tell, shown},
                             .payload = shown,
                             .next = begin_line,
                             .begin_question = begin_question,
                             .end = end_line,
                             .warn = arguments->quiet ? NULL : print_warning,
                             .tell_missing = print_warning,
                             .tell_finding = print_finding,
                             .is_interrupted = is_interrupted,
                             .tell_plan = arguments->verbose ? print_plan : NULL,
                             .tell_profile = arguments->limits.profile ? print_profile : NULL};
}

static pspec_status run(ps_answer *out, const ps_command *command, const ps_request *arguments,
                        const ps_answer_hooks *hooks, ps_error *error) {
    PS_TRY(command->run != NULL ? command->run(out, arguments, hooks, error)
                                : ps_devices_produce(out, command, arguments, hooks, error));
    if (command->makes_folder && out->table != NULL) { /* a rank that has a share has none */
        PS_TRY(ps_table_write(out->table, "-", PS_FORMAT_CSV, error));
    }
    if (out->verdict.status != PSPEC_OK) {
        *error = out->verdict;
    }
    return out->verdict.status;
}

/* Ranks of one machine share its devices. */
static pspec_status take_devices(ps_request *own, ps_text *selector, const ps_ranks *ranks,
                                 ps_error *error) {
    size_t num = 0;
    const size_t local = ps_ranks_find_local(&num);
    if (ranks == NULL || !ps_selector_is_list(own->limits.device)) {
        return PSPEC_OK;
    }
    PS_TRY(ps_devices_of_rank(selector, own->limits.device, local, num, error));
    own->limits.device = ps_text_string(selector);
    return PSPEC_OK;
}

static pspec_status run_share(ps_answer *out, const ps_command *command,
                              const ps_request *arguments, ps_ranks *ranks,
                              const ps_answer_hooks *hooks, ps_error *error) {
    ps_ranks_share share;
    ps_answer_hooks shared = *hooks;
    ps_ranks_begin_share(&share, ranks, &shared);
    const pspec_status status = run(out, command, arguments, &shared, error);
    return ps_ranks_end_share(&share, status, error);
}

/* Ranks but 0 are silent; NULL: the process is alone. */
static pspec_status run_ranks(ps_answer *out, const ps_command *command,
                              const ps_request *arguments, ps_ranks *ranks,
                              const ps_answer_hooks *hooks, ps_error *error) {
    const ps_answer_hooks silent = {.watch = {tell, hooks->payload},
                                    .payload = hooks->payload,
                                    .is_interrupted = is_interrupted};
    const bool is_first = ps_ranks_own(ranks) == 0;
    const ps_answer_hooks *const own = is_first ? hooks : &silent;
    ps_ranks_plan plan;
    ps_request request = *arguments;
    ps_text selector = {0};
    pspec_status status = take_devices(&request, &selector, ranks, error);
    status = ps_ranks_agree(ranks, status, error);
    if (status != PSPEC_OK) {
        ps_text_free(&selector);
        return status;
    }
    status = ps_ranks_plan_work(&plan, ranks, command, &request, own, error);
    if (status == PSPEC_OK && plan.job.is_shared) {
        status = ps_ranks_produce(out, ranks, &plan, command, &request, own, error);
    } else if (status == PSPEC_OK && plan.job.has_shares) {
        status = run_share(out, command, &request, ranks, own, error);
    } else if (status == PSPEC_OK) {
        status = is_first ? run(out, command, &request, hooks, error) : PSPEC_OK;
        status = ps_ranks_agree(ranks, status, error);
    }
    ps_ranks_plan_free(&plan);
    ps_text_free(&selector);
    return status;
}

pspec_status ps_shown_run(const ps_command *command, const ps_request *arguments, ps_ranks *ranks,
                          ps_error *error) {
    ps_shown shown = {.arguments = arguments,
                      .counted = command->counted,
                      .speaker = command->speaker != NULL ? command->speaker : "pointspec",
                      .is_streamed = command->makes_points};
    const ps_answer_hooks hooks = ps_shown_hooks(&shown);
    ps_answer answer = {0};
    const pspec_status status = run_ranks(&answer, command, arguments, ranks, &hooks, error);
    ps_answer_free(&answer);
    return shown.has_printed && (fflush(stdout) != 0 || ferror(stdout))
               ? ps_fail(error, PSPEC_ERROR_IO, "cannot write standard output")
               : status;
}
