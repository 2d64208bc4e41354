#include "files/packed/npz.h"

#include "base/memory.h"
#include "files/output_file.h"
#include "files/packed/npz_records.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>
#include <zlib.h>

struct ps_npz {
    ps_output_file *file;
    XXH3_state_t *digest; /* of all bytes written */
    ps_npz_records records;
    bool is_ended;
};

static void write_bytes(ps_npz *npz, const void *bytes, size_t num) {
    ps_output_write(npz->file, bytes, 1, num);
    XXH3_128bits_update(npz->digest, bytes, num);
    npz->records.position += num;
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

/* path NULL: to the stream. */
static pspec_status open_all(ps_npz *npz, const char *path, FILE *stream, ps_error *error) {
    npz->digest = XXH3_createState();
    if (npz->digest == NULL) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for a digest");
    }
    XXH3_128bits_reset(npz->digest);
    return path != NULL ? ps_output_open(&npz->file, path, error)
                        : ps_output_open_stream(&npz->file, stream, error);
}

static pspec_status open_one(ps_npz **out, const char *path, FILE *stream, uint64_t limit,
                             ps_error *error) {
    ps_npz *npz = NULL;
    PS_TRY(PS_NEW(&npz, 1, "an archive", error));
    npz->records.limit = limit;
    const pspec_status status = open_all(npz, path, stream, error);
    if (status != PSPEC_OK) {
        ps_npz_discard(&npz);
    }
    *out = npz;
    return status;
}

pspec_status ps_npz_open(ps_npz **out, const char *path, uint64_t limit, ps_error *error) {
    return open_one(out, path, NULL, limit, error);
}

pspec_status ps_npz_open_stream(ps_npz **out, FILE *stream, uint64_t limit, ps_error *error) {
    return open_one(out, NULL, stream, limit, error);
}

pspec_status ps_npz_add(ps_npz *npz, const ps_npz_array *array, ps_error *error) {
    char header[PS_NPY_HEADER_BYTES];
    ps_text local = {0};
    size_t bytes = 0;
    const size_t header_bytes = ps_npz_make_header(header, array);
    (void)ps_npz_count_bytes(array, &bytes); /* of memory that there is */
    const uLong crc = crc32_z(crc32_z(0, NULL, 0), (const Bytef *)header, header_bytes);
    const ps_npz_member one = {.name = array->name,
                               .name_bytes = strlen(array->name),
                               .crc = (uint32_t)crc32_z(crc, array->data, bytes),
                               .size = (uint64_t)header_bytes + bytes};
    ps_npz_put_member(&local, &npz->records, &one);
    PS_TRY(write_records(npz, &local, error));
    write_bytes(npz, header, header_bytes);
    write_bytes(npz, array->data, bytes);
    return ps_output_check(npz->file, error);
}

pspec_status ps_npz_end(ps_npz *npz, uint64_t *num_bytes, ps_error *error) {
    const XXH128_hash_t digest = XXH3_128bits_digest(npz->digest);
    const size_t num = sizeof digest / sizeof(int64_t);
    const ps_npz_array last = {PS_NPZ_DIGEST, 'i', sizeof(int64_t), 1, &num, &digest};
    ps_text end = {0};
    PS_TRY(ps_npz_add(npz, &last, error));
    const uint64_t directory_bytes = npz->records.directory.length;
    PS_TRY(write_records(npz, &npz->records.directory, error));
    ps_npz_put_end(&end, &npz->records, directory_bytes);
    PS_TRY(write_records(npz, &end, error));
    npz->is_ended = true;
    *num_bytes = npz->records.position;
    return PSPEC_OK;
}

pspec_status ps_npz_commit(ps_npz **npz, ps_error *error) {
    uint64_t num_bytes = 0;
    pspec_status status = (*npz)->is_ended ? PSPEC_OK : ps_npz_end(*npz, &num_bytes, error);
    if (status == PSPEC_OK) {
        status = ps_output_commit(&(*npz)->file, error);
    }
    ps_npz_discard(npz);
    return status;
}

void ps_npz_discard(ps_npz **npz) {
    if (*npz != NULL) {
        ps_output_discard(&(*npz)->file);
        ps_text_free(&(*npz)->records.directory);
        XXH3_freeState((*npz)->digest);
        free(*npz);
        *npz = NULL;
    }
}
