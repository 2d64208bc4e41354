/* The values of one key of a scene. */
#include "questions/option_text.h"
#include "scene/scene_file.h"

#include <string.h>

/* A key has at most so many values: lists are typed by people. */
enum { MOST_VALUES = 1000 };

/* ---- paths ------------------------------------------------------------------------------- */

static bool is_absolute(const char *path) {
    return path[0] == '/';
}

static pspec_status complain_of_stream(const ps_scene_file *file, const ps_scene_value *value) {
    return ps_scene_complain(file, value->line, NULL,
                             "a scene can be run again, standard input (-) cannot");
}

const char *ps_scene_find_path(const ps_result_kind *kind, int option, const char *text) {
    if (option == PS_SCENE_FILES) {
        return text;
    }
    ps_option_input *const find =
        option >= 0 && option < PS_NUM_OPTIONS ? ps_options[option].input : NULL;
    return find != NULL ? find(ps_result_words(kind, (ps_option_id)option), text) : NULL;
}

/* The path, a part of *text, becomes relative to what the scene's folder is relative to. */
static pspec_status resolve(ps_scene *scene, const ps_scene_file *file, const ps_scene_value *value,
                            const char **text, const char *path) {
    if (strcmp(path, "-") == 0) {
        return complain_of_stream(file, value);
    }
    if (is_absolute(path)) {
        return PSPEC_OK;
    }
    /* "-odd.txt" alone would be an option in the command line of the question */
    const bool is_odd = scene->folder[0] == '\0' && path == *text && path[0] == '-';
    ps_text joined = {0};
    ps_text_append_bytes(&joined, *text, (size_t)(path - *text));
    ps_text_append(&joined, "%s%s", is_odd ? "./" : scene->folder, path);
    pspec_status status = ps_text_check(&joined, file->error);
    if (status == PSPEC_OK) {
        status = ps_scene_copy(scene, "", ps_text_string(&joined), text, file->error);
    }
    ps_text_free(&joined);
    return status;
}

static pspec_status resolve_paths(ps_scene *scene, const ps_scene_file *file,
                                  const ps_result_kind *kind, int option, ps_scene_value *value) {
    for (size_t i = 0; i < value->num_texts; i++) {
        const char *const path = ps_scene_find_path(kind, option, value->texts[i]);
        if (path != NULL) {
            PS_TRY(resolve(scene, file, value, &value->texts[i], path));
        }
    }
    return PSPEC_OK;
}

/* ---- values ------------------------------------------------------------------------------ */

/* The sentence of an option without the name that the complaint has already. */
static pspec_status complain_of_value(const ps_scene_file *file, int line, const char *key,
                                      const ps_error *reason) {
    const char *sentence = reason->message;
    const size_t length = strlen(key);
    if (strncmp(sentence, key, length) == 0 && strncmp(sentence + length, ": ", 2) == 0) {
        sentence += length + 2;
    }
    return ps_scene_complain(file, line, key, "%s", sentence);
}

static pspec_status check_value(const ps_scene_file *file, const ps_result_kind *kind, int option,
                                const char *key, const ps_scene_value *value) {
    ps_request scratch = ps_request_default;
    ps_error reason = {0};
    if (option == PS_SCENE_FILES) {
        return PSPEC_OK;
    }
    const ps_option_id id = (ps_option_id)option;
    return ps_option_apply(&scratch, id, ps_result_words(kind, id), value->texts[0], &reason) ==
                   PSPEC_OK
               ? PSPEC_OK
               : complain_of_value(file, value->line, key, &reason);
}

/* A value of num texts, which are set one by one. */
pspec_status ps_scene_make_value(ps_scene *scene, size_t num, int line, ps_scene_value *out,
                                 ps_error *error) {
    void *memory = NULL;
    PS_TRY(ps_scene_allocate(scene, 2 * num, sizeof *out->texts, &memory, error));
    *out = (ps_scene_value){.num_texts = num, .texts = memory, .line = line};
    out->originals = out->texts + num;
    return PSPEC_OK;
}

static void set_text(ps_scene_value *value, size_t index, const char *text) {
    value->texts[index] = value->originals[index] = text;
}

/* The scalars of a node as the texts of one value. */
static pspec_status take_value(ps_scene *scene, const ps_scene_file *file, const char *key,
                               const ps_scene_node *node, ps_scene_value *out) {
    const size_t num = ps_scene_num_items(node);
    if (num == 0) {
        return ps_scene_complain(file, node->line, key, "an empty list");
    }
    PS_TRY(ps_scene_make_value(scene, num, node->line, out, file->error));
    const ps_scene_node *item = ps_scene_first_item(node);
    for (size_t i = 0; i < num; i++, item = item->next) {
        const char *text = NULL;
        PS_TRY(ps_scene_take_text(file, item, key, &text));
        set_text(out, i, text);
    }
    return PSPEC_OK;
}

