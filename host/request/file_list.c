#include "request/file_list.h"

#include "base/memory.h"
#include "base/text.h"
#include "request/options.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char magic[] = "*?[\\";

static pspec_status add_text(ps_file_list *list, const char *before, const char *path,
                             ps_error *error) {
    void *grown = list->owned;
    char *copy = NULL;
    const size_t bytes = strlen(before) + strlen(path) + 1;
    const pspec_status status = ps_grow(&grown, &list->capacity, list->num + 1, sizeof *list->owned,
                                        "names of files", error);
    list->owned = grown;
    list->paths = (const char *const *)grown;
    PS_TRY(status);
    PS_TRY(PS_NEW(&copy, bytes, "the name of a file", error));
    snprintf(copy, bytes, "%s%s", before, path);
    list->owned[list->num++] = copy;
    return PSPEC_OK;
}

/* A file whose name is like that of a program is no program, whoever has put it there. */
static pspec_status add_path(ps_file_list *list, const char *path, ps_error *error) {
    return add_text(list, ps_points_program(path) != NULL ? "./" : "", path, error);
}

static pspec_status add_matches(ps_file_list *list, const char *pattern, const char *shown,
                                const char *said, ps_error *error) {
    glob_t found = {0};
    pspec_status status = PSPEC_OK;
    const int code = glob(pattern, 0, NULL, &found);
    if (code != 0) {
        status = code == GLOB_NOSPACE
                     ? ps_fail(error, PSPEC_ERROR_MEMORY, "no memory for the names of files of %s",
                               shown)
                     : ps_fail(error, PSPEC_ERROR_INPUT, "%s: no file matches \"%s\"", shown, said);
    }
    for (size_t i = 0; status == PSPEC_OK && i < found.gl_pathc; i++) {
        status = add_path(list, found.gl_pathv[i], error);
    }
    globfree(&found);
    return status;
}

/* Letters of a folder stand for themselves. */
static void append_escaped(ps_text *out, const char *text) {
    for (; *text != '\0'; text++) {
        ps_text_append(out, strchr(magic, *text) != NULL ? "\\%c" : "%c", *text);
    }
}

/* A name without a pattern, or of a file that is there, is taken as it is: whoever opens the file
 * says what is wrong with it. */
static pspec_status add_item(ps_file_list *list, const char *shown, const char *folder,
                             const char *item, ps_error *error) {
    ps_text path = {0};
    ps_text pattern = {0};
    ps_text_append(&path, "%s%s", folder, item);
    append_escaped(&pattern, folder);
    ps_text_append(&pattern, "%s", item);
    pspec_status status = ps_text_check(&path, error);
    if (status == PSPEC_OK) {
        status = ps_text_check(&pattern, error);
    }
    if (status == PSPEC_OK) {
        const char *const name = ps_text_string(&path);
        status = strpbrk(item, magic) == NULL || access(name, F_OK) == 0
                     ? add_path(list, name, error)
                     : add_matches(list, ps_text_string(&pattern), shown, name, error);
    }
    ps_text_free(&path);
    ps_text_free(&pattern);
    return status;
}

pspec_status ps_file_list_add(ps_file_list *list, const char *shown, const char *folder,
                              const char *item, ps_error *error) {
    if (item[0] == '\0') {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: a name of a file is empty", shown);
    }
    return strcmp(item, "-") == 0 ? add_path(list, item, error)
                                  : add_item(list, shown, folder, item, error);
}

pspec_status ps_file_list_read(ps_file_list *out, const char *shown, const char *text,
                               ps_error *error) {
    pspec_status status = PSPEC_OK;
    *out = (ps_file_list){0};
    for (const char *begin = text; begin != NULL && status == PSPEC_OK;) {
        const char *const comma = strchr(begin, ',');
        ps_text item = {0};
        ps_text_append_bytes(&item, begin, comma != NULL ? (size_t)(comma - begin) : strlen(begin));
        status = ps_text_check(&item, error);
        if (status == PSPEC_OK) {
            status = ps_file_list_add(out, shown, "", ps_text_string(&item), error);
        }
        ps_text_free(&item);
        begin = comma != NULL ? comma + 1 : NULL;
    }
    return status;
}

