/* The schema of scenes. */
#include "scene/options.h"
#include "scene/scene_file.h"

#include <ctype.h>
#include <string.h>

/* Results of a scene, and questions of one: pages of more are of no use to anyone. */
enum { MOST_RESULTS = 256, MOST_QUESTIONS = 10000 };

typedef struct reader {
    ps_scene *scene;
    ps_scene_file *file;
    yaml_node_t *defaults; /* NULL: none */
} reader;

/* ---- words ------------------------------------------------------------------------------- */

/* Words that a complaint may suggest. */
typedef struct nearest {
    const char *word;
    size_t distance;
} nearest;

static void consider(nearest *best, const char *typed, const char *known) {
    const size_t distance = ps_name_distance(typed, known);
    if (best->word == NULL || distance < best->distance) {
        *best = (nearest){known, distance};
    }
}

static const char *const own_keys[] = {"result",   "name",  "title",   "plot",
                                       "pictures", "files", "samplers"};
enum { NUM_OWN_KEYS = sizeof own_keys / sizeof own_keys[0] };

/* The option that a key of a result means; -1: none. */
static int find_option(const ps_result_kind *kind, const char *key) {
    const bool takes_points = ps_options_have(kind->options, PS_OPTION_SAMPLER);
    if (strcmp(key, "files") == 0) {
        return takes_points ? PS_SCENE_FILES : -1;
    }
    const char *const name = strcmp(key, "samplers") == 0 ? "sampler" : key;
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        if (strcmp(ps_options[id].name, name) == 0) {
            return ps_options_have(kind->options, (ps_option_id)id) ? id : -1;
        }
    }
    return -1;
}

static bool is_any_option(const char *key) {
    for (size_t i = 0; ps_result_kinds[i] != NULL; i++) {
        if (find_option(ps_result_kinds[i], key) >= 0) {
            return true;
        }
    }
    return false;
}

static pspec_status complain_of_key(const reader *from, const ps_result_kind *kind, int line,
                                    const char *key) {
    nearest best = {NULL, 0};
    for (size_t i = 0; i < NUM_OWN_KEYS; i++) {
        consider(&best, key, own_keys[i]);
    }
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        if (ps_options_have(kind->options, (ps_option_id)id)) {
            consider(&best, key, ps_options[id].name);
        }
    }
    return ps_scene_complain(from->file, line, key, "%s; did you mean %s?",
                             is_any_option(key) ? "not a key of this result" : "unknown key",
                             best.word);
}

/* ---- one result -------------------------------------------------------------------------- */

static pspec_status take_switch(const reader *from, yaml_node_t *node, const char *key, bool *out) {
    const char *text = NULL;
    PS_TRY(ps_scene_take_text(from->file, node, key, &text));
    *out = strcmp(text, "true") == 0;
    return *out || strcmp(text, "false") == 0
               ? PSPEC_OK
               : ps_scene_complain(from->file, ps_scene_line(node), key,
                                   "true or false, not \"%s\"", text);
}

static pspec_status take_words(const reader *from, yaml_node_t *node, const char *key,
                               const char **out) {
    PS_TRY(ps_scene_take_text(from->file, node, key, out));
    return ps_scene_copy(from->scene, "", *out, out, from->file->error);
}

/* It becomes the name of files. */
static pspec_status take_name(const reader *from, yaml_node_t *node, const char **out) {
    enum { MOST_LETTERS = 64 };
    PS_TRY(take_words(from, node, "name", out));
    bool is_good = strlen(*out) <= MOST_LETTERS && (*out)[0] != '-';
    for (const char *c = *out; *c != '\0'; c++) {
        is_good = is_good && (isalnum((unsigned char)*c) || *c == '-' || *c == '_');
    }
    return is_good
               ? PSPEC_OK
               : ps_scene_complain(from->file, ps_scene_line(node), "name",
                                   "\"%s\" cannot name files: up to %d letters, digits, - and _",
                                   *out, MOST_LETTERS);
}

