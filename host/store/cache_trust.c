#include "store/cache_trust.h"

#include "files/descriptor.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static pspec_status fail_foreign(const char *path, uid_t owner, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_IO,
                   "%s belongs to another user, number %lu, and is ignored by number %lu; "
                   "POINTSPEC_CACHE_DIR names another folder",
                   path, (unsigned long)owner, (unsigned long)geteuid());
}

pspec_status ps_cache_check_folder(const char *path, ps_error *error) {
    struct stat facts;
    if (fstatat(AT_FDCWD, path, &facts, 0) != 0) {
        return PSPEC_OK;
    }
    if (!S_ISDIR(facts.st_mode)) {
        return PSPEC_OK;
    }
    if (facts.st_uid != geteuid()) {
        return fail_foreign(path, facts.st_uid, error);
    }
    return (facts.st_mode & (S_IWGRP | S_IWOTH)) == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_IO,
                         "%s can be written by other users (mode %03o) and is ignored; "
                         "chmod go-w makes it yours alone",
                         path, (unsigned)(facts.st_mode & 0777));
}

/* What open() says of links, sockets and devices without a driver. */
static bool is_no_file(int reason) {
    return reason == ELOOP || reason == ENXIO || reason == ENODEV;
}

static pspec_status look_at(int descriptor, const char *path, uint64_t *num_bytes,
                            ps_cache_file_kind *kind, ps_error *error) {
    struct stat facts;
    if (fstat(descriptor, &facts) != 0) {
        return ps_read_fail(path, error);
    }
    if (!S_ISREG(facts.st_mode)) {
        *kind = PS_CACHE_FILE_NONE;
        return PSPEC_OK;
    }
    if (facts.st_uid != geteuid()) {
        return fail_foreign(path, facts.st_uid, error);
    }
    *kind = PS_CACHE_FILE_OWN;
    *num_bytes = (uint64_t)facts.st_size;
    return PSPEC_OK;
}

pspec_status ps_cache_file_open(const char *path, int *descriptor, uint64_t *num_bytes,
                                ps_cache_file_kind *kind, ps_error *error) {
    *kind = PS_CACHE_FILE_ABSENT;
    *num_bytes = 0;
    /* O_NONBLOCK: a pipe of that name would wait for a writer */
    *descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK | O_NOFOLLOW);
    if (*descriptor < 0) {
        const bool is_absent = errno == ENOENT || errno == ENOTDIR;
        *kind = is_no_file(errno) ? PS_CACHE_FILE_NONE : PS_CACHE_FILE_ABSENT;
        return is_absent || is_no_file(errno) ? PSPEC_OK : ps_read_fail(path, error);
    }
    const pspec_status status = look_at(*descriptor, path, num_bytes, kind, error);
    if (*kind != PS_CACHE_FILE_OWN) {
        close(*descriptor);
        *descriptor = -1;
    }
    return status;
}

pspec_status ps_cache_clear_way(const char *path, ps_error *error) {
    struct stat facts;
    if (lstat(path, &facts) != 0 || S_ISREG(facts.st_mode)) {
        return PSPEC_OK; /* the writer finds out what else may be wrong */
    }
    const int reason = S_ISDIR(facts.st_mode) ? EISDIR : unlink(path) != 0 ? errno : 0;
    return reason == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_IO, "cannot write %s: %s", path, strerror(reason));
}
