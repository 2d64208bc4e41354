#include "cli/command.h"
#include "scene/run/run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Runs of each kind, in turn; the fastest counts, since a machine has other things to do. */
enum { RUNS = 2 };

static double compare_result(const ps_run_result *a, const ps_run_result *b) {
    double worst = 0;
    for (size_t q = 0; q < a->num; q++) {
        worst = fmax(worst, ps_answer_compare(a->asked->kind, a->questions[q].answer.table,
                                              b->questions[q].answer.table));
    }
    return worst;
}

/* ---- runs ---------------------------------------------------------------------------------- */

/* Answers of one scene: with skips, and without. */
typedef struct comparison {
    const ps_scene *scene;
    ps_request arguments[2];
    ps_run runs[2];
    double differs; /* the largest difference of all results so far */
} comparison;

static pspec_status answer(const ps_request *arguments, const ps_scene *scene, ps_run *out,
                           ps_error *error) {
    ps_shown shown = {.arguments = arguments, .counted = "realizations", .speaker = "pointspec"};
    *out = (ps_run){
        .hooks = ps_shown_hooks(&shown), .arguments = arguments, .scene = scene, .folder = ""};
    PS_TRY(ps_run_ask(out, error));
    const pspec_status status = ps_run_answer(out, error);
    out->hooks = (ps_answer_hooks){0}; /* nobody hears any more */
    return status;
}

static double seconds_of(const ps_run_result *result) {
    double seconds = 0;
    for (size_t q = 0; q < result->num; q++) {
        seconds += result->questions[q].seconds;
    }
    return seconds;
}

static void keep_fastest(ps_run *run, const ps_run *other) {
    for (size_t i = 0; i < run->num_questions; i++) {
        run->questions[i].seconds = fmin(run->questions[i].seconds, other->questions[i].seconds);
    }
}

/* The first run of each kind is kept for its answers, and compiles what has to be compiled. */
static pspec_status answer_again(comparison *both, int kind, ps_error *error) {
    ps_run again;
    pspec_status status = answer(&both->arguments[kind], both->scene, &again, error);
    if (status == PSPEC_OK) {
        keep_fastest(&both->runs[kind], &again);
    }
    ps_run_free(&again);
    return status;
}

static pspec_status add_rows(ps_table *table, comparison *both, ps_error *error) {
    for (size_t i = 0; i < both->runs[0].num_results; i++) {
        const ps_run_result *const skip = &both->runs[0].results[i];
        const double with = seconds_of(skip);
        const double without = seconds_of(&both->runs[1].results[i]);
        const double difference = compare_result(skip, &both->runs[1].results[i]);
        const ps_cell cells[] = {
            PS_TEXT(both->scene->path), PS_TEXT(skip->asked->name),
            PS_INTEGER(skip->num),      PS_NUMBER(with),
            PS_NUMBER(without),         PS_NUMBER(without / with),
            PS_NUMBER(difference),      PS_TEXT(difference <= 1 ? "same" : "different")};
        both->differs = fmax(both->differs, difference);
        PS_TRY(ps_table_add_row(table, cells, error));
    }
    return PSPEC_OK;
}

static pspec_status bench_scene(ps_table *table, comparison *both, ps_error *error) {
    for (int run = 0; run < RUNS; run++) {
        for (int kind = 0; kind < 2; kind++) {
            PS_TRY(run == 0 ? answer(&both->arguments[kind], both->scene, &both->runs[kind], error)
                            : answer_again(both, kind, error));
        }
    }
    return add_rows(table, both, error);
}

static pspec_status bench_file(ps_table *table, const ps_request *arguments, const char *path,
                               ps_error *error) {
    ps_scene scene;
    comparison both = {.scene = &scene, .arguments = {*arguments, *arguments}};
    both.arguments[1].accuracy.no_skip = true;
    pspec_status status = ps_scene_read(&scene, path, error);
    if (status == PSPEC_OK) {
        status = bench_scene(table, &both, error);
    }
    ps_run_free(&both.runs[0]);
    ps_run_free(&both.runs[1]);
    ps_scene_free(&scene);
    return status != PSPEC_OK || both.differs <= 1
               ? status
               : ps_fail(error, PSPEC_ERROR_CHECK,
                         "answers of %s with and without skips are %.3g times as far apart as "
                         "both sides allow",
                         path, both.differs);
}

static pspec_status add_header(ps_table *table, const ps_request *arguments, ps_error *error) {
    PS_TRY(ps_lead_add_origin(table, arguments->command_line, error));
    PS_TRY(ps_table_add_meta(
        table, "time",
        PS_TEXT(
            "of the questions, one after the other, on the clock: the faster of two runs in turn"),
        error));
    return ps_table_add_meta(
        table, "difference",
        PS_TEXT(
            "the largest, in units of the error bounds of both sides and, where realizations are "
            "others, 7 standard errors of the difference; more than 1 is too much"),
        error);
}

pspec_status ps_bench_scenes(ps_table **out, const ps_request *arguments, ps_error *error) {
    static const char *const columns[] = {"scene",           "result",  "questions",  "seconds",
                                          "seconds_no_skip", "speedup", "difference", "verdict"};
    pspec_status verdict = PSPEC_OK;
    ps_error first = {0};
    PS_TRY(ps_table_create(out, "bench", columns, sizeof columns / sizeof columns[0], error));
    PS_TRY(add_header(*out, arguments, error));
    for (size_t i = 0; i < arguments->num_files; i++) {
        const pspec_status status = bench_file(*out, arguments, arguments->files[i], error);
        if (status != PSPEC_OK && status != PSPEC_ERROR_CHECK) {
            return status;
        }
        if (status != PSPEC_OK && verdict == PSPEC_OK) {
            verdict = status;
            first = *error;
        }
    }
    if (verdict != PSPEC_OK) {
        *error = first;
    }
    return verdict;
}
