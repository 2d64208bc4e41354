/* The schema of scenes: the keys of the file. */
#include "base/text.h"
#include "scene/scene_file.h"

#include <stdio.h>
#include <string.h>

/* Pages of more are of no use to anyone. */
enum { MOST_RESULTS = 256 };

/* power-1, .. where the file says none. */
static pspec_status name_result(const ps_scene_file *file, size_t index) {
    enum { NAME = 96 };
    char text[NAME];
    ps_scene_result *const result = &file->scene->results[index];
    if (result->name == NULL) {
        snprintf(text, sizeof text, "%s-%zu", result->kind->name, index + 1);
        PS_TRY(ps_scene_copy(file, text, &result->name));
    }
    for (size_t i = 0; i < index; i++) {
        if (strcmp(file->scene->results[i].name, result->name) == 0) {
            return ps_scene_complain(file, result->line, "name",
                                     "\"%s\" is the name of the result of line %d already",
                                     result->name, file->scene->results[i].line);
        }
    }
    return PSPEC_OK;
}

static pspec_status take_results(const ps_scene_file *file, const ps_scene_node *node) {
    const size_t num = ps_scene_num_items(node);
    if (node->kind != PS_NODE_LIST || num == 0 || num > MOST_RESULTS) {
        return ps_scene_complain(file, node->line, "results",
                                 "a list of 1 to %d results is wanted here", MOST_RESULTS);
    }
    PS_TRY(PS_SCENE_NEW(file, &file->scene->results, num));
    size_t num_questions = 0;
    const ps_scene_node *item = ps_scene_first_item(node);
    for (size_t i = 0; i < num; i++, item = item->next) {
        PS_TRY(ps_scene_take_result(file, item, &file->scene->results[i]));
        file->scene->num_results++;
        num_questions += ps_scene_num_questions(&file->scene->results[i]);
        if (num_questions > PS_SCENE_MOST_QUESTIONS) {
            return ps_scene_complain(file, file->scene->results[i].line, "results",
                                     "here the scene asks %zu questions, more than %d",
                                     num_questions, PS_SCENE_MOST_QUESTIONS);
        }
        PS_TRY(name_result(file, i));
    }
    return PSPEC_OK;
}

static pspec_status take_texts(const ps_scene_file *file, const ps_scene_node *node,
                               const char *key, const char ***out, size_t *num_out) {
    const size_t num = ps_scene_num_items(node);
    PS_TRY(PS_SCENE_NEW(file, out, num));
    const ps_scene_node *item = ps_scene_first_item(node);
    for (size_t i = 0; i < num; i++, item = item->next) {
        PS_TRY(ps_scene_take_text(file, item, key, &(*out)[i]));
    }
    *num_out = num;
    return PSPEC_OK;
}

static pspec_status take_engine(const ps_scene_file *file, const ps_scene_node *question,
                                size_t number) {
    if (question->kind != PS_NODE_MAPPING) {
        return ps_scene_complain(file, question->line, "questions", "no list of mappings");
    }
    file->scene->engines[number] = file->scene->precisions[number] = "";
    for (size_t i = 0; i < ps_scene_num_pairs(question); i++) {
        const char *key = NULL;
        const ps_scene_node *value = NULL;
        PS_TRY(ps_scene_pair(file, question, i, &key, &value));
        if (strcmp(key, "engine") == 0) {
            PS_TRY(ps_scene_take_text(file, value, key, &file->scene->engines[number]));
        } else if (strcmp(key, "precision") == 0) {
            PS_TRY(ps_scene_take_text(file, value, key, &file->scene->precisions[number]));
        }
    }
    return PSPEC_OK;
}

static pspec_status take_engines(const ps_scene_file *file, const ps_scene_node *node) {
    ps_scene *const scene = file->scene;
    const size_t num = ps_scene_num_items(node);
    PS_TRY(PS_SCENE_NEW(file, &scene->engines, 2 * num));
    scene->precisions = scene->engines + num;
    const ps_scene_node *item = ps_scene_first_item(node);
    for (size_t i = 0; i < num; i++, item = item->next) {
        PS_TRY(take_engine(file, item, i));
    }
    scene->num_engines = num;
    return PSPEC_OK;
}

