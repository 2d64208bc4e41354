#include "io/temporary_file.h"

#include "base/text.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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
    enum { MOST_TRIES = 10000 };
    for (int number = 0; number < MOST_TRIES; number++) {
        ps_text path = {0};
        ps_text_append(&path, "%s/.pointspec-%ld-%d.tmp", folder, (long)getpid(), number);
        errno = ENOMEM;
        const int descriptor =
            path.failed ? -1 : open(path.data, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
        const int reason = errno;
        if (descriptor >= 0) {
            (void)unlink(path.data); /* what cannot be removed stays, and holds nothing secret */
        }
        ps_text_free(&path);
        errno = reason;
        if (descriptor >= 0 || reason != EEXIST) {
            return descriptor;
        }
    }
    return -1;
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