static pspec_status take_kind(const reader *from, yaml_node_t *node, const ps_result_kind **out) {
    const char *text = NULL;
    nearest best = {NULL, 0};
    PS_TRY(ps_scene_take_text(from->file, node, "result", &text));
    for (size_t i = 0; ps_result_kinds[i] != NULL; i++) {
        consider(&best, text, ps_result_kinds[i]->name);
        if (strcmp(text, ps_result_kinds[i]->name) == 0) {
            *out = ps_result_kinds[i];
            return PSPEC_OK;
        }
    }
    return ps_scene_complain(from->file, ps_scene_line(node), "result",
                             "\"%s\" is no kind of result; did you mean %s?", text, best.word);
}

static pspec_status take_pair(const reader *from, ps_scene_result *out, const char *key, int line,
                              yaml_node_t *value) {
    if (strcmp(key, "result") == 0) {
        return PSPEC_OK; /* taken before all others */
    }
    if (strcmp(key, "name") == 0) {
        return take_name(from, value, &out->name);
    }
    if (strcmp(key, "title") == 0) {
        return take_words(from, value, key, &out->title);
    }
    if (strcmp(key, "plot") == 0) {
        return take_switch(from, value, key, &out->wants_plot);
    }
    if (strcmp(key, "pictures") == 0 && out->kind == &ps_result_power) {
        return take_switch(from, value, key, &out->wants_pictures);
    }
    const int option = find_option(out->kind, key);
    if (option < 0) {
        return complain_of_key(from, out->kind, line, key);
    }
    return ps_scene_take_entry(from->scene, from->file, out->kind, option, key, value,
                               &out->entries[out->num_entries++]);
}

static bool has_entry(const ps_scene_result *result, int option) {
    for (size_t i = 0; i < result->num_entries; i++) {
        if (result->entries[i].option == option) {
            return true;
        }
    }
    return false;
}

/* Points come from a sampler or from files: the defaults' one gives way to the result's other. */
static bool is_settled(const ps_scene_result *result, int option) {
    return has_entry(result, option) ||
           (option == PS_OPTION_SAMPLER && has_entry(result, PS_SCENE_FILES)) ||
           (option == PS_SCENE_FILES && has_entry(result, PS_OPTION_SAMPLER));
}

static pspec_status take_defaults(const reader *from, ps_scene_result *out) {
    const size_t num_own = out->num_entries;
    ps_scene_result own = *out;
    for (size_t i = 0; from->defaults != NULL && i < ps_scene_num_pairs(from->defaults); i++) {
        const char *key = NULL;
        yaml_node_t *value = NULL;
        PS_TRY(ps_scene_pair(from->file, from->defaults, i, &key, &value));
        const int option = find_option(out->kind, key);
        own.num_entries = num_own;
        if (option >= 0 && !is_settled(&own, option)) {
            PS_TRY(ps_scene_take_entry(from->scene, from->file, out->kind, option, key, value,
                                       &out->entries[out->num_entries++]));
        } else if (option < 0 && !is_any_option(key)) {
            return complain_of_key(from, out->kind, ps_scene_line(value), key);
        }
    }
    return PSPEC_OK;
}

/* Which result it is says what the other keys may be. */
static pspec_status find_kind(const reader *from, yaml_node_t *node, ps_scene_result *out) {
    for (size_t i = 0; i < ps_scene_num_pairs(node); i++) {
        const char *key = NULL;
        yaml_node_t *value = NULL;
        PS_TRY(ps_scene_pair(from->file, node, i, &key, &value));
        if (strcmp(key, "result") == 0) {
            return take_kind(from, value, &out->kind);
        }
    }
    return ps_scene_complain(from->file, ps_scene_line(node), "result",
                             "is missing: power, angular, pairs, quadrature, truncation or check");
}

static pspec_status check_twice(const reader *from, const ps_scene_result *result) {
    for (size_t i = 0; i < result->num_entries; i++) {
        for (size_t j = 0; j < i; j++) {
            if (result->entries[i].option == result->entries[j].option) {
                return ps_scene_complain(from->file, result->entries[i].line,
                                         ps_scene_key(&result->entries[i]),
                                         "stands in line %d already", result->entries[j].line);
            }
        }
    }
    return PSPEC_OK;
}

static pspec_status check_questions(const reader *from, const ps_scene_result *result) {
    double num = 1;
    for (size_t i = 0; i < result->num_entries; i++) {
        num *= (double)result->entries[i].num_values;
    }
    return num <= MOST_QUESTIONS
               ? PSPEC_OK
               : ps_scene_complain(from->file, result->line, NULL,
                                   "the lists of this result ask %.3g questions, more than %d", num,
                                   MOST_QUESTIONS);
}