void ps_file_list_free(ps_file_list *list) {
    for (size_t i = 0; list->owned != NULL && i < list->num; i++) {
        free(list->owned[i]);
    }
    free(list->owned);
    *list = (ps_file_list){0};
}

/* ---- of questions -------------------------------------------------------------------------- */

/* What a caller gives of several numbers of points is a set for each of them. */
static pspec_status find_given(ps_file_list *out, const ps_request *request,
                               const ps_source_words *source, size_t count, ps_error *error) {
    ps_text name = {0};
    ps_given_name(&name, source->files, count);
    pspec_status status = ps_text_check(&name, error);
    if (status == PSPEC_OK) {
        const ps_given_set *const set =
            ps_given_sets_find(&request->reading.given, ps_text_string(&name));
        status = set != NULL
                     ? PSPEC_OK
                     : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                               "the set %s has points of %zu number%s, and %s names %zu",
                               source->name, count, count > 1 ? "s" : "",
                               ps_option_show(request, PS_OPTION_POINTS).text, request->num_counts);
        *out = (ps_file_list){.num = 1, .paths = set != NULL ? &set->name : NULL};
    }
    ps_text_free(&name);
    return status;
}

/* Runs of a program are what its command becomes with these in the place of the words. Other
 * braces are the shell's, or the program's. */
typedef struct run_numbers {
    uint64_t points, dimension, seed, realization, realizations;
} run_numbers;

static bool append_number(ps_text *out, const char *word, size_t length,
                          const run_numbers *numbers) {
    const struct {
        const char *word;
        uint64_t number;
    } known[] = {{PS_PROGRAM_POINTS, numbers->points},
                 {"{d}", numbers->dimension},
                 {"{seed}", numbers->seed},
                 {PS_PROGRAM_REALIZATION, numbers->realization},
                 {PS_PROGRAM_REALIZATIONS, numbers->realizations}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strlen(known[i].word) == length && memcmp(known[i].word, word, length) == 0) {
            ps_text_append(out, "%llu", (unsigned long long)known[i].number);
            return true;
        }
    }
    return false;
}

static pspec_status add_run(ps_file_list *list, const char *files, const run_numbers *numbers,
                            ps_error *error) {
    ps_text path = {0};
    for (const char *at = files; *at != '\0';) {
        const char *const end = *at == '{' ? strchr(at, '}') : NULL;
        const size_t length = end != NULL ? (size_t)(end - at) + 1 : 0;
        if (length > 0 && append_number(&path, at, length, numbers)) {
            at += length;
        } else {
            ps_text_append_bytes(&path, at++, 1);
        }
    }
    pspec_status status = ps_text_check(&path, error);
    if (status == PSPEC_OK) {
        status = add_text(list, "", ps_text_string(&path), error);
    }
    ps_text_free(&path);
    return status;
}

/* One that makes all realizations in one run has a word for their number. */
static pspec_status list_runs(ps_file_list *out, const ps_request *request, size_t question,
                              ps_error *error) {
    const char *const files = request->sources[question / request->num_counts].files;
    run_numbers numbers = {.points = ps_request_points(request, question),
                           .dimension = request->dimension,
                           .seed = request->seed,
                           .realizations = request->num_realizations};
    const uint64_t num_runs =
        strstr(files, PS_PROGRAM_REALIZATIONS) != NULL ? 1 : request->num_realizations;
    /* Of which the names take 40 MB, and the shortest take 20 minutes (a Zen 3). */
    const uint64_t most_runs = 1000000;
    *out = (ps_file_list){0};
    if (num_runs > most_runs) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s %llu: a program is run %llu times at most; with %s in its command it is "
                       "run once, and prints all",
                       ps_option_show(request, PS_OPTION_REALIZATIONS).text,
                       (unsigned long long)num_runs, (unsigned long long)most_runs,
                       PS_PROGRAM_REALIZATIONS);
    }
    if (request->accuracy.standard_error > 0 && !request->is_given[PS_OPTION_REALIZATIONS]) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: a program is told how many realizations there are at most: %s",
                       ps_option_show(request, PS_OPTION_STANDARD_ERROR).text,
                       ps_option_show(request, PS_OPTION_REALIZATIONS).text);
    }
    for (uint64_t r = 0; r < num_runs; r++) {
        numbers.realization = r;
        PS_TRY(add_run(out, files, &numbers, error));
    }
    return PSPEC_OK;
}

