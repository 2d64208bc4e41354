#include "files/input_file.h"

#include "base/memory.h"
#include "base/process/program.h"
#include "files/descriptor.h"
#include "files/packed/gzip.h"
#include "files/packed/zip.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    BUFFER_BYTES = 1 << 16, /* larger reads go around the buffer; smaller ones share system calls */
    MOST_PEEKED = 1024
};

pspec_status ps_input_check(const char *path, ps_error *error) {
    return path == NULL || strcmp(path, "-") == 0 || access(path, R_OK) == 0
               ? PSPEC_OK
               : ps_read_fail(path, error);
}

/* ---- opening ----------------------------------------------------------------------------- */

static pspec_status check_kind(ps_input *input, ps_error *error) {
    struct stat facts;
    if (fstat(input->descriptor, &facts) != 0) {
        return ps_read_fail(input->name, error);
    }
    if (S_ISDIR(facts.st_mode)) {
        errno = EISDIR;
        return ps_read_fail(input->name, error);
    }
    input->is_seekable = S_ISREG(facts.st_mode);
    return PSPEC_OK;
}

/* Do the bytes to come begin so? As few are waited for as tell, for a pipe may be slow. */
static pspec_status begins_with(ps_input *input, const char *magic, bool *begins, ps_error *error) {
    const unsigned char *bytes = NULL;
    size_t num_bytes = 0;
    *begins = true;
    for (size_t i = 0; *begins && magic[i] != '\0'; i++) {
        PS_TRY(ps_input_peek(input, i + 1, &bytes, &num_bytes, error));
        *begins = num_bytes > i && bytes[i] == (unsigned char)magic[i];
    }
    return PSPEC_OK;
}

static pspec_status start_zip(ps_input *input, const char *array, ps_error *error) {
    if (!input->is_seekable) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s is a zip archive, whose directory is at its end: give a file instead "
                       "of a pipe",
                       input->name);
    }
    input->begin = input->end = 0;
    input->is_seekable = false;
    return ps_zip_open(&input->zip, input->descriptor, input->name, array, error);
}

static pspec_status start_gzip(ps_input *input, ps_error *error) {
    PS_TRY(ps_gzip_create(&input->gzip, PS_GZIP_FILE, input->descriptor, input->name,
                          input->buffer + input->begin, input->end - input->begin, error));
    input->begin = input->end = 0;
    input->is_seekable = false;
    return PSPEC_OK;
}

static pspec_status check_not_empty(ps_input *input, ps_error *error) {
    const unsigned char *bytes = NULL;
    size_t num_bytes = 0;
    PS_TRY(ps_input_peek(input, 1, &bytes, &num_bytes, error));
    return num_bytes > 0 ? PSPEC_OK
                         : ps_fail(error, PSPEC_ERROR_INPUT, "%s %s", input->name,
                                   input->program != NULL ? "printed nothing" : "is empty");
}

static pspec_status start_compressed(ps_input *input, const char *array, ps_error *error) {
    bool is_gzip = false;
    bool is_zip = false;
    PS_TRY(check_not_empty(input, error));
    PS_TRY(begins_with(input, "\x1f\x8b", &is_gzip, error));
    PS_TRY(begins_with(input, "PK\3\4", &is_zip, error));
    return is_gzip ? start_gzip(input, error) : is_zip ? start_zip(input, array, error) : PSPEC_OK;
}

static pspec_status begin(ps_input *input, const char *name, ps_error *error) {
    *input = (ps_input){.name = strdup(name), .descriptor = -1};
    if (input->name == NULL) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for a file name");
    }
    return PS_NEW(&input->buffer, BUFFER_BYTES, "an input buffer", error);
}

static pspec_status open_input(ps_input *input, const char *path, const char *array,
                               ps_error *error) {
    PS_TRY(begin(input, strcmp(path, "-") == 0 ? "standard input" : path, error));
    input->descriptor = ps_descriptor_open(path);
    if (input->descriptor < 0) {
        return ps_read_fail(input->name, error);
    }
    PS_TRY(check_kind(input, error));
    input->can_reopen = input->is_seekable && strcmp(path, "-") != 0;
    return start_compressed(input, array, error);
}

pspec_status ps_input_open(ps_input *input, const char *path, ps_error *error) {
    return ps_input_open_array(input, path, "points", error);
}

pspec_status ps_input_open_array(ps_input *input, const char *path, const char *array,
                                 ps_error *error) {
    const pspec_status status = open_input(input, path, array, error);
    if (status != PSPEC_OK) {
        ps_input_close(input);
    }
    return status;
}

