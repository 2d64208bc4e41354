/* The format: "\x93NUMPY", two version bytes, the header's length (2 bytes, 4 from version 2 on,
 * little-endian), a Python dictionary {'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), },
 * the elements. */
#include "files/npy.h"

#include "base/memory.h"
#include "base/text.h"
#include "files/bytes.h"
#include "files/text_lines.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum {
    MAGIC_BYTES = 6,
    HEADER_ALIGNMENT = 64,     /* NumPy pads the header so that the elements are aligned */
    MAX_HEADER_BYTES = 1 << 20 /* plain arrays need 128; a length beyond this is damage */
};
static const char magic[] = "\x93NUMPY";

static pspec_status fail_short(const ps_input *input, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "%s is truncated: it ends inside its NPY header or array", input->name);
}

/* Exactly num_bytes. */
static pspec_status read_exactly(ps_input *input, void *out, size_t num_bytes, ps_error *error) {
    size_t count = 0;
    PS_TRY(ps_input_read(input, out, num_bytes, &count, error));
    return count == num_bytes ? PSPEC_OK : fail_short(input, error);
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

/* "<f8": byte order, kind, bytes. "<c16" is two floats of half the bytes. */
static bool accept_type(const char **at, ps_npy_header *out) {
    char type[5] = "";
    static const char kinds[] = {
        [PS_ELEMENT_FLOAT] = 'f', [PS_ELEMENT_SIGNED] = 'i', [PS_ELEMENT_UNSIGNED] = 'u'};
    if (!accept_text(at, type, sizeof type)) {
        return false;
    }
    out->is_complex = strcmp(type + 1, "c8") == 0 || strcmp(type + 1, "c16") == 0;
    if (out->is_complex) {
        memcpy(type + 1, type[2] == '8' ? "f4" : "f8", sizeof "f8");
    }
    if (strlen(type) != 3 || memchr(kinds, type[1], sizeof kinds) == NULL) {
        return false;
    }
    const bool is_float = type[1] == 'f';
    out->type.kind = (ps_element_kind)((const char *)memchr(kinds, type[1], sizeof kinds) - kinds);
    out->type.is_big_endian =
        type[0] == '>' || (strchr("=|", type[0]) != NULL && ps_host_is_big_endian());
    out->type.num_bytes = (unsigned)(type[2] - '0');
    return strchr("<>=|", type[0]) != NULL && strchr(is_float ? "248" : "1248", type[2]) != NULL;
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
        if (!accept_type(at, out) || (out->is_complex && !out->may_be_complex)) {
            char shown[PS_TOKEN_BYTES];
            return ps_fail(
                error, PSPEC_ERROR_INPUT,
                "%s: element type %s cannot be read; float16 to float64%s and whole numbers can",
                name, ps_token_show(shown, value, strcspn(value, ",}")),
                out->may_be_complex ? ", complex" : "");
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

pspec_status ps_npy_is_next(ps_input *input, bool *is_next, ps_error *error) {
    const unsigned char *bytes = NULL;
    size_t num = 0;
    PS_TRY(ps_input_peek(input, 1, &bytes, &num, error));
    *is_next = num > 0 && bytes[0] == (unsigned char)magic[0];
    return PSPEC_OK;
}

static pspec_status read_header_text(ps_input *input, char **text, ps_error *error) {
    unsigned char start[MAGIC_BYTES + 2];
    unsigned char length_bytes[4] = {0};
    PS_TRY(read_exactly(input, start, sizeof start, error));
    const unsigned version = start[MAGIC_BYTES];
    if (memcmp(start, magic, MAGIC_BYTES) != 0 || version < 1 || version > 3) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s is not an NPY file of version 1, 2 or 3",
                       input->name);
    }
    PS_TRY(read_exactly(input, length_bytes, version == 1 ? 2 : 4, error));
    const size_t length = (size_t)ps_bytes_number(length_bytes, sizeof length_bytes);
    if (length > MAX_HEADER_BYTES) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: an NPY header of %zu bytes; at most %d are read", input->name, length,
                       MAX_HEADER_BYTES);
    }
    PS_TRY(PS_NEW(text, length + 1, "NPY header", error));
    return read_exactly(input, *text, length, error);
}

