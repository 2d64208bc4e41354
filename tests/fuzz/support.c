#define _GNU_SOURCE /* memfd_create */

#include "fuzz.h"

#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

void fuzz_fail(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fputs("fuzz: ", stderr);
    vfprintf(stderr, format, arguments);
    fputs("\n", stderr);
    va_end(arguments);
    abort();
}

/* ---- bytes ------------------------------------------------------------------------------- */

uint8_t fuzz_take(fuzz_bytes *bytes) {
    if (bytes->size == 0) {
        return 0;
    }
    bytes->size--;
    return *bytes->data++;
}

void *fuzz_allocate(void *old, size_t count, size_t element_bytes) {
    void *const memory = realloc(old, count * element_bytes + 1);
    if (memory == NULL) {
        fuzz_fail("no memory for %zu elements of %zu bytes", count, element_bytes);
    }
    return memory;
}

char *fuzz_copy_text(fuzz_bytes bytes) {
    char *const text = fuzz_allocate(NULL, bytes.size + 1, 1);
    if (bytes.size > 0) {
        memcpy(text, bytes.data, bytes.size);
    }
    text[bytes.size] = '\0';
    return text;
}

/* ---- errors ------------------------------------------------------------------------------ */

/* PSPEC_ERROR_MEMORY is none of them: inputs are small, so a header was believed. */
static bool comes_from_input(pspec_status status) {
    return status == PSPEC_ERROR_INVALID_ARGUMENT || status == PSPEC_ERROR_INPUT ||
           status == PSPEC_ERROR_IO;
}

void fuzz_check_error(pspec_status status, const ps_error *error, fuzz_quotes quotes) {
    if (status == PSPEC_OK) {
        return;
    }
    if (!comes_from_input(status) || status != error->status) {
        fuzz_fail("status %d, status %d in the error: %s", (int)status, (int)error->status,
                  error->message);
    }
    if (error->message[0] == '\0') {
        fuzz_fail("status %d without a sentence", (int)status);
    }
    size_t bytes = 0;
    for (const char *c = error->message; *c != '\0' && quotes == FUZZ_PRINTABLE; c += bytes) {
        bytes = ps_text_character(c);
        if (bytes == 0 || strchr("\t\r\n", *c) != NULL) {
            fuzz_fail("byte %d in the sentence: %s", *c, error->message);
        }
    }
}

/* ---- files ------------------------------------------------------------------------------- */

static void write_all(int descriptor, fuzz_bytes content) {
    while (content.size > 0) {
        const ssize_t count = write(descriptor, content.data, content.size);
        if (count <= 0) {
            fuzz_fail("cannot write to a file in memory");
        }
        content.data += count;
        content.size -= (size_t)count;
    }
}

static fuzz_file name_file(int descriptor) {
    fuzz_file file = {.descriptor = descriptor};
    snprintf(file.path, sizeof file.path, "/proc/self/fd/%d", descriptor);
    return file;
}

fuzz_file fuzz_file_make(fuzz_bytes content) {
    const int descriptor = memfd_create("pointspec-fuzz", MFD_CLOEXEC);
    if (descriptor < 0) {
        fuzz_fail("no file in memory");
    }
    write_all(descriptor, content);
    return name_file(descriptor);
}

fuzz_file fuzz_pipe_make(fuzz_bytes content) {
    enum { CAPACITY = 1 << 16 }; /* of Linux: one more byte and the write would wait for a reader */
    int ends[2];
    if (content.size > CAPACITY) {
        return fuzz_file_make(content);
    }
    if (pipe(ends) != 0) {
        fuzz_fail("no pipe");
    }
    write_all(ends[1], content);
    close(ends[1]);
    return name_file(ends[0]);
}

void fuzz_file_close(fuzz_file *file) {
    close(file->descriptor);
    file->descriptor = -1;
}
