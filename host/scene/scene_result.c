/* One result of a scene: its keys, and those of the defaults. */
#include "base/text.h"
#include "request/options.h"
#include "scene/scene_file.h"

#include <ctype.h>
#include <string.h>

/* What a scene can ask for. */
static const ps_kind *const scene_kinds[] = {
    PS_COMMANDS(PS_KIND_OF, PS_NO_COMMAND, PS_NO_COMMAND, PS_NO_COMMAND) PS_KIND_OF(points) NULL};

void ps_scene_consider(ps_scene_nearest *best, const char *typed, const char *known) {
    const size_t distance = ps_name_distance(typed, known);
    if (best->word == NULL || distance < best->distance) {
        *best = (ps_scene_nearest){known, distance};
    }
}

static const char *const own_keys[] = {"result", "name",  "title",    "plot", "pictures",
                                       "arrays", "files", "samplers", "sets", "integrands"};
enum { NUM_OWN_KEYS = sizeof own_keys / sizeof own_keys[0] };

static const char sets_key[] = "sets";

/* The option that a key of a result means; -1: none. */
static int find_option(const ps_kind *kind, const char *key) {
    if (strcmp(key, "files") == 0) {
        return ps_kind_asks(kind, PS_OPTION_INPUT_FORMAT) ? PS_SCENE_FILES : -1;
    }
    if (strcmp(key, sets_key) == 0 && (ps_options[PS_OPTION_SET].commands & kind->takes) == 0) {
        return -1;
    }
    const char *const name = strcmp(key, "samplers") == 0 || strcmp(key, sets_key) == 0 ? "sampler"
                             : strcmp(key, "integrands") == 0 ? "integrand"
                                                              : key;
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        if (strcmp(ps_options[id].name, name) == 0) {
            return ps_kind_asks(kind, (ps_option_id)id) ? id : -1;
        }
    }
    return -1;
}

static bool is_any_option(const char *key) {
    for (size_t i = 0; scene_kinds[i] != NULL; i++) {
        if (find_option(scene_kinds[i], key) >= 0) {
            return true;
        }
    }
    return false;
}

/* Nothing where it is that very word, which others may have. */
static ps_suggestion suggest(const char *typed, const ps_scene_nearest *best) {
    return best->distance > 0
               ? ps_text_suggest(typed, best->word, best->distance, "; did you mean ", "?")
               : (ps_suggestion){""};
}

static pspec_status complain_of_key(const ps_scene_file *file, const ps_kind *kind, int line,
                                    const char *key) {
    ps_scene_nearest best = {NULL, 0};
    for (size_t i = 0; i < NUM_OWN_KEYS; i++) {
        ps_scene_consider(&best, key, own_keys[i]);
    }
    for (int i = 0; i < PS_SCENE_NUM_AXES; i++) {
        ps_scene_consider(&best, key, ps_options[ps_scene_axes[i]].name);
    }
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        if (ps_kind_asks(kind, (ps_option_id)id)) {
            ps_scene_consider(&best, key, ps_options[id].name);
        }
    }
    return best.distance == 0 || is_any_option(key)
               ? ps_scene_complain(file, line, key, "not a key of this result%s",
                                   suggest(key, &best).text)
               : ps_scene_complain(file, line, key, "unknown key%s", suggest(key, &best).text);
}

/* ---- one result -------------------------------------------------------------------------- */

static pspec_status take_switch(const ps_scene_file *file, const ps_scene_node *node,
                                const char *key, bool *out) {
    const char *text = NULL;
    PS_TRY(ps_scene_take_text(file, node, key, &text));
    *out = strcmp(text, "true") == 0;
    return *out || strcmp(text, "false") == 0
               ? PSPEC_OK
               : ps_scene_complain(file, node->line, key, "true or false, not \"%s\"", text);
}

/* It becomes the name of files. */
static pspec_status take_name(const ps_scene_file *file, const ps_scene_node *node,
                              const char **out) {
    enum { MOST_LETTERS = 64 };
    PS_TRY(ps_scene_take_text(file, node, "name", out));
    bool is_good = strlen(*out) <= MOST_LETTERS && (*out)[0] != '-';
    for (const char *c = *out; *c != '\0'; c++) {
        is_good = is_good && (isalnum((unsigned char)*c) || *c == '-' || *c == '_');
    }
    return is_good
               ? PSPEC_OK
               : ps_scene_complain(file, node->line, "name",
                                   "\"%s\" cannot name files: up to %d letters, digits, - and _",
                                   *out, MOST_LETTERS);
}

