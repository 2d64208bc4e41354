/* A scene answered, and what becomes of the answers, in this order: prepare, answer, write, judge.
 * Each file is one part:
 *
 *     run.c        the whole of it, its beginning and end
 *     answers.c    every question from the cache or computed
 *     cache.c      keys and bytes of answers in the cache
 *     tables.c     tables of the results, and summaries
 *     pictures.c   which pictures there are
 *     plots.c      those pictures, drawn; labels.c has the words that tell curves apart
 *     page.c       the page that shows them
 *     record.c     the record that repeats them
 *     files.c      names of the files that there will be
 *     folder.c     the folder for them; former.c: files of the former run in it
 *     write.c      the files
 *     verdict.c    what it comes to
 *     plan.c       what it would do
 */
#ifndef PS_SCENE_RUN_RUN_H
#define PS_SCENE_RUN_RUN_H

#include "answers/kind.h"
#include "device/kind.h"
#include "files/digest.h"
#include "scene/run/files.h"
#include "scene/run/pictures.h"
#include "scene/scene.h"
#include "store/result_cache.h"

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
    ps_run_question *questions;
    ps_table *table, *summary; /* the summary has a row for each question */
    ps_pictures pictures;      /* that may come of it */
    size_t num_plots, plot_capacity;
    ps_run_plot *plots;
} ps_run_result;

typedef struct ps_run {
    ps_answer_hooks hooks; /* the watch hears of the work for each question */
    const ps_request *arguments;
    const ps_scene *scene;
    const char *folder;  /* for the results */
    ps_cache *cache;     /* NULL: none */
    ps_text identity;    /* of program and device, for the keys of the cache */
    ps_device_kind kind; /* of the device */
    ps_device *device;   /* that of the hooks, or opened here; NULL: none yet */
    bool owns_device;
    bool lacks_device; /* a plan that goes on without */
    size_t num_results, num_questions, num_cached;
    double seconds; /* of this run */
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

/* ---- the steps of it ------------------------------------------------------------------------- */

/* Reads the scene and gives it the limit of memory of the command, if there is one. A record
 * repeats what was typed then: POINTSPEC_MEMORY of today is not for it. */
pspec_status ps_run_read_scene(ps_scene *out, const ps_request *arguments,
                               ps_error *error) PS_MUST_CHECK;
/* All that can be found out before the work: questions, folder, former run, cache. */
pspec_status ps_run_prepare(ps_run *run, ps_error *error) PS_MUST_CHECK;
/* Writes all files. The record comes first: with it the folder is one of a run, whatever happens
 * next. A picture that cannot be drawn is no error: run->num_undrawn. */
pspec_status ps_run_write(ps_run *run, ps_error *error) PS_MUST_CHECK;
/* PSPEC_ERROR_CHECK where the scene is a record whose digests are others, a check found another
 * spectrum, or a cut-off leaves more open than was asked. */
pspec_status ps_run_judge(const ps_run *run, ps_error *error) PS_MUST_CHECK;

/* ---- the steps of these ---------------------------------------------------------------------- */

/* Makes all questions and looks whether they can be asked, without work. */
pspec_status ps_run_ask(ps_run *run, ps_error *error) PS_MUST_CHECK;
pspec_status ps_run_answer(ps_run *run, ps_error *error) PS_MUST_CHECK;
/* The device of all questions: its programs are built once. None where the question needs none. */
pspec_status ps_run_open_device(ps_run *run, const ps_run_result *result,
                                const ps_run_question *question, ps_error *error) PS_MUST_CHECK;
/* Finds out who we are, and opens the cache unless the arguments say that there is none. A cache
 * that cannot be had is no error, but a warning. */
pspec_status ps_run_open_cache(ps_run *run, ps_error *error) PS_MUST_CHECK;
/* Keeps the answer under the key that ps_run_fetch made of the inputs before it was computed. */
void ps_run_keep(ps_run *run, const ps_run_question *question, double seconds);
/* Is the answer in the cache? *out is to be freed in either case; *seconds is what computing it
 * took. */
pspec_status ps_run_fetch(ps_run *run, ps_run_question *question, ps_answer *out, double *seconds,
                          bool *is_found, ps_error *error) PS_MUST_CHECK;
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

/* What tells a question from the others of its result, "jittered, 1024"; the kind where nothing
 * does. */
void ps_run_label(const ps_run_result *result, size_t number, ps_text *out);

/* The plan of the scene request->files[0]: one block for every question. */
pspec_status ps_run_plan(ps_planner *planner, const ps_request *arguments,
                         ps_error *error) PS_MUST_CHECK;

#endif