/* A list of paths is one value; a list in which there are lists has a value in each item. */
static bool has_lists(const ps_scene_node *node) {
    for (const ps_scene_node *item = node->first; item != NULL; item = item->next) {
        if (node->kind == PS_NODE_LIST && item->kind == PS_NODE_LIST) {
            return true;
        }
    }
    return false;
}

/* "16..4096": powers of 2 times the first. num 0: the text is no such range. */
static pspec_status read_range(const char *text, uint64_t *first, size_t *num, ps_error *error) {
    enum { MOST_LETTERS = 31 };
    char left[MOST_LETTERS + 1];
    const char *const dots = strstr(text, "..");
    uint64_t last = 0;
    *num = 0;
    if (dots == NULL || dots - text > MOST_LETTERS) {
        return PSPEC_OK;
    }
    memcpy(left, text, (size_t)(dots - text));
    left[dots - text] = '\0';
    PS_TRY(ps_parse_count(left, "points", 1, INT64_MAX, first, error));
    PS_TRY(ps_parse_count(dots + 2, "points", 1, INT64_MAX, &last, error));
    if (last < *first) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "points: \"%s\": the first number is the larger one", text);
    }
    for (uint64_t n = *first; n <= last; n *= 2) {
        ++*num;
    }
    return PSPEC_OK;
}

static pspec_status expand_range(ps_scene *scene, const ps_scene_file *file,
                                 const ps_scene_node *node, ps_scene_entry *out, bool *is_range) {
    enum { NUMBER = 24 };
    const char *text = NULL;
    uint64_t first = 0;
    size_t num = 0;
    ps_error reason = {0};
    void *values = NULL;
    *is_range = false;
    if (out->option != PS_OPTION_POINTS || node->kind != PS_NODE_TEXT) {
        return PSPEC_OK;
    }
    PS_TRY(ps_scene_take_text(file, node, "points", &text));
    if (read_range(text, &first, &num, &reason) != PSPEC_OK) {
        return complain_of_value(file, node->line, "points", &reason);
    }
    *is_range = num > 0;
    PS_TRY(ps_scene_allocate(scene, num, sizeof *out->values, &values, file->error));
    out->values = values;
    out->num_values = num;
    for (size_t i = 0; i < num; i++) {
        char number[NUMBER];
        const char *kept = NULL;
        snprintf(number, sizeof number, "%llu", (unsigned long long)(first << i));
        PS_TRY(ps_scene_copy(scene, "", number, &kept, file->error));
        PS_TRY(ps_scene_make_value(scene, 1, out->line, &out->values[i], file->error));
        set_text(&out->values[i], 0, kept);
    }
    return PSPEC_OK;
}

static pspec_status take_values(ps_scene *scene, const ps_scene_file *file, const char *key,
                                const ps_scene_node *node, ps_scene_entry *out) {
    const bool is_one = out->option == PS_SCENE_FILES && !has_lists(node);
    const size_t num = is_one ? 1 : ps_scene_num_items(node);
    void *values = NULL;
    if (num == 0 || num > MOST_VALUES) {
        return num == 0 ? ps_scene_complain(file, node->line, key, "an empty list")
                        : ps_scene_complain(file, node->line, key, "%zu values, more than %d", num,
                                            MOST_VALUES);
    }
    PS_TRY(ps_scene_allocate(scene, num, sizeof *out->values, &values, file->error));
    out->values = values;
    out->num_values = num;
    const ps_scene_node *item = is_one ? node : ps_scene_first_item(node);
    for (size_t i = 0; i < num; i++, item = item->next) {
        if (item->kind == PS_NODE_LIST && out->option != PS_SCENE_FILES) {
            return ps_scene_complain(file, item->line, key,
                                     "a list in a list; only files have those");
        }
        PS_TRY(take_value(scene, file, key, item, &out->values[i]));
    }
    return PSPEC_OK;
}

pspec_status ps_scene_take_entry(ps_scene *scene, const ps_scene_file *file,
                                 const ps_result_kind *kind, int option, const char *key,
                                 const ps_scene_node *value, ps_scene_entry *out) {
    bool is_range = false;
    *out = (ps_scene_entry){.option = option, .line = value->line};
    PS_TRY(expand_range(scene, file, value, out, &is_range));
    if (!is_range) {
        PS_TRY(take_values(scene, file, key, value, out));
    }
    for (size_t i = 0; i < out->num_values; i++) {
        PS_TRY(resolve_paths(scene, file, kind, option, &out->values[i]));
        PS_TRY(check_value(file, kind, option, key, &out->values[i]));
    }
    return PSPEC_OK;
}