static pspec_status take_kind(const ps_scene_file *file, const ps_scene_node *node,
                              const ps_kind **out) {
    const char *text = NULL;
    size_t distance = 0;
    PS_TRY(ps_scene_take_text(file, node, "result", &text));
    *out = ps_command_nearest(scene_kinds, text, &distance);
    return distance == 0
               ? PSPEC_OK
               : ps_scene_complain(
                     file, node->line, "result", "\"%s\" is no kind of answer%s", text,
                     ps_text_suggest(text, (*out)->name, distance, "; did you mean ", "?").text);
}

/* true, false or, of spectra of the plane, decibels: those of true, and the same in dB. */
static pspec_status take_pictures(const ps_scene_file *file, const ps_scene_node *node,
                                  ps_scene_result *out) {
    const char *text = NULL;
    PS_TRY(ps_scene_take_text(file, node, "pictures", &text));
    out->wants_decibels = out->kind->has_decibels && strcmp(text, "decibels") == 0;
    out->wants_pictures = out->wants_decibels || strcmp(text, "true") == 0;
    return out->wants_pictures || strcmp(text, "false") == 0
               ? PSPEC_OK
               : ps_scene_complain(file, node->line, "pictures", "true or false%s, not \"%s\"",
                                   out->kind->has_decibels ? " or decibels" : "", text);
}

/* true, false or coefficients, as the kind has them. */
static pspec_status take_arrays(const ps_scene_file *file, const ps_scene_node *node,
                                ps_scene_result *out) {
    const char *text = NULL;
    const ps_kind *const kind = out->kind;
    PS_TRY(ps_scene_take_text(file, node, "arrays", &text));
    out->wants_coefficients = kind->has_coefficients && strcmp(text, "coefficients") == 0;
    out->wants_arrays = out->wants_coefficients || (kind->has_arrays && strcmp(text, "true") == 0);
    return out->wants_arrays || strcmp(text, "false") == 0
               ? PSPEC_OK
               : ps_scene_complain(file, node->line, "arrays", "%sfalse%s, not \"%s\"",
                                   kind->has_arrays ? "true or " : "",
                                   kind->has_coefficients ? " or coefficients" : "", text);
}

static pspec_status take_entry(const ps_scene_file *file, ps_scene_result *out, int option,
                               const char *key, const ps_scene_node *value) {
    ps_scene_entry *const entry = &out->entries[out->num_entries++];
    return strcmp(key, sets_key) == 0 ? ps_scene_take_sets(file, value, entry)
                                      : ps_scene_take_entry(file, out, option, key, value, entry);
}

static pspec_status take_pair(const ps_scene_file *file, ps_scene_result *out, const char *key,
                              int line, const ps_scene_node *value) {
    if (strcmp(key, "result") == 0) {
        return PSPEC_OK; /* taken before all others */
    }
    if (strcmp(key, "name") == 0) {
        return take_name(file, value, &out->name);
    }
    if (strcmp(key, "title") == 0) {
        return ps_scene_take_text(file, value, key, &out->title);
    }
    if (strcmp(key, "plot") == 0) {
        return take_switch(file, value, key, &out->wants_plot);
    }
    if (strcmp(key, "pictures") == 0 && out->kind->has_images) {
        return take_pictures(file, value, out);
    }
    if (strcmp(key, "arrays") == 0 && (out->kind->has_arrays || out->kind->has_coefficients)) {
        return take_arrays(file, value, out);
    }
    const int axes = ps_scene_find_axes(key);
    if (ps_scene_has_axes(out->kind, axes)) {
        return ps_scene_take_axes(file, out, axes, value);
    }
    const int option = find_option(out->kind, key);
    if (option < 0) {
        return complain_of_key(file, out->kind, line, key);
    }
    return take_entry(file, out, option, key, value);
}