static pspec_status take_result(const reader *from, yaml_node_t *node, ps_scene_result *out) {
    void *entries = NULL;
    *out = (ps_scene_result){.line = ps_scene_line(node), .wants_plot = true};
    if (node->type != YAML_MAPPING_NODE) {
        return ps_scene_complain(from->file, out->line, "results", "a result is a mapping of keys");
    }
    PS_TRY(find_kind(from, node, out));
    /* every option, files, and `sampler` beside `samplers` */
    PS_TRY(ps_scene_allocate(from->scene, PS_NUM_OPTIONS + 2, sizeof *out->entries, &entries,
                             from->file->error));
    out->entries = entries;
    for (size_t i = 0; i < ps_scene_num_pairs(node); i++) {
        const char *key = NULL;
        yaml_node_t *value = NULL;
        PS_TRY(ps_scene_pair(from->file, node, i, &key, &value));
        PS_TRY(take_pair(from, out, key, ps_scene_line(value), value));
    }
    PS_TRY(check_twice(from, out));
    PS_TRY(take_defaults(from, out));
    PS_TRY(check_twice(from, out));
    return check_questions(from, out);
}

/* ---- the scene --------------------------------------------------------------------------- */

/* power-1, .. where the file says none. */
static pspec_status name_result(const reader *from, size_t index) {
    enum { NAME = 96 };
    char text[NAME];
    ps_scene_result *const result = &from->scene->results[index];
    if (result->name == NULL) {
        snprintf(text, sizeof text, "%s-%zu", result->kind->name, index + 1);
        PS_TRY(ps_scene_copy(from->scene, "", text, &result->name, from->file->error));
    }
    for (size_t i = 0; i < index; i++) {
        if (strcmp(from->scene->results[i].name, result->name) == 0) {
            return ps_scene_complain(from->file, result->line, "name",
                                     "\"%s\" is the name of the result of line %d already",
                                     result->name, from->scene->results[i].line);
        }
    }
    return PSPEC_OK;
}

static pspec_status take_results(const reader *from, yaml_node_t *node) {
    void *results = NULL;
    const size_t num = ps_scene_num_items(node);
    if (node->type != YAML_SEQUENCE_NODE || num == 0 || num > MOST_RESULTS) {
        return ps_scene_complain(from->file, ps_scene_line(node), "results",
                                 "a list of 1 to %d results is wanted here", MOST_RESULTS);
    }
    PS_TRY(ps_scene_allocate(from->scene, num, sizeof *from->scene->results, &results,
                             from->file->error));
    from->scene->results = results;
    for (size_t i = 0; i < num; i++) {
        PS_TRY(take_result(from, ps_scene_item(from->file, node, i), &from->scene->results[i]));
        from->scene->num_results++;
        PS_TRY(name_result(from, i));
    }
    return PSPEC_OK;
}

static pspec_status take_digests(const reader *from, yaml_node_t *node) {
    ps_scene *const scene = from->scene;
    void *digests = NULL;
    const size_t num = ps_scene_num_items(node);
    PS_TRY(ps_scene_allocate(scene, num, sizeof *scene->digests, &digests, from->file->error));
    scene->digests = digests;
    for (size_t i = 0; i < num; i++) {
        PS_TRY(take_words(from, ps_scene_item(from->file, node, i), "digests", &scene->digests[i]));
    }
    scene->num_digests = num;
    return PSPEC_OK;
}

/* What a run wrote (docs/scenes.md); other keys are for people. */
static pspec_status take_record(const reader *from, yaml_node_t *node) {
    if (node->type != YAML_MAPPING_NODE) {
        return ps_scene_complain(from->file, ps_scene_line(node), "record", "no mapping");
    }
    for (size_t i = 0; i < ps_scene_num_pairs(node); i++) {
        const char *key = NULL;
        yaml_node_t *value = NULL;
        PS_TRY(ps_scene_pair(from->file, node, i, &key, &value));
        if (strcmp(key, "folder") == 0) {
            PS_TRY(take_words(from, value, key, &from->scene->folder));
        } else if (strcmp(key, "digests") == 0) {
            PS_TRY(take_digests(from, value));
        } else if (strcmp(key, "pointspec_version") == 0) {
            PS_TRY(take_words(from, value, key, &from->scene->recorded_version));
        } else if (strcmp(key, "device") == 0) {
            PS_TRY(take_words(from, value, key, &from->scene->recorded_device));
        }
    }
    return PSPEC_OK;
}

