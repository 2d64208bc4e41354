/* Nodes of YAML, complaints about them, and memory for what is taken from them. */
#include "scene/scene_file.h"

#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- complaints ---------------------------------------------------------------------------- */

pspec_status ps_scene_complain(const ps_scene_file *file, int line, const char *key,
                               const char *format, ...) {
    char sentence[PS_MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    return file->is_made ? ps_fail(file->error, PSPEC_ERROR_INPUT, "%s", sentence)
                         : ps_fail(file->error, PSPEC_ERROR_INPUT, "%s:%d: %s%s%s", file->path,
                                   line, key != NULL ? key : "", key != NULL ? ": " : "", sentence);
}

pspec_status ps_scene_fail_parser(const ps_scene_file *file, const yaml_parser_t *parser) {
    if (parser->error == YAML_MEMORY_ERROR) {
        return ps_fail(file->error, PSPEC_ERROR_MEMORY, "no memory for the scene \"%s\"",
                       file->path);
    }
    /* errors of single bytes have an offset, no mark */
    const int line =
        (int)(parser->problem_mark.line > 0 ? parser->problem_mark.line : parser->mark.line) + 1;
    return ps_scene_complain(file, line, NULL, "not YAML: %s%s%s",
                             parser->context != NULL ? parser->context : "",
                             parser->context != NULL ? ", " : "",
                             parser->problem != NULL ? parser->problem : "unknown reason");
}

/* ---- nodes ------------------------------------------------------------------------------- */

pspec_status ps_scene_take_text(const ps_scene_file *file, const ps_scene_node *node,
                                const char *key, const char **out) {
    if (node->kind != PS_NODE_TEXT) {
        return ps_scene_complain(file, node->line, key, "one value is wanted here, not a %s",
                                 node->kind == PS_NODE_LIST ? "list" : "mapping");
    }
    if (strlen(node->text) != node->length) {
        return ps_scene_complain(file, node->line, key, "a byte of value 0 in a text");
    }
    if (node->length == 0) {
        return ps_scene_complain(file, node->line, key, "no value");
    }
    *out = node->text;
    return PSPEC_OK;
}

size_t ps_scene_num_items(const ps_scene_node *node) {
    return node->kind == PS_NODE_LIST ? node->num_items : 1;
}

const ps_scene_node *ps_scene_first_item(const ps_scene_node *node) {
    return node->kind == PS_NODE_LIST ? node->first : node;
}

size_t ps_scene_num_pairs(const ps_scene_node *node) {
    return node->num_items / 2;
}

pspec_status ps_scene_pair(const ps_scene_file *file, const ps_scene_node *mapping, size_t index,
                           const char **key, const ps_scene_node **value) {
    const ps_scene_node *node = mapping->first;
    for (size_t i = 0; i < index; i++) {
        node = node->next->next;
    }
    PS_TRY(ps_scene_take_text(file, node, NULL, key));
    for (const ps_scene_node *other = mapping->first; other != node; other = other->next->next) {
        if (strcmp(other->text, *key) == 0) {
            return ps_scene_complain(file, node->line, *key, "this key stands in line %d already",
                                     other->line);
        }
    }
    *value = node->next;
    return PSPEC_OK;
}

/* ---- memory ------------------------------------------------------------------------------ */

pspec_status ps_scene_copy(const ps_scene_file *file, const char *text, const char **out) {
    const size_t bytes = strlen(text) + 1;
    char *copy = NULL;
    PS_TRY(PS_SCENE_NEW(file, &copy, bytes));
    *out = memcpy(copy, text, bytes);
    return PSPEC_OK;
}

void ps_scene_free(ps_scene *scene) {
    ps_pool_free(&scene->memory);
    *scene = (ps_scene){0};
}