/* A flag that is said to be off, also in a record, where every value is a list. */
static bool is_off(const ps_scene_node *value) {
    const ps_scene_node *item = ps_scene_first_item(value);
    const size_t num = ps_scene_num_items(value);
    bool is = num > 0;
    for (size_t i = 0; is && i < num; i++, item = item->next) {
        is = item->kind == PS_NODE_TEXT && strcmp(item->text, "false") == 0;
    }
    return is;
}

static bool has_key(const ps_scene_node *mapping, const char *wanted) {
    const ps_scene_node *key = mapping->first;
    while (key != NULL && strcmp(key->text, wanted) != 0) {
        key = key->next->next;
    }
    return key != NULL;
}

/* Does a key of the mapping, which is none of the result's own, make one question of all samplers
 * and numbers of points? own NULL: the mapping is the result. */
static pspec_status find_joining(const ps_scene_file *file, const ps_scene_node *mapping,
                                 const ps_scene_node *own, ps_scene_result *out) {
    for (size_t i = 0; mapping != NULL && i < ps_scene_num_pairs(mapping); i++) {
        const char *key = NULL;
        const ps_scene_node *value = NULL;
        PS_TRY(ps_scene_pair(file, mapping, i, &key, &value));
        const int option = find_option(out->kind, key);
        const bool joins = option >= 0 && option != PS_SCENE_FILES &&
                           ps_options[option].is_of_all && !is_off(value);
        out->is_joined = out->is_joined || (joins && (own == NULL || !has_key(own, key)));
    }
    return PSPEC_OK;
}

/* Points come from a sampler or from files: the defaults' one gives way to the result's other. */
static bool is_settled(const ps_scene_result *result, int option) {
    return ps_scene_find_entry(result, option) != NULL ||
           (option == PS_OPTION_SAMPLER && ps_scene_find_entry(result, PS_SCENE_FILES) != NULL) ||
           (option == PS_SCENE_FILES && ps_scene_find_entry(result, PS_OPTION_SAMPLER) != NULL);
}

/* Defaults that are about samplers are not for files, nor the reverse; a kind may leave more. */
static bool fits_result(const ps_scene_result *result, int option) {
    const ps_scene_entry *const sources = ps_scene_find_entry(result, PS_OPTION_SAMPLER);
    const size_t num_sets = sources != NULL ? ps_scene_num_sets(sources) : 0;
    const bool are_files = ps_scene_find_entry(result, PS_SCENE_FILES) != NULL ||
                           (num_sets > 0 && ps_scene_are_sets(sources));
    if (option == PS_SCENE_FILES) {
        return true;
    }
    const ps_option_source source = ps_options[option].source;
    return !(are_files && source == PS_OF_SAMPLERS) &&
           !(!are_files && num_sets == 0 && source == PS_OF_FILES) &&
           (result->kind->leaves_default == NULL ||
            !result->kind->leaves_default((ps_option_id)option));
}

static void drop_unfit(ps_scene_result *result, size_t num_own) {
    size_t num = num_own;
    for (size_t i = num_own; i < result->num_entries; i++) {
        if (fits_result(result, result->entries[i].option)) {
            result->entries[num++] = result->entries[i];
        }
    }
    result->num_entries = num;
}

static pspec_status take_defaults(const ps_scene_file *file, ps_scene_result *out) {
    const size_t num_own = out->num_entries;
    ps_scene_result own = *out;
    for (size_t i = 0; file->defaults != NULL && i < ps_scene_num_pairs(file->defaults); i++) {
        const char *key = NULL;
        const ps_scene_node *value = NULL;
        PS_TRY(ps_scene_pair(file, file->defaults, i, &key, &value));
        const int option = find_option(out->kind, key);
        const int axes = ps_scene_find_axes(key);
        own.num_entries = num_own;
        if (ps_scene_has_axes(out->kind, axes) && out->axes_texts[axes] == NULL) {
            PS_TRY(ps_scene_take_axes(file, out, axes, value));
        } else if (option >= 0 && !is_settled(&own, option)) {
            PS_TRY(take_entry(file, out, option, key, value));
        } else if (option < 0 && axes < 0 && !is_any_option(key)) {
            return complain_of_key(file, out->kind, value->line, key);
        }
    }
    PS_TRY(ps_scene_join_sources(file, out));
    drop_unfit(out, num_own);
    return PSPEC_OK;
}