static pspec_status open_program(ps_input *input, const char *name, const char *command,
                                 ps_error *error) {
    PS_TRY(begin(input, name, error));
    PS_TRY(ps_program_start(&input->program, command, error));
    return check_not_empty(input, error);
}

pspec_status ps_input_open_program(ps_input *input, const char *name, const char *command,
                                   ps_error *error) {
    const pspec_status status = open_program(input, name, command, error);
    if (status != PSPEC_OK) {
        ps_input_close(input);
    }
    return status;
}

void ps_input_close(ps_input *input) {
    if (input->name != NULL && input->descriptor >= 0) {
        close(input->descriptor);
    }
    ps_gzip_destroy(input->gzip);
    ps_zip_destroy(input->zip);
    ps_program_end(input->program);
    free(input->buffer);
    free(input->name);
    *input = (ps_input){.descriptor = -1};
}

/* ---- reading ----------------------------------------------------------------------------- */

/* One step of the source itself, around the buffer. */
static pspec_status read_source(ps_input *input, void *out, size_t max_bytes, size_t *count,
                                ps_error *error) {
    if (input->gzip != NULL) {
        return ps_gzip_read(input->gzip, out, max_bytes, count, error);
    }
    if (input->zip != NULL) {
        return ps_zip_read(input->zip, out, max_bytes, count, error);
    }
    if (input->program != NULL) {
        return ps_program_read(input->program, out, max_bytes, count, error);
    }
    return ps_descriptor_read(input->descriptor, input->name, out, max_bytes, count, error);
}

pspec_status ps_input_peek(ps_input *input, size_t wanted, const unsigned char **bytes,
                           size_t *num_bytes, ps_error *error) {
    size_t count = 1;
    if (input->begin > 0 && input->end - input->begin < MOST_PEEKED) {
        memmove(input->buffer, input->buffer + input->begin, input->end - input->begin);
        input->end -= input->begin;
        input->begin = 0;
    }
    while (input->end - input->begin < wanted && count > 0) {
        PS_TRY(read_source(input, input->buffer + input->end, BUFFER_BYTES - input->end, &count,
                           error));
        input->end += count;
    }
    *bytes = input->buffer + input->begin;
    *num_bytes = input->end - input->begin;
    return PSPEC_OK;
}

static size_t take_buffered(ps_input *input, void *out, size_t max_bytes) {
    const size_t there = input->end - input->begin;
    const size_t count = there < max_bytes ? there : max_bytes;
    if (count > 0) {
        memcpy(out, input->buffer + input->begin, count);
        input->begin += count;
    }
    return count;
}

pspec_status ps_input_read_some(ps_input *input, void *out, size_t max_bytes, size_t *count,
                                ps_error *error) {
    *count = take_buffered(input, out, max_bytes);
    return *count > 0 ? PSPEC_OK : read_source(input, out, max_bytes, count, error);
}

/* Large reads go where they are wanted, small ones through the buffer. */
static pspec_status read_step(ps_input *input, void *out, size_t num_bytes, size_t *count,
                              ps_error *error) {
    if (num_bytes >= BUFFER_BYTES) {
        return read_source(input, out, num_bytes, count, error);
    }
    input->begin = input->end = 0;
    PS_TRY(read_source(input, input->buffer, BUFFER_BYTES, count, error));
    input->end = *count;
    *count = take_buffered(input, out, num_bytes);
    return PSPEC_OK;
}

pspec_status ps_input_read(ps_input *input, void *out, size_t num_bytes, size_t *count,
                           ps_error *error) {
    *count = take_buffered(input, out, num_bytes);
    while (*count < num_bytes) {
        size_t step = 0;
        PS_TRY(read_step(input, (unsigned char *)out + *count, num_bytes - *count, &step, error));
        if (step == 0) {
            break;
        }
        *count += step;
    }
    return PSPEC_OK;
}

/* ---- places in files --------------------------------------------------------------------- */

off_t ps_input_position(const ps_input *input) {
    return lseek(input->descriptor, 0, SEEK_CUR) - (off_t)(input->end - input->begin);
}

bool ps_input_bytes_left(const ps_input *input, uint64_t *num_bytes) {
    struct stat facts;
    const off_t position = input->is_seekable ? ps_input_position(input) : -1;
    if (position < 0 || fstat(input->descriptor, &facts) != 0) {
        return false;
    }
    *num_bytes = facts.st_size > position ? (uint64_t)(facts.st_size - position) : 0;
    return true;
}

pspec_status ps_input_seek(ps_input *input, off_t position, ps_error *error) {
    input->begin = input->end = 0;
    return lseek(input->descriptor, position, SEEK_SET) == position
               ? PSPEC_OK
               : ps_read_fail(input->name, error);
}