/* A wrong size is found before memory is asked for. */
static pspec_status check_size(const ps_input *input, const ps_npy_header *header,
                               ps_error *error) {
    size_t needed = 0;
    uint64_t present = 0;
    const size_t element_bytes = header->type.num_bytes * (header->is_complex ? 2U : 1U);
    if (!ps_size_multiply(header->num_elements, element_bytes, &needed)) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: its NPY header promises %zu elements",
                       input->name, header->num_elements);
    }
    if (!ps_input_bytes_left(input, &present)) {
        return PSPEC_OK;
    }
    if (present < needed) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s is truncated: its header promises %zu bytes of data, there are %llu",
                       input->name, needed, (unsigned long long)present);
    }
    if (present > needed) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s has %llu bytes after its array; one array per file is read", input->name,
                       (unsigned long long)(present - needed));
    }
    return PSPEC_OK;
}

pspec_status ps_npy_read_header(ps_input *input, ps_npy_header *out, bool may_be_complex,
                                ps_error *error) {
    *out = (ps_npy_header){.may_be_complex = may_be_complex};
    char *text = NULL;
    pspec_status status = read_header_text(input, &text, error);
    if (status == PSPEC_OK) {
        status = parse_dictionary(text, input->name, out, error);
    }
    free(text);
    PS_TRY(status);
    out->num_elements = 1;
    for (unsigned axis = 0; axis < out->rank; axis++) {
        if (!ps_size_multiply(out->num_elements, out->shape[axis], &out->num_elements)) {
            return ps_fail(error, PSPEC_ERROR_INPUT, "%s: the shape in its NPY header is too large",
                           input->name);
        }
    }
    return check_size(input, out, error);
}

pspec_status ps_npy_read_elements(ps_input *input, const ps_npy_header *header, double *out,
                                  size_t count, ps_error *error) {
    size_t num_read = 0;
    PS_TRY(ps_elements_read(input, header->type, out, count, &num_read, error));
    return num_read == count ? PSPEC_OK : fail_short(input, error);
}

pspec_status ps_npy_check_end(ps_input *input, ps_error *error) {
    const unsigned char *bytes = NULL;
    size_t count = 0;
    PS_TRY(ps_input_peek(input, 1, &bytes, &count, error));
    return count == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "%s goes on after its array; one array per input is read", input->name);
}

/* ---- writing ---- */

size_t ps_npy_make_header(char out[PS_NPY_HEADER_BYTES], const char *element, unsigned rank,
                          const size_t *shape) {
    enum { BEFORE_TEXT = MAGIC_BYTES + 4, MOST_TEXT = PS_NPY_HEADER_BYTES - BEFORE_TEXT };
    char *const text = out + BEFORE_TEXT;
    size_t length =
        (size_t)snprintf(text, MOST_TEXT, "{'descr': '%c%s', 'fortran_order': False, 'shape': (",
                         ps_host_is_big_endian() ? '>' : '<', element);
    for (unsigned axis = 0; axis < rank; axis++) {
        length += (size_t)snprintf(text + length, MOST_TEXT - length,
                                   axis + 1 == rank && rank > 1 ? "%zu" : "%zu,%s", shape[axis],
                                   axis + 1 == rank ? "" : " ");
    }
    length += (size_t)snprintf(text + length, MOST_TEXT - length, "), }");
    while ((BEFORE_TEXT + length + 1) % HEADER_ALIGNMENT != 0) {
        text[length++] = ' ';
    }
    text[length++] = '\n';
    memcpy(out, magic, MAGIC_BYTES);
    memcpy(out + MAGIC_BYTES, (const char[]){1, 0}, 2);
    ps_bytes_put(out + MAGIC_BYTES + 2, length, 2);
    return BEFORE_TEXT + length;
}

void ps_npy_write_header(ps_output_file *file, const char *element, unsigned rank,
                         const size_t *shape) {
    char header[PS_NPY_HEADER_BYTES];
    ps_output_write(file, header, 1, ps_npy_make_header(header, element, rank, shape));
}

pspec_status ps_npy_check_name(const char *option, const char *path, ps_error *error) {
    static const char ending[] = ".npy";
    return ps_text_ends_in(path, ending)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s writes NPY: \"%s\" does not end in %s", option, path, ending);
}
