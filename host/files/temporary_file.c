#include "files/temporary_file.h"

#include "base/text.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

/* ---- names --------------------------------------------------------------------------------- */

enum { NAME_BYTES = 64 };

/* What names of this machine begin with. Locks of another machine may not be seen here. */
static void make_start(char start[NAME_BYTES]) {
    char host[256] = ""; /* POSIX machines have shorter names */
    (void)gethostname(host, sizeof host - 1);
    snprintf(start, NAME_BYTES, ".pointspec-%08lx-",
             (unsigned long)(XXH3_64bits(host, strlen(host)) & 0xffffffff));
}

static bool begins_with(const char *name, const char *start) {
    return strncmp(name, start, strlen(start)) == 0;
}

/* ---- what dead processes left -------------------------------------------------------------- */

/* Whether the name still belongs to the file that is open: its writer may have given it the final
 * name in the meantime, and may write the next one under the old name already. */
static bool has_name(int descriptor, int folder, const char *name) {
    struct stat file;
    struct stat named;
    return fstat(descriptor, &file) == 0 &&
           fstatat(folder, name, &named, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(file.st_mode) &&
           file.st_uid == geteuid() && file.st_dev == named.st_dev && file.st_ino == named.st_ino;
}

/* Whoever writes to the file holds its lock, and takes its name away before the lock goes: with the
 * lock in hand, the name is looked at once more, and then stays as it is. Files that are no files,
 * or that cannot be opened, stay. */
static void remove_if_dead(int folder, const char *folder_path, const char *name) {
    ps_text path = {0};
    ps_text_append(&path, "%s%s", folder_path, name);
    const int descriptor =
        path.failed ? -1 : open(path.data, O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor >= 0) {
        if (flock(descriptor, LOCK_EX | LOCK_NB) == 0 && has_name(descriptor, folder, name)) {
            (void)unlinkat(folder, name, 0);
        }
        close(descriptor);
    }
    ps_text_free(&path);
}

/* A folder that cannot be looked into keeps what it has. */
static void remove_dead(const char *folder_path, const char *start, const char *own) {
    DIR *const folder = opendir(folder_path[0] != '\0' ? folder_path : ".");
    if (folder == NULL) {
        return;
    }
    for (const struct dirent *found = readdir(folder); found != NULL; found = readdir(folder)) {
        if (begins_with(found->d_name, start) && ps_text_ends_in(found->d_name, ".tmp") &&
            !begins_with(found->d_name, own)) {
            remove_if_dead(dirfd(folder), folder_path, found->d_name);
        }
    }
    closedir(folder);
}

/* ---- new files ----------------------------------------------------------------------------- */

/* Another process may have taken the file for a dead one's before it was locked: it then has no
 * name any more. Where locks do not work nobody can do that. */
static bool is_kept(int descriptor) {
    struct stat facts;
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        return false;
    }
    return fstat(descriptor, &facts) != 0 || facts.st_nlink > 0;
}

/* -1 and errno: EEXIST where another name may do. */
static int create_named(const char *path, mode_t mode) {
    const int descriptor = open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (descriptor >= 0 && !is_kept(descriptor)) {
        close(descriptor);
        errno = EEXIST;
        return -1;
    }
    return descriptor;
}

/* Numbers that other files of this process have are passed over. */
static int create_numbered(const char *folder, const char *own, mode_t mode, char **path) {
    enum { MOST_TRIES = 10000 };
    for (int number = 0; number < MOST_TRIES; number++) {
        ps_text text = {0};
        ps_text_append(&text, "%s%s%d.tmp", folder, own, number);
        errno = ENOMEM;
        const int descriptor = text.failed ? -1 : create_named(text.data, mode);
        if (descriptor >= 0) {
            *path = text.data;
            return descriptor;
        }
        const int reason = errno;
        ps_text_free(&text);
        errno = reason;
        if (reason != EEXIST) {
            return -1;
        }
    }
    return -1;
}

/* Names of this process, which is not dead, begin with its number: its files may be without a lock
 * where one was not to be had. */
int ps_temporary_create(const char *folder, size_t folder_length, mode_t mode, char **path) {
    char start[NAME_BYTES];
    char own[NAME_BYTES + 24];
    ps_text where = {0};
    int descriptor = -1;
    *path = NULL;
    make_start(start);
    snprintf(own, sizeof own, "%s%ld-", start, (long)getpid());
    ps_text_append_bytes(&where, folder, folder_length);
    errno = ENOMEM;
    if (!where.failed) {
        remove_dead(ps_text_string(&where), start, own);
        descriptor = create_numbered(ps_text_string(&where), own, mode, path);
    }
    const int reason = errno;
    ps_text_free(&where);
    errno = reason;
    return descriptor;
}

/* ---- files without a name ------------------------------------------------------------------ */

static const char *find_folder(void) {
    const char *const folder = getenv("TMPDIR");
    return folder != NULL && folder[0] != '\0' ? folder : "/tmp";
}

static pspec_status fail(int reason, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_IO,
                   "cannot create a temporary file in \"%s\", a folder that TMPDIR chooses: %s",
                   find_folder(), strerror(reason));
}

/* A new file of a name that nobody has, which it loses at once. -1 and errno: there is none. */
static int open_nameless(const char *folder) {
    ps_text where = {0};
    char *path = NULL;
    ps_text_append(&where, "%s/", folder);
    errno = ENOMEM;
    const int descriptor =
        where.failed ? -1 : ps_temporary_create(where.data, where.length, 0600, &path);
    const int reason = errno;
    if (descriptor >= 0) {
        (void)unlink(path); /* what cannot be removed stays, and holds nothing secret */
    }
    free(path);
    ps_text_free(&where);
    errno = reason;
    return descriptor;
}

pspec_status ps_temporary_open(FILE **out, ps_error *error) {
    *out = NULL;
    const int descriptor = open_nameless(find_folder());
    if (descriptor < 0) {
        return fail(errno, error);
    }
    *out = fdopen(descriptor, "w+b");
    if (*out == NULL) {
        const int reason = errno;
        close(descriptor);
        return fail(reason, error);
    }
    return PSPEC_OK;
}
