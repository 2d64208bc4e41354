/* The files of a run. */
#include "files/output_file.h"
#include "scene/run/run.h"

#include <stdio.h>
#include <string.h>

/* A file that cannot be read back is of the run all the same, but no later run removes it. */
static void note_written(const ps_run *run, const char *path) {
    ps_error ignored = {0};
    ps_run_file *const file = ps_run_files_find(&run->files, strrchr(path, '/') + 1);
    if (file != NULL) {
        file->is_written = true;
        if (ps_digest_file(path, file->digest, &ignored) != PSPEC_OK) {
            file->digest[0] = '\0';
        }
    }
}

static pspec_status write_file(const ps_run *run, const char *name, const char *ending,
                               const char *bytes, size_t num, ps_error *error) {
    ps_text path = {0};
    ps_output_file *file = NULL;
    ps_text_append(&path, "%s/%s%s", run->folder, name, ending);
    pspec_status status = ps_text_check(&path, error);
    if (status == PSPEC_OK) {
        status = ps_output_open(&file, ps_text_string(&path), error);
    }
    if (status == PSPEC_OK) {
        ps_output_write(file, bytes, 1, num);
        status = ps_output_commit(&file, error);
    }
    if (status == PSPEC_OK) {
        note_written(run, ps_text_string(&path));
    }
    ps_text_free(&path);
    return status;
}

static pspec_status write_table(const ps_run *run, const ps_table *table, const char *name,
                                const char *ending, ps_error *error) {
    ps_text path = {0};
    ps_text_append(&path, "%s/%s%s", run->folder, name, ending);
    pspec_status status = ps_text_check(&path, error);
    if (status == PSPEC_OK) {
        status = ps_table_write(table, ps_text_string(&path), PS_FORMAT_CSV, error);
    }
    if (status == PSPEC_OK) {
        note_written(run, ps_text_string(&path));
    }
    ps_text_free(&path);
    return status;
}

/* Of a question that has one: lists of frequencies fill none. */
static pspec_status write_array(const ps_run *run, const ps_answer *answer, const char *name,
                                size_t question, ps_error *error) {
    const char *field = NULL;
    bool is_state = false;
    ps_text path = {0};
    ps_text_append(&path, "%s/%s%s%s", run->folder, name, ps_run_array_suffix(question).text,
                   ps_run_array_ending);
    pspec_status status = ps_text_check(&path, error);
    if (status == PSPEC_OK) {
        status = ps_npy_write_array(ps_text_string(&path),
                                    ps_table_array(answer->table, 0, &field, &is_state), error);
    }
    if (status == PSPEC_OK) {
        note_written(run, ps_text_string(&path));
    }
    ps_text_free(&path);
    return status;
}

typedef pspec_status make_text(const ps_run *, ps_text *, ps_error *);

static pspec_status write_text(const ps_run *run, const char *name, make_text *make,
                               ps_error *error) {
    ps_text text = {0};
    pspec_status status = make(run, &text, error);
    if (status == PSPEC_OK) {
        status = write_file(run, name, "", ps_text_string(&text), text.length, error);
    }
    ps_text_free(&text);
    return status;
}

static pspec_status write_picture(const ps_run *run, const char *name, const ps_run_plot *plot,
                                  ps_error *error) {
    char ending[PS_SUFFIX_BYTES + 8];
    snprintf(ending, sizeof ending, "%s%s", plot->what->suffix, ps_run_picture_ending);
    return write_file(run, name, ending, plot->svg, strlen(plot->svg), error);
}

static pspec_status write_tables(const ps_run *run, ps_run_result *result, ps_error *error) {
    const char *const name = result->asked->name;
    PS_TRY(ps_run_make_tables(run, result, error));
    PS_TRY(write_table(run, result->table, name, ps_run_table_ending, error));
    PS_TRY(write_table(run, result->summary, name, ps_run_summary_ending, error));
    for (size_t q = 0; result->asked->wants_arrays && q < result->num; q++) {
        PS_TRY(write_array(run, &result->questions[q].answer, name, q, error));
    }
    return PSPEC_OK;
}

static pspec_status write_pictures(ps_run *run, ps_run_result *result, ps_error *error) {
    PS_TRY(ps_run_make_plots(run, result, error));
    for (size_t p = 0; p < result->num_plots; p++) {
        if (result->plots[p].svg != NULL) {
            PS_TRY(write_picture(run, result->asked->name, &result->plots[p], error));
        }
    }
    return PSPEC_OK;
}

/* The record comes first: with it the folder is one of a run, whatever happens next. Numbers come
 * before pictures. The record of the end names what was written; files of the former run go before
 * it, for it no longer names them. */
pspec_status ps_run_write(ps_run *run, ps_error *error) {
    PS_TRY(ps_run_make_folder(run->folder, error));
    PS_TRY(write_text(run, ps_run_record_name, ps_run_record, error));
    for (size_t i = 0; i < run->num_results; i++) {
        PS_TRY(write_tables(run, &run->results[i], error));
    }
    for (size_t i = 0; i < run->num_results; i++) {
        PS_TRY(write_pictures(run, &run->results[i], error));
    }
    PS_TRY(write_text(run, ps_run_page_name, ps_run_page, error));
    PS_TRY(ps_run_remove_former(run, error));
    run->is_written = true;
    return write_text(run, ps_run_record_name, ps_run_record, error);
}
