/* The former run in the folder: what of it goes when another scene takes its place, and what is
 * nobody's to write over. */
#include "scene/run/run.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Stands for the digest of a file that a run was to write. */
static const char unfinished[] = "-";

/* The name in "DIGEST NAME" of a record; NULL where there is none, or one that would lead out of
 * the folder or is hidden: no run writes such, but whoever edits a record may. */
static const char *name_in(const char *entry) {
    const char *const space = strchr(entry, ' ');
    const char *const name = space != NULL ? space + 1 : "";
    return name[0] == '\0' || name[0] == '.' || strchr(name, '/') != NULL ? NULL : name;
}

static const char *find_former(const ps_run *run, const char *name) {
    for (size_t i = 0; i < run->former.num_files; i++) {
        const char *const other = name_in(run->former.files[i]);
        if (other != NULL && strcmp(other, name) == 0) {
            return run->former.files[i];
        }
    }
    return NULL;
}

/* ---- what the scene reads ---------------------------------------------------------------- */

typedef struct same_file {
    const struct stat *as;
    bool is_found;
} same_file;

static pspec_status compare_input(void *payload, const ps_scene *scene, const ps_scene_entry *entry,
                                  const ps_scene_value *value, const char *path, ps_error *error) {
    same_file *const same = payload;
    struct stat facts;
    (void)scene, (void)entry, (void)value, (void)error;
    same->is_found =
        same->is_found || (stat(path, &facts) == 0 && facts.st_dev == same->as->st_dev &&
                           facts.st_ino == same->as->st_ino);
    return PSPEC_OK;
}

static pspec_status is_input(const ps_run *run, const struct stat *facts, bool *out,
                             ps_error *error) {
    same_file same = {facts, false};
    PS_TRY(ps_scene_visit_inputs(run->scene, compare_input, &same, error));
    PS_TRY(compare_input(&same, NULL, NULL, NULL, run->scene->path, error));
    *out = same.is_found;
    return PSPEC_OK;
}

/* ---- before the work --------------------------------------------------------------------- */

/* After a call that did not find the file. */
static pspec_status fail_unless_missing(const char *path, ps_error *error) {
    return errno == ENOENT
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_IO, "cannot look at \"%s\": %s", path, strerror(errno));
}

static pspec_status refuse_foreign(const ps_run_file *file, ps_error *error) {
    struct stat facts;
    return lstat(file->path, &facts) != 0
               ? fail_unless_missing(file->path, error)
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "\"%s\" would be written over, but is not of the former run by its "
                         "record.json; move it away, or say another folder by -o FOLDER",
                         file->path);
}

/* What is no record says nothing about files: the folder is that of a run all the same. */
static pspec_status read_record(ps_run *run, const char *path, ps_error *error) {
    struct stat facts;
    ps_error reason = {0};
    if (lstat(path, &facts) != 0) {
        return fail_unless_missing(path, error);
    }
    if (!S_ISREG(facts.st_mode)) {
        return PSPEC_OK;
    }
    const pspec_status status = ps_scene_read(&run->former, path, &reason);
    run->former.path = NULL; /* it was borrowed */
    if (status != PSPEC_OK) {
        ps_scene_free(&run->former);
        run->former = (ps_scene){0};
    }
    if (status != PSPEC_OK && status != PSPEC_ERROR_INPUT) {
        *error = reason;
        return status;
    }
    return PSPEC_OK;
}

/* A name that the run writes is a file that the scene reads. */
static pspec_status refuse_written_input(const ps_run *run, const ps_run_file *file,
                                         ps_error *error) {
    struct stat facts;
    bool is_read = false;
    if (stat(file->path, &facts) == 0) {
        PS_TRY(is_input(run, &facts, &is_read, error));
    }
    return !is_read
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "\"%s\" is read by the scene and would be written over; another name of "
                         "the result or another folder by -o FOLDER keeps it",
                         file->path);
}

