/* A scene answered, and what becomes of the answers, in this order: prepare, answer, write, judge.
 * Each file is one part:
 *
 *     run.c        the whole of it, its beginning and end
 *     answers.c    every question from the cache or computed
 *     cache.c      keys and bytes of answers in the cache
 *     tables.c     tables of the results, and summaries
 *     pictures.c   which pictures there are
 *     plots.c      those pictures, drawn, with the words that tell curves apart
 *     page.c       the page that shows them
 *     record.c     the record that repeats them
 *     report.c     the page alone, of a scene that is made of a command line
 *     files.c      names of the files that there will be
 *     folder.c     the folder for them; former.c: files of the former run in it
 *     write.c      the files
 *     verdict.c    what it comes to
 *     plan_blocks.c  what it would do
 *     shares.c     may several processes share the questions?
 */
#ifndef PS_SCENE_RUN_RUN_H
#define PS_SCENE_RUN_RUN_H

#include "answers/kind.h"
#include "base/memory.h"
#include "device/kind.h"
#include "files/digest.h"
#include "scene/scene.h"
#include "store/result_cache.h"

/* ---- which pictures a result has, and under which names -------------------------------------- */

enum { PS_SUFFIX_BYTES = 96 };

typedef struct ps_picture {
    char suffix[PS_SUFFIX_BYTES]; /* of the file: NAME + suffix + .svg */
    const ps_picture_kind *kind;
    /* What its questions have and those of other pictures do not; NULL: there are no others */
    const ps_scene_value *value;
    /* Entries of the result: of that value, of the numbers of points along a line, and of the value
     * that a panel has for itself; and that which changes fastest, by which panels are told apart
     * where none has values for itself. num_entries: none. */
    size_t group, points, panel, fastest;
    /* Questions, a curve each, or the first of a curve against numbers of points, those of a panel
     * together; panel i ends before ends[i]. One panel: a frame without others. */
    size_t num_curves, num_panels;
    size_t *curves, *ends;
} ps_picture;

typedef struct ps_pictures {
    size_t num, capacity;
    ps_picture *all;
    ps_pool memory; /* of their curves and panels */
} ps_pictures;

/* Those that the answers may lead to: of some there turns out to be nothing to draw. Known before
 * any work, and the one list by which they are drawn. Freed by ps_pictures_free, also after an
 * error. */
pspec_status ps_pictures_list(ps_pictures *out, const ps_scene_result *asked,
                              ps_error *error) PS_MUST_CHECK;
/* Why it has panels, and of what. */
void ps_picture_say_panels(const ps_picture *picture, const ps_scene_result *asked, ps_text *out);
void ps_pictures_free(ps_pictures *pictures);

/* Has this entry several values? */
bool ps_run_varies(const ps_scene_entry *entry);

/* ---- a run -------------------------------------------------------------------------------- */

typedef struct ps_run_question {
    ps_scene_question asked;
    ps_text key; /* of the cache; made once, since all inputs are read for it; empty before */
    ps_answer answer;
    double seconds; /* that it took to compute, also when the cache has it */
    bool is_cached;
    char digest[PS_DIGEST_BYTES]; /* of the rows of the table and of the array */
} ps_run_question;

typedef struct ps_run_plot {
    const ps_picture *what;
    char *svg;    /* NULL: it could not be drawn */
    char *reason; /* why not; else NULL */
} ps_run_plot;

typedef struct ps_run_result {
    const ps_scene_result *asked;
    size_t num;
    ps_run_question *questions; /* [num] of those of the run */
    ps_table *table, *summary;  /* the summary has a row for each question */
    ps_pictures pictures;       /* that may come of it */
    size_t num_plots, plot_capacity;
    ps_run_plot *plots;
} ps_run_result;

/* What a file of the folder is. */
typedef enum ps_run_part {
    PS_RUN_RECORD,
    PS_RUN_PAGE,
    PS_RUN_TABLE,
    PS_RUN_SUMMARY,
    PS_RUN_ARRAY,
    PS_RUN_PICTURE
} ps_run_part;

typedef struct ps_run_file {
    const char *path, *name;     /* name: its end, behind the folder */
    const ps_run_result *result; /* whose it is; NULL: the run's */
    ps_run_part part;
    size_t index; /* of the question, or the picture, in the result */
    bool is_written;
    char digest[PS_DIGEST_BYTES]; /* of what was written; "" where that is not known */
} ps_run_file;

