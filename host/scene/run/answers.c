/* Every question of a scene, from the cache or computed. */
#include "answers/devices/devices_work.h"
#include "answers/checkpoints.h"
#include "base/clock.h"
#include "base/memory.h"
#include "scene/run/run.h"
#include "store/figures_file.h"

#include <stdlib.h>
#include <string.h>

/* ---- questions --------------------------------------------------------------------------- */

/* Those of the record, of question number `number` of the scene. */
static pspec_status use_recorded(const ps_run *run, size_t number, ps_scene_question *asked,
                                 ps_error *error) {
    const ps_scene *const scene = run->scene;
    if (!run->arguments->recorded_engines) {
        return PSPEC_OK;
    }
    return number < scene->num_engines
               ? ps_scene_question_use(asked, scene->engines[number], scene->precisions[number],
                                       error)
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "--recorded-engines is for records, and this scene names no engines of a "
                         "former run");
}

static pspec_status ask_one(ps_run *run, const ps_scene_result *result, size_t number,
                            ps_run_question *question, ps_error *error) {
    ps_scene_question *const asked = &question->asked;
    /* points that are kept would hide that this machine makes others */
    const bool is_repeated = run->scene->num_digests > 0;
    pspec_status status = ps_scene_question_make(asked, result, number, error);
    if (status == PSPEC_OK) {
        status = use_recorded(run, (size_t)(question - run->questions), asked, error);
    }
    if (run->arguments->accuracy.no_skip) {
        asked->request.accuracy.no_skip = true;
    }
    asked->request.integrands_made = &run->made;
    asked->request.reading.programs.may_run = run->arguments->reading.programs.may_run;
    asked->request.limits.device = run->arguments->limits.device;
    asked->request.limits.cache_folder = run->arguments->limits.cache_folder;
    asked->request.limits.kept_bytes = is_repeated ? 0 : run->arguments->limits.kept_bytes;
    if (status == PSPEC_OK) {
        status = result->kind->check_question(&asked->request, error);
    }
    return status == PSPEC_OK ? PSPEC_OK : ps_scene_blame(run->scene, result, error);
}

pspec_status ps_run_ask(ps_run *run, ps_error *error) {
    size_t num = 0;
    PS_TRY(ps_scene_check_inputs(run->scene, error));
    PS_TRY(PS_NEW(&run->results, run->scene->num_results, "results", error));
    run->num_results = run->scene->num_results;
    for (size_t i = 0; i < run->num_results; i++) {
        num += ps_scene_num_questions(&run->scene->results[i]);
    }
    PS_TRY(PS_NEW(&run->questions, num, "questions", error));
    run->num_questions = num;
    ps_run_question *next = run->questions;
    for (size_t i = 0; i < run->num_results; i++) {
        ps_run_result *const result = &run->results[i];
        result->asked = &run->scene->results[i];
        result->num = ps_scene_num_questions(result->asked);
        result->questions = next;
        PS_TRY(ps_pictures_list(&result->pictures, result->asked, error));
        for (size_t q = 0; q < result->num; q++) {
            PS_TRY(ask_one(run, result->asked, q, next++, error));
        }
    }
    return ps_run_list_files(run, error);
}

/* ---- one question ------------------------------------------------------------------------ */

/* Integrands may have paths in their names, which a record says from its own folder. */
static bool names_files(const ps_table *table, size_t column) {
    return strcmp(ps_table_column_name(table, column), "integrand") == 0;
}

/* The header says how the rows came about, with versions and paths; the rows are the result. */
static pspec_status digest(const ps_answer *answer, char out[PS_DIGEST_BYTES], ps_error *error) {
    ps_text bytes = {0};
    const size_t num_columns = ps_table_num_columns(answer->table);
    for (size_t row = 0; row < ps_table_num_rows(answer->table); row++) {
        for (size_t column = 0; column < num_columns; column++) {
            if (names_files(answer->table, column)) {
                continue;
            }
            const ps_cell cell = ps_table_cell(answer->table, row, column);
            ps_text_append_bytes(&bytes, (const char *)&cell.number, sizeof cell.number);
            ps_text_append_bytes(&bytes, (const char *)&cell.integer, sizeof cell.integer);
            ps_text_append(&bytes, "%d %s;", (int)cell.kind, cell.text != NULL ? cell.text : "");
        }
    }
    for (size_t i = 0; i < ps_table_num_arrays(answer->table); i++) {
        const char *name = NULL;
        bool is_state = false;
        const ps_npy_array *const array = ps_table_array(answer->table, i, &name, &is_state);
        ps_text_append_bytes(&bytes, (const char *)array->data,
                             is_state ? 0 : ps_npy_num_doubles(array) * sizeof *array->data);
    }
    ps_digest_bytes(ps_text_string(&bytes), bytes.length, out);
    const pspec_status status = ps_text_check(&bytes, error);
    ps_text_free(&bytes);
    return status;
}

