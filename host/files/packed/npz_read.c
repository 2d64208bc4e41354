/* NPZ files that pointspec wrote, read back. Sizes, names and checksums are taken from the records
 * before arrays; all the rest of the file is made again from them, and must be what is there. */
#include "base/memory.h"
#include "files/bytes.h"
#include "files/descriptor.h"
#include "files/packed/npz_records.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <xxhash.h>

typedef struct stored {
    ps_npz_array array;
    size_t name_bytes, shape[PS_NPY_MAX_RANK];
} stored;

struct ps_npz_file {
    char *name, *bytes; /* of the file */
    size_t num_bytes;
    stored *arrays;
    size_t num, capacity;
};

static pspec_status fail_npz(const ps_npz_file *file, const char *what, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT, "\"%s\" %s", file->name, what);
}

static pspec_status fail_at(const ps_npz_file *file, uint64_t position, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "\"%s\" is no NPZ file of pointspec, or damaged or cut off: it has other bytes "
                   "than pointspec writes from byte %llu on",
                   file->name, (unsigned long long)position + 1);
}

/* These bytes stand there; the text is emptied. */
static pspec_status need(const ps_npz_file *file, uint64_t position, ps_text *bytes,
                         ps_error *error) {
    pspec_status status = ps_text_check(bytes, error);
    if (status == PSPEC_OK &&
        (file->num_bytes - position < bytes->length ||
         memcmp(file->bytes + position, ps_text_string(bytes), bytes->length) != 0)) {
        status = fail_at(file, position, error);
    }
    ps_text_free(bytes);
    return status;
}

/* ---- arrays -------------------------------------------------------------------------------- */

static bool is_known(const ps_npz_array *array) {
    const size_t bytes = array->element_bytes;
    return array->kind == 'c'   ? bytes == 2 * sizeof(double)
           : array->kind == 'u' ? bytes == 1
           : array->kind == 'U'
               ? bytes > 0
               : (array->kind == 'f' || array->kind == 'i') && bytes == sizeof(double);
}

static void take_shape(stored *out, const char *at) {
    while (*at >= '0' && *at <= '9' && out->array.rank < PS_NPY_MAX_RANK) {
        char *end = NULL;
        out->shape[out->array.rank++] = (size_t)strtoull(at, &end, 10);
        at = end + strspn(end, ", ");
    }
}

/* What the header says, as far as it can be understood. */
static bool take_header(stored *out, const char *bytes, size_t num) {
    enum { BEFORE_TEXT = 10, BEHIND = 4 };
    static const char type[] = "{'descr': '<";
    static const char shape[] = "'shape': (";
    char header[PS_NPY_HEADER_BYTES + BEHIND] = "";
    ps_npz_array *const array = &out->array;
    memcpy(header, bytes, num < PS_NPY_HEADER_BYTES ? num : PS_NPY_HEADER_BYTES);
    const char *const text = header + BEFORE_TEXT;
    const char *const sizes = strstr(text, shape);
    if (sizes == NULL || strlen(text) < sizeof type) {
        return false;
    }
    array->kind = text[sizeof type - 1];
    array->element_bytes = (size_t)strtoull(text + sizeof type, NULL, 10);
    take_shape(out, sizes + sizeof shape - 1);
    const size_t letter = array->kind == 'U' ? sizeof(uint32_t) : 1;
    return ps_size_multiply(array->element_bytes, letter, &array->element_bytes) && is_known(array);
}

/* The array that these bytes are, and no others. */
static bool take_array(stored *out, const char *bytes, size_t num) {
    char header[PS_NPY_HEADER_BYTES];
    size_t data_bytes = 0;
    ps_npz_array *const array = &out->array;
    array->shape = out->shape;
    if (!take_header(out, bytes, num) || !ps_npz_count_bytes(array, &data_bytes)) {
        return false;
    }
    const size_t header_bytes = ps_npz_make_header(header, array);
    array->data = bytes + header_bytes;
    return num >= header_bytes && num - header_bytes == data_bytes &&
           memcmp(bytes, header, header_bytes) == 0;
}

/* ---- records ------------------------------------------------------------------------------- */

/* What the record there says, as far as it is in the file. */
static bool take_record(ps_npz_member *out, const ps_npz_file *file, uint64_t position) {
    const size_t ending = strlen(PS_NPZ_ENDING);
    const char *const local = file->bytes + position;
    const uint64_t left = file->num_bytes - position;
    if (left < PS_ZIP_LOCAL_BYTES) {
        return false;
    }
    const size_t name_bytes = (size_t)ps_bytes_number(local + PS_ZIP_LOCAL_NAME_BYTES, 2);
    const size_t extra_bytes = (size_t)ps_bytes_number(local + PS_ZIP_LOCAL_EXTRA_BYTES, 2);
    const char *const extra = local + PS_ZIP_LOCAL_BYTES + name_bytes;
    if (left - PS_ZIP_LOCAL_BYTES < name_bytes + extra_bytes || name_bytes <= ending) {
        return false;
    }
    *out = (ps_npz_member){.name = local + PS_ZIP_LOCAL_BYTES,
                           .name_bytes = name_bytes - ending,
                           .crc = (uint32_t)ps_bytes_number(local + PS_ZIP_LOCAL_CRC, 4),
                           .size = extra_bytes == PS_ZIP_EXTRA_BYTES
                                       ? ps_bytes_number(extra + PS_ZIP_EXTRA_SIZE, 8)
                                       : ps_bytes_number(local + PS_ZIP_LOCAL_SIZE, 4)};
    return memchr(out->name, '\0', out->name_bytes) == NULL;
}

