/* pointspec run: a scene, its results into a folder. */
#include "base/text.h"
#include "cli/command.h"
#include "cli/run/run.h"
#include "files/output_file.h"
#include "plots/plot.h"
#include "pointspec_version.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- the folder -------------------------------------------------------------------------- */

/* The name of the scene without its folder and ending. */
static void name_folder(const char *scene, ps_text *out) {
    const char *const slash = strrchr(scene, '/');
    const char *const name = strcmp(scene, "-") == 0 ? "scene" /* from standard input */
                             : slash != NULL         ? slash + 1
                                                     : scene;
    const char *const dot = strrchr(name, '.');
    const size_t length = dot != NULL && dot > name ? (size_t)(dot - name) : strlen(name);
    ps_text_append_bytes(out, name, length);
    if (dot == NULL) {
        ps_text_append(out, "-results"); /* the name of the scene itself is taken */
    }
}

static pspec_status is_empty_folder(const char *path, bool *is_empty, ps_error *error) {
    DIR *const folder = opendir(path);
    if (folder == NULL) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot read the folder \"%s\": %s", path,
                       strerror(errno));
    }
    *is_empty = true;
    errno = 0;
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        *is_empty =
            *is_empty && (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0);
    }
    const int reason = errno; /* readdir leaves it alone at the end */
    closedir(folder);
    return reason == 0 ? PSPEC_OK
                       : ps_fail(error, PSPEC_ERROR_IO, "cannot read the folder \"%s\": %s", path,
                                 strerror(reason));
}

/* Whether files can be made there is found out before the work, which may be long. */
static pspec_status check_writable(const char *path, const char *results, ps_error *error) {
    return access(path, W_OK | X_OK) == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_IO, "cannot write the results \"%s\" to \"%s\": %s",
                         results, path, strerror(errno));
}

static pspec_status check_parent(const char *path, ps_error *error) {
    ps_text parent = {0};
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/') {
        length--;
    }
    while (length > 0 && path[length - 1] != '/') {
        length--;
    }
    ps_text_append_bytes(&parent, length > 0 ? path : ".", length > 0 ? length : 1);
    pspec_status status = ps_text_check(&parent, error);
    if (status == PSPEC_OK) {
        status = check_writable(ps_text_string(&parent), path, error);
    }
    ps_text_free(&parent);
    return status;
}

/* A folder of an earlier run is written over; one with anything else in it is somebody's. */
static pspec_status check_folder(const char *path, ps_error *error) {
    struct stat facts;
    bool is_empty = false;
    ps_text record = {0};
    if (stat(path, &facts) != 0) {
        return errno == ENOENT ? check_parent(path, error)
                               : ps_fail(error, PSPEC_ERROR_IO, "cannot read \"%s\": %s", path,
                                         strerror(errno));
    }
    if (!S_ISDIR(facts.st_mode)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "\"%s\" is no folder; -o FOLDER says where results go", path);
    }
    ps_text_append(&record, "%s/record.json", path);
    pspec_status status = ps_text_check(&record, error);
    const bool has_record = status == PSPEC_OK && access(ps_text_string(&record), F_OK) == 0;
    ps_text_free(&record);
    if (status == PSPEC_OK && !has_record) {
        status = is_empty_folder(path, &is_empty, error);
    }
    if (status == PSPEC_OK && (has_record || is_empty)) {
        return check_writable(path, path, error);
    }
    return status != PSPEC_OK
               ? status
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "the folder \"%s\" has files that are not of a run; -o FOLDER says where "
                         "results go",
                         path);
}

static pspec_status make_folder(const char *path, ps_error *error) {
    const mode_t all = 0777; /* the umask takes its share */
    return mkdir(path, all) == 0 || errno == EEXIST
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_IO, "cannot make the folder \"%s\": %s", path,
                         strerror(errno));
}

/* ---- files ------------------------------------------------------------------------------- */

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
    return write_table(run, result->summary, name, ps_run_summary_ending, error);
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

/* The record comes first: with it the folder is one of a run, whatever happens next. Numbers come before pictures. The
 * record of the end names what was written; files of the former run go before it, for it no longer names them. */
