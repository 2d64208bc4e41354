#include "store/cache_folder.h"

#include "base/memory.h"
#include "base/text.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum {
    BLOCK_BYTES = 4096,   /* of most file systems */
    NAME_BYTES = 64,      /* ours are shorter */
    DIGITS = 32,          /* of 128 bits */
    STALE_SECONDS = 3600, /* entries are written in seconds; a machine may sleep in between */
    CLOCK_SECONDS = 60    /* clocks of machines that share a folder */
};

typedef struct cache_file {
    char name[NAME_BYTES];
    uint64_t bytes;
    struct timespec used;
    bool is_temporary;
} cache_file;

typedef struct cache_list {
    const char *path; /* for messages */
    cache_file *files;
    size_t num, capacity;
    uint64_t bytes;
} cache_list;

static pspec_status fail_folder(const char *verb, const char *path, int reason, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_IO, "cannot %s the cache %s: %s", verb, path,
                   strerror(reason));
}

uint64_t ps_cache_disk_bytes(uint64_t file_bytes) {
    const uint64_t full = file_bytes / BLOCK_BYTES + (file_bytes % BLOCK_BYTES != 0);
    return full <= UINT64_MAX / BLOCK_BYTES ? full * BLOCK_BYTES : UINT64_MAX;
}

/* ---- making it ---- */

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
    if (is_folder(path)) {
        return PSPEC_OK;
    }
    char *const part = strdup(path);
    if (part == NULL) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for a file name");
    }
    int reason = 0;
    for (char *c = part; *c != '\0' && reason == 0; c++) {
        if (*c == '/' && c > part) {
            *c = '\0';
            reason = make_one(part);
            *c = '/';
        }
    }
    reason = reason == 0 ? make_one(part) : reason;
    free(part);
    return reason == 0 ? PSPEC_OK : fail_folder("make the folder of", path, reason, error);
}

/* ---- looking ---- */

static bool is_entry_name(const char *name) {
    return strspn(name, "0123456789abcdef") == DIGITS && strcmp(name + DIGITS, ".result") == 0;
}

static bool is_temporary_name(const char *name) {
    static const char start[] = ".pointspec-";
    const size_t length = strlen(name);
    return length < NAME_BYTES && strncmp(name, start, sizeof start - 1) == 0 &&
           strcmp(name + length - 4, ".tmp") == 0; /* longer than that: it has the start */
}

static pspec_status add_file(cache_list *list, int folder, const char *name, ps_error *error) {
    struct stat facts;
    const bool is_temporary = is_temporary_name(name);
    if (!is_temporary && !is_entry_name(name)) {
        return PSPEC_OK;
    }
    if (fstatat(folder, name, &facts, AT_SYMLINK_NOFOLLOW) != 0) {
        return errno == ENOENT ? PSPEC_OK /* removed by another process in the meantime */
                               : fail_folder("look into", list->path, errno, error);
    }
    if (!S_ISREG(facts.st_mode)) {
        return PSPEC_OK;
    }
    void *memory = list->files;
    PS_TRY(ps_grow(&memory, &list->capacity, list->num + 1, sizeof(cache_file), "names of files",
                   error));
    list->files = memory;
    cache_file *const file = &list->files[list->num++];
    *file = (cache_file){.bytes = ps_cache_disk_bytes((uint64_t)facts.st_size),
                         .used = facts.st_mtim,
                         .is_temporary = is_temporary};
    memcpy(file->name, name, strlen(name) + 1); /* shorter than NAME_BYTES, both kinds */
    list->bytes += file->bytes;
    return PSPEC_OK;
}

static pspec_status add_files(cache_list *list, DIR *folder, ps_error *error) {
    for (;;) {
        errno = 0;
        const struct dirent *const found = readdir(folder);
        if (found == NULL) {
            return errno == 0 ? PSPEC_OK : fail_folder("look into", list->path, errno, error);
        }
        PS_TRY(add_file(list, dirfd(folder), found->d_name, error));
    }
}

/* *folder stays NULL where there is none. Both are to be given back by close_list, whatever the
 * status. */
static pspec_status open_list(cache_list *list, DIR **folder, const char *path, ps_error *error) {
    *list = (cache_list){.path = path};
    *folder = opendir(path);
    if (*folder == NULL) {
        return errno == ENOENT ? PSPEC_OK : fail_folder("look into", path, errno, error);
    }
    return add_files(list, *folder, error);
}

