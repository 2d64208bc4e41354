/* What libyaml and the schema would take the square of the file's size for, or more, is refused first, by the events of the
 * file, of which libyaml keeps none: nests, anchors and long mappings. Aliases are refused altogether: a scene that says
 * what it asks for needs none, and a few lines of them can stand for gigabytes. */
#include "scene/scene_file.h"

/* A scene needs 6 levels (results, a result, files, lists of files); more keys and anchors than these nobody writes by hand, and
 * records have none. */
enum { MOST_DEPTH = 16, MOST_ANCHORS = 1000, MOST_KEYS = 1000 };

/* A list or mapping that has begun. */
typedef struct level {
    int line;
    size_t num_nodes; /* in it so far; keys and values of a mapping count */
} level;

typedef struct shape {
    const ps_scene_file *file;
    int depth, num_anchors;
    level levels[MOST_DEPTH + 1]; /* [0]: the file */
} shape;

static bool has_anchor(const yaml_event_t *event) {
    return (event->type == YAML_SCALAR_EVENT && event->data.scalar.anchor != NULL) ||
           (event->type == YAML_SEQUENCE_START_EVENT &&
            event->data.sequence_start.anchor != NULL) ||
           (event->type == YAML_MAPPING_START_EVENT && event->data.mapping_start.anchor != NULL);
}

static pspec_status add_node(shape *seen, const yaml_event_t *event, int line) {
    if (event->type == YAML_ALIAS_EVENT) {
        return ps_scene_complain(seen->file, line, NULL,
                                 "an alias (*%s); what it stands for is to be written out",
                                 (const char *)event->data.alias.anchor);
    }
    seen->levels[seen->depth].num_nodes++;
    seen->num_anchors += has_anchor(event);
    if (seen->num_anchors > MOST_ANCHORS) {
        return ps_scene_complain(seen->file, line, NULL, "more than %d anchors (&name)",
                                 MOST_ANCHORS);
    }
    if (event->type == YAML_SCALAR_EVENT) {
        return PSPEC_OK;
    }
    if (seen->depth == MOST_DEPTH) {
        return ps_scene_complain(seen->file, line, NULL,
                                 "lists and mappings nested more than %d deep", MOST_DEPTH);
    }
    seen->levels[++seen->depth] = (level){line, 0};
    return PSPEC_OK;
}

static pspec_status end_mapping(shape *seen) {
    const level *const mapping = &seen->levels[seen->depth--];
    const size_t num_keys = mapping->num_nodes / 2;
    return num_keys <= MOST_KEYS
               ? PSPEC_OK
               : ps_scene_complain(seen->file, mapping->line, NULL,
                                   "a mapping of %zu keys, more than %d", num_keys, MOST_KEYS);
}

static pspec_status see(shape *seen, const yaml_event_t *event) {
    switch (event->type) {
    case YAML_ALIAS_EVENT:
    case YAML_SCALAR_EVENT:
    case YAML_SEQUENCE_START_EVENT:
    case YAML_MAPPING_START_EVENT:
        return add_node(seen, event, (int)event->start_mark.line + 1);
    case YAML_SEQUENCE_END_EVENT:
        seen->depth--;
        return PSPEC_OK;
    case YAML_MAPPING_END_EVENT:
        return end_mapping(seen);
    default:
        return PSPEC_OK;
    }
}

pspec_status ps_scene_check_events(ps_scene_file *file, yaml_parser_t *parser) {
    shape seen = {.file = file};
    for (bool is_over = false; !is_over;) {
        yaml_event_t event;
        if (!yaml_parser_parse(parser, &event)) {
            return ps_scene_fail_parser(file, parser);
        }
        is_over = event.type == YAML_STREAM_END_EVENT;
        const pspec_status status = see(&seen, &event);
        yaml_event_delete(&event);
        PS_TRY(status);
    }
    return PSPEC_OK;
}
