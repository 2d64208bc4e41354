/* The files of a run: which there will be, known before the work, and which there were by the
 * record of a former run. */
#ifndef PS_SCENE_RUN_FILES_H
#define PS_SCENE_RUN_FILES_H

#include "base/text.h"
#include "files/digest.h"

#include <stdbool.h>
#include <stddef.h>

struct ps_run;
struct ps_scene_result;

/* One file of the folder. */
typedef struct ps_run_file {
    char *name;
    const struct ps_scene_result *result; /* whose it is; NULL: the run's */
    bool is_written;
    char digest[PS_DIGEST_BYTES]; /* of what was written; "" where that is not known */
} ps_run_file;

typedef struct ps_run_files {
    size_t num, capacity;
    ps_run_file *all; /* sorted by name */
} ps_run_files;

/* Names are made of these, here and where files are written. */
extern const char ps_run_table_ending[], ps_run_summary_ending[], ps_run_picture_ending[];
extern const char ps_run_array_ending[];
extern const char ps_run_record_name[], ps_run_page_name[];
/* "-array-1", of the first question of a result. */
typedef struct ps_array_suffix {
    char text[32];
} ps_array_suffix;
ps_array_suffix ps_run_array_suffix(size_t question);

/* All files that a run may write. Two results that want the same one are PSPEC_ERROR_INPUT, with
 * the line of one. Freed by ps_run_files_free, also after an error. */
pspec_status ps_run_files_list(ps_run_files *out, const struct ps_run *run,
                               ps_error *error) PS_MUST_CHECK;
void ps_run_files_free(ps_run_files *files);
/* NULL: there is none of that name. */
ps_run_file *ps_run_files_find(const ps_run_files *files, const char *name);

/* ---- the folder: folder.c ---------------------------------------------------------------- */

/* The folder for a scene where none is named: the scene's name without its folder and ending. */
void ps_run_name_folder(const char *scene, ps_text *out);
/* A folder of an earlier run is written over; one with anything else in it is somebody's. Whether
 * files can be made there is found out before the work, which may be long. */
pspec_status ps_run_check_folder(const char *path, ps_error *error) PS_MUST_CHECK;
pspec_status ps_run_make_folder(const char *path, ps_error *error) PS_MUST_CHECK;

/* ---- the former run in the folder: former.c ------------------------------------------ */

/* Reads its record, if there is one, and refuses to write over a file that it does not name:
 * somebody's own. A record that is no record, or of a version that named no files, says nothing. */
pspec_status ps_run_read_former(struct ps_run *run, ps_error *error) PS_MUST_CHECK;
/* Refuses to write over a file that the scene reads, whatever its names are. */
pspec_status ps_run_check_inputs(const struct ps_run *run, ps_error *error) PS_MUST_CHECK;
/* Removes what the former run wrote and this one did not: plain names in the folder, regular files
 * that have the bytes of then and that the scene does not read. Warns of what went, and what stayed
 * because it changed. */
pspec_status ps_run_remove_former(const struct ps_run *run, ps_error *error) PS_MUST_CHECK;
/* The files of the record, each as a JSON text: at the end those that were written, before it those
 * that may be there, so that the run after one that was interrupted knows them. */
void ps_run_print_files(const struct ps_run *run, ps_text *out);

#endif