static void close_list(cache_list *list, DIR *folder) {
    free(list->files);
    if (folder != NULL) {
        closedir(folder);
    }
}

pspec_status ps_cache_folder_usage(const char *path, size_t *num_entries, uint64_t *bytes,
                                   ps_error *error) {
    cache_list list;
    DIR *folder = NULL;
    const pspec_status status = open_list(&list, &folder, path, error);
    *num_entries = 0;
    *bytes = list.bytes;
    for (size_t i = 0; i < list.num; i++) {
        *num_entries += list.files[i].is_temporary ? 0 : 1;
    }
    close_list(&list, folder);
    return status;
}

/* ---- removing ---- */

/* Oldest first; names only to have one order. */
static int compare_use(const void *a, const void *b) {
    const cache_file *const x = a;
    const cache_file *const y = b;
    if (x->used.tv_sec != y->used.tv_sec) {
        return x->used.tv_sec < y->used.tv_sec ? -1 : 1;
    }
    if (x->used.tv_nsec != y->used.tv_nsec) {
        return x->used.tv_nsec < y->used.tv_nsec ? -1 : 1;
    }
    return strcmp(x->name, y->name);
}

/* What a clock that went wrong has dated into the future would never become old. */
static void sort_by_use(cache_list *list, time_t now) {
    for (size_t i = 0; i < list->num; i++) {
        if (list->files[i].used.tv_sec > now + CLOCK_SECONDS) {
            list->files[i].used = (struct timespec){0};
        }
    }
    qsort(list->files, list->num, sizeof(cache_file), compare_use);
}

/* What cannot be removed is passed over; *reason is then errno. */
static void remove_oldest(cache_list *list, int folder, uint64_t max_bytes, int *reason) {
    const time_t now = time(NULL);
    sort_by_use(list, now);
    for (size_t i = 0; i < list->num; i++) {
        const cache_file *const file = &list->files[i];
        const bool must_go =
            file->is_temporary ? file->used.tv_sec < now - STALE_SECONDS : list->bytes > max_bytes;
        if (!must_go) {
            continue;
        }
        if (unlinkat(folder, file->name, 0) == 0 || errno == ENOENT) {
            list->bytes -= file->bytes;
        } else {
            *reason = errno;
        }
    }
}

pspec_status ps_cache_folder_shrink(const char *path, uint64_t max_bytes, ps_error *error) {
    cache_list list;
    DIR *folder = NULL;
    int reason = 0;
    pspec_status status = open_list(&list, &folder, path, error);
    if (status == PSPEC_OK && list.num > 0) {
        remove_oldest(&list, dirfd(folder), max_bytes, &reason);
        if (reason != 0 && list.bytes > max_bytes) {
            status = fail_folder("remove files of", path, reason, error);
        }
    }
    close_list(&list, folder);
    return status;
}

/* Where locks do not work, two processes remove the same entries, which is no harm: -1 and not
 * busy. */
static int take_lock(const char *path, bool *is_busy) {
    enum { MOST_TRIES = 50 };
    const struct timespec pause = {0, 2000000}; /* all tries: a tenth of a second */
    const int lock_flags = O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
    ps_text name = {0};
    ps_text_append(&name, "%s/lock", path);
    const int lock = name.failed ? -1 : open(name.data, lock_flags, 0600);
    ps_text_free(&name);
    *is_busy = false;
    for (int i = 0; lock >= 0 && i < MOST_TRIES; i++) {
        *is_busy = flock(lock, LOCK_EX | LOCK_NB) != 0 && (errno == EWOULDBLOCK || errno == EINTR);
        if (!*is_busy) {
            break;
        }
        nanosleep(&pause, NULL);
    }
    return lock;
}

pspec_status ps_cache_folder_evict(const char *path, uint64_t max_bytes, ps_error *error) {
    size_t num_entries = 0;
    uint64_t bytes = 0;
    PS_TRY(ps_cache_folder_usage(path, &num_entries, &bytes, error));
    if (bytes <= max_bytes) {
        return PSPEC_OK;
    }
    bool is_busy = false;
    const int lock = take_lock(path, &is_busy);
    const pspec_status status = is_busy ? PSPEC_OK : ps_cache_folder_shrink(path, max_bytes, error);
    if (lock >= 0) {
        close(lock); /* and gives the lock up */
    }
    return status;
}
