#define _XOPEN_SOURCE 700 /* realpath */

#include "files/output_file.h"

#include "base/memory.h"
#include "base/text.h"
#include "files/temporary_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct ps_output_file {
    FILE *stream;
    FILE *waiting;        /* the output itself, while stream is a temporary file; or NULL */
    char *name;           /* as the caller gave it, for messages */
    char *target;         /* the final name, symbolic links resolved; NULL: written directly */
    char *temporary;      /* where the data are until commit; NULL: written directly */
    mode_t mode;          /* permissions that the target had, 0: it is new */
    int reason;           /* errno of the first ps_output_write that failed, or 0 */
    size_t unsettled;     /* bytes of ps_output_write that may not be on the disk */
    bool is_caller_owned; /* standard output is not ours to close */
};

static pspec_status fail_write(const char *name, int reason, ps_error *error) {
    return ps_fail(error, reason == EINTR ? PSPEC_ERROR_CANCELLED : PSPEC_ERROR_IO,
                   "cannot write %s: %s", name,
                   reason == EFBIG ? "File too large for the file size limit, see ulimit -f"
                   : reason != 0   ? strerror(reason)
                                   : "a write failed");
}

/* After this, stream is the output itself. */
static void end_waiting(ps_output_file *file) {
    if (file->waiting != NULL) {
        fclose(file->stream);
        file->stream = file->waiting;
        file->waiting = NULL;
    }
}

/* The temporary file loses its name while it is locked, see temporary_file.h. */
static void destroy(ps_output_file *file) {
    end_waiting(file);
    if (file->temporary != NULL) {
        unlink(file->temporary);
    }
    if (file->stream != NULL && !file->is_caller_owned) {
        fclose(file->stream);
    }
    free(file->name);
    free(file->target);
    free(file->temporary);
    free(file);
}

/* Pipes and devices cannot be made durable, and say EINVAL. */
static bool is_durable(int descriptor) {
    return fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP;
}

/* The descriptors of this process under their file names: replacing them would be a surprise. */
static bool names_descriptor(const char *path) {
    return strncmp(path, "/dev/std", 8) == 0 || strncmp(path, "/dev/fd/", 8) == 0 ||
           strncmp(path, "/proc/", 6) == 0;
}

static pspec_status open_directly(ps_output_file *file, const char *path, ps_error *error) {
    const int descriptor = open(path, O_WRONLY | O_NOCTTY | O_CLOEXEC);
    file->stream = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL;
    if (file->stream == NULL) {
        const int reason = errno;
        if (descriptor >= 0) {
            close(descriptor);
        }
        return fail_write(file->name, reason, error);
    }
    return PSPEC_OK;
}

/* In the folder of the target, whose name may have the greatest length already. */
static int create_temporary(ps_output_file *file) {
    const char *const slash = strrchr(file->target, '/');
    const size_t folder_length = slash != NULL ? (size_t)(slash - file->target) + 1 : 0;
    return ps_temporary_create(file->target, folder_length, 0666, &file->temporary);
}

static pspec_status open_temporary(ps_output_file *file, ps_error *error) {
    const int descriptor = create_temporary(file);
    if (descriptor < 0) {
        return fail_write(file->name, errno, error);
    }
    if (file->mode != 0) {
        (void)fchmod(descriptor, file->mode); /* not all file systems have permissions */
    }
    file->stream = fdopen(descriptor, "wb");
    if (file->stream == NULL) {
        close(descriptor);
        return fail_write(file->name, ENOMEM, error);
    }
    return PSPEC_OK;
}

