/* Streams. A write or read that fails does what stdio does: nothing is moved, errno and the error
 * indicator of the stream are set. */
#include "faults.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

int __real_fcntl64(int descriptor, int command, ...);
int __real_fstat64(int descriptor, struct stat *facts);

/* Reports tell what is closed: after reading, without a name, and still empty (the trial of an
 * output) there is nothing to lose. */
static const char *name_of_close(FILE *stream) {
    struct stat facts;
    if ((__real_fcntl64(fileno(stream), F_GETFL) & O_ACCMODE) == O_RDONLY) {
        return "fclose-reading";
    }
    return __real_fstat64(fileno(stream), &facts) != 0 ? "fclose"
           : facts.st_nlink == 0                       ? "fclose-nameless"
           : facts.st_size == 0                        ? "fclose-empty"
                                                       : "fclose";
}

/* The text is the stream's until it is closed, and then freed by who has it. One is open at a time,
 * and no write to it is one to a file: what it lacks is memory, as open_memstream may. */
static struct {
    FILE *stream;
    char **text;
} in_memory;

static bool fails(FILE *stream, const char *name, int reason) {
    if (stream != NULL && stream == in_memory.stream) {
        return false;
    }
    /* Without standard error a failure could not be told. */
    const bool is_due = stream == stderr ? fault_is_due_alone(FAULT_FILE, "standard-error")
                                         : fault_is_due(FAULT_FILE, name);
    if (is_due) {
        errno = reason;
        if (stream != NULL) {
            stream->_flags |= _IO_ERR_SEEN; /* glibc has no function for it */
        }
    }
    return is_due;
}

/* ---- opening and closing ------------------------------------------------------------------- */

WRAPPER(fopen64, FILE *, (const char *path, const char *mode)) {
    FILE *const stream = fails(NULL, "fopen", EMFILE) ? NULL : __real_fopen64(path, mode);
    fault_gain(stream, "fopen");
    return stream;
}

WRAPPER(fdopen, FILE *, (int descriptor, const char *mode)) {
    FILE *const stream = fails(NULL, "fdopen", ENOMEM) ? NULL : __real_fdopen(descriptor, mode);
    if (stream != NULL) {
        fault_lose(fault_descriptor(descriptor));
        fault_gain(stream, "fdopen");
    }
    return stream;
}

WRAPPER(open_memstream, FILE *, (char **text, size_t *num_bytes)) {
    in_memory.stream = fault_is_due(FAULT_MEMORY, "open_memstream")
                           ? NULL
                           : __real_open_memstream(text, num_bytes);
    in_memory.text = text;
    if (in_memory.stream != NULL) {
        fault_gain(in_memory.stream, "open_memstream");
    }
    return in_memory.stream;
}

WRAPPER(fclose, int, (FILE * stream)) {
    const bool is_due = stream != in_memory.stream && fails(NULL, name_of_close(stream), EIO);
    fault_lose(stream);
    const int status = __real_fclose(stream);
    if (stream == in_memory.stream) {
        in_memory.stream = NULL;
        fault_gain(*in_memory.text, "open_memstream");
    }
    if (is_due) {
        errno = EIO;
    }
    return is_due ? EOF : status;
}

/* ---- calls that fail with a value of their own --------------------------------------------- */

#define CALL(name, type, failure, reason, parameters, arguments)                                   \
    WRAPPER(name, type, parameters) {                                                              \
        return fails(stream, #name, reason) ? failure : __real_##name arguments;                   \
    }

CALL(fflush, int, EOF, ENOSPC, (FILE * stream), (stream))
CALL(fwrite, size_t, 0, ENOSPC, (const void *in, size_t bytes, size_t count, FILE *stream),
     (in, bytes, count, stream))
CALL(fputs, int, EOF, ENOSPC, (const char *text, FILE *stream), (text, stream))
CALL(fputc, int, EOF, ENOSPC, (int byte, FILE *stream), (byte, stream))
CALL(putc, int, EOF, ENOSPC, (int byte, FILE *stream), (byte, stream))
CALL(fread, size_t, 0, EIO, (void *out, size_t bytes, size_t count, FILE *stream),
     (out, bytes, count, stream))
CALL(fgets, char *, NULL, EIO, (char *out, int bytes, FILE *stream), (out, bytes, stream))
CALL(getc, int, EOF, EIO, (FILE * stream), (stream))

/* These do not touch the error indicator. */
#define QUIET_CALL(name, type, failure, reason, parameters, arguments)                             \
    WRAPPER(name, type, parameters) {                                                              \
        return fails(NULL, #name, reason) ? failure : __real_##name arguments;                     \
    }

QUIET_CALL(fseeko64, int, -1, ESPIPE, (FILE * stream, off_t offset, int whence),
           (stream, offset, whence))
QUIET_CALL(ftello64, off_t, -1, ESPIPE, (FILE * stream), (stream))

/* ---- formatted output ---------------------------------------------------------------------- */

#define PRINT(name, stream, parameters)                                                            \
    WRAPPER(name, int, parameters) {                                                               \
        va_list arguments;                                                                         \
        if (fails(stream, #name, ENOSPC)) {                                                        \
            return -1;                                                                             \
        }                                                                                          \
        va_start(arguments, format);                                                               \
        const int length = vfprintf(stream, format, arguments);                                    \
        va_end(arguments);                                                                         \
        return length;                                                                             \
    }

PRINT(fprintf, stream, (FILE * stream, const char *format, ...))
PRINT(printf, stdout, (const char *format, ...))

WRAPPER(puts, int, (const char *text)) {
    return fails(stdout, "puts", ENOSPC) ? EOF : __real_puts(text);
}

WRAPPER(putchar, int, (int byte)) {
    return fails(stdout, "putchar", ENOSPC) ? EOF : __real_putchar(byte);
}
