/* What libyaml and the schema would take the square of the file's size for, or more, is refused first: nests, anchors,
 * long mappings, and aliases of aliases. */
#include "scene/scene_file.h"

/* A scene needs 6 levels (results, a result, files, lists of files); more keys and anchors than these nobody writes by hand, and
 * records have none. A list of 10000 questions in a record is below 5 MB. */
enum { MOST_DEPTH = 16, MOST_ANCHORS = 1000, MOST_KEYS = 1000, MOST_EXPANDED = 1 << 24 };

/* ---- the file as events, which libyaml keeps none of ------------------------------------- */

static bool has_anchor(const yaml_event_t *event) {
    return (event->type == YAML_SCALAR_EVENT && event->data.scalar.anchor != NULL) ||
           (event->type == YAML_SEQUENCE_START_EVENT &&
            event->data.sequence_start.anchor != NULL) ||
           (event->type == YAML_MAPPING_START_EVENT && event->data.mapping_start.anchor != NULL);
}

typedef struct counts {
    int depth, num_anchors;
} counts;

static pspec_status count_event(const ps_scene_file *file, const yaml_event_t *event,
                                counts *so_far) {
    const int line = (int)event->start_mark.line + 1;
    const bool begins =
        event->type == YAML_SEQUENCE_START_EVENT || event->type == YAML_MAPPING_START_EVENT;
    const bool ends =
        event->type == YAML_SEQUENCE_END_EVENT || event->type == YAML_MAPPING_END_EVENT;
    so_far->depth += begins - ends;
    so_far->num_anchors += has_anchor(event);
    if (so_far->depth > MOST_DEPTH) {
        return ps_scene_complain(file, line, NULL, "lists and mappings nested more than %d deep",
                                 MOST_DEPTH);
    }
    return so_far->num_anchors <= MOST_ANCHORS
               ? PSPEC_OK
               : ps_scene_complain(file, line, NULL, "more than %d anchors (&name)", MOST_ANCHORS);
}

pspec_status ps_scene_check_events(const ps_scene_file *file, yaml_parser_t *parser) {
    counts so_far = {0, 0};
    for (bool is_over = false; !is_over;) {
        yaml_event_t event;
        if (!yaml_parser_parse(parser, &event)) {
            return ps_scene_fail_parser(file, parser);
        }
        is_over = event.type == YAML_STREAM_END_EVENT;
        const pspec_status status = count_event(file, &event, &so_far);
        yaml_event_delete(&event);
        PS_TRY(status);
    }
    return PSPEC_OK;
}

/* ---- the document with every alias written out ------------------------------------------- */

typedef struct walk {
    const ps_scene_file *file;
    size_t left; /* of MOST_EXPANDED */
} walk;

static pspec_status visit(walk *over, const yaml_node_t *node, int depth);

static yaml_node_t *node_of(const walk *over, int number) {
    return yaml_document_get_node((yaml_document_t *)(uintptr_t)&over->file->document, number);
}

static pspec_status visit_inside(walk *over, const yaml_node_t *node, int depth) {
    if (node->type == YAML_SEQUENCE_NODE) {
        for (const yaml_node_item_t *item = node->data.sequence.items.start;
             item < node->data.sequence.items.top; item++) {
            PS_TRY(visit(over, node_of(over, *item), depth + 1));
        }
        return PSPEC_OK;
    }
    if (ps_scene_num_pairs(node) > MOST_KEYS) {
        return ps_scene_complain(over->file, ps_scene_line(node), NULL,
                                 "a mapping of %zu keys, more than %d", ps_scene_num_pairs(node),
                                 MOST_KEYS);
    }
    for (const yaml_node_pair_t *pair = node->data.mapping.pairs.start;
         pair < node->data.mapping.pairs.top; pair++) {
        PS_TRY(visit(over, node_of(over, pair->key), depth + 1));
        PS_TRY(visit(over, node_of(over, pair->value), depth + 1));
    }
    return PSPEC_OK;
}

/* An alias of what it stands in is nested without end. */
static pspec_status visit(walk *over, const yaml_node_t *node, int depth) {
    const size_t bytes =
        1 + (node->type == YAML_SCALAR_NODE ? node->data.scalar.length : sizeof *node);
    if (depth > MOST_DEPTH) {
        return ps_scene_complain(over->file, ps_scene_line(node), NULL,
                                 "nested more than %d deep: an alias of what it stands in?",
                                 MOST_DEPTH);
    }
    if (bytes > over->left) {
        return ps_scene_complain(over->file, ps_scene_line(node), NULL,
                                 "with all aliases (*name) written out the scene is larger than %d "
                                 "bytes",
                                 MOST_EXPANDED);
    }
    over->left -= bytes;
    return node->type == YAML_SCALAR_NODE ? PSPEC_OK : visit_inside(over, node, depth);
}

pspec_status ps_scene_check_aliases(const ps_scene_file *file, const yaml_node_t *root) {
    walk over = {file, MOST_EXPANDED};
    return visit(&over, root, 1);
}
