#include "files/descriptor.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

int ps_descriptor_open(const char *path) {
    return strcmp(path, "-") != 0 ? open(path, O_RDONLY | O_NOCTTY | O_CLOEXEC)
                                  : fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0);
}

pspec_status ps_descriptor_read(int descriptor, const char *name, void *out, size_t max_bytes,
                                size_t *count, ps_error *error) {
    const ssize_t taken = read(descriptor, out, max_bytes);
    if (taken < 0) {
        return ps_read_fail(name, error);
    }
    *count = (size_t)taken;
    return PSPEC_OK;
}

pspec_status ps_read_fail(const char *name, ps_error *error) {
    const int reason = errno;
    return ps_fail(error, reason == EINTR ? PSPEC_ERROR_CANCELLED : PSPEC_ERROR_IO,
                   "cannot read %s: %s", name, strerror(reason));
}