static pspec_status open_path(ps_output_file *file, const char *path, ps_error *error) {
    struct stat facts;
    const bool exists = stat(path, &facts) == 0;
    if (!exists && errno != ENOENT) { /* it may be there: nothing to be replaced blindly */
        return fail_write(file->name, errno, error);
    }
    if (exists && S_ISDIR(facts.st_mode)) {
        return fail_write(file->name, EISDIR, error);
    }
    if (names_descriptor(path) || (exists && !S_ISREG(facts.st_mode))) {
        return open_directly(file, path, error);
    }
    if (exists && access(path, W_OK) != 0 && errno != ENOENT) {
        return fail_write(file->name, errno, error);
    }
    file->mode = exists ? facts.st_mode & 0777 : 0;
    file->target = exists ? realpath(path, NULL) : NULL;
    if (file->target == NULL &&
        (!exists || errno == ENOENT)) { /* new, or just removed by another */
        file->target = strdup(path);
    }
    if (file->target == NULL) {
        return fail_write(file->name, errno, error);
    }
    return open_temporary(file, error);
}

const char *ps_output_ending(const char *path) {
    const char *const slash = strrchr(path, '/');
    const char *const name = slash != NULL ? slash + 1 : path;
    const char *const dot = strrchr(name, '.');
    return dot != NULL && dot != name && dot[1] != '\0' ? dot : "";
}

pspec_status ps_output_open(ps_output_file **out, const char *path, ps_error *error) {
    *out = NULL;
    ps_output_file *file = NULL;
    PS_TRY(PS_NEW(&file, 1, "output file", error));
    const bool is_standard = strcmp(path, "-") == 0;
    pspec_status status = PSPEC_OK;
    file->name = strdup(is_standard ? "standard output" : path);
    if (file->name == NULL) {
        status = ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for a file name");
    } else if (path[0] == '\0') {
        status = ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "the name of an output is empty");
    } else if (ps_text_ends_in(path, ".gz")) { /* what it promises would not be in it */
        status = ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "\"%s\": gzip is read, but not written; write to standard output and "
                         "pipe that through gzip",
                         path);
    } else if (is_standard) {
        file->stream = stdout;
        file->is_caller_owned = true;
    } else {
        status = open_path(file, path, error);
    }
    if (status != PSPEC_OK) {
        destroy(file);
        return status;
    }
    *out = file;
    return PSPEC_OK;
}

pspec_status ps_output_open_stream(ps_output_file **out, FILE *stream, ps_error *error) {
    ps_output_file *file = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&file, 1, "output file", error));
    file->name = strdup("a temporary file");
    if (file->name == NULL) {
        free(file);
        return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for a file name");
    }
    file->stream = stream;
    file->is_caller_owned = true;
    *out = file;
    return PSPEC_OK;
}

FILE *ps_output_stream(ps_output_file *file) {
    return file->stream;
}

/* On to the disk, so that commit has little left to wait for: no signal ends that wait. What has no
 * name of ours is made durable by nobody. */
static void settle(ps_output_file *file, size_t bytes) {
    enum { BYTES_AT_A_TIME = 1 << 24 }; /* a fifth of a second of a slow disk */
    file->unsettled += bytes;
    if (file->temporary == NULL || file->waiting != NULL || file->unsettled < BYTES_AT_A_TIME) {
        return;
    }
    file->unsettled = 0;
    errno = 0;
    if (fflush(file->stream) != 0 || !is_durable(fileno(file->stream))) {
        file->reason = errno != 0 ? errno : EIO;
    }
}

/* Piece by piece: a call of the system that takes gigabytes hears no signal before it has them. */
void ps_output_write(ps_output_file *file, const void *data, size_t element_bytes, size_t count) {
    enum { PIECE_BYTES = 1 << 22 };
    const char *next = data;
    const size_t most = PIECE_BYTES / element_bytes + 1;
    while (count > 0 && file->reason == 0) {
        const size_t num = count < most ? count : most;
        errno = 0;
        if (fwrite(next, element_bytes, num, file->stream) == num) {
            settle(file, num * element_bytes);
        } else {
            file->reason = errno != 0 ? errno : EIO;
        }
        next += num * element_bytes;
        count -= num;
    }
}

pspec_status ps_output_check(ps_output_file *file, ps_error *error) {
    errno = 0;
    if (fflush(file->stream) != 0 || ferror(file->stream) || file->reason != 0) {
        return fail_write(file->name, file->reason != 0 ? file->reason : errno, error);
    }
    return PSPEC_OK;
}

