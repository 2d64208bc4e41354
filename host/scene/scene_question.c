/* The questions of a result: one for each combination of its values. */
#include "engines/engine.h"
#include "request/option_text.h"
#include "scene/scene_file.h"

#include <stdlib.h>
#include <string.h>

const char *ps_scene_key(const ps_scene_entry *entry) {
    return entry->option == PS_SCENE_FILES ? "files" : ps_options[entry->option].name;
}

const ps_scene_entry *ps_scene_find_entry(const ps_scene_result *result, int option) {
    size_t i = 0;
    while (i < result->num_entries && result->entries[i].option != option) {
        i++;
    }
    return i < result->num_entries ? &result->entries[i] : NULL;
}

size_t ps_scene_num_questions(const ps_scene_result *result) {
    size_t num = 1;
    for (size_t i = 0; i < result->num_entries; i++) {
        num *= result->entries[i].num_values;
    }
    return num;
}

/* Like the digits of a number: the last entry changes fastest. */
const ps_scene_value *ps_scene_value_of(const ps_scene_result *result, size_t number,
                                        size_t i_entry) {
    for (size_t i = result->num_entries; --i > i_entry;) {
        number /= result->entries[i].num_values;
    }
    const ps_scene_entry *const entry = &result->entries[i_entry];
    return &entry->values[number % entry->num_values];
}

/* Trials of variances, and subsets of rings, are drawn by a seed, too. */
static bool is_seed_of_files(const ps_scene_result *result, int option) {
    return option == PS_OPTION_SEED && (ps_scene_find_entry(result, PS_OPTION_PER_RING) != NULL ||
                                        ps_scene_find_entry(result, PS_OPTION_INTEGRAND) != NULL);
}

static bool is_program(const ps_scene_value *value) {
    return value->set == NULL && ps_points_program(value->texts[0]) != NULL;
}

static bool has_programs(const ps_scene_entry *sources) {
    size_t i = 0;
    while (i < sources->num_values && !is_program(&sources->values[i])) {
        i++;
    }
    return i < sources->num_values;
}

bool ps_scene_reads_points(const ps_scene_result *result) {
    const ps_scene_entry *const sources = ps_scene_find_entry(result, PS_OPTION_SAMPLER);
    return sources == NULL || ps_scene_num_sets(sources) > 0 || has_programs(sources);
}

/* Beside sets what is about samplers says nothing to these, and the reverse. Both say something to
 * programs. */
static bool is_for_others(const ps_scene_question *question, int option) {
    const ps_scene_entry *const sources = ps_scene_find_entry(question->result, PS_OPTION_SAMPLER);
    if (sources == NULL || ps_scene_are_sets(sources) || sources->num_more > 0 ||
        option == PS_SCENE_FILES || (ps_scene_num_sets(sources) == 0 && !has_programs(sources))) {
        return false;
    }
    const size_t i = (size_t)(sources - question->result->entries);
    const ps_scene_value *const value = ps_scene_value_of(question->result, question->number, i);
    const bool is_set = value->set != NULL;
    const bool is_of_others =
        ps_options[option].source == (is_set ? PS_OF_SAMPLERS : PS_OF_FILES) &&
        !(is_set && is_seed_of_files(question->result, option)) && !is_program(value);
    return is_of_others || (is_set && option == PS_OPTION_POINTS);
}

static pspec_status take_text(ps_scene_question *out, ps_option_id id, const char *text,
                              ps_error *error) {
    ps_option_append(&out->command, id, text);
    return ps_option_apply(&out->request, id, ps_command_words(out->result->kind, id), text, error);
}

static pspec_status take_value(ps_scene_question *out, const ps_scene_entry *entry,
                               const ps_scene_value *value, ps_error *error) {
    if (is_for_others(out, entry->option)) {
        return PSPEC_OK;
    }
    if (value->set != NULL) {
        return take_text(out, PS_OPTION_SET, value->set, error);
    }
    if (entry->option == PS_SCENE_FILES) {
        out->request.files = value->texts;
        out->request.num_files = value->num_texts;
        return PSPEC_OK;
    }
    for (size_t i = 0; i < value->num_texts; i++) { /* several of an option that may be repeated */
        PS_TRY(take_text(out, (ps_option_id)entry->option, value->texts[i], error));
    }
    return PSPEC_OK;
}

pspec_status ps_scene_question_make(ps_scene_question *out, const ps_scene_result *result,
                                    size_t number, ps_error *error) {
    *out = (ps_scene_question){.result = result, .number = number, .request = ps_request_default};
    ps_text_append(&out->command, "pointspec %s", result->kind->name);
    for (size_t i = 0; i < result->num_entries; i++) {
        const ps_scene_entry *const entry = &result->entries[i];
        PS_TRY(take_value(out, entry, ps_scene_value_of(result, number, i), error));
        for (size_t k = 0; k < entry->num_more; k++) {
            PS_TRY(take_value(out, entry, &entry->values[entry->num_values + k], error));
        }
    }
    for (size_t i = 0; i < out->request.num_files; i++) {
        ps_text_append_word(&out->command, out->request.files[i]);
    }
    PS_TRY(ps_text_check(&out->command, error));
    out->request.quiet = true;
    out->request.wants_picture =
        result->wants_pictures ||
        (result->wants_plot && result->kind->pictures->dealing == PS_OF_SETS &&
         result->kind->pictures->needs == PS_NEEDS_NOTHING);
    out->request.wants_array = result->wants_arrays && !result->wants_coefficients;
    out->request.wants_coefficients = result->wants_coefficients;
    out->request.command_line = ps_text_string(&out->command);
    return PSPEC_OK;
}

/* The word outlives the question. */
static pspec_status use_word(ps_scene_question *question, ps_option_id id, const char *word,
                             ps_error *error) {
    if (question->request.is_given[id] || !ps_kind_asks(question->result->kind, id)) {
        return PSPEC_OK;
    }
    ps_option_append(&question->command, id, word);
    PS_TRY(ps_text_check(&question->command, error));
    question->request.command_line = ps_text_string(&question->command);
    return ps_option_apply(&question->request, id, ps_command_words(question->result->kind, id),
                           word, error);
}

/* "(NAME ..)" */
static bool is_of_engine(const char *description, const char *name) {
    const size_t length = strlen(name);
    return description[0] == '(' && strncmp(description + 1, name, length) == 0 &&
           strchr(" )", description[1 + length]) != NULL;
}

pspec_status ps_scene_question_use(ps_scene_question *question, const char *engine,
                                   const char *precision, ps_error *error) {
    size_t i = 0;
    if (engine[0] == '\0' || !ps_kind_asks(question->result->kind, PS_OPTION_ENGINE)) {
        return PSPEC_OK; /* none, or the host */
    }
    while (ps_engines[i] != NULL && !is_of_engine(engine, ps_engines[i]->name)) {
        i++;
    }
    if (ps_engines[i] == NULL) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "the record names an engine \"%.60s\" that this "
                       "version does not have",
                       engine);
    }
    PS_TRY(use_word(question, PS_OPTION_ENGINE, ps_engines[i]->name, error));
    return use_word(question, PS_OPTION_PRECISION, precision, error);
}

void ps_scene_question_free(ps_scene_question *question) {
    ps_text_free(&question->command);
}

pspec_status ps_scene_blame(const ps_scene *scene, const ps_scene_result *result, ps_error *error) {
    ps_error reason = *error;
    return scene->is_made ? ps_fail(error, reason.status, "%s: %s", result->name, reason.message)
                          : ps_fail(error, reason.status, "%s:%d: %s: %s", scene->path,
                                    result->line, result->name, reason.message);
}
