/* A scene: a YAML file that asks for several results (docs/user/scenes.md has the schema).
 *
 *     scene: 1
 *     results:
 *       - result: power
 *         samplers: [white, jittered]
 *         points: 256..4096
 *
 * A key of a result is an option of the command of that name. A list of values asks for every one
 * of them: a result has one question for each combination, of which the key that stands last in the
 * file changes fastest.
 */
#ifndef PS_SCENE_SCENE_H
#define PS_SCENE_SCENE_H

#include "answers/kind.h"
#include "base/memory.h"
#include "base/text.h"

#define PS_SCENE_NO_DATA "it is not in the folder that POINTSPEC_TEST_DATA names"

/* One value of a key: a text; of `files`, and of a set, the paths that belong together. */
typedef struct ps_scene_value {
    size_t num_texts;
    const char **texts;     /* paths relative to the current folder */
    const char **originals; /* as the file has them */
    const char *label;      /* what tables and pages call the value: the first, or the set's name */
    const char *set;        /* NULL, or one of `sets`, a value beside samplers: as --set has it */
    int line;
} ps_scene_value;

enum { PS_SCENE_FILES = PS_NUM_OPTIONS }; /* the "option" of point files */

typedef struct ps_scene_entry {
    int option; /* a ps_option_id, or PS_SCENE_FILES */
    int line;
    size_t num_values;
    size_t num_more;        /* sets that the one question of a joined result has besides */
    ps_scene_value *values; /* [num_values + num_more] */
} ps_scene_entry;

enum { PS_SCENE_NUM_AXES = 2 }; /* keys of axes: plot-log and plot-range */
extern const ps_option_id ps_scene_axes[PS_SCENE_NUM_AXES];

typedef struct ps_scene_result {
    const ps_kind *kind;
    const char *name, *title; /* name: letters, digits, - and _; unique in the scene */
    int line;
    /* It has a key that compares samplers and numbers of points, which are values of one question
     * then, and not of several */
    bool is_joined;
    size_t num_entries;
    ps_scene_entry
        *entries;    /* of the result, then those of the defaults that it takes and does not say */
    bool wants_plot; /* unless the file says no */
    /* Of its pictures, which are no part of its questions; NULL: not said */
    const char *axes_texts[PS_SCENE_NUM_AXES];
    ps_plot_axes axes; /* what these say */
    /* The file asks for pictures of the averaged periodogram of every question. */
    bool wants_pictures;
    bool wants_decibels;     /* of spectra in dB, too */
    bool wants_arrays;       /* the file asks for the array of every question, */
    bool wants_coefficients; /* which are then its coefficients */
} ps_scene_result;

typedef struct ps_scene {
    const char *path;                /* borrowed */
    bool is_made;                    /* of ps_scene_read_text */
    const char *title, *description; /* NULL: none */
    /* What relative paths of the scene are relative to, with its /; "" for the current one */
    const char *folder;
    /* A file of "data:" that is not there, which an integrand does without; NULL: none */
    const char *missing;
    size_t num_results;
    ps_scene_result *results;
    /* of a record: what the questions, in their order, gave then; NULL in other scenes */
    size_t num_digests;
    const char **digests;
    const char *recorded_version, *recorded_device, *recorded_kind;
    size_t num_engines; /* engine and precision of each question, "" where there was none */
    const char **engines, **precisions;
    size_t num_files;
    /* That the run wrote, each "DIGEST NAME"; - for the digest of one that it did not finish */
    const char **files;
    ps_pool memory; /* what the texts and arrays are in */
} ps_scene;

/* Complaints are PSPEC_ERROR_INPUT and begin with file and line. Every value was looked at by
 * itself; whether those of a question fit together is found out by who asks it. Freed by
 * ps_scene_free, also after an error. */
pspec_status ps_scene_read(ps_scene *out, const char *path, ps_error *error) PS_MUST_CHECK;
/* The same of a text that a program has made: its lines are nobody's, and complaints name none. */
pspec_status ps_scene_read_text(ps_scene *out, const char *name, const char *text,
                                ps_error *error) PS_MUST_CHECK;
void ps_scene_free(ps_scene *scene);

/* A limit of memory becomes a key of every result that could have it and does not, so that records
 * keep it. */
pspec_status ps_scene_limit_memory(ps_scene *scene, uint64_t bytes, ps_error *error) PS_MUST_CHECK;

/* Every file that the scene reads: points, weights, frequencies, lobes, saved spectra. */
typedef pspec_status ps_scene_visit_input(void *payload, const ps_scene *scene,
                                          const ps_scene_entry *entry, const ps_scene_value *value,
                                          const char *path, ps_error *error);
pspec_status ps_scene_visit_inputs(const ps_scene *scene, ps_scene_visit_input *visit,
                                   void *payload, ps_error *error) PS_MUST_CHECK;
/* Refuses what is no regular file, or has no end, with its line and key, before anything is opened.
 */
pspec_status ps_scene_check_inputs(const ps_scene *scene, ps_error *error) PS_MUST_CHECK;

/* One question of a result. */
typedef struct ps_scene_question {
    const ps_scene_result *result;
    size_t number;      /* in the result, from 0 */
    ps_request request; /* quiet; texts borrowed from the scene and from command */
    ps_text command;    /* the command line that asks the same */
} ps_scene_question;

/* Are there points of files, sets or programs among those that it is about? */
bool ps_scene_reads_points(const ps_scene_result *result);
size_t ps_scene_num_questions(const ps_scene_result *result);
/* Freed by ps_scene_question_free, also after an error. */
pspec_status ps_scene_question_make(ps_scene_question *out, const ps_scene_result *result,
                                    size_t number, ps_error *error) PS_MUST_CHECK;
/* Has the question answered by the engine of a record, "(NAME ..)", in that precision, unless it
 * names an engine itself; "" is none. */
pspec_status ps_scene_question_use(ps_scene_question *question, const char *engine,
                                   const char *precision, ps_error *error) PS_MUST_CHECK;
void ps_scene_question_free(ps_scene_question *question);

/* The value that question `number` has of an entry. */
const ps_scene_value *ps_scene_value_of(const ps_scene_result *result, size_t number,
                                        size_t i_entry);
/* The entry of an option, of PS_OPTION_SAMPLER that of samplers and sets; NULL: none. */
const ps_scene_entry *ps_scene_find_entry(const ps_scene_result *result, int option);
/* How many values of an entry are sets; of sets alone all are. */
size_t ps_scene_num_sets(const ps_scene_entry *entry);
bool ps_scene_are_sets(const ps_scene_entry *entry);
/* The key of an entry, for complaints and names of columns: "points". */
const char *ps_scene_key(const ps_scene_entry *entry);

/* The sentence in *error gets file, line and name of the result in front of it. */
pspec_status ps_scene_blame(const ps_scene *scene, const ps_scene_result *result, ps_error *error);

/* Appends the scene as JSON, which is YAML too: what ps_scene_read makes the same questions of,
 * wherever the text lies. Ends before the closing brace, so that a record can add to it. */
void ps_scene_print(const ps_scene *scene, ps_text *out);
/* A JSON string with its quotes. */
void ps_scene_print_text(const char *text, ps_text *out);

#endif
