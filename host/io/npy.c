/* The format: "\x93NUMPY", two version bytes, the header's length (2 bytes, 4 from version 2 on,
 * little-endian), a Python dictionary {'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), },
 * the elements. */
#include "io/npy.h"

#include "base/memory.h"
#include "base/text.h"
#include "io/input_file.h"
#include "io/output_file.h"

#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum {
    MAGIC_BYTES = 6,
    HEADER_ALIGNMENT = 64,     /* NumPy pads the header so that the elements are aligned */
    MAX_HEADER_BYTES = 1 << 20 /* plain arrays need 128; a length beyond this is damage */
};
static const char magic[] = "\x93NUMPY";

static bool host_is_little_endian(void) {
    const uint16_t probe = 1;
    unsigned char first = 0;
    memcpy(&first, &probe, 1);
    return first == 1;
}

static pspec_status fail_short(FILE *stream, const char *name, ps_error *error) {
    if (ferror(stream)) {
        return ps_input_fail(name, error);
    }
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s is truncated: it ends inside its NPY %s", name,
                   "header or array");
}

/* ---- the header's dictionary ---- */

static bool accept(const char **at, char expected) {
    *at += strspn(*at, " \t\n");
    const bool found = **at == expected;
    *at += found;
    return found;
}

/* A quoted text; longer ones than fit are not ours, and fail. */
static bool accept_text(const char **at, char *out, size_t out_bytes) {
    const char quote = accept(at, '\'') ? '\'' : accept(at, '"') ? '"' : '\0';
    const char *const end = quote != '\0' ? strchr(*at, quote) : NULL;
    if (end == NULL || (size_t)(end - *at) >= out_bytes) {
        return false;
    }
    memcpy(out, *at, (size_t)(end - *at));
    out[end - *at] = '\0';
    *at = end + 1;
    return true;
}

static bool accept_word(const char **at, const char *word) {
    *at += strspn(*at, " \t\n");
    const bool found = strncmp(*at, word, strlen(word)) == 0;
    *at += found ? strlen(word) : 0;
    return found;
}

static bool accept_extent(const char **at, size_t *extent) {
    *at += strspn(*at, " \t\n");
    char *end = NULL;
    errno = 0;
    const unsigned long long value = strtoull(*at, &end, 10);
    if (**at < '0' || **at > '9' || errno == ERANGE || value > SIZE_MAX) {
        return false;
    }
    *extent = (size_t)value;
    *at = end + (*end == 'L'); /* Python 2 marked long integers */
    return true;
}

static bool accept_shape(const char **at, ps_npy_header *out) {
    if (!accept(at, '(')) {
        return false;
    }
    while (!accept(at, ')')) {
        if (out->rank == PS_NPY_MAX_RANK || !accept_extent(at, &out->shape[out->rank])) {
            return false;
        }
        out->rank++;
        if (!accept(at, ',') && **at != ')') {
            return false;
        }
    }
    return true;
}

static bool accept_type(const char **at, ps_npy_header *out) {
    char type[4] = "";
    if (!accept_text(at, type, sizeof type) || strlen(type) != 3 || type[1] != 'f') {
        return false;
    }
    out->is_little_endian = type[0] == '<' || (type[0] == '=' && host_is_little_endian());
    out->element_bytes = (unsigned)(type[2] - '0');
    return strchr("<>=", type[0]) != NULL &&
           (out->element_bytes == sizeof(float) || out->element_bytes == sizeof(double));
}

static pspec_status fail_header(const char *name, const char *text, ps_error *error) {
    char shown[PS_TOKEN_BYTES];
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s: the NPY header cannot be understood at \"%s\"",
                   name, ps_token_show(shown, text, strlen(text)));
}

