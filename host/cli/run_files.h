/* The files of a run: which there will be, known before the work, and which there were by the record of a former run. */
#ifndef PS_CLI_RUN_FILES_H
#define PS_CLI_RUN_FILES_H

#include "cli/run.h"

/* One file of the folder. */
typedef struct ps_run_file {
    char *name;
    const ps_scene_result *of; /* NULL: of the run */
} ps_run_file;

typedef struct ps_run_files {
    size_t num, capacity;
    ps_run_file *all; /* sorted by name */
} ps_run_files;

/* Names are made of these, here and where files are written. */
extern const char ps_run_table_ending[], ps_run_summary_ending[], ps_run_picture_ending[];
extern const char ps_run_record_name[], ps_run_page_name[];

/* All files that a run may write. Two results that want the same one are PSPEC_ERROR_INPUT, with the line of one. Freed by
 * ps_run_files_free, also after an error. */
pspec_status ps_run_files_list(ps_run_files *out, const ps_run *run, ps_error *error) PS_MUST_CHECK;
void ps_run_files_free(ps_run_files *files);
bool ps_run_files_have(const ps_run_files *files, const char *name);

#endif