static pspec_status check_schema(const reader *from, yaml_node_t *node) {
    const char *text = NULL;
    PS_TRY(ps_scene_take_text(from->file, node, "scene", &text));
    return strcmp(text, "1") == 0
               ? PSPEC_OK
               : ps_scene_complain(from->file, ps_scene_line(node), "scene",
                                   "schema \"%s\" is not known, this version reads schema 1", text);
}

/* The keys of the file; the results come last, when the defaults and the folder are known. */
typedef struct parts {
    yaml_node_t *schema, *title, *description, *defaults, *results, *record;
} parts;

static pspec_status find_parts(const reader *from, yaml_node_t *root, parts *out) {
    const struct {
        const char *key;
        yaml_node_t **node;
    } known[] = {{"scene", &out->schema},
                 {"title", &out->title},
                 {"description", &out->description},
                 {"defaults", &out->defaults},
                 {"results", &out->results},
                 {"record", &out->record}};
    for (size_t i = 0; i < ps_scene_num_pairs(root); i++) {
        const char *key = NULL;
        yaml_node_t *value = NULL;
        nearest best = {NULL, 0};
        bool is_known = false;
        PS_TRY(ps_scene_pair(from->file, root, i, &key, &value));
        for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
            consider(&best, key, known[k].key);
            if (strcmp(key, known[k].key) == 0) {
                *known[k].node = value;
                is_known = true;
            }
        }
        if (!is_known) {
            return ps_scene_complain(from->file, ps_scene_line(value), key,
                                     "unknown key; did you mean %s?", best.word);
        }
    }
    return PSPEC_OK;
}

static pspec_status find_folder(const reader *from) {
    const char *const slash = strrchr(from->scene->path, '/');
    if (slash == NULL || strcmp(from->scene->path, "-") == 0) {
        from->scene->folder = "";
        return PSPEC_OK;
    }
    void *memory = NULL;
    const size_t length = (size_t)(slash - from->scene->path) + 1;
    PS_TRY(ps_scene_allocate(from->scene, length + 1, 1, &memory, from->file->error));
    memcpy(memory, from->scene->path, length);
    from->scene->folder = memory;
    return PSPEC_OK;
}

static pspec_status take_scene(reader *from, yaml_node_t *root) {
    parts found = {0};
    if (root->type != YAML_MAPPING_NODE) {
        return ps_scene_complain(from->file, ps_scene_line(root), NULL,
                                 "a scene is a mapping with the keys scene and results");
    }
    PS_TRY(find_parts(from, root, &found));
    if (found.schema == NULL || found.results == NULL) {
        return ps_scene_complain(from->file, ps_scene_line(root),
                                 found.schema == NULL ? "scene" : "results", "is missing%s",
                                 found.schema == NULL ? ": a scene begins with scene: 1" : "");
    }
    PS_TRY(check_schema(from, found.schema));
    PS_TRY(find_folder(from));
    if (found.record != NULL) {
        PS_TRY(take_record(from, found.record));
    }
    if (found.title != NULL) {
        PS_TRY(take_words(from, found.title, "title", &from->scene->title));
    }
    if (found.description != NULL) {
        PS_TRY(take_words(from, found.description, "description", &from->scene->description));
    }
    if (found.defaults != NULL && found.defaults->type != YAML_MAPPING_NODE) {
        return ps_scene_complain(from->file, ps_scene_line(found.defaults), "defaults",
                                 "a mapping of keys is wanted here");
    }
    from->defaults = found.defaults;
    return take_results(from, found.results);
}

pspec_status ps_scene_read(ps_scene *out, const char *path, ps_error *error) {
    ps_scene_file file;
    *out = (ps_scene){.path = path};
    pspec_status status = ps_scene_file_open(&file, path, error);
    if (status == PSPEC_OK) {
        reader from = {out, &file, NULL};
        status = take_scene(&from, yaml_document_get_root_node(&file.document));
    }
    ps_scene_file_close(&file);
    return status;
}
