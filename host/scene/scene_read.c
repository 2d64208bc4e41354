/* The schema of scenes: the keys of the file. */
#include "base/text.h"
#include "scene/scene_file.h"

#include <stdio.h>
#include <string.h>

/* Pages of more are of no use to anyone. */
enum { MOST_RESULTS = 256 };

/* power-1, .. where the file says none. */
static pspec_status name_result(const ps_scene_reader *from, size_t index) {
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

static pspec_status take_results(const ps_scene_reader *from, yaml_node_t *node) {
    void *results = NULL;
    const size_t num = ps_scene_num_items(node);
    if (node->type != YAML_SEQUENCE_NODE || num == 0 || num > MOST_RESULTS) {
        return ps_scene_complain(from->file, ps_scene_line(node), "results",
                                 "a list of 1 to %d results is wanted here", MOST_RESULTS);
    }
    PS_TRY(ps_scene_allocate(from->scene, num, sizeof *from->scene->results, &results,
                             from->file->error));
    from->scene->results = results;
    size_t num_questions = 0;
    for (size_t i = 0; i < num; i++) {
        PS_TRY(ps_scene_take_result(from, ps_scene_item(from->file, node, i),
                                    &from->scene->results[i]));
        from->scene->num_results++;
        num_questions += ps_scene_num_questions(&from->scene->results[i]);
        if (num_questions > PS_SCENE_MOST_QUESTIONS) {
            return ps_scene_complain(from->file, from->scene->results[i].line, "results",
                                     "here the scene asks %zu questions, more than %d",
                                     num_questions, PS_SCENE_MOST_QUESTIONS);
        }
        PS_TRY(name_result(from, i));
    }
    return PSPEC_OK;
}

static pspec_status take_texts(const ps_scene_reader *from, yaml_node_t *node, const char *key,
                               const char ***out, size_t *num_out) {
    void *memory = NULL;
    const size_t num = ps_scene_num_items(node);
    PS_TRY(ps_scene_allocate(from->scene, num, sizeof **out, &memory, from->file->error));
    *out = memory;
    for (size_t i = 0; i < num; i++) {
        PS_TRY(ps_scene_keep_text(from, ps_scene_item(from->file, node, i), key, &(*out)[i]));
    }
    *num_out = num;
    return PSPEC_OK;
}

/* What a run wrote (docs/scenes.md); other keys are for people. */
static pspec_status take_record(const ps_scene_reader *from, yaml_node_t *node) {
    if (node->type != YAML_MAPPING_NODE) {
        return ps_scene_complain(from->file, ps_scene_line(node), "record", "no mapping");
    }
    for (size_t i = 0; i < ps_scene_num_pairs(node); i++) {
        const char *key = NULL;
        yaml_node_t *value = NULL;
        PS_TRY(ps_scene_pair(from->file, node, i, &key, &value));
        if (strcmp(key, "folder") == 0) {
            PS_TRY(ps_scene_keep_text(from, value, key, &from->scene->folder));
        } else if (strcmp(key, "digests") == 0) {
            PS_TRY(take_texts(from, value, key, &from->scene->digests, &from->scene->num_digests));
        } else if (strcmp(key, "files") == 0) {
            PS_TRY(take_texts(from, value, key, &from->scene->files, &from->scene->num_files));
        } else if (strcmp(key, "pointspec_version") == 0) {
            PS_TRY(ps_scene_keep_text(from, value, key, &from->scene->recorded_version));
        } else if (strcmp(key, "device") == 0) {
            PS_TRY(ps_scene_keep_text(from, value, key, &from->scene->recorded_device));
        }
    }
    return PSPEC_OK;
}

static pspec_status check_schema(const ps_scene_reader *from, yaml_node_t *node) {
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

static pspec_status find_parts(const ps_scene_reader *from, yaml_node_t *root, parts *out) {
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
        ps_scene_nearest best = {NULL, 0};
        bool is_known = false;
        PS_TRY(ps_scene_pair(from->file, root, i, &key, &value));
        for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
            ps_scene_consider(&best, key, known[k].key);
            if (strcmp(key, known[k].key) == 0) {
                *known[k].node = value;
                is_known = true;
            }
        }
        if (!is_known) {
            return ps_scene_complain(
                from->file, ps_scene_line(value), key, "unknown key%s",
                ps_text_suggest(key, best.word, best.distance, "; did you mean ", "?").text);
        }
    }
    return PSPEC_OK;
}

static pspec_status find_folder(const ps_scene_reader *from) {
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

static pspec_status take_scene(ps_scene_reader *from, yaml_node_t *root) {
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
        PS_TRY(ps_scene_keep_text(from, found.title, "title", &from->scene->title));
    }
    if (found.description != NULL) {
        PS_TRY(
            ps_scene_keep_text(from, found.description, "description", &from->scene->description));
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
        ps_scene_reader from = {out, &file, NULL};
        status = take_scene(&from, yaml_document_get_root_node(&file.document));
    }
    ps_scene_file_close(&file);
    return status;
}
