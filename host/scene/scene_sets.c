/* Sets of files under names, values beside samplers: where points come from is one key. */
#include "request/file_list.h"
#include "scene/scene_file.h"

#include <string.h>

/* ---- the files of a set -------------------------------------------------------------------- */

/* A name or pattern, relative to the folder of the scene. */
static pspec_status add_path(const ps_scene_file *file, const char *name, ps_file_list *list,
                             const ps_scene_node *item) {
    const char *text = NULL;
    ps_error reason = {0};
    PS_TRY(ps_scene_take_text(file, item, name, &text));
    if (strcmp(text, "-") == 0) {
        return ps_scene_complain(file, item->line, name, PS_SCENE_NO_STREAM);
    }
    const bool is_absolute = text[0] == '/';
    const char *const folder = is_absolute ? "" : file->scene->folder;
    const pspec_status status = ps_file_list_add(list, "sets", folder, text, &reason);
    if (status == PSPEC_ERROR_MEMORY) {
        *file->error = reason;
        return status;
    }
    return status == PSPEC_OK ? PSPEC_OK
                              : ps_scene_complain(file, item->line, name, "%s", reason.message);
}

/* "NAME=a.txt,b.txt" */
static pspec_status write_option(const ps_scene_file *file, const char *name, ps_scene_value *out) {
    ps_text text = {0};
    ps_text_append(&text, "%s=", name);
    for (size_t i = 0; i < out->num_texts; i++) {
        if (strchr(out->texts[i], ',') != NULL) {
            ps_text_free(&text);
            return ps_scene_complain(file, out->line, name,
                                     "\"%s\" has a comma, which stands between files here",
                                     out->texts[i]);
        }
        ps_text_append(&text, "%s%s", i > 0 ? "," : "", out->texts[i]);
    }
    return ps_text_keep(&out->set, &file->scene->memory, &text, file->error);
}

/* Records name the files that were found, relative to the folder as the scene has them. */
static pspec_status copy_paths(const ps_scene_file *file, const char *name,
                               const ps_file_list *list, int line, ps_scene_value *out) {
    const size_t length = strlen(file->scene->folder);
    PS_TRY(ps_scene_make_value(file, list->num, line, out));
    for (size_t i = 0; i < list->num; i++) {
        const char **const text = &out->texts[i];
        PS_TRY(ps_scene_copy(file, list->paths[i], text));
        const bool is_below = strncmp(*text, file->scene->folder, length) == 0;
        out->originals[i] = *text + (is_below ? length : 0);
    }
    out->label = name;
    return write_option(file, name, out);
}

static pspec_status take_set(const ps_scene_file *file, const char *name, const ps_scene_node *node,
                             ps_scene_value *out) {
    ps_file_list list = {0};
    pspec_status status = PSPEC_OK;
    const ps_scene_node *item = ps_scene_first_item(node);
    if (ps_scene_num_items(node) == 0 || name[0] == '\0' || strlen(name) >= PS_SET_NAME_BYTES ||
        strchr(name, '=') != NULL) {
        return ps_scene_complain(file, node->line, "sets",
                                 "\"%s\" needs a name of 1 to %d bytes without =, and files", name,
                                 PS_SET_NAME_BYTES - 1);
    }
    for (size_t i = 0; status == PSPEC_OK && i < ps_scene_num_items(node); i++) {
        status = add_path(file, name, &list, item);
        item = item->next;
    }
    if (status == PSPEC_OK) {
        status = copy_paths(file, name, &list, node->line, out);
    }
    ps_file_list_free(&list);
    return status;
}

