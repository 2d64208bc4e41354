#include "scene/run/files.h"

#include "base/memory.h"
#include "scene/run/run.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char ps_run_table_ending[] = ".csv";
const char ps_run_summary_ending[] = ".summary.csv";
const char ps_run_picture_ending[] = ".svg";
const char ps_run_array_ending[] = ".npy";
const char ps_run_record_name[] = "record.json";
const char ps_run_page_name[] = "index.html";

ps_array_suffix ps_run_array_suffix(size_t question) {
    ps_array_suffix out;
    snprintf(out.text, sizeof out.text, "-array-%zu", question + 1);
    return out;
}

static pspec_status add(ps_run_files *files, const ps_scene_result *result, const char *name,
                        const char *suffix, const char *ending, ps_error *error) {
    ps_text text = {0};
    void *all = files->all;
    PS_TRY(ps_grow(&all, &files->capacity, files->num + 1, sizeof *files->all, "files", error));
    files->all = all;
    ps_text_append(&text, "%s%s%s", name, suffix, ending);
    const pspec_status status = ps_text_check(&text, error);
    if (status != PSPEC_OK) {
        ps_text_free(&text);
        return status;
    }
    files->all[files->num++] = (ps_run_file){.name = text.data, .result = result};
    return PSPEC_OK;
}

static pspec_status add_result(ps_run_files *files, const ps_run_result *result, ps_error *error) {
    const ps_scene_result *const asked = result->asked;
    PS_TRY(add(files, asked, asked->name, "", ps_run_table_ending, error));
    PS_TRY(add(files, asked, asked->name, "", ps_run_summary_ending, error));
    for (size_t q = 0; asked->wants_arrays && q < result->num; q++) {
        PS_TRY(add(files, asked, asked->name, ps_run_array_suffix(q).text, ps_run_array_ending,
                   error));
    }
    for (size_t i = 0; i < result->pictures.num; i++) {
        PS_TRY(add(files, asked, asked->name, result->pictures.all[i].suffix, ps_run_picture_ending,
                   error));
    }
    return PSPEC_OK;
}

static int compare_names(const void *a, const void *b) {
    return strcmp(((const ps_run_file *)a)->name, ((const ps_run_file *)b)->name);
}

static pspec_status complain(const ps_run *run, const ps_run_file *one, const ps_run_file *other,
                             ps_error *error) {
    const bool is_first =
        other->result == NULL || (one->result != NULL && one->result->line > other->result->line);
    const ps_run_file *const late = is_first ? one : other;
    const ps_run_file *const early = is_first ? other : one;
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "%s:%d: name: \"%s\" and \"%s\" would write the same file %s; another name "
                   "for one of them keeps them apart",
                   run->scene->path, late->result != NULL ? late->result->line : 0,
                   early->result != NULL ? early->result->name : "the run",
                   late->result != NULL ? late->result->name : "the run", late->name);
}

pspec_status ps_run_files_list(ps_run_files *out, const ps_run *run, ps_error *error) {
    PS_TRY(add(out, NULL, ps_run_record_name, "", "", error));
    PS_TRY(add(out, NULL, ps_run_page_name, "", "", error));
    for (size_t i = 0; i < run->num_results; i++) {
        PS_TRY(add_result(out, &run->results[i], error));
    }
    qsort(out->all, out->num, sizeof *out->all, compare_names);
    for (size_t i = 1; i < out->num; i++) {
        if (compare_names(&out->all[i - 1], &out->all[i]) == 0) {
            return complain(run, &out->all[i - 1], &out->all[i], error);
        }
    }
    return PSPEC_OK;
}

void ps_run_files_free(ps_run_files *files) {
    for (size_t i = 0; i < files->num; i++) {
        free(files->all[i].name);
    }
    free(files->all);
    *files = (ps_run_files){0};
}

ps_run_file *ps_run_files_find(const ps_run_files *files, const char *name) {
    const ps_run_file wanted = {.name = (char *)(uintptr_t)name};
    return files->num > 0
               ? bsearch(&wanted, files->all, files->num, sizeof *files->all, compare_names)
               : NULL;
}
