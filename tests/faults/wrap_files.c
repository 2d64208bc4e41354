/* Files, descriptors and child processes. A call that gives something up does so and then says that
 * it failed, as close(2) does. */
#include "faults.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static bool fails(const char *name, int reason) {
    const bool is_due = fault_is_due(FAULT_FILE, name);
    if (is_due) {
        errno = reason;
    }
    return is_due;
}

/* A call that fails with -1 and errno, and takes and gives nothing. */
#define CALL(name, type, reason, parameters, arguments)                                            \
    WRAPPER(name, type, parameters) {                                                              \
        return fails(#name, reason) ? -1 : __real_##name arguments;                                \
    }

/* ---- names --------------------------------------------------------------------------------- */

CALL(stat64, int, EIO, (const char *path, struct stat *facts), (path, facts))
CALL(lstat64, int, EIO, (const char *path, struct stat *facts), (path, facts))
CALL(access, int, EACCES, (const char *path, int mode), (path, mode))
CALL(rename, int, EIO, (const char *from, const char *to), (from, to))
CALL(mkdir, int, ENOSPC, (const char *path, mode_t mode), (path, mode))

/* Spared by N+: what cannot be removed stays, and no program can do anything about it. */
WRAPPER(unlink, int, (const char *path)) {
    if (fault_is_due_alone(FAULT_FILE, "unlink")) {
        errno = EIO;
        return -1;
    }
    return __real_unlink(path);
}

WRAPPER(unlinkat, int, (int folder, const char *name, int flags)) {
    if (fault_is_due_alone(FAULT_FILE, "unlinkat")) {
        errno = EIO;
        return -1;
    }
    return __real_unlinkat(folder, name, flags);
}

WRAPPER(realpath, char *, (const char *path, char *room)) {
    char *const resolved = fails("realpath", EIO) ? NULL : __real_realpath(path, room);
    fault_gain(room == NULL ? resolved : NULL, "realpath");
    return resolved;
}

/* ---- folders ------------------------------------------------------------------------------- */

CALL(fstatat64, int, EIO, (int folder, const char *name, struct stat *facts, int flags),
     (folder, name, facts, flags))

WRAPPER(opendir, DIR *, (const char *path)) {
    DIR *const folder = fails("opendir", EMFILE) ? NULL : __real_opendir(path);
    fault_gain(folder, "opendir");
    return folder;
}

WRAPPER(readdir64, struct dirent *, (DIR * folder)) {
    return fails("readdir", EIO) ? NULL : __real_readdir64(folder);
}

/* A descriptor for reading: everything was read, and nobody asks. */
WRAPPER(closedir, int, (DIR * folder)) {
    fault_lose(folder);
    return __real_closedir(folder);
}

/* ---- descriptors --------------------------------------------------------------------------- */

CALL(fstat64, int, EIO, (int descriptor, struct stat *facts), (descriptor, facts))
CALL(fchmod, int, EPERM, (int descriptor, mode_t mode), (descriptor, mode))
CALL(futimens, int, EPERM, (int descriptor, const struct timespec times[2]), (descriptor, times))
CALL(flock, int, ENOLCK, (int descriptor, int operation), (descriptor, operation))
CALL(ftruncate64, int, EIO, (int descriptor, off_t length), (descriptor, length))
CALL(lseek64, off_t, EIO, (int descriptor, off_t offset, int whence), (descriptor, offset, whence))
CALL(write, ssize_t, ENOSPC, (int descriptor, const void *in, size_t bytes),
     (descriptor, in, bytes))

/* The commands in use: F_SETFD and F_DUPFD_CLOEXEC take a number, F_GETFD and F_GETFL do not. */
WRAPPER(fcntl64, int, (int descriptor, int command, ...)) {
    const bool takes_number = command == F_SETFD || command == F_DUPFD_CLOEXEC;
    va_list arguments;
    va_start(arguments, command);
    const int value = takes_number ? va_arg(arguments, int) : 0;
    va_end(arguments);
    const char *const name = command == F_GETFD   ? "fcntl-query"
                             : command == F_GETFL ? "fcntl-flags"
                                                  : "fcntl";
    const int result = fails(name, EIO) ? -1 : __real_fcntl64(descriptor, command, value);
    if (command == F_DUPFD_CLOEXEC) {
        fault_gain(fault_descriptor(result), "fcntl");
    }
    return result;
}

/* Files that the system makes up, apart in reports: limits in them that cannot be read are left
 * out. */
static const char *name_of_read(int descriptor) {
    char link[64];
    char target[8] = "";
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const ssize_t length = readlink(link, target, sizeof target - 1);
    const bool is_system =
        length > 0 && (strncmp(target, "/proc/", 6) == 0 || strncmp(target, "/sys/", 5) == 0);
    return is_system ? "read-system" : "read";
}

WRAPPER(read, ssize_t, (int descriptor, void *out, size_t bytes)) {
    return fails(name_of_read(descriptor), EIO) ? -1 : __real_read(descriptor, out, bytes);
}

/* Reports tell folders and pipes apart: only there may a failure be tolerated. */
static const char *name_of(int descriptor, const char *file, const char *folder, const char *pipe) {
    struct stat facts;
    const bool is_known = __real_fstat64(descriptor, &facts) == 0;
    return is_known && S_ISDIR(facts.st_mode)    ? folder
           : is_known && S_ISFIFO(facts.st_mode) ? pipe
                                                 : file;
}

WRAPPER(fsync, int, (int descriptor)) {
    const bool is_due = fails(name_of(descriptor, "fsync", "fsync-folder", "fsync"), EIO);
    return is_due ? -1 : __real_fsync(descriptor);
}

WRAPPER(close, int, (int descriptor)) {
    const bool is_read = (__real_fcntl64(descriptor, F_GETFL, 0) & O_ACCMODE) == O_RDONLY;
    const char *const file = is_read ? "close-reading" : "close";
    const bool is_due = fails(name_of(descriptor, file, "close-folder", "close-pipe"), EIO);
    fault_lose(fault_descriptor(descriptor));
    const int status = __real_close(descriptor);
    if (is_due) {
        errno = EIO;
    }
    return is_due ? -1 : status;
}

WRAPPER(open64, int, (const char *path, int flags, ...)) {
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
    va_end(arguments);
    const char *const name = (flags & O_ACCMODE) == O_RDONLY ? "open-reading" : "open";
    const int descriptor = fails(name, EMFILE) ? -1 : __real_open64(path, flags, mode);
    fault_gain(fault_descriptor(descriptor), "open");
    return descriptor;
}

WRAPPER(dup, int, (int descriptor)) {
    const int copy = fails("dup", EMFILE) ? -1 : __real_dup(descriptor);
    fault_gain(fault_descriptor(copy), "dup");
    return copy;
}

/* ---- child processes ----------------------------------------------------------------------- */

WRAPPER(pipe, int, (int ends[2])) {
    if (fails("pipe", EMFILE)) {
        return -1;
    }
    const int status = __real_pipe(ends);
    if (status == 0) {
        fault_gain(fault_descriptor(ends[0]), "pipe");
        fault_gain(fault_descriptor(ends[1]), "pipe");
    }
    return status;
}

/* These return the error instead of setting errno. */
WRAPPER(posix_spawn_file_actions_init, int, (posix_spawn_file_actions_t * actions)) {
    if (fails("posix_spawn_file_actions_init", ENOMEM)) {
        return ENOMEM;
    }
    fault_gain(actions, "posix_spawn_file_actions_init");
    return __real_posix_spawn_file_actions_init(actions);
}

WRAPPER(posix_spawn_file_actions_destroy, int, (posix_spawn_file_actions_t * actions)) {
    fault_lose(actions);
    return __real_posix_spawn_file_actions_destroy(actions);
}

WRAPPER(posix_spawn_file_actions_adddup2, int,
        (posix_spawn_file_actions_t * actions, int from, int to)) {
    return fails("posix_spawn_file_actions_adddup2", ENOMEM)
               ? ENOMEM
               : __real_posix_spawn_file_actions_adddup2(actions, from, to);
}

WRAPPER(posix_spawnattr_init, int, (posix_spawnattr_t * attributes)) {
    if (fails("posix_spawnattr_init", ENOMEM)) {
        return ENOMEM;
    }
    fault_gain(attributes, "posix_spawnattr_init");
    return __real_posix_spawnattr_init(attributes);
}

WRAPPER(posix_spawnattr_destroy, int, (posix_spawnattr_t * attributes)) {
    fault_lose(attributes);
    return __real_posix_spawnattr_destroy(attributes);
}

WRAPPER(posix_spawn, int,
        (pid_t * child, const char *file, const posix_spawn_file_actions_t *actions,
         const posix_spawnattr_t *attributes, char *const *arguments, char *const *environment)) {
    return fails("posix_spawn", EAGAIN)
               ? EAGAIN
               : __real_posix_spawn(child, file, actions, attributes, arguments, environment);
}

WRAPPER(waitpid, pid_t, (pid_t child, int *state, int options)) {
    const pid_t waited = __real_waitpid(child, state, options);
    return fails("waitpid", ECHILD) ? -1 : waited;
}
