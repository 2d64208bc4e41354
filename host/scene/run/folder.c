/* The folder that results go to. */
#include "scene/run/run.h"

#include <dirent.h>
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

void ps_run_name_folder(const char *scene, ps_text *out) {
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

pspec_status ps_run_check_folder(const ps_run *run, ps_error *error) {
    const char *const path = run->folder;
    struct stat facts;
    bool is_empty = false;
    if (stat(path, &facts) != 0) {
        return errno == ENOENT ? check_parent(path, error)
                               : ps_fail(error, PSPEC_ERROR_IO, "cannot read \"%s\": %s", path,
                                         strerror(errno));
    }
    if (!S_ISDIR(facts.st_mode)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "\"%s\" is no folder; -o FOLDER says where results go", path);
    }
    const bool has_record = access(ps_run_find_file(run, ps_run_record_name)->path, F_OK) == 0;
    if (!has_record) {
        PS_TRY(is_empty_folder(path, &is_empty, error));
    }
    return has_record || is_empty
               ? check_writable(path, path, error)
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "the folder \"%s\" has files that are not of a run; -o FOLDER says where "
                         "results go",
                         path);
}

pspec_status ps_run_make_folder(const char *path, ps_error *error) {
    const mode_t all = 0777; /* the umask takes its share */
    return mkdir(path, all) == 0 || errno == EEXIST
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_IO, "cannot make the folder \"%s\": %s", path,
                         strerror(errno));
}
