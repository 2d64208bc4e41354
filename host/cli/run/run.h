/* pointspec run: a scene answered, and what becomes of the answers. cmd_run.c goes through it once:
 *
 *     run_answers.c   every question from the cache or computed
 *     run_cache.c     keys and bytes of answers in the cache
 *     run_tables.c    tables of the results, and summaries
 *     run_pictures.c  which pictures there are
 *     run_plots.c     those pictures, drawn
 *     run_page.c      the page that shows them
 *     run_record.c    the record that repeats them
 *     run_files.c     names of the files that there will be
 *     run_former.c    files of the former run in the folder
 */
#ifndef PS_CLI_RUN_RUN_H
#define PS_CLI_RUN_RUN_H

#include "cli/command.h"
#include "cli/run/files.h"
#include "cli/run/pictures.h"
#include "files/digest.h"
#include "store/result_cache.h"
#include "scene/scene.h"

typedef struct ps_run_question {
    ps_scene_question asked;
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
    const ps_request *arguments;
    const ps_scene *scene;
    const char *folder; /* for the results */
    ps_cache *cache;    /* NULL: none */
    ps_text identity;   /* of program and device, for the keys of the cache */
    ps_device *device;  /* NULL: not opened yet */
    bool lacks_device;  /* a plan that goes on without */
    size_t num_results, num_questions, num_cached;
    double seconds; /* of this run */
    size_t num_undrawn;
    ps_error undrawn; /* why the first picture that was not drawn was not */
    ps_run_result *results;
    ps_run_files files; /* that this run may write */
    ps_scene former;    /* the record of the former run in the folder; no files: none */
    bool is_written;    /* all files are there, but for the last record */
} ps_run;

/* Reads the scene and gives it the limit of memory of the command, if there is one. A record repeats what was typed then:
 * POINTSPEC_MEMORY of today is not for it. */
pspec_status ps_run_read_scene(ps_scene *out, const ps_request *arguments,
                               ps_error *error) PS_MUST_CHECK;
/* Makes all questions and looks whether they can be asked, without work. */
pspec_status ps_run_ask(ps_run *run, ps_error *error) PS_MUST_CHECK;
pspec_status ps_run_answer(ps_run *run, ps_error *error) PS_MUST_CHECK;
/* The device of all questions: its programs are built once. None where the result needs none. */
pspec_status ps_run_open_device(ps_run *run, const ps_run_result *result,
                                ps_error *error) PS_MUST_CHECK;
/* Finds out who we are, and opens the cache unless the arguments say that there is none. A cache that cannot be had is no
 * error, but a warning. */
pspec_status ps_run_open_cache(ps_run *run, ps_error *error) PS_MUST_CHECK;
pspec_status ps_run_keep(ps_run *run, const ps_run_question *question, double seconds,
                         ps_error *error) PS_MUST_CHECK;
/* Is the answer in the cache? *out is to be freed in either case; *seconds is what computing it took. */
pspec_status ps_run_fetch(ps_run *run, const ps_run_question *question, ps_answer *out,
                          double *seconds, bool *is_found, ps_error *error) PS_MUST_CHECK;
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
/* PSPEC_ERROR_CHECK where the scene is a record whose digests are others. */
pspec_status ps_run_compare(const ps_run *run, ps_error *error) PS_MUST_CHECK;

/* What tells a question from the others of its result, "jittered, 1024"; the kind where nothing does. */
void ps_run_label(const ps_run_result *result, size_t number, ps_text *out);

#endif