/* "power, angular, .. or check" */
static pspec_status complain_of_no_kind(const ps_scene_file *file, int line) {
    ps_text names = {0};
    for (size_t i = 0; scene_kinds[i] != NULL; i++) {
        const bool is_last = scene_kinds[i + 1] == NULL;
        ps_text_append(&names, "%s%s", i == 0 ? "" : is_last ? " or " : ", ", scene_kinds[i]->name);
    }
    const pspec_status status =
        ps_scene_complain(file, line, "result", "is missing: %s", ps_text_string(&names));
    ps_text_free(&names);
    return status;
}

/* Which result it is says what the other keys may be. */
static pspec_status find_kind(const ps_scene_file *file, const ps_scene_node *node,
                              ps_scene_result *out) {
    for (size_t i = 0; i < ps_scene_num_pairs(node); i++) {
        const char *key = NULL;
        const ps_scene_node *value = NULL;
        PS_TRY(ps_scene_pair(file, node, i, &key, &value));
        if (strcmp(key, "result") == 0) {
            return take_kind(file, value, &out->kind);
        }
    }
    return complain_of_no_kind(file, node->line);
}

static pspec_status check_twice(const ps_scene_file *file, const ps_scene_result *result) {
    for (size_t i = 0; i < result->num_entries; i++) {
        for (size_t j = 0; j < i; j++) {
            if (result->entries[i].option == result->entries[j].option) {
                return ps_scene_complain(file, result->entries[i].line,
                                         ps_scene_key(&result->entries[i]),
                                         "stands in line %d already", result->entries[j].line);
            }
        }
    }
    return PSPEC_OK;
}

/* Sets are files, and so others have no place beside them; they have their numbers of points. */
static pspec_status check_entries(const ps_scene_file *file, ps_scene_result *result) {
    PS_TRY(ps_scene_join_sources(file, result));
    PS_TRY(check_twice(file, result));
    const ps_scene_entry *const sources = ps_scene_find_entry(result, PS_OPTION_SAMPLER);
    for (size_t i = 0; sources != NULL && i < result->num_entries; i++) {
        const ps_scene_entry *const entry = &result->entries[i];
        const bool are_several = entry->option == PS_OPTION_POINTS && entry->num_values > 1;
        if (ps_scene_num_sets(sources) > 0 && (entry->option == PS_SCENE_FILES || are_several)) {
            return ps_scene_complain(file, entry->line, ps_scene_key(entry),
                                     are_several
                                         ? "%s have their own, and one number is for samplers"
                                         : "beside %s files stand under a name, as one of them",
                                     sets_key);
        }
    }
    return PSPEC_OK;
}

static pspec_status check_questions(const ps_scene_file *file, const ps_scene_result *result) {
    double num = 1;
    for (size_t i = 0; i < result->num_entries; i++) {
        num *= (double)result->entries[i].num_values;
    }
    return num <= PS_SCENE_MOST_QUESTIONS
               ? PSPEC_OK
               : ps_scene_complain(file, result->line, NULL,
                                   "the lists of this result ask %.3g questions, more than %d", num,
                                   PS_SCENE_MOST_QUESTIONS);
}

pspec_status ps_scene_take_result(const ps_scene_file *file, const ps_scene_node *node,
                                  ps_scene_result *out) {
    *out = (ps_scene_result){.line = node->line, .wants_plot = true};
    if (node->kind != PS_NODE_MAPPING) {
        return ps_scene_complain(file, out->line, "results", "a result is a mapping of keys");
    }
    PS_TRY(find_kind(file, node, out));
    PS_TRY(find_joining(file, node, NULL, out));
    PS_TRY(find_joining(file, file->defaults, node, out));
    /* every option, files, sets, and `sampler` beside `samplers`, `integrand` beside `integrands`
     */
    PS_TRY(PS_SCENE_NEW(file, &out->entries, PS_NUM_OPTIONS + 4));
    for (size_t i = 0; i < ps_scene_num_pairs(node); i++) {
        const char *key = NULL;
        const ps_scene_node *value = NULL;
        PS_TRY(ps_scene_pair(file, node, i, &key, &value));
        PS_TRY(take_pair(file, out, key, value->line, value));
    }
    PS_TRY(check_entries(file, out));
    PS_TRY(take_defaults(file, out));
    PS_TRY(check_entries(file, out));
    return check_questions(file, out);
}