pspec_status ps_output_make_seekable(ps_output_file *file, ps_error *error) {
    struct stat facts;
    const int descriptor = fileno(file->stream);
    const bool appends = (fcntl(descriptor, F_GETFL) & O_APPEND) != 0;
    if (fstat(descriptor, &facts) == 0 && S_ISREG(facts.st_mode) && !appends &&
        ftello(file->stream) == 0) { /* standard output may be a file with something in it */
        return PSPEC_OK;
    }
    FILE *temporary = NULL;
    PS_TRY(ps_temporary_open(&temporary, error));
    file->waiting = file->stream;
    file->stream = temporary;
    return PSPEC_OK;
}

pspec_status ps_output_rewind(ps_output_file *file, ps_error *error) {
    PS_TRY(ps_output_check(file, error));
    return fseeko(file->stream, 0, SEEK_SET) == 0 ? PSPEC_OK : fail_write(file->name, errno, error);
}

/* From the temporary file to where the data belong. */
static pspec_status copy_waiting(ps_output_file *file, ps_error *error) {
    enum { BLOCK_BYTES = 1 << 16 };
    char block[BLOCK_BYTES];
    PS_TRY(ps_output_rewind(file, error));
    FILE *const temporary = file->stream;
    for (size_t count = BLOCK_BYTES; count == BLOCK_BYTES;) {
        count = fread(block, 1, BLOCK_BYTES, temporary);
        errno = 0;
        if (fwrite(block, 1, count, file->waiting) != count || ferror(temporary)) {
            return fail_write(file->name, errno, error);
        }
    }
    end_waiting(file);
    return ps_output_check(file, error);
}

/* The new name itself is in the folder, which has its own way to the disk. Failure is not reported:
 * the file is complete and there. */
static void sync_folder(const char *target) {
    const char *const slash = strrchr(target, '/');
    ps_text folder = {0};
    ps_text_append_bytes(&folder, slash != NULL ? target : ".",
                         slash != NULL ? (size_t)(slash - target) + 1 : 1);
    const int descriptor = open(ps_text_string(&folder), O_RDONLY | O_CLOEXEC);
    if (descriptor >= 0) {
        (void)fsync(descriptor);
        close(descriptor);
    }
    ps_text_free(&folder);
}

static pspec_status close_stream(ps_output_file *file, ps_error *error) {
    const int close_status = fclose(file->stream);
    file->stream = NULL;
    return close_status == 0 ? PSPEC_OK : fail_write(file->name, errno, error);
}

/* A second descriptor keeps the lock until the file has its final name: without it another process
 * could take it for one that was left behind. */
static pspec_status take_name(ps_output_file *file, ps_error *error) {
    const int lock = fcntl(fileno(file->stream), F_DUPFD_CLOEXEC, 0);
    if (lock < 0) {
        return fail_write(file->name, errno, error);
    }
    pspec_status status = close_stream(file, error);
    if (status == PSPEC_OK && rename(file->temporary, file->target) != 0) {
        status = fail_write(file->name, errno, error);
    }
    if (status != PSPEC_OK) {
        unlink(file->temporary);
    }
    free(file->temporary);
    file->temporary = NULL;
    close(lock);
    PS_TRY(status);
    sync_folder(file->target);
    return PSPEC_OK;
}

static pspec_status finish(ps_output_file *file, ps_error *error) {
    PS_TRY(ps_output_check(file, error));
    if (file->waiting != NULL) {
        PS_TRY(copy_waiting(file, error));
    }
    if (file->is_caller_owned) {
        return PSPEC_OK;
    }
    if (!is_durable(fileno(file->stream))) {
        return fail_write(file->name, errno, error);
    }
    return file->temporary != NULL ? take_name(file, error) : close_stream(file, error);
}

pspec_status ps_output_commit(ps_output_file **file, ps_error *error) {
    const pspec_status status = finish(*file, error);
    destroy(*file);
    *file = NULL;
    return status;
}

void ps_output_discard(ps_output_file **file) {
    if (*file != NULL) {
        destroy(*file);
        *file = NULL;
    }
}
