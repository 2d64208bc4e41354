/* The tree of a scene's file, built of the events of libyaml, which keeps none. What would cost the
 * square of the file's size, or more, is refused on the way: nests, anchors and long mappings.
 * Aliases are refused altogether: a scene that says what it asks for needs none, and a few lines of
 * them can stand for gigabytes. */
#include "scene/scene_file.h"

#include <string.h>

/* A scene needs 6 levels (results, a result, files, lists of files); more keys and anchors than
 * these nobody writes by hand, and records have none. */
enum { MOST_DEPTH = 16, MOST_ANCHORS = 1000, MOST_KEYS = 1000 };

typedef struct builder {
    ps_scene_file *file;
    int depth;
    int second_line;                     /* where a second document begins; 0: there is none */
    ps_scene_node *open[MOST_DEPTH + 1]; /* lists and mappings that have begun; [0] is not used */
    size_t num_anchors;
    const char *anchors[MOST_ANCHORS];
} builder;

/* NULL: it has none. */
static const char *find_anchor(const yaml_event_t *event) {
    return (const char *)(event->type == YAML_SCALAR_EVENT ? event->data.scalar.anchor
                          : event->type == YAML_SEQUENCE_START_EVENT
                              ? event->data.sequence_start.anchor
                              : event->data.mapping_start.anchor);
}

/* Nothing may refer to it, but twice the same one is an error of YAML all the same. */
static pspec_status note_anchor(builder *tree, const char *anchor, int line) {
    if (tree->num_anchors == MOST_ANCHORS) {
        return ps_scene_complain(tree->file, line, NULL, "more than %d anchors (&name)",
                                 MOST_ANCHORS);
    }
    for (size_t i = 0; i < tree->num_anchors; i++) {
        if (strcmp(tree->anchors[i], anchor) == 0) {
            return ps_scene_complain(
                tree->file, line, NULL,
                "not YAML: found duplicate anchor; first occurrence, second occurrence");
        }
    }
    return ps_scene_copy(tree->file, anchor, &tree->anchors[tree->num_anchors++]);
}

/* Puts a node at the end of what is open. */
static void attach(builder *tree, ps_scene_node *node) {
    if (tree->depth > 0) {
        ps_scene_node *const parent = tree->open[tree->depth];
        *(parent->last != NULL ? &parent->last->next : &parent->first) = node;
        parent->last = node;
        parent->num_items++;
    } else if (tree->file->root == NULL) {
        tree->file->root = node;
    } else if (tree->second_line == 0) {
        tree->second_line = node->line;
    }
}

/* The node of an event, with the copy of its text. */
static pspec_status make_node(builder *tree, const yaml_event_t *event, int line,
                              ps_scene_node **out) {
    const bool is_text = event->type == YAML_SCALAR_EVENT;
    const size_t length = is_text ? event->data.scalar.length : 0;
    char *text = NULL;
    PS_TRY(PS_SCENE_NEW(tree->file, out, 1));
    PS_TRY(PS_SCENE_NEW(tree->file, &text, length + 1));
    **out = (ps_scene_node){.kind = is_text                                    ? PS_NODE_TEXT
                                    : event->type == YAML_SEQUENCE_START_EVENT ? PS_NODE_LIST
                                                                               : PS_NODE_MAPPING,
                            .line = line,
                            .text = text,
                            .length = length};
    if (is_text) {
        memcpy(text, event->data.scalar.value, length);
    }
    return PSPEC_OK;
}

static pspec_status add_node(builder *tree, const yaml_event_t *event, int line) {
    ps_scene_node *node = NULL;
    if (event->type == YAML_ALIAS_EVENT) {
        return ps_scene_complain(tree->file, line, NULL,
                                 "an alias (*%s); what it stands for is to be written out",
                                 (const char *)event->data.alias.anchor);
    }
    const char *const anchor = find_anchor(event);
    if (anchor != NULL) {
        PS_TRY(note_anchor(tree, anchor, line));
    }
    PS_TRY(make_node(tree, event, line, &node));
    attach(tree, node);
    if (node->kind == PS_NODE_TEXT) {
        return PSPEC_OK;
    }
    if (tree->depth == MOST_DEPTH) {
        return ps_scene_complain(tree->file, line, NULL,
                                 "lists and mappings nested more than %d deep", MOST_DEPTH);
    }
    tree->open[++tree->depth] = node;
    return PSPEC_OK;
}

static pspec_status end_mapping(builder *tree) {
    const ps_scene_node *const mapping = tree->open[tree->depth--];
    const size_t num_keys = ps_scene_num_pairs(mapping);
    return num_keys <= MOST_KEYS
               ? PSPEC_OK
               : ps_scene_complain(tree->file, mapping->line, NULL,
                                   "a mapping of %zu keys, more than %d", num_keys, MOST_KEYS);
}

static pspec_status take_event(builder *tree, const yaml_event_t *event) {
    switch (event->type) {
    case YAML_ALIAS_EVENT:
    case YAML_SCALAR_EVENT:
    case YAML_SEQUENCE_START_EVENT:
    case YAML_MAPPING_START_EVENT:
        return add_node(tree, event, (int)event->start_mark.line + 1);
    case YAML_SEQUENCE_END_EVENT:
        tree->depth--;
        return PSPEC_OK;
    case YAML_MAPPING_END_EVENT:
        return end_mapping(tree);
    default:
        return PSPEC_OK;
    }
}

pspec_status ps_scene_build(ps_scene_file *file, yaml_parser_t *parser) {
    builder tree = {.file = file};
    for (bool is_over = false; !is_over;) {
        yaml_event_t event;
        if (!yaml_parser_parse(parser, &event)) {
            return ps_scene_fail_parser(file, parser);
        }
        is_over = event.type == YAML_STREAM_END_EVENT;
        const pspec_status status = take_event(&tree, &event);
        yaml_event_delete(&event);
        PS_TRY(status);
    }
    if (file->root == NULL) {
        return ps_scene_complain(file, 1, NULL, "nothing is asked for: the file has no content");
    }
    return tree.second_line == 0
               ? PSPEC_OK
               : ps_scene_complain(file, tree.second_line, NULL,
                                   "a second document begins here; a scene is one");
}
