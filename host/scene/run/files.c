/* The files of a run: the one list by which they are known before the work, and written. */
#include "base/memory.h"
#include "scene/run/run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char ps_run_record_name[] = "record.json";

static pspec_status add(ps_run *run, ps_run_file file, const char *name, const char *suffix,
                        const char *ending, ps_error *error) {
    ps_run_files *const files = &run->files;
    ps_text path = {0};
    void *all = files->all;
    PS_TRY(ps_grow(&all, &files->capacity, files->num + 1, sizeof *files->all, "files", error));
    files->all = all;
    ps_text_append(&path, "%s/%s%s%s", run->folder, name, suffix, ending);
    PS_TRY(ps_text_keep(&file.path, &files->memory, &path, error));
    file.name = file.path + strlen(run->folder) + 1;
    files->all[files->num++] = file;
    return PSPEC_OK;
}

static pspec_status add_result(ps_run *run, const ps_run_result *result, ps_error *error) {
    const ps_scene_result *const asked = result->asked;
    ps_run_file file = {.result = result, .part = PS_RUN_TABLE};
    PS_TRY(add(run, file, asked->name, "", ".csv", error));
    file.part = PS_RUN_SUMMARY;
    PS_TRY(add(run, file, asked->name, "", ".summary.csv", error));
    file.part = PS_RUN_ARRAY;
    for (file.index = 0; asked->wants_arrays && file.index < result->num; file.index++) {
        char suffix[32];
        snprintf(suffix, sizeof suffix, "-array-%zu", file.index + 1);
        PS_TRY(add(run, file, asked->name, suffix, ".npy", error));
    }
    file.part = PS_RUN_PICTURE;
    for (file.index = 0; file.index < result->pictures.num; file.index++) {
        const char *const suffix = result->pictures.all[file.index].suffix;
        PS_TRY(add(run, file, asked->name, suffix, ".svg", error));
    }
    return PSPEC_OK;
}

static int compare_names(const void *a, const void *b) {
    return strcmp(((const ps_run_file *)a)->name, ((const ps_run_file *)b)->name);
}

static int line_of(const ps_run_file *file) {
    return file->result != NULL ? file->result->asked->line : 0;
}

static const char *owner_of(const ps_run_file *file) {
    return file->result != NULL ? file->result->asked->name : "the run";
}

static pspec_status complain(const ps_run *run, const ps_run_file *one, const ps_run_file *other,
                             ps_error *error) {
    const bool is_first = line_of(one) > line_of(other);
    const ps_run_file *const late = is_first ? one : other;
    const ps_run_file *const early = is_first ? other : one;
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "%s:%d: name: \"%s\" and \"%s\" would write the same file %s; another name "
                   "for one of them keeps them apart",
                   run->scene->path, line_of(late), owner_of(early), owner_of(late), late->name);
}

pspec_status ps_run_list_files(ps_run *run, ps_error *error) {
    ps_run_files *const files = &run->files;
    PS_TRY(add(run, (ps_run_file){.part = PS_RUN_RECORD}, ps_run_record_name, "", "", error));
    PS_TRY(add(run, (ps_run_file){.part = PS_RUN_PAGE}, "index.html", "", "", error));
    for (size_t i = 0; i < run->num_results; i++) {
        PS_TRY(add_result(run, &run->results[i], error));
    }
    qsort(files->all, files->num, sizeof *files->all, compare_names);
    for (size_t i = 1; i < files->num; i++) {
        if (compare_names(&files->all[i - 1], &files->all[i]) == 0) {
            return complain(run, &files->all[i - 1], &files->all[i], error);
        }
    }
    return PSPEC_OK;
}

ps_run_file *ps_run_find_file(const ps_run *run, const char *name) {
    const ps_run_file wanted = {.name = name};
    const ps_run_files *const files = &run->files;
    return files->num > 0
               ? bsearch(&wanted, files->all, files->num, sizeof *files->all, compare_names)
               : NULL;
}