/* What a run wrote (docs/user/scenes.md); other keys are for people. */
static pspec_status take_record(const ps_scene_file *file, const ps_scene_node *node) {
    if (node->kind != PS_NODE_MAPPING) {
        return ps_scene_complain(file, node->line, "record", "no mapping");
    }
    for (size_t i = 0; i < ps_scene_num_pairs(node); i++) {
        const char *key = NULL;
        const ps_scene_node *value = NULL;
        PS_TRY(ps_scene_pair(file, node, i, &key, &value));
        if (strcmp(key, "folder") == 0) {
            PS_TRY(ps_scene_take_text(file, value, key, &file->scene->folder));
        } else if (strcmp(key, "digests") == 0) {
            PS_TRY(take_texts(file, value, key, &file->scene->digests, &file->scene->num_digests));
        } else if (strcmp(key, "files") == 0) {
            PS_TRY(take_texts(file, value, key, &file->scene->files, &file->scene->num_files));
        } else if (strcmp(key, "pointspec_version") == 0) {
            PS_TRY(ps_scene_take_text(file, value, key, &file->scene->recorded_version));
        } else if (strcmp(key, "device") == 0) {
            PS_TRY(ps_scene_take_text(file, value, key, &file->scene->recorded_device));
        } else if (strcmp(key, "kind") == 0) {
            PS_TRY(ps_scene_take_text(file, value, key, &file->scene->recorded_kind));
        } else if (strcmp(key, "questions") == 0) {
            PS_TRY(take_engines(file, value));
        }
    }
    return PSPEC_OK;
}

static pspec_status check_schema(const ps_scene_file *file, const ps_scene_node *node) {
    const char *text = NULL;
    PS_TRY(ps_scene_take_text(file, node, "scene", &text));
    return strcmp(text, "1") == 0
               ? PSPEC_OK
               : ps_scene_complain(file, node->line, "scene",
                                   "schema \"%s\" is not known, this version reads schema 1", text);
}

/* The keys of the file; the results come last, when the defaults and the folder are known. */
typedef struct parts {
    const ps_scene_node *schema, *title, *description, *defaults, *results, *record;
} parts;

static pspec_status find_parts(const ps_scene_file *file, const ps_scene_node *root, parts *out) {
    const struct {
        const char *key;
        const ps_scene_node **node;
    } known[] = {{"scene", &out->schema},
                 {"title", &out->title},
                 {"description", &out->description},
                 {"defaults", &out->defaults},
                 {"results", &out->results},
                 {"record", &out->record}};
    for (size_t i = 0; i < ps_scene_num_pairs(root); i++) {
        const char *key = NULL;
        const ps_scene_node *value = NULL;
        ps_scene_nearest best = {NULL, 0};
        bool is_known = false;
        PS_TRY(ps_scene_pair(file, root, i, &key, &value));
        for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
            ps_scene_consider(&best, key, known[k].key);
            if (strcmp(key, known[k].key) == 0) {
                *known[k].node = value;
                is_known = true;
            }
        }
        if (!is_known) {
            return ps_scene_complain(
                file, value->line, key, "unknown key%s",
                ps_text_suggest(key, best.word, best.distance, "; did you mean ", "?").text);
        }
    }
    return PSPEC_OK;
}

static pspec_status find_folder(const ps_scene_file *file) {
    const char *const slash = strrchr(file->scene->path, '/');
    if (slash == NULL || strcmp(file->scene->path, "-") == 0) {
        file->scene->folder = "";
        return PSPEC_OK;
    }
    ps_text folder = {0};
    ps_text_append_bytes(&folder, file->scene->path, (size_t)(slash - file->scene->path) + 1);
    return ps_text_keep(&file->scene->folder, &file->scene->memory, &folder, file->error);
}

static pspec_status take_scene(ps_scene_file *file) {
    const ps_scene_node *const root = file->root;
    parts found = {0};
    if (root->kind != PS_NODE_MAPPING) {
        return ps_scene_complain(file, root->line, NULL,
                                 "a scene is a mapping with the keys scene and results");
    }
    PS_TRY(find_parts(file, root, &found));
    if (found.schema == NULL || found.results == NULL) {
        return ps_scene_complain(file, root->line, found.schema == NULL ? "scene" : "results",
                                 "is missing%s",
                                 found.schema == NULL ? ": a scene begins with scene: 1" : "");
    }
    PS_TRY(check_schema(file, found.schema));
    PS_TRY(find_folder(file));
    if (found.record != NULL) {
        PS_TRY(take_record(file, found.record));
    }
    if (found.title != NULL) {
        PS_TRY(ps_scene_take_text(file, found.title, "title", &file->scene->title));
    }
    if (found.description != NULL) {
        PS_TRY(
            ps_scene_take_text(file, found.description, "description", &file->scene->description));
    }
    if (found.defaults != NULL && found.defaults->kind != PS_NODE_MAPPING) {
        return ps_scene_complain(file, found.defaults->line, "defaults",
                                 "a mapping of keys is wanted here");
    }
    file->defaults = found.defaults;
    return take_results(file, found.results);
}

pspec_status ps_scene_read(ps_scene *out, const char *path, ps_error *error) {
    ps_scene_file file;
    *out = (ps_scene){.path = path};
    PS_TRY(ps_scene_file_read(&file, out, path, error));
    return take_scene(&file);
}

pspec_status ps_scene_read_text(ps_scene *out, const char *name, const char *text,
                                ps_error *error) {
    ps_scene_file file = {.scene = out, .path = name, .is_made = true, .error = error};
    *out = (ps_scene){.path = name, .is_made = true};
    PS_TRY(ps_scene_file_parse(&file, (const unsigned char *)text, strlen(text)));
    return take_scene(&file);
}
