/* What a run comes to: the bits of the record that was run again, and the spectra of its checks. */
#include "scene/run/run.h"

#include <string.h>

/* What is not as it was when the record was made. */
static void say_what_differs(const ps_run *run, ps_text *out) {
    const ps_scene *const scene = run->scene;
    const char *const version =
        scene->recorded_version != NULL ? scene->recorded_version : "another version";
    ps_text_append(out, "which is of pointspec %s on %s", version,
                   scene->recorded_device != NULL ? scene->recorded_device : "another device");
    if (scene->recorded_kind == NULL || strcmp(scene->recorded_kind, run->kind.text) == 0) {
        return;
    }
    ps_text_append(out, ", a device of another kind (%s) than this one (%s)", scene->recorded_kind,
                   run->kind.text);
    if (!run->arguments->recorded_engines) {
        ps_text_append(out, "; --recorded-engines takes the engines of then");
    }
}

static pspec_status fail_digest(const ps_run *run, const ps_run_result *result, size_t question,
                                ps_error *error) {
    ps_text differs = {0};
    say_what_differs(run, &differs);
    pspec_status status = ps_text_check(&differs, error);
    if (status == PSPEC_OK) {
        status = ps_fail(error, PSPEC_ERROR_CHECK,
                         "question %zu of result %s has other bits than the record, %s: %s",
                         question + 1, result->asked->name, ps_text_string(&differs),
                         result->questions[question].asked.request.command_line);
    }
    ps_text_free(&differs);
    return status;
}

static pspec_status compare_with_record(const ps_run *run, ps_error *error) {
    const ps_scene *const scene = run->scene;
    size_t number = 0;
    if (scene->num_digests == 0) {
        return PSPEC_OK;
    }
    for (size_t i = 0; i < run->num_results; i++) {
        const ps_run_result *const result = &run->results[i];
        for (size_t q = 0; q < result->num; q++, number++) {
            if (number >= scene->num_digests ||
                strcmp(scene->digests[number], result->questions[q].digest) != 0) {
                return fail_digest(run, result, q, error);
            }
        }
    }
    return number == scene->num_digests
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_CHECK,
                         "the record is of %zu questions, but its scene asks %zu",
                         scene->num_digests, number);
}

/* Looks for the answers that have another verdict than "same". */
static pspec_status find_differences(const ps_run *run, ps_error *error) {
    size_t num = 0;
    const ps_run_question *first = NULL;
    const ps_run_result *first_result = NULL;
    for (size_t i = 0; i < run->num_results; i++) {
        for (size_t q = 0; q < run->results[i].num; q++) {
            const ps_run_question *const question = &run->results[i].questions[q];
            const ps_cell verdict = ps_table_find_meta(question->answer.table, "verdict");
            if (verdict.kind == PS_CELL_TEXT && strcmp(verdict.text, "different") == 0) {
                first = num++ == 0 ? question : first;
                first_result = num == 1 ? &run->results[i] : first_result;
            }
        }
    }
    if (num == 0) {
        return PSPEC_OK;
    }
    const ps_cell different = ps_table_find_meta(first->answer.table, "different");
    return ps_fail(error, PSPEC_ERROR_CHECK,
                   "%zu check%s found another spectrum than the saved one: %s differ in %s (%s)",
                   num, num == 1 ? "" : "s",
                   different.kind == PS_CELL_TEXT ? different.text : "some",
                   first_result->asked->name, first->asked.request.command_line);
}

pspec_status ps_run_judge(const ps_run *run, ps_error *error) {
    PS_TRY(compare_with_record(run, error));
    return find_differences(run, error);
}
