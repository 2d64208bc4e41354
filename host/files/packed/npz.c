#include "files/packed/npz.h"

#include "base/memory.h"
#include "base/text.h"
#include "files/npy.h"
#include "files/output_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* APPNOTE.TXT 6.3. */
enum {
    VERSION = 20,    /* of the format, 2.0, */
    VERSION_64 = 45, /* and with ZIP64 */
    STORED = 0,
    FIRST_DAY = 1 << 5 | 1, /* January 1, 1980, as MS-DOS counts */
    EXTRA_ZIP64 = 1,
    BOTH_SIZES = 16, /* bytes of them there */
    END64_BYTES = 44 /* of the record of the large directory, behind its size */
};
#define NOT_HERE UINT32_MAX /* the value stands in a ZIP64 field */

struct ps_npz {
    ps_output_file *file;
    uint64_t limit;
    uint64_t position;  /* bytes written */
    ps_text directory;  /* its records so far */
    size_t num_members; /* at most a few hundred */
};

/* What the record before a member and that of the directory say of it. */
static const char ending[] = ".npy";
typedef struct member {
    const char *name; /* without its ending */
    uint32_t crc;
    uint64_t size, offset;
} member;

/* ---- records ------------------------------------------------------------------------------- */

/* The lowest byte first. */
static void put(ps_text *out, uint64_t value, unsigned num_bytes) {
    for (; num_bytes > 0; num_bytes--, value >>= 8) {
        const char byte = (char)(unsigned char)(value & 0xff);
        ps_text_append_bytes(out, &byte, 1);
    }
}

static bool is_large(const ps_npz *npz, uint64_t value) {
    return value >= npz->limit;
}

static uint64_t here(const ps_npz *npz, uint64_t value) {
    return is_large(npz, value) ? NOT_HERE : value;
}

/* From the version that reads it to the number of bytes of the extra field. */
static void put_facts(ps_text *out, const ps_npz *npz, const member *one, size_t extra_bytes) {
    put(out, extra_bytes > 0 ? VERSION_64 : VERSION, 2);
    put(out, 0, 2); /* no flags */
    put(out, STORED, 2);
    put(out, 0, 2); /* midnight */
    put(out, FIRST_DAY, 2);
    put(out, one->crc, 4);
    put(out, here(npz, one->size), 4); /* compressed */
    put(out, here(npz, one->size), 4);
    put(out, strlen(one->name) + sizeof ending - 1, 2);
    put(out, extra_bytes > 0 ? extra_bytes + 4 : 0, 2);
}

/* Those that are not in their fields, in this order: both sizes, the offset. */
static void put_extra(ps_text *out, const ps_npz *npz, const member *one, bool has_offset,
                      size_t num_bytes) {
    if (num_bytes > 0) {
        put(out, EXTRA_ZIP64, 2);
        put(out, num_bytes, 2);
    }
    if (is_large(npz, one->size)) {
        put(out, one->size, 8);
        put(out, one->size, 8);
    }
    if (has_offset) {
        put(out, one->offset, 8);
    }
}

static void put_local(ps_text *out, const ps_npz *npz, const member *one) {
    const size_t extra = is_large(npz, one->size) ? BOTH_SIZES : 0;
    ps_text_append(out, "PK\3\4");
    put_facts(out, npz, one, extra);
    ps_text_append(out, "%s%s", one->name, ending);
    put_extra(out, npz, one, false, extra);
}

static void put_entry(ps_text *out, const ps_npz *npz, const member *one) {
    const bool has_offset = is_large(npz, one->offset);
    const size_t extra = (is_large(npz, one->size) ? BOTH_SIZES : 0U) + (has_offset ? 8U : 0U);
    ps_text_append(out, "PK\1\2");
    put(out, VERSION_64, 2); /* that wrote it */
    put_facts(out, npz, one, extra);
    put(out, 0, 2 + 2 + 2 + 4); /* no comment, the first disk, no attributes */
    put(out, here(npz, one->offset), 4);
    ps_text_append(out, "%s%s", one->name, ending);
    put_extra(out, npz, one, has_offset, extra);
}