static pspec_status parse_entry(const char **at, const char *name, ps_npy_header *out,
                                unsigned *found, ps_error *error) {
    char key[16] = "";
    const char *const start = *at;
    if (!accept_text(at, key, sizeof key) || !accept(at, ':')) {
        return fail_header(name, start, error);
    }
    const char *const value = *at + strspn(*at, " ");
    bool is_good = false;
    if (strcmp(key, "descr") == 0) {
        *found |= 1U;
        if (!accept_type(at, out)) {
            char shown[PS_TOKEN_BYTES];
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s: element type %s cannot be read; float64 and float32 can", name,
                           ps_token_show(shown, value, strcspn(value, ",}")));
        }
        is_good = true;
    } else if (strcmp(key, "fortran_order") == 0) {
        *found |= 2U;
        out->is_fortran_order = accept_word(at, "True");
        is_good = out->is_fortran_order || accept_word(at, "False");
    } else if (strcmp(key, "shape") == 0) {
        *found |= 4U;
        out->rank = 0;
        is_good = accept_shape(at, out);
    }
    return is_good ? PSPEC_OK : fail_header(name, value, error);
}

static pspec_status parse_dictionary(const char *text, const char *name, ps_npy_header *out,
                                     ps_error *error) {
    enum { ALL_FOUND = 7 };
    unsigned found = 0;
    const char *at = text;
    if (!accept(&at, '{')) {
        return fail_header(name, text, error);
    }
    while (!accept(&at, '}')) {
        PS_TRY(parse_entry(&at, name, out, &found, error));
        if (!accept(&at, ',') && *at != '}') {
            return fail_header(name, at, error);
        }
    }
    return found == ALL_FOUND ? PSPEC_OK : fail_header(name, text, error);
}

/* ---- reading ---- */

static pspec_status read_header_text(FILE *stream, const char *name, char **text, ps_error *error) {
    unsigned char start[MAGIC_BYTES + 2];
    unsigned char length_bytes[4] = {0};
    if (fread(start, 1, sizeof start, stream) != sizeof start) {
        return fail_short(stream, name, error);
    }
    const unsigned version = start[MAGIC_BYTES];
    if (memcmp(start, magic, MAGIC_BYTES) != 0 || version < 1 || version > 3) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s is not an NPY file of version 1, 2 or 3",
                       name);
    }
    if (fread(length_bytes, 1, version == 1 ? 2 : 4, stream) != (version == 1 ? 2 : 4)) {
        return fail_short(stream, name, error);
    }
    const size_t length = length_bytes[0] + ((size_t)length_bytes[1] << 8) +
                          ((size_t)length_bytes[2] << 16) + ((size_t)length_bytes[3] << 24);
    if (length > MAX_HEADER_BYTES) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: an NPY header of %zu bytes; at most %d are read", name, length,
                       MAX_HEADER_BYTES);
    }
    void *memory = NULL;
    PS_TRY(ps_allocate(&memory, length + 1, 1, "NPY header", error));
    *text = memory;
    return fread(*text, 1, length, stream) == length ? PSPEC_OK : fail_short(stream, name, error);
}

/* A wrong size is found before memory is asked for. */
static pspec_status check_size(FILE *stream, const char *name, const ps_npy_header *header,
                               ps_error *error) {
    size_t needed = 0;
    if (!ps_size_multiply(header->num_elements, header->element_bytes, &needed)) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: its NPY header promises %zu elements", name,
                       header->num_elements);
    }
    struct stat facts;
    const off_t position = ftello(stream);
    if (position < 0 || fstat(fileno(stream), &facts) != 0 || !S_ISREG(facts.st_mode)) {
        return PSPEC_OK;
    }
    const size_t present = facts.st_size > position ? (size_t)(facts.st_size - position) : 0;
    if (present < needed) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s is truncated: its header promises %zu bytes of data, there are %zu",
                       name, needed, present);
    }
    if (present > needed) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s has %zu bytes after its array; one array per file is read", name,
                       present - needed);
    }
    return PSPEC_OK;
}

