/* What an NPZ file has besides its arrays: a record before each and, behind the last, a directory
 * (APPNOTE.TXT 6.3). One who reads makes them again and compares. Private to host/files/packed. */
#ifndef PS_FILES_PACKED_NPZ_RECORDS_H
#define PS_FILES_PACKED_NPZ_RECORDS_H

#include "base/text.h"
#include "files/npy.h"
#include "files/packed/npz.h"

/* {.limit} at the beginning. */
typedef struct ps_npz_records {
    uint64_t limit;     /* sizes and places from here on stand in fields of ZIP64 */
    uint64_t position;  /* bytes so far, which the caller counts */
    ps_text directory;  /* its records so far */
    size_t num_members; /* at most a few hundred */
} ps_npz_records;

#define PS_NPZ_ENDING ".npy"
typedef struct ps_npz_member {
    const char *name; /* without its ending, and without a NUL behind it */
    size_t name_bytes;
    uint32_t crc;
    uint64_t size;
} ps_npz_member;

enum {
    PS_ZIP_LOCAL_BYTES = 30, /* of the record before a member, without its name; places in it */
    PS_ZIP_LOCAL_METHOD = 8,
    PS_ZIP_LOCAL_CRC = 14,
    PS_ZIP_LOCAL_SIZE = 22,
    PS_ZIP_LOCAL_NAME_BYTES = 26,
    PS_ZIP_LOCAL_EXTRA_BYTES = 28,
    PS_ZIP_EXTRA_BYTES = 20, /* behind the name where the size is in ZIP64; it stands there: */
    PS_ZIP_EXTRA_SIZE = 4,
    PS_ZIP_EXTRA_64 = 1, /* the kind of a field of ZIP64 */
    PS_ZIP_STORED = 0    /* the method of what is not compressed */
};
#define PS_ZIP_NOT_HERE UINT32_MAX /* the value stands in such a field */

/* The record before the member, which comes at records->position, to local; the other to the
 * directory. */
void ps_npz_put_member(ps_text *local, ps_npz_records *records, const ps_npz_member *one);
/* What ends the file, behind `bytes` of directory that end at records->position. */
void ps_npz_put_end(ps_text *out, const ps_npz_records *records, uint64_t bytes);

/* What stands before the data in a member. Returns how many bytes it has. */
size_t ps_npz_make_header(char header[PS_NPY_HEADER_BYTES], const ps_npz_array *array);
/* Of the data; false: more than memory could hold. */
bool ps_npz_count_bytes(const ps_npz_array *array, size_t *bytes);

#endif