/* What ends the file: where the directory is, of which `bytes` have been written. */
static void put_end(ps_text *out, const ps_npz *npz, uint64_t bytes) {
    const uint64_t start = npz->position - bytes;
    if (is_large(npz, start) || is_large(npz, bytes)) {
        ps_text_append(out, "PK\6\6");
        put(out, END64_BYTES, 8);
        put(out, VERSION_64, 2);
        put(out, VERSION_64, 2);
        put(out, 0, 4 + 4); /* the only disk */
        put(out, npz->num_members, 8);
        put(out, npz->num_members, 8);
        put(out, bytes, 8);
        put(out, start, 8);
        ps_text_append(out, "PK\6\7");
        put(out, 0, 4);
        put(out, npz->position, 8); /* of the record above */
        put(out, 1, 4);
    }
    ps_text_append(out, "PK\5\6");
    put(out, 0, 2 + 2);
    put(out, npz->num_members, 2);
    put(out, npz->num_members, 2);
    put(out, here(npz, bytes), 4);
    put(out, here(npz, start), 4);
    put(out, 0, 2);
}

/* ---- writing ------------------------------------------------------------------------------- */

static void write_bytes(ps_npz *npz, const void *bytes, size_t num) {
    ps_output_write(npz->file, bytes, 1, num);
    npz->position += num;
}

/* The text is emptied. */
static pspec_status write_records(ps_npz *npz, ps_text *records, ps_error *error) {
    const pspec_status status = ps_text_check(records, error);
    if (status == PSPEC_OK) {
        write_bytes(npz, ps_text_string(records), records->length);
    }
    ps_text_free(records);
    return status;
}

pspec_status ps_npz_open(ps_npz **out, const char *path, uint64_t limit, ps_error *error) {
    ps_npz *npz = NULL;
    PS_TRY(PS_NEW(&npz, 1, "an archive", error));
    npz->limit = limit;
    const pspec_status status = ps_output_open(&npz->file, path, error);
    if (status != PSPEC_OK) {
        ps_npz_discard(&npz);
    }
    *out = npz;
    return status;
}

/* Sizes are known to be those of memory that there is. */
static size_t count_bytes(const ps_npz_array *array) {
    size_t bytes = array->element_bytes;
    for (unsigned axis = 0; axis < array->rank; axis++) {
        bytes *= array->shape[axis];
    }
    return bytes;
}

static size_t make_header(char header[PS_NPY_HEADER_BYTES], const ps_npz_array *array) {
    char element[24];
    snprintf(element, sizeof element, "%c%zu", array->kind,
             array->kind == 'U' ? array->element_bytes / sizeof(uint32_t) : array->element_bytes);
    return ps_npy_make_header(header, element, array->rank, array->shape);
}

pspec_status ps_npz_add(ps_npz *npz, const ps_npz_array *array, ps_error *error) {
    char header[PS_NPY_HEADER_BYTES];
    ps_text local = {0};
    const size_t header_bytes = make_header(header, array);
    const size_t bytes = count_bytes(array);
    const uLong crc = crc32_z(crc32_z(0, NULL, 0), (const Bytef *)header, header_bytes);
    const member one = {.name = array->name,
                        .crc = (uint32_t)crc32_z(crc, array->data, bytes),
                        .size = (uint64_t)header_bytes + bytes,
                        .offset = npz->position};
    put_local(&local, npz, &one);
    put_entry(&npz->directory, npz, &one);
    npz->num_members++;
    PS_TRY(write_records(npz, &local, error));
    write_bytes(npz, header, header_bytes);
    write_bytes(npz, array->data, bytes);
    return ps_output_check(npz->file, error);
}

pspec_status ps_npz_commit(ps_npz **npz, ps_error *error) {
    ps_npz *const self = *npz;
    ps_text end = {0};
    const uint64_t directory_bytes = self->directory.length;
    pspec_status status = write_records(self, &self->directory, error);
    if (status == PSPEC_OK) {
        put_end(&end, self, directory_bytes);
        status = write_records(self, &end, error);
    }
    if (status == PSPEC_OK) {
        status = ps_output_commit(&self->file, error);
    }
    ps_npz_discard(npz);
    return status;
}

void ps_npz_discard(ps_npz **npz) {
    if (*npz != NULL) {
        ps_output_discard(&(*npz)->file);
        ps_text_free(&(*npz)->directory);
        free(*npz);
        *npz = NULL;
    }
}