/* One device for all questions: its programs are built once. */
pspec_status ps_run_open_device(ps_run *run, const ps_run_question *question, ps_error *error) {
    const ps_plan_constraints *const constraints = &question->asked.request.limits.constraints;
    if (run->device == NULL) {
        run->device = run->hooks.device;
    }
    if (run->device != NULL || question->asked.result->kind->is_of_host ||
        !ps_plan_may_need_device(constraints)) {
        return PSPEC_OK;
    }
    const pspec_status opened =
        ps_figures_open_device(&run->device, run->arguments->limits.device, false,
                               run->arguments->limits.cache_folder, error);
    run->owns_device = opened == PSPEC_OK;
    return ps_kind_without_device(question->asked.result->kind, opened);
}

/* Those of a question come behind those of the questions before it. */
static void find_checkpoints(ps_request *out, const ps_run *run, const ps_run_question *question) {
    const ps_command_set takers = ps_options[PS_OPTION_CHECKPOINT].commands;
    const ps_checkpoint_spec *const asked = &run->arguments->limits.checkpoint;
    unsigned first = 0;
    for (const ps_run_question *before = run->questions; before < question; before++) {
        first += ps_answer_num_checkpoints(&before->asked.request, before->asked.result->kind);
    }
    *out = question->asked.request;
    if ((takers & question->asked.result->kind->takes) != 0) {
        out->limits.checkpoint = *asked;
        out->limits.checkpoint.part = first;
        out->limits.checkpoint.num_parts =
            ps_answer_num_checkpoints(out, question->asked.result->kind);
    }
}

static pspec_status make_answer(ps_run *run, ps_run_question *question, ps_error *error) {
    const ps_kind *const kind = question->asked.result->kind;
    const ps_answer_hooks hooks = {.watch = run->hooks.watch, .device = run->device};
    ps_text key = {0};
    ps_request request;
    find_checkpoints(&request, run, question);
    pspec_status status = ps_answer_begin_checkpoints(&request, kind, &key, &run->hooks, error);
    if (status == PSPEC_OK) {
        status = ps_devices_make(&question->answer, kind, &request, &hooks, error);
    }
    ps_text_free(&key);
    return status;
}

void ps_run_end_checkpoints(const ps_run *run) {
    for (size_t i = 0; i < run->num_questions; i++) {
        ps_request request;
        find_checkpoints(&request, run, &run->questions[i]);
        ps_answer_end_checkpoints(&request);
    }
}

static pspec_status answer_one(ps_run *run, ps_run_question *question, ps_error *error) {
    const double start = ps_clock_seconds();
    PS_TRY(ps_run_fetch(run, question, error));
    if (!question->is_cached) {
        PS_TRY(ps_run_open_device(run, question, error));
        PS_TRY(make_answer(run, question, error));
        question->seconds = ps_clock_seconds() - start;
        ps_run_keep(run, question);
    }
    run->num_cached += question->is_cached;
    return digest(&question->answer, question->digest, error);
}

static pspec_status answer_next(ps_run *run, size_t i, ps_error *error) {
    ps_run_question *const question = &run->questions[i];
    const ps_scene_result *const result = question->asked.result;
    if (ps_answer_is_interrupted(&run->hooks)) {
        return ps_fail(error, PSPEC_ERROR_CANCELLED, "interrupted after %zu of %zu questions", i,
                       run->num_questions);
    }
    if (run->hooks.begin_question != NULL) {
        run->hooks.begin_question(run->hooks.payload, result->name, i + 1, run->num_questions);
    }
    return answer_one(run, question, error) == PSPEC_OK ? PSPEC_OK
                                                        : ps_scene_blame(run->scene, result, error);
}

/* ---- all of them, or a share ----------------------------------------------------------------- */

/* Questions with many points often come at a stride, the last of each list: the order of owners
 * turns from one round of them to the next, by golden ratios, so that no stride is one owner's. */
static size_t find_owner(size_t i, size_t num_shares) {
    const uint32_t golden = 0x9E3779B9U; /* of 2^32 */
    const uint32_t turn = (uint32_t)(i / num_shares) * golden;
    return (i + (size_t)((uint64_t)turn * num_shares >> 32)) % num_shares;
}

bool ps_run_only_helps(const ps_run *run) {
    return !ps_team_is_led_here(run->hooks.team);
}

/* Answers of others than share 0 are in the cache; without one they would be lost. */
static pspec_status answer_share(ps_run *run, ps_error *error) {
    const ps_team *const team = run->hooks.team;
    const bool helps = ps_run_only_helps(run);
    pspec_status status = PSPEC_OK;
    for (size_t i = 0; status == PSPEC_OK && run->cache != NULL && i < run->num_questions; i++) {
        if (find_owner(i, team->num) == team->own) {
            status = answer_next(run, i, error);
        }
        if (helps) {
            ps_answer_free(&run->questions[i].answer);
        }
    }
    return ps_team_meet(team, status, error);
}

pspec_status ps_run_answer(ps_run *run, ps_error *error) {
    const size_t num = ps_run_only_helps(run) ? 0 : run->num_questions;
    const double start = ps_clock_seconds();
    ps_answer_begin_next(&run->hooks);
    pspec_status status = run->hooks.team != NULL ? answer_share(run, error) : PSPEC_OK;
    for (size_t i = 0; status == PSPEC_OK && i < num; i++) {
        if (run->questions[i].answer.table == NULL) {
            status = answer_next(run, i, error);
        }
    }
    ps_answer_end(&run->hooks);
    run->seconds = ps_clock_seconds() - start;
    return status;
}
