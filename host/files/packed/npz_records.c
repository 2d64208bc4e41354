#include "files/packed/npz_records.h"

#include "base/memory.h"
#include "files/bytes.h"

#include <stdio.h>
#include <string.h>

enum {
    VERSION = 20,           /* of the format, 2.0, */
    VERSION_64 = 45,        /* and with ZIP64 */
    FIRST_DAY = 1 << 5 | 1, /* January 1, 1980, as MS-DOS counts */
    BOTH_SIZES = 16,        /* bytes of them there */
    MOST_PUT = 10,          /* bytes of a number, or of several that are 0 */
    END64_BYTES = 44        /* of the record of the large directory, behind its size */
};

static const char ending[] = PS_NPZ_ENDING;

/* ---- records ------------------------------------------------------------------------------- */

static void put(ps_text *out, uint64_t value, unsigned num_bytes) {
    char bytes[MOST_PUT];
    ps_bytes_put(bytes, value, num_bytes);
    ps_text_append_bytes(out, bytes, num_bytes);
}

static bool is_large(const ps_npz_records *records, uint64_t value) {
    return value >= records->limit;
}

static uint64_t here(const ps_npz_records *records, uint64_t value) {
    return is_large(records, value) ? PS_ZIP_NOT_HERE : value;
}

/* From the version that reads it to the number of bytes of the extra field. */
static void put_facts(ps_text *out, const ps_npz_records *records, const ps_npz_member *one,
                      size_t extra_bytes) {
    put(out, extra_bytes > 0 ? VERSION_64 : VERSION, 2);
    put(out, 0, 2); /* no flags */
    put(out, PS_ZIP_STORED, 2);
    put(out, 0, 2); /* midnight */
    put(out, FIRST_DAY, 2);
    put(out, one->crc, 4);
    put(out, here(records, one->size), 4); /* compressed */
    put(out, here(records, one->size), 4);
    put(out, one->name_bytes + sizeof ending - 1, 2);
    put(out, extra_bytes > 0 ? extra_bytes + 4 : 0, 2);
}

static void put_name(ps_text *out, const ps_npz_member *one) {
    ps_text_append_bytes(out, one->name, one->name_bytes);
    ps_text_append(out, "%s", ending);
}

/* Those that are not in their fields, in this order: both sizes, the offset. */
static void put_extra(ps_text *out, const ps_npz_records *records, const ps_npz_member *one,
                      bool has_offset, size_t num_bytes) {
    if (num_bytes > 0) {
        put(out, PS_ZIP_EXTRA_64, 2);
        put(out, num_bytes, 2);
    }
    if (is_large(records, one->size)) {
        put(out, one->size, 8);
        put(out, one->size, 8);
    }
    if (has_offset) {
        put(out, records->position, 8);
    }
}

static void put_local(ps_text *out, const ps_npz_records *records, const ps_npz_member *one) {
    const size_t extra = is_large(records, one->size) ? BOTH_SIZES : 0;
    ps_text_append(out, "PK\3\4");
    put_facts(out, records, one, extra);
    put_name(out, one);
    put_extra(out, records, one, false, extra);
}

static void put_entry(ps_text *out, const ps_npz_records *records, const ps_npz_member *one) {
    const bool has_offset = is_large(records, records->position);
    const size_t extra = (is_large(records, one->size) ? BOTH_SIZES : 0U) + (has_offset ? 8U : 0U);
    ps_text_append(out, "PK\1\2");
    put(out, VERSION_64, 2); /* that wrote it */
    put_facts(out, records, one, extra);
    put(out, 0, 2 + 2 + 2 + 4); /* no comment, the first disk, no attributes */
    put(out, here(records, records->position), 4);
    put_name(out, one);
    put_extra(out, records, one, has_offset, extra);
}

void ps_npz_put_member(ps_text *local, ps_npz_records *records, const ps_npz_member *one) {
    put_local(local, records, one);
    put_entry(&records->directory, records, one);
    records->num_members++;
}

void ps_npz_put_end(ps_text *out, const ps_npz_records *records, uint64_t bytes) {
    const uint64_t start = records->position - bytes;
    if (is_large(records, start) || is_large(records, bytes)) {
        ps_text_append(out, "PK\6\6");
        put(out, END64_BYTES, 8);
        put(out, VERSION_64, 2);
        put(out, VERSION_64, 2);
        put(out, 0, 4 + 4); /* the only disk */
        put(out, records->num_members, 8);
        put(out, records->num_members, 8);
        put(out, bytes, 8);
        put(out, start, 8);
        ps_text_append(out, "PK\6\7");
        put(out, 0, 4);
        put(out, records->position, 8); /* of the record above */
        put(out, 1, 4);
    }
    ps_text_append(out, "PK\5\6");
    put(out, 0, 2 + 2);
    put(out, records->num_members, 2);
    put(out, records->num_members, 2);
    put(out, here(records, bytes), 4);
    put(out, here(records, start), 4);
    put(out, 0, 2);
}

/* ---- arrays -------------------------------------------------------------------------------- */

bool ps_npz_count_bytes(const ps_npz_array *array, size_t *bytes) {
    bool fits = true;
    *bytes = array->element_bytes;
    for (unsigned axis = 0; axis < array->rank; axis++) {
        fits = fits && ps_size_multiply(*bytes, array->shape[axis], bytes);
    }
    return fits;
}

size_t ps_npz_make_header(char header[PS_NPY_HEADER_BYTES], const ps_npz_array *array) {
    char element[24];
    snprintf(element, sizeof element, "%c%zu", array->kind,
             array->kind == 'U' ? array->element_bytes / sizeof(uint32_t) : array->element_bytes);
    return ps_npy_make_header(header, element, array->rank, array->shape);
}
