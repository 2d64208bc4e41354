#include "io/cache_directory.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* NULL: not set, or empty */
static const char *variable(const char *name) {
    const char *const value = getenv(name);
    return value != NULL && value[0] != '\0' ? value : NULL;
}

pspec_status ps_cache_default_directory(ps_text *out, ps_error *error) {
    const char *const own = variable("POINTSPEC_CACHE_DIR");
    const char *const all = variable("XDG_CACHE_HOME");
    const char *const home = variable("HOME");
    if (own != NULL) {
        ps_text_append(out, "%s", own);
    } else if (all != NULL && all[0] == '/') {
        ps_text_append(out, "%s/pointspec", all);
    } else if (home != NULL) {
        ps_text_append(out, "%s/.cache/pointspec", home);
    } else {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "no folder for caches: none of POINTSPEC_CACHE_DIR, XDG_CACHE_HOME and HOME "
                       "is set");
    }
    return ps_text_check(out, error);
}

static bool is_folder(const char *path) {
    struct stat facts;
    return stat(path, &facts) == 0 && S_ISDIR(facts.st_mode);
}

/* 0, or errno. Private to the user, as the XDG base directory specification wants it. */
static int make_one(const char *path) {
    if (is_folder(path) || mkdir(path, 0700) == 0) {
        return 0;
    }
    const int reason = errno;
    return reason != EEXIST ? reason : is_folder(path) ? 0 : ENOTDIR; /* another process made it */
}

pspec_status ps_cache_folder_make(const char *path, ps_error *error) {
    char *const part = strdup(path);
    int reason = 0;
    if (part == NULL) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for a file name");
    }
    for (char *c = part; *c != '\0' && reason == 0; c++) {
        if (*c == '/' && c > part) {
            *c = '\0';
            reason = make_one(part);
            *c = '/';
        }
    }
    free(part);
    reason = reason == 0 ? make_one(path) : reason;
    return reason == 0 ? PSPEC_OK
                       : ps_fail(error, PSPEC_ERROR_IO, "cannot make the folder %s: %s", path,
                                 strerror(reason));
}
