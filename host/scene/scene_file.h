/* The YAML below a scene: nodes with their lines, complaints, memory. Private to host/scene. */
#ifndef PS_SCENE_SCENE_FILE_H
#define PS_SCENE_SCENE_FILE_H

#include "scene/scene.h"

#include <yaml.h>

/* A text, or what a list or mapping holds, with its line. Lives as long as the scene, as its text
 * does. */
typedef enum ps_scene_node_kind { PS_NODE_TEXT, PS_NODE_LIST, PS_NODE_MAPPING } ps_scene_node_kind;
typedef struct ps_scene_node {
    ps_scene_node_kind kind;
    int line;
    const char *text; /* of a text */
    size_t length;    /* of it: more than strlen where it holds bytes of value 0 */
    size_t num_items; /* of a list; keys and values of a mapping in turn */
    struct ps_scene_node *first, *last, *next; /* of these; the next one of what this is in */
} ps_scene_node;

/* What reads a scene. */
typedef struct ps_scene_file {
    ps_scene *scene;
    const char *path;
    bool is_made;                         /* as the scene is: complaints name no line */
    const ps_scene_node *root, *defaults; /* defaults NULL: none */
    ps_error *error;
} ps_scene_file;

/* The tree of the only document: no nest, anchor or mapping beyond what a scene can need, and no
 * alias. The parser is at its beginning, and is at its end then. */
pspec_status ps_scene_build(ps_scene_file *file, yaml_parser_t *parser) PS_MUST_CHECK;
/* What the parser objects to. */
pspec_status ps_scene_fail_parser(const ps_scene_file *file, const yaml_parser_t *parser);

/* Of "-" among what a scene reads. */
/* What a path of test data begins with. */
#define PS_SCENE_DATA "data:"
#define PS_SCENE_NO_STREAM "a scene can be run again, standard input (-) cannot"

/* Reads the only document of a file, "-" for standard input. */
pspec_status ps_scene_file_read(ps_scene_file *out, ps_scene *scene, const char *path,
                                ps_error *error) PS_MUST_CHECK;

/* The same of a text, of a file that has its path, scene and error. */
pspec_status ps_scene_file_parse(ps_scene_file *file, const unsigned char *bytes,
                                 size_t num) PS_MUST_CHECK;

/* "scene.yaml:3: points: ..."; key NULL: of no key. Returns PSPEC_ERROR_INPUT. */
pspec_status ps_scene_complain(const ps_scene_file *file, int line, const char *key,
                               const char *format, ...) PS_PRINTF(4, 5);

/* The text of a node; anything else is complained of. */
pspec_status ps_scene_take_text(const ps_scene_file *file, const ps_scene_node *node,
                                const char *key, const char **out) PS_MUST_CHECK;

/* Items of a list, linked by next; a node that is none counts as its only item. */
size_t ps_scene_num_items(const ps_scene_node *node);
const ps_scene_node *ps_scene_first_item(const ps_scene_node *node);

/* Pairs of a mapping. A key that is no text, and one that stands there twice, is complained of. */
size_t ps_scene_num_pairs(const ps_scene_node *node);
pspec_status ps_scene_pair(const ps_scene_file *file, const ps_scene_node *mapping, size_t index,
                           const char **key, const ps_scene_node **value) PS_MUST_CHECK;

/* Memory that lives as long as the scene. */
#define PS_SCENE_NEW(file, pointer, count)                                                         \
    PS_POOL_NEW(&(file)->scene->memory, (pointer), (count), "a scene", (file)->error)
pspec_status ps_scene_copy(const ps_scene_file *file, const char *text,
                           const char **out) PS_MUST_CHECK;

/* A value of num texts, which are set one by one. */
pspec_status ps_scene_make_value(const ps_scene_file *file, size_t num, int line,
                                 ps_scene_value *out) PS_MUST_CHECK;
/* Sets a text, which is as the file has it. */
void ps_scene_set_text(ps_scene_value *value, size_t index, const char *text);
/* The values of an option of a result, which word says: paths are made relative to the current
 * folder. */
pspec_status ps_scene_take_entry(const ps_scene_file *file, const ps_scene_result *result,
                                 int option, const char *key, const ps_scene_node *value,
                                 ps_scene_entry *out) PS_MUST_CHECK;

/* Which of ps_scene_axes a key is; -1: none. */
int ps_scene_find_axes(const char *key);
/* Has the kind pictures whose axes these are about? */
bool ps_scene_has_axes(const ps_kind *kind, int axes);
/* Takes the value of a key of axes. */
pspec_status ps_scene_take_axes(const ps_scene_file *file, ps_scene_result *result, int axes,
                                const ps_scene_node *value) PS_MUST_CHECK;

/* The values of `sets`, an entry of samplers. */
pspec_status ps_scene_take_sets(const ps_scene_file *file, const ps_scene_node *node,
                                ps_scene_entry *out) PS_MUST_CHECK;
/* Makes one entry of `samplers` and `sets`, where a result has both. */
pspec_status ps_scene_join_sources(const ps_scene_file *file,
                                   ps_scene_result *result) PS_MUST_CHECK;

/* What finds the files in values of an option; NULL: there are none, or they are the value. */
ps_option_input *ps_scene_find_input(int option);
/* The path of a file that is read in the value of an option of the kind, a part of text; NULL: it
 * names none. */
const char *ps_scene_find_path(const ps_kind *kind, int option, const char *text);

/* A scene asks at most so many questions: pages of more are of no use to anyone, and a record of
 * more could not be read. */
enum { PS_SCENE_MOST_QUESTIONS = 10000 };

/* One of the results, but for a name that the file does not say. */
pspec_status ps_scene_take_result(const ps_scene_file *file, const ps_scene_node *node,
                                  ps_scene_result *out) PS_MUST_CHECK;

/* The word that a complaint may suggest: begins as {0}, and ends as the nearest of those
 * considered. */
typedef struct ps_scene_nearest {
    const char *word;
    size_t distance;
} ps_scene_nearest;
void ps_scene_consider(ps_scene_nearest *best, const char *typed, const char *known);

#endif