static pspec_status write_all(ps_run *run, ps_error *error) {
    PS_TRY(make_folder(run->folder, error));
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

/* ---- what is said at the end ------------------------------------------------------------- */

static pspec_status add_result(ps_table *table, const ps_run_result *result, ps_error *error) {
    double seconds = 0;
    size_t num_cached = 0;
    for (size_t q = 0; q < result->num; q++) {
        seconds += result->questions[q].seconds;
        num_cached += result->questions[q].is_cached;
    }
    const ps_cell cells[] = {PS_TEXT(result->asked->name), PS_TEXT(result->asked->kind->name),
                             PS_INTEGER(result->num), PS_INTEGER(num_cached), PS_NUMBER(seconds)};
    return ps_table_add_row(table, cells, error);
}

static pspec_status print_results(const ps_run *run, ps_error *error) {
    static const char *const columns[] = {"result", "kind", "questions", "cached", "seconds"};
    ps_table *table = NULL;
    ps_text page = {0};
    pspec_status status = PSPEC_OK;
    PS_TRY(ps_table_create(&table, "run", columns, sizeof columns / sizeof columns[0], error));
    ps_text_append(&page, "%s/index.html", run->folder);
    PS_TRY_OUT(status, ps_text_check(&page, error));
    PS_TRY_OUT(status, ps_table_add_meta(table, "page", PS_TEXT(ps_text_string(&page)), error));
    PS_TRY_OUT(status, ps_table_add_meta(table, "seconds", PS_NUMBER(run->seconds), error));
    for (size_t i = 0; i < run->num_results; i++) {
        PS_TRY_OUT(status, add_result(table, &run->results[i], error));
    }
    status = ps_table_write(table, "-", PS_FORMAT_CSV, error);
out:
    ps_text_free(&page);
    ps_table_destroy(table);
    return status;
}

/* Before the work, while there is time to install it. Memory that is refused says nothing about gnuplot. */
static void warn_of_gnuplot(const ps_run *run) {
    ps_text path = {0};
    ps_error reason = {0};
    size_t num = 0;
    for (size_t i = 0; i < run->num_results; i++) {
        num += run->results[i].pictures.num;
    }
    const pspec_status status =
        num > 0 && !run->arguments->quiet ? ps_plot_find_gnuplot(&path, &reason) : PSPEC_OK;
    if (status != PSPEC_OK && status != PSPEC_ERROR_MEMORY) {
        fprintf(stderr, "pointspec: %s; pictures are left out where the cache has none\n",
                reason.message);
    }
    ps_text_free(&path);
}

/* Also with --quiet: files are missing that were asked for. */
static void warn_of_pictures(const ps_run *run) {
    if (run->num_undrawn > 0) {
        fprintf(stderr, "pointspec: %zu picture%s of \"%s\" %s not drawn: %s\n", run->num_undrawn,
                run->num_undrawn == 1 ? "" : "s", run->folder,
                run->num_undrawn == 1 ? "was" : "were", run->undrawn.message);
    }
}

/* Of results of the kind check. */
static pspec_status judge(const ps_run *run, ps_error *error) {
    size_t num = 0;
    const ps_run_question *first = NULL;
    const ps_run_result *of = NULL;
    for (size_t i = 0; i < run->num_results; i++) {
        for (size_t q = 0; q < run->results[i].num; q++) {
            const ps_run_question *const question = &run->results[i].questions[q];
            const ps_cell verdict = ps_table_find_meta(question->answer.table, "verdict");
            if (verdict.kind == PS_CELL_TEXT && strcmp(verdict.text, "different") == 0) {
                first = num++ == 0 ? question : first;
                of = num == 1 ? &run->results[i] : of;
            }
        }
    }
    if (num == 0) {
        return PSPEC_OK;
    }
    const ps_cell different = ps_table_find_meta(first->answer.table, "different");
    return ps_fail(error, PSPEC_ERROR_CHECK,
                   "%zu check%s found another spectrum than the saved one: %s differ in %s (%s)",
                   num, num == 1 ? "" : "s",
                   different.kind == PS_CELL_TEXT ? different.text : "some", of->asked->name,
                   first->asked.request.command_line);
}

/* ---- all --------------------------------------------------------------------------------- */

static pspec_status run_scene(ps_run *run, ps_error *error) {
    PS_TRY(ps_run_ask(run, error));
    PS_TRY(check_folder(run->folder, error));
    PS_TRY(ps_run_read_former(run, error));
    PS_TRY(ps_run_open_cache(run, error));
    warn_of_gnuplot(run);
    PS_TRY(ps_run_answer(run, error));
    PS_TRY(write_all(run, error));
    warn_of_pictures(run);
    PS_TRY(print_results(run, error));
    PS_TRY(ps_run_compare(run, error));
    return judge(run, error);
}

static pspec_status run(const ps_request *arguments, ps_error *error) {
    ps_scene scene = {0};
    ps_text folder = {0};
    if (arguments->num_files != 1) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "one scene is run at a time, but %zu files were named",
                       arguments->num_files);
    }
    if (arguments->output != NULL) {
        ps_text_append(&folder, "%s", arguments->output);
    } else {
        name_folder(arguments->files[0], &folder);
    }
    ps_run all = {.arguments = arguments, .scene = &scene, .folder = ps_text_string(&folder)};
    pspec_status status = ps_text_check(&folder, error);
    if (status == PSPEC_OK) {
        status = ps_run_read_scene(&scene, arguments, error);
    }
    if (status == PSPEC_OK) {
        status = run_scene(&all, error);
    }
    ps_run_free(&all);
    ps_scene_free(&scene);
    ps_text_free(&folder);
    return status;
}

static const ps_option_id options[] = {PS_OPTION_MEMORY,  PS_OPTION_DEVICE, PS_OPTION_CACHE,
                                       PS_OPTION_NO_SKIP, PS_OPTION_OUTPUT, PS_OPTION_QUIET,
                                       PS_OPTION_HELP,    PS_NUM_OPTIONS};

const ps_command ps_command_run = {
    .name = "run",
    .summary = "all results that a scene file asks for, into a folder with a page that shows them",
    .usage = "run [options] SCENE.yaml",
    .description =
        "Reads a scene (docs/scenes.md): results of the kinds power, angular, pairs, quadrature, "
        "truncation and check, each with the options of the command of that name, where lists ask "
        "for every combination. Writes a folder (-o; else named like the scene) with a table and a "
        "summary of each result, pictures, index.html, which shows all of it, and record.json, "
        "which is a scene too: running it makes the same results and says whether they have the "
        "same bits. Answers are kept in a cache that all scenes share. Exit status 3 when a check "
        "finds another spectrum than the saved one, or a record is not repeated.",
    .options = options,
    .examples = {"printf 'scene: 1\\nresults:\\n  - {result: power, samplers: [white, jittered], "
                 "points: 64..256, realizations: 16}\\n' >scene.yaml && pointspec run scene.yaml",
                 "pointspec run scene.yaml -o again --no-skip"},
    .run = run,
};