pspec_status ps_file_list_of_question(ps_file_list *out, const ps_request *request, size_t question,
                                      ps_error *error) {
    enum { BYTES = PS_SET_NAME_BYTES + 32 };
    char shown[BYTES];
    *out = (ps_file_list){.num = request->num_files, .paths = request->files};
    if (request->num_sources == 0) {
        return PSPEC_OK;
    }
    const ps_source_words *const source = &request->sources[question / request->num_counts];
    if (source->files == NULL) {
        *out = (ps_file_list){0};
        return PSPEC_OK;
    }
    if (ps_given_sets_find(&request->reading.given, source->files) != NULL) {
        return find_given(out, request, source, question % request->num_counts, error);
    }
    if (ps_points_program(source->files) != NULL) {
        return list_runs(out, request, question, error);
    }
    snprintf(shown, sizeof shown, "%s %s", ps_option_show(request, PS_OPTION_SET).text,
             source->name);
    return ps_file_list_read(out, shown, source->files, error);
}

/* A file that is there, under one of its names. */
typedef struct known_file {
    struct stat facts;
    const char *path;
} known_file;

/* A given set is a file of no device, and its place in the list the number of that. */
static bool look_up(known_file *file, const ps_given_sets *given) {
    const ps_given_set *const set = ps_given_sets_find(given, file->path);
    if (set != NULL) {
        file->facts = (struct stat){.st_ino = (ino_t)(set - given->sets) + 1};
        return true;
    }
    return strcmp(file->path, "-") != 0 && stat(file->path, &file->facts) == 0;
}

static int compare_files(const void *first, const void *second) {
    const known_file *const a = first;
    const known_file *const b = second;
    if (a->facts.st_dev != b->facts.st_dev) {
        return a->facts.st_dev < b->facts.st_dev ? -1 : 1;
    }
    if (a->facts.st_ino != b->facts.st_ino) {
        return a->facts.st_ino < b->facts.st_ino ? -1 : 1;
    }
    return strcmp(a->path, b->path);
}

/* Realizations and sets that are compared are taken for independent ones: of one that counts twice
 * standard errors would be 0, or too small. A name without a file is for whoever opens it. */
static pspec_status check_different(const ps_file_list *lists, const ps_request *request,
                                    ps_error *error) {
    const size_t num_lists = ps_request_num_questions(request);
    known_file *files = NULL;
    size_t num = 0;
    for (size_t i = 0; i < num_lists; i += request->num_counts) {
        num += lists[i].num;
    }
    PS_TRY(PS_NEW(&files, num, "names of files", error));
    num = 0;
    for (size_t i = 0; i < num_lists; i += request->num_counts) {
        for (size_t j = 0; j < lists[i].num; j++) {
            files[num].path = lists[i].paths[j];
            num += look_up(&files[num], &request->reading.given);
        }
    }
    qsort(files, num, sizeof *files, compare_files);
    pspec_status status = PSPEC_OK;
    for (size_t i = 1; i < num && status == PSPEC_OK; i++) {
        const known_file *const two = &files[i - 1];
        if (two[0].facts.st_dev == two[1].facts.st_dev &&
            two[0].facts.st_ino == two[1].facts.st_ino) {
            status = ps_fail(error, PSPEC_ERROR_INPUT,
                             "\"%s\" and \"%s\" are one file, which would count twice as if its "
                             "points were independent ones; name it once",
                             two[0].path, two[1].path);
        }
    }
    free(files);
    return status;
}

pspec_status ps_file_lists_make(ps_file_list **out, const ps_request *request, ps_error *error) {
    const size_t num = ps_request_num_questions(request);
    PS_TRY(PS_NEW(out, num, "lists of files", error));
    for (size_t i = 0; i < num; i++) {
        PS_TRY(ps_file_list_of_question(&(*out)[i], request, i, error));
    }
    return check_different(*out, request, error);
}

void ps_file_lists_free(ps_file_list *lists, size_t num) {
    for (size_t i = 0; lists != NULL && i < num; i++) {
        ps_file_list_free(&lists[i]);
    }
    free(lists);
}
