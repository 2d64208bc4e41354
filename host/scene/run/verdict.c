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

static pspec_status fail_digest(const ps_run *run, const ps_scene_question *asked,
                                ps_error *error) {
    ps_text differs = {0};
    say_what_differs(run, &differs);
    pspec_status status = ps_text_check(&differs, error);
    if (status == PSPEC_OK) {
        status = ps_fail(error, PSPEC_ERROR_CHECK,
                         "question %zu of result %s has other bits than the record, %s: %s",
                         asked->number + 1, asked->result->name, ps_text_string(&differs),
                         asked->request.command_line);
    }
    ps_text_free(&differs);
    return status;
}

static pspec_status compare_with_record(const ps_run *run, ps_error *error) {
    const ps_scene *const scene = run->scene;
    if (scene->num_digests == 0) {
        return PSPEC_OK;
    }
    for (size_t i = 0; i < run->num_questions; i++) {
        if (i >= scene->num_digests || strcmp(scene->digests[i], run->questions[i].digest) != 0) {
            return fail_digest(run, &run->questions[i].asked, error);
        }
    }
    return run->num_questions == scene->num_digests
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_CHECK,
                         "the record is of %zu questions, but its scene asks %zu",
                         scene->num_digests, run->num_questions);
}

/* Answers with another verdict than "same": the first of all, and how many ask which question. */
typedef struct differences {
    size_t num_spectra, num_homogeneous;
    const ps_run_question *first;
} differences;

static void add_difference(differences *found, const ps_run_question *question) {
    const ps_cell verdict = ps_table_find_meta(question->answer.table, "verdict");
    if (verdict.kind != PS_CELL_TEXT || strcmp(verdict.text, "different") != 0) {
        return;
    }
    if (found->first == NULL) {
        found->first = question;
    }
    if (question->asked.request.homogeneous) {
        found->num_homogeneous++;
    } else {
        found->num_spectra++;
    }
}

/* "2 checks found another spectrum than the saved one, and 1 check found sets that are not
 * homogeneous: 3 of 24 rings differ in NAME (COMMAND)" */
static void describe_differences(const differences *found, ps_text *out) {
    const size_t a = found->num_spectra;
    const size_t b = found->num_homogeneous;
    const ps_cell different = ps_table_find_meta(found->first->answer.table, "different");
    if (a > 0) {
        ps_text_append(out, "%zu check%s found another spectrum than the saved one%s", a,
                       a == 1 ? "" : "s", b > 0 ? ", and " : "");
    }
    if (b > 0) {
        ps_text_append(out, "%zu check%s found sets that are not homogeneous", b,
                       b == 1 ? "" : "s");
    }
    ps_text_append(out, ": %s %s in %s (%s)",
                   different.kind == PS_CELL_TEXT ? different.text : "some",
                   found->first->asked.request.homogeneous ? "are not uniform" : "differ",
                   found->first->asked.result->name, found->first->asked.request.command_line);
}

static pspec_status find_differences(const ps_run *run, ps_error *error) {
    differences found = {0};
    for (size_t i = 0; i < run->num_questions; i++) {
        add_difference(&found, &run->questions[i]);
    }
    if (found.first == NULL) {
        return PSPEC_OK;
    }
    ps_text text = {0};
    describe_differences(&found, &text);
    pspec_status status = ps_text_check(&text, error);
    if (status == PSPEC_OK) {
        status = ps_fail(error, PSPEC_ERROR_CHECK, "%s", ps_text_string(&text));
    }
    ps_text_free(&text);
    return status;
}

/* The first variance whose cut-off leaves more open than was asked. */
static pspec_status find_missed_tail(const ps_run *run, ps_error *error) {
    for (size_t i = 0; i < run->num_questions; i++) {
        const ps_run_question *const question = &run->questions[i];
        const ps_cell verdict = ps_table_find_meta(question->answer.table, "tail_verdict");
        if (verdict.kind == PS_CELL_TEXT && strcmp(verdict.text, "reached") != 0) {
            return ps_fail(error, PSPEC_ERROR_CHECK, "%s: %s", question->asked.result->name,
                           verdict.text);
        }
    }
    return PSPEC_OK;
}

pspec_status ps_run_judge(const ps_run *run, ps_error *error) {
    PS_TRY(compare_with_record(run, error));
    PS_TRY(find_differences(run, error));
    return find_missed_tail(run, error);
}