/* All files that a run may write, known before the work. */
typedef struct ps_run_files {
    size_t num, capacity;
    ps_run_file *all; /* sorted by name */
    ps_pool memory;   /* of their paths */
} ps_run_files;

typedef struct ps_run {
    ps_answer_hooks hooks; /* the watch hears of the work for each question */
    const ps_request *arguments;
    const ps_scene *scene;
    const char *folder;  /* for the results; "": none is made */
    bool is_page_alone;  /* which names no files beside it */
    ps_cache *cache;     /* NULL: none */
    ps_text identity;    /* of program and device, for the keys of the cache */
    ps_device_kind kind; /* of the device */
    ps_device *device;   /* that of the hooks, or opened here; NULL: none yet */
    bool owns_device;
    bool lacks_device; /* a plan that goes on without */
    size_t num_results, num_questions, num_cached;
    ps_run_question *questions; /* of the results, one after the other */
    ps_made_integrands made;    /* of all of them, till the end of the run */
    double seconds;             /* of this run */
    size_t num_undrawn;
    ps_error undrawn; /* why the first picture that was not drawn was not */
    ps_run_result *results;
    ps_run_files files; /* that this run may write */
    ps_scene former;    /* the record of the former run in the folder; no files: none */
    bool is_written;    /* all files are there, but for the last record */
} ps_run;

/* All of it: the scene arguments->files[0], with its results in the folder arguments->output, or in
 * one of the scene's name. *out is {0} before and has the overview then, and the verdict on records
 * and checks; it is freed by ps_answer_free, also after an error. */