/* Record and page are the run's own: a record may be run again into its folder. */
pspec_status ps_run_check_inputs(const ps_run *run, ps_error *error) {
    for (size_t i = 0; i < run->files.num; i++) {
        if (run->files.all[i].result != NULL) {
            PS_TRY(refuse_written_input(run, &run->files.all[i], error));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_run_read_former(ps_run *run, ps_error *error) {
    PS_TRY(read_record(run, ps_run_find_file(run, ps_run_record_name)->path, error));
    for (size_t i = 0; run->former.num_files > 0 && i < run->files.num; i++) {
        const ps_run_file *const file = &run->files.all[i];
        if (file->part != PS_RUN_RECORD && find_former(run, file->name) == NULL) {
            PS_TRY(refuse_foreign(file, error));
        }
    }
    return PSPEC_OK;
}

/* ---- after the work ---------------------------------------------------------------------- */

typedef enum fate { GONE_BEFORE, REMOVED, KEPT_INPUT, KEPT_CHANGED, KEPT_IN_VAIN } fate;

static pspec_status remove_one(const ps_run *run, const char *entry, const char *path, fate *out,
                               ps_error *error) {
    struct stat facts;
    char digest[PS_DIGEST_BYTES] = "";
    ps_error ignored = {0};
    bool is_read = false;
    if (lstat(path, &facts) != 0) {
        *out = GONE_BEFORE;
        return PSPEC_OK;
    }
    PS_TRY(is_input(run, &facts, &is_read, error));
    *out = is_read ? KEPT_INPUT : KEPT_CHANGED;
    if (is_read || !S_ISREG(facts.st_mode) || ps_digest_file(path, digest, &ignored) != PSPEC_OK ||
        strncmp(entry, digest, PS_DIGEST_BYTES - 1) != 0 || entry[PS_DIGEST_BYTES - 1] != ' ') {
        return PSPEC_OK;
    }
    *out = unlink(path) == 0 ? REMOVED : KEPT_IN_VAIN;
    return PSPEC_OK;
}

static void say(const ps_run *run, fate what, const char *path) {
    static const char *const sentences[] = {
        [GONE_BEFORE] = NULL,
        [REMOVED] = "removed \"%s\", which the former run made and this one does not",
        [KEPT_INPUT] = "kept \"%s\" of the former run: this scene reads it",
        [KEPT_CHANGED] = "kept \"%s\": it is not what the former run made",
        [KEPT_IN_VAIN] = "cannot remove \"%s\", which the former run made and this one does not"};
    if (sentences[what] != NULL) {
        ps_answer_warn(&run->hooks, sentences[what], path);
    }
}

pspec_status ps_run_remove_former(const ps_run *run, ps_error *error) {
    pspec_status status = PSPEC_OK;
    for (size_t i = 0; status == PSPEC_OK && i < run->former.num_files; i++) {
        const char *const entry = run->former.files[i];
        const char *const name = name_in(entry);
        const ps_run_file *const ours = name != NULL ? ps_run_find_file(run, name) : NULL;
        if (name == NULL || strcmp(name, ps_run_record_name) == 0 ||
            (ours != NULL && ours->is_written)) {
            continue;
        }
        fate what = GONE_BEFORE;
        ps_text path = {0};
        ps_text_append(&path, "%s/%s", run->folder, name);
        status = ps_text_check(&path, error);
        if (status == PSPEC_OK) {
            status = remove_one(run, entry, ps_text_string(&path), &what, error);
        }
        if (status == PSPEC_OK) {
            say(run, what, ps_text_string(&path));
        }
        ps_text_free(&path);
    }
    return status;
}

/* ---- the record -------------------------------------------------------------------------- */

static void print_entry(const char *digest, const char *name, bool *is_first, ps_text *out) {
    ps_text_append(out, "%s\n      \"%s %s\"", *is_first ? "" : ",", digest, name);
    *is_first = false;
}

void ps_run_print_files(const ps_run *run, ps_text *out) {
    bool is_first = true;
    for (size_t i = 0; i < run->files.num; i++) {
        const ps_run_file *const file = &run->files.all[i];
        const bool is_due =
            run->is_written ? file->is_written : find_former(run, file->name) == NULL;
        if (is_due && file->part != PS_RUN_RECORD) {
            print_entry(file->digest[0] != '\0' ? file->digest : unfinished, file->name, &is_first,
                        out);
        }
    }
    for (size_t i = 0; !run->is_written && i < run->former.num_files; i++) {
        ps_text_append(out, "%s\n      ", is_first ? "" : ",");
        ps_scene_print_text(run->former.files[i], out);
        is_first = false;
    }
}