pspec_status ps_npy_read_header(FILE *stream, const char *name, ps_npy_header *out,
                                ps_error *error) {
    *out = (ps_npy_header){0};
    char *text = NULL;
    pspec_status status = read_header_text(stream, name, &text, error);
    if (status == PSPEC_OK) {
        status = parse_dictionary(text, name, out, error);
    }
    free(text);
    PS_TRY(status);
    out->num_elements = 1;
    for (unsigned axis = 0; axis < out->rank; axis++) {
        if (!ps_size_multiply(out->num_elements, out->shape[axis], &out->num_elements)) {
            return ps_fail(error, PSPEC_ERROR_INPUT, "%s: the shape in its NPY header is too large",
                           name);
        }
    }
    return check_size(stream, name, out, error);
}

static void swap_bytes(unsigned char *bytes, size_t count, size_t element_bytes) {
    for (size_t i = 0; i < count; i++) {
        unsigned char *const element = bytes + i * element_bytes;
        for (size_t j = 0; j < element_bytes / 2; j++) {
            const unsigned char kept = element[j];
            element[j] = element[element_bytes - 1 - j];
            element[element_bytes - 1 - j] = kept;
        }
    }
}

pspec_status ps_npy_read_elements(FILE *stream, const char *name, const ps_npy_header *header,
                                  double *out, size_t count, ps_error *error) {
    /* float32 is read into the upper half of out; widening from the front never overtakes it. */
    unsigned char *const raw =
        (unsigned char *)out + count * (sizeof(double) - header->element_bytes);
    if (fread(raw, header->element_bytes, count, stream) != count) {
        return fail_short(stream, name, error);
    }
    if (header->is_little_endian != host_is_little_endian()) {
        swap_bytes(raw, count, header->element_bytes);
    }
    if (header->element_bytes == sizeof(float)) {
        for (size_t i = 0; i < count; i++) {
            float narrow = 0;
            memcpy(&narrow, raw + i * sizeof narrow, sizeof narrow);
            const double value = narrow;
            memcpy(out + i, &value, sizeof value);
        }
    }
    return PSPEC_OK;
}

pspec_status ps_npy_check_end(FILE *stream, const char *name, ps_error *error) {
    if (getc(stream) != EOF) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s goes on after its array; one array per input is read", name);
    }
    return ferror(stream) ? ps_input_fail(name, error) : PSPEC_OK;
}

/* ---- writing ---- */

void ps_npy_write_header(FILE *stream, unsigned rank, const size_t *shape) {
    enum { MAX_TEXT = 320, BEFORE_TEXT = MAGIC_BYTES + 4 }; /* 8 extents of 20 digits, and words */
    char text[MAX_TEXT];
    size_t length =
        (size_t)snprintf(text, sizeof text, "{'descr': '%cf8', 'fortran_order': False, 'shape': (",
                         host_is_little_endian() ? '<' : '>');
    for (unsigned axis = 0; axis < rank; axis++) {
        length += (size_t)snprintf(text + length, sizeof text - length,
                                   axis + 1 == rank && rank > 1 ? "%zu" : "%zu,%s", shape[axis],
                                   axis + 1 == rank ? "" : " ");
    }
    length += (size_t)snprintf(text + length, sizeof text - length, "), }");
    while ((BEFORE_TEXT + length + 1) % HEADER_ALIGNMENT != 0) {
        text[length++] = ' ';
    }
    text[length++] = '\n';
    const unsigned char start[] = {1, 0, (unsigned char)(length & 0xff),
                                   (unsigned char)(length >> 8)};
    fwrite(magic, 1, MAGIC_BYTES, stream);
    fwrite(start, 1, sizeof start, stream);
    fwrite(text, 1, length, stream);
}

pspec_status ps_npy_write(const char *path, unsigned rank, const size_t *shape, const double *data,
                          ps_error *error) {
    size_t count = 1;
    for (unsigned axis = 0; axis < rank; axis++) {
        if (!ps_size_multiply(count, shape[axis], &count)) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: the array is too large", path);
        }
    }
    ps_output_file *file = NULL;
    PS_TRY(ps_output_open(&file, path, error));
    ps_npy_write_header(ps_output_stream(file), rank, shape);
    ps_output_write(file, data, sizeof *data, count);
    return ps_output_commit(&file, error);
}