pspec_status ps_run_produce(ps_answer *out, const ps_request *arguments,
                            const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

/* A page about the points that the arguments name, beside known sets, into arguments->output. */
pspec_status ps_run_report(ps_answer *out, const ps_request *arguments,
                           const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;
/* Its plan: a block for every question. */
pspec_status ps_run_plan_report(ps_planner *planner, const ps_request *arguments,
                                ps_error *error) PS_MUST_CHECK;

/* look_at_shares of the row: questions are shared where there is a cache for the answers. */
pspec_status ps_run_look_at_shares(uint64_t *num, ps_error *why, const ps_request *arguments,
                                   ps_error *error) PS_MUST_CHECK;

/* ---- the steps of it ------------------------------------------------------------------------- */

/* One scene is run at a time. */
pspec_status ps_run_check_words(const ps_request *arguments, ps_error *error) PS_MUST_CHECK;
/* Reads the scene and gives it the limit of memory of the command, if there is one. A record
 * repeats what was typed then: POINTSPEC_MEMORY of today is not for it. */
pspec_status ps_run_read_scene(ps_scene *out, const ps_request *arguments,
                               ps_error *error) PS_MUST_CHECK;
/* Writes all files. The record comes first: with it the folder is one of a run, whatever happens
 * next. A picture that cannot be drawn is no error: run->num_undrawn. */
pspec_status ps_run_write(ps_run *run, ps_error *error) PS_MUST_CHECK;
/* PSPEC_ERROR_CHECK where the scene is a record whose digests are others, a check found another
 * spectrum, or a cut-off leaves more open than was asked. */
pspec_status ps_run_judge(const ps_run *run, ps_error *error) PS_MUST_CHECK;

/* ---- the steps of these ---------------------------------------------------------------------- */

/* Makes all questions and looks whether they can be asked, without work. */
pspec_status ps_run_ask(ps_run *run, ps_error *error) PS_MUST_CHECK;
/* Of a team (hooks.team) the share of this member goes into the cache first, then the first member
 * does the rest. */
pspec_status ps_run_answer(ps_run *run, ps_error *error) PS_MUST_CHECK;
/* Is the rest of the run that of another, who has share 0? */
bool ps_run_only_helps(const ps_run *run);
/* Removes checkpoints of questions, when everything is written. */
void ps_run_end_checkpoints(const ps_run *run);
/* The device of all questions: its programs are built once. None where the question needs
 * none, or its kind may lack it and there is none. */
pspec_status ps_run_open_device(ps_run *run, const ps_run_question *question,
                                ps_error *error) PS_MUST_CHECK;
/* Finds out who we are, and opens the cache unless the arguments say that there is none. A cache
 * that cannot be had is no error, but a warning. */
pspec_status ps_run_open_cache(ps_run *run, ps_error *error) PS_MUST_CHECK;
/* Why answers of the scene are not kept; NULL: they are, if the folder can be had. */
const char *ps_run_find_why_uncached(const ps_request *arguments, const ps_scene *scene);
/* Keeps the answer under the key that ps_run_fetch made of the inputs before it was computed. */
void ps_run_keep(ps_run *run, const ps_run_question *question);
/* Takes the answer, and the seconds that computing it took, from the cache, if they are there. */
pspec_status ps_run_fetch(ps_run *run, ps_run_question *question, ps_error *error) PS_MUST_CHECK;
/* What is wrong with the cache keeps nobody from computing: it is told once, and forgotten. */
void ps_run_warn_of_cache(const ps_run *run, ps_error *reason);
void ps_run_free(ps_run *run);

pspec_status ps_run_make_tables(const ps_run *run, ps_run_result *result,
                                ps_error *error) PS_MUST_CHECK;
/* A picture that fails is counted and said, and is no error. */
pspec_status ps_run_make_plots(ps_run *run, ps_run_result *result, ps_error *error) PS_MUST_CHECK;
/* Whole texts: HTML and JSON. */
pspec_status ps_run_page(const ps_run *run, ps_text *out, ps_error *error) PS_MUST_CHECK;
pspec_status ps_run_record(const ps_run *run, ps_text *out, ps_error *error) PS_MUST_CHECK;
/* A row for each result: how many questions, how many from the cache, seconds. *out is also to be
 * destroyed after an error. */
pspec_status ps_run_overview(ps_table **out, const ps_run *run, ps_error *error) PS_MUST_CHECK;

/* All files that the run may write, into run->files. Two results that want the same one are
 * PSPEC_ERROR_INPUT, with the line of one. */
pspec_status ps_run_list_files(ps_run *run, ps_error *error) PS_MUST_CHECK;
/* NULL: there is none of that name. */
ps_run_file *ps_run_find_file(const ps_run *run, const char *name);
extern const char ps_run_record_name[];

/* ---- the folder: folder.c ---------------------------------------------------------------- */

/* The folder for a scene where none is named: the scene's name without its folder and ending. */
void ps_run_name_folder(const char *scene, ps_text *out);
/* A folder of an earlier run is written over; one with anything else in it is somebody's. Whether
 * files can be made there is found out before the work, which may be long. */
pspec_status ps_run_check_folder(const ps_run *run, ps_error *error) PS_MUST_CHECK;
pspec_status ps_run_make_folder(const char *path, ps_error *error) PS_MUST_CHECK;

/* ---- the former run in the folder: former.c ------------------------------------------ */

/* Reads its record, if there is one, and refuses to write over a file that it does not name:
 * somebody's own. A record that is no record, or of a version that named no files, says nothing. */
pspec_status ps_run_read_former(ps_run *run, ps_error *error) PS_MUST_CHECK;
/* Refuses to write over a file that the scene reads, whatever its names are. */
pspec_status ps_run_check_inputs(const ps_run *run, ps_error *error) PS_MUST_CHECK;
/* Removes what the former run wrote and this one did not: plain names in the folder, regular files
 * that have the bytes of then and that the scene does not read. Warns of what went, and what stayed
 * because it changed. */
pspec_status ps_run_remove_former(const ps_run *run, ps_error *error) PS_MUST_CHECK;
/* The files of the record, each as a JSON text: at the end those that were written, before it those
 * that may be there, so that the run after one that was interrupted knows them. */
void ps_run_print_files(const ps_run *run, ps_text *out);

/* ---- words and plans ------------------------------------------------------------------------- */

/* What tells a question from the others of its result, "jittered, 1024"; the kind where nothing
 * does. */
void ps_run_label(const ps_run_result *result, size_t number, ps_text *out);

/* A block of the plan for every question of the scene of the run. */
pspec_status ps_run_plan_blocks(ps_run *run, ps_planner *planner, ps_error *error) PS_MUST_CHECK;
/* Why pictures were not drawn, if some were not; where: what they are missing in. */
void ps_run_tell_of_pictures(const ps_run *run, const char *where);
/* The plan of the scene request->files[0]. */
pspec_status ps_run_plan(ps_planner *planner, const ps_request *arguments,
                         ps_error *error) PS_MUST_CHECK;

#endif