/* The member where those end whose records were made so far. */
static pspec_status take_member(ps_npz_file *file, ps_npz_records *made, ps_error *error) {
    const uint64_t position = made->position;
    ps_npz_member one;
    ps_text local = {0};
    void *memory = file->arrays;
    if (!take_record(&one, file, position)) {
        return fail_at(file, position, error);
    }
    if (ps_bytes_number(file->bytes + position + PS_ZIP_LOCAL_METHOD, 2) != PS_ZIP_STORED) {
        return fail_npz(file, "is compressed, and pointspec reads NPZ files that it wrote", error);
    }
    PS_TRY(ps_grow(&memory, &file->capacity, file->num + 1, sizeof *file->arrays, "arrays", error));
    file->arrays = memory;
    stored *const entry = &file->arrays[file->num++];
    *entry = (stored){.array.name = one.name, .name_bytes = one.name_bytes};
    ps_npz_put_member(&local, made, &one);
    const uint64_t data = position + local.length;
    made->position = data + one.size;
    PS_TRY(need(file, position, &local, error));
    return one.size <= file->num_bytes - data &&
                   take_array(entry, file->bytes + data, (size_t)one.size)
               ? PSPEC_OK
               : fail_at(file, data, error);
}

/* The directory, and what ends the file. */
static pspec_status take_end(const ps_npz_file *file, ps_npz_records *made, ps_error *error) {
    ps_text end = {0};
    const uint64_t bytes = made->directory.length;
    PS_TRY(need(file, made->position, &made->directory, error));
    made->position += bytes;
    ps_npz_put_end(&end, made, bytes);
    made->position += end.length;
    PS_TRY(need(file, made->position - end.length, &end, error));
    return made->position == file->num_bytes ? PSPEC_OK : fail_at(file, made->position, error);
}

static bool has_next(const ps_npz_file *file, const ps_npz_records *made) {
    static const char begin[] = "PK\3\4";
    const size_t num = sizeof begin - 1;
    return file->num_bytes - made->position >= num &&
           memcmp(file->bytes + made->position, begin, num) == 0;
}

static pspec_status take_members(ps_npz_file *file, ps_npz_records *made, uint64_t *last,
                                 ps_error *error) {
    while (has_next(file, made)) {
        *last = made->position;
        PS_TRY(take_member(file, made, error));
    }
    return take_end(file, made, error);
}

/* ---- the file ------------------------------------------------------------------------------ */

/* Points to what does not move any more, and ends names. */
static void finish(ps_npz_file *file) {
    for (size_t i = 0; i < file->num; i++) {
        stored *const entry = &file->arrays[i];
        entry->array.shape = entry->shape;
        file->bytes[entry->array.name - file->bytes + (ptrdiff_t)entry->name_bytes] = '\0';
    }
}

static pspec_status take_all(ps_npz_file *file, uint64_t limit, ps_error *error) {
    ps_npz_records made = {.limit = limit};
    uint64_t last = 0;
    const pspec_status status = take_members(file, &made, &last, error);
    ps_text_free(&made.directory);
    PS_TRY(status);
    const XXH128_hash_t digest = XXH3_128bits(file->bytes, (size_t)last);
    finish(file);
    const ps_npz_array *const found = ps_npz_find(file, PS_NPZ_DIGEST);
    return found != NULL && found == &file->arrays[file->num - 1].array && found->rank == 1 &&
                   found->shape[0] * found->element_bytes == sizeof digest &&
                   memcmp(found->data, &digest, sizeof digest) == 0
               ? PSPEC_OK
               : fail_npz(file, "is no NPZ file of pointspec, or damaged: its digest is another",
                          error);
}

/* What is no archive costs no memory. */
static pspec_status read_bytes(ps_npz_file *file, int descriptor, ps_error *error) {
    struct stat facts;
    char magic[2];
    size_t count = 0;
    if (fstat(descriptor, &facts) != 0) {
        return ps_read_fail(file->name, error);
    }
    const size_t num = S_ISREG(facts.st_mode) ? (size_t)facts.st_size : 0;
    if (num > sizeof magic) {
        PS_TRY(ps_descriptor_read(descriptor, file->name, magic, sizeof magic, &count, error));
    }
    if (count < sizeof magic || memcmp(magic, "PK", sizeof magic) != 0) {
        return fail_npz(file, "is no NPZ file", error);
    }
    PS_TRY(PS_NEW(&file->bytes, num, "an NPZ file", error));
    memcpy(file->bytes, magic, sizeof magic);
    file->num_bytes = sizeof magic;
    while (count > 0 && file->num_bytes < num) {
        PS_TRY(ps_descriptor_read(descriptor, file->name, file->bytes + file->num_bytes,
                                  num - file->num_bytes, &count, error));
        file->num_bytes += count;
    }
    return PSPEC_OK;
}

pspec_status ps_npz_read(ps_npz_file **out, int descriptor, const char *name, uint64_t limit,
                         ps_error *error) {
    ps_npz_file *file = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&file, 1, "an NPZ file", error));
    file->name = strdup(name);
    pspec_status status = file->name != NULL
                              ? read_bytes(file, descriptor, error)
                              : ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for a name");
    if (status == PSPEC_OK) {
        status = take_all(file, limit, error);
    }
    if (status != PSPEC_OK) {
        ps_npz_free(file);
        return status;
    }
    *out = file;
    return PSPEC_OK;
}

const char *ps_npz_name(const ps_npz_file *file) {
    return file->name;
}

const ps_npz_array *ps_npz_find(const ps_npz_file *file, const char *name) {
    size_t i = 0;
    while (i < file->num && strcmp(file->arrays[i].array.name, name) != 0) {
        i++;
    }
    return i < file->num ? &file->arrays[i].array : NULL;
}

void ps_npz_free(ps_npz_file *file) {
    if (file != NULL) {
        free(file->arrays);
        free(file->bytes);
        free(file->name);
        free(file);
    }
}