pspec_status ps_scene_take_sets(const ps_scene_file *file, const ps_scene_node *node,
                                ps_scene_entry *out) {
    const size_t num = ps_scene_num_pairs(node);
    *out = (ps_scene_entry){.option = PS_OPTION_SAMPLER, .line = node->line, .num_values = num};
    if (node->kind != PS_NODE_MAPPING || num == 0 || num > PS_MAX_SAMPLERS) {
        return ps_scene_complain(file, node->line, "sets",
                                 "a mapping is wanted here, of 1 to %d names to files, as in "
                                 "{mine: [a.txt, b.txt], theirs: c*.txt}",
                                 PS_MAX_SAMPLERS);
    }
    PS_TRY(PS_SCENE_NEW(file, &out->values, num));
    for (size_t i = 0; i < num; i++) {
        const char *name = NULL;
        const ps_scene_node *files = NULL;
        PS_TRY(ps_scene_pair(file, node, i, &name, &files));
        PS_TRY(take_set(file, name, files, &out->values[i]));
    }
    return PSPEC_OK;
}

/* ---- beside samplers ----------------------------------------------------------------------- */

size_t ps_scene_num_sets(const ps_scene_entry *entry) {
    size_t num = 0;
    for (size_t i = 0; i < entry->num_values + entry->num_more; i++) {
        num += entry->values[i].set != NULL;
    }
    return num;
}

bool ps_scene_are_sets(const ps_scene_entry *entry) {
    return ps_scene_num_sets(entry) == entry->num_values + entry->num_more;
}

static pspec_status check_names(const ps_scene_file *file, const ps_scene_entry *samplers,
                                const ps_scene_entry *sets) {
    for (size_t i = 0; i < sets->num_values; i++) {
        for (size_t k = 0; k < samplers->num_values; k++) {
            if (strcmp(sets->values[i].label, samplers->values[k].label) == 0) {
                return ps_scene_complain(file, sets->values[i].line, "sets",
                                         "\"%s\" is the name of a sampler of line %d already",
                                         sets->values[i].label, samplers->line);
            }
        }
    }
    return PSPEC_OK;
}

/* Samplers come first, whatever the order in the file: so a record has them. */
static pspec_status join(const ps_scene_file *file, ps_scene_entry *out,
                         const ps_scene_entry *samplers, const ps_scene_entry *sets) {
    const size_t num = samplers->num_values + sets->num_values;
    ps_scene_entry joined = *out;
    PS_TRY(check_names(file, samplers, sets));
    PS_TRY(PS_SCENE_NEW(file, &joined.values, num));
    joined.num_values = num;
    joined.num_more = 0;
    memcpy(joined.values, samplers->values, samplers->num_values * sizeof *joined.values);
    memcpy(joined.values + samplers->num_values, sets->values,
           sets->num_values * sizeof *joined.values);
    *out = joined;
    return PSPEC_OK;
}

/* Of a result that compares them, all of them are of one question. */
static void gather(const ps_scene_result *result, ps_scene_entry *sources) {
    if (result->is_joined && sources != NULL) {
        sources->num_more += sources->num_values - 1;
        sources->num_values = 1;
    }
}

pspec_status ps_scene_join_sources(const ps_scene_file *file, ps_scene_result *result) {
    ps_scene_entry *sources[2] = {NULL, NULL}; /* samplers, sets */
    for (size_t i = 0; i < result->num_entries; i++) {
        ps_scene_entry *const entry = &result->entries[i];
        if (entry->option == PS_OPTION_SAMPLER) {
            sources[ps_scene_num_sets(entry) > 0] = entry;
        }
    }
    if (sources[0] == NULL || sources[1] == NULL) {
        gather(result, sources[1]);
        return PSPEC_OK;
    }
    ps_scene_entry *const first = sources[0] < sources[1] ? sources[0] : sources[1];
    ps_scene_entry *const second = sources[0] < sources[1] ? sources[1] : sources[0];
    PS_TRY(join(file, first, sources[0], sources[1]));
    gather(result, first);
    result->num_entries--;
    memmove(second, second + 1,
            (size_t)(result->entries + result->num_entries - second) * sizeof *second);
    return PSPEC_OK;
}
