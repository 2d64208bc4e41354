/* The files of a run. */
#include "files/output_file.h"
#include "scene/run/run.h"

#include <string.h>

static pspec_status write_bytes(const char *path, const char *bytes, size_t num, ps_error *error) {
    ps_output_file *file = NULL;
    PS_TRY(ps_output_open(&file, path, error));
    ps_output_write(file, bytes, 1, num);
    return ps_output_commit(&file, error);
}

typedef pspec_status make_text(const ps_run *, ps_text *, ps_error *);

static pspec_status write_text(const char *path, const ps_run *run, make_text *make,
                               ps_error *error) {
    ps_text text = {0};
    pspec_status status = make(run, &text, error);
    if (status == PSPEC_OK) {
        status = write_bytes(path, ps_text_string(&text), text.length, error);
    }
    ps_text_free(&text);
    return status;
}

/* NULL: it was not drawn, or there is nothing to draw. */
static const char *find_picture(const ps_run_file *file) {
    const ps_run_result *const result = file->result;
    for (size_t p = 0; p < result->num_plots; p++) {
        if (result->plots[p].what == &result->pictures.all[file->index]) {
            return result->plots[p].svg;
        }
    }
    return NULL;
}

static const ps_npy_array *find_array(const ps_run_file *file) {
    const char *name = NULL;
    bool is_state = false;
    return ps_table_array(file->result->questions[file->index].answer.table, 0, &name, &is_state);
}

static pspec_status write_part(const ps_run *run, const ps_run_file *file, ps_error *error) {
    const char *svg = NULL;
    switch (file->part) {
    case PS_RUN_RECORD:
        return write_text(file->path, run, ps_run_record, error);
    case PS_RUN_PAGE:
        return write_text(file->path, run, ps_run_page, error);
    case PS_RUN_TABLE:
        return ps_table_write(file->result->table, file->path, PS_FORMAT_CSV, error);
    case PS_RUN_SUMMARY:
        return ps_table_write(file->result->summary, file->path, PS_FORMAT_CSV, error);
    case PS_RUN_ARRAY:
        return ps_npy_write_array(file->path, find_array(file), error);
    case PS_RUN_PICTURE:
        svg = find_picture(file);
        return write_bytes(file->path, svg, strlen(svg), error);
    }
    return PSPEC_OK;
}

/* A file that cannot be read back is of the run all the same, but no later run removes it. */
static pspec_status write_file(const ps_run *run, ps_run_file *file, ps_error *error) {
    ps_error ignored = {0};
    if (file->part == PS_RUN_PICTURE && find_picture(file) == NULL) {
        return PSPEC_OK;
    }
    PS_TRY(write_part(run, file, error));
    file->is_written = true;
    if (ps_digest_file(file->path, file->digest, &ignored) != PSPEC_OK) {
        file->digest[0] = '\0';
    }
    return PSPEC_OK;
}

/* Those of a result, NULL: of the run, that are such parts of it. */
static pspec_status write_parts(const ps_run *run, const ps_run_result *result, ps_run_part first,
                                ps_run_part last, ps_error *error) {
    for (size_t i = 0; i < run->files.num; i++) {
        ps_run_file *const file = &run->files.all[i];
        if (file->result == result && file->part >= first && file->part <= last) {
            PS_TRY(write_file(run, file, error));
        }
    }
    return PSPEC_OK;
}

/* The record comes first: with it the folder is one of a run, whatever happens next. Numbers come
 * before pictures. The record of the end names what was written; files of the former run go before
 * it, for it no longer names them. */
pspec_status ps_run_write(ps_run *run, ps_error *error) {
    PS_TRY(ps_run_make_folder(run->folder, error));
    PS_TRY(write_parts(run, NULL, PS_RUN_RECORD, PS_RUN_RECORD, error));
    for (size_t i = 0; i < run->num_results; i++) {
        PS_TRY(ps_run_make_tables(run, &run->results[i], error));
        PS_TRY(write_parts(run, &run->results[i], PS_RUN_TABLE, PS_RUN_ARRAY, error));
    }
    for (size_t i = 0; i < run->num_results; i++) {
        PS_TRY(ps_run_make_plots(run, &run->results[i], error));
        PS_TRY(write_parts(run, &run->results[i], PS_RUN_PICTURE, PS_RUN_PICTURE, error));
    }
    PS_TRY(write_parts(run, NULL, PS_RUN_PAGE, PS_RUN_PAGE, error));
    PS_TRY(ps_run_remove_former(run, error));
    run->is_written = true;
    return write_parts(run, NULL, PS_RUN_RECORD, PS_RUN_RECORD, error);
}
