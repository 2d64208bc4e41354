/* Tables as bytes, on their way from a rank to rank 0. */
#include "answers/ranks/ranks_work.h"

#include "base/memory.h"
#include "files/temporary_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static pspec_status fail_file(ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_IO, "cannot use a temporary file");
}

/* ---- tables as bytes ------------------------------------------------------------------------- */

static pspec_status write_table(const ps_table *table, FILE *stream, uint64_t *num_bytes,
                                ps_error *error) {
    ps_npz *npz = NULL;
    PS_TRY(ps_npz_open_stream(&npz, stream, PS_NPZ_LIMIT, error));
    pspec_status status = ps_table_add_to_npz(table, npz, error);
    if (status == PSPEC_OK) {
        status = ps_npz_end(npz, num_bytes, error);
    }
    if (status != PSPEC_OK) {
        ps_npz_discard(&npz);
        return status;
    }
    return ps_npz_commit(&npz, error);
}

/* Behind those that are there: how many bytes a table has, and these. */
static pspec_status add_bytes(ps_rank_bytes *out, FILE *stream, uint64_t num, ps_error *error) {
    char *const data = realloc(out->data, out->num + sizeof num + num);
    if (data == NULL) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "no memory for the answer of a rank");
    }
    out->data = data;
    memcpy(data + out->num, &num, sizeof num);
    if (fseeko(stream, 0, SEEK_SET) != 0 ||
        fread(data + out->num + sizeof num, 1, num, stream) != num) {
        return fail_file(error);
    }
    out->num += sizeof num + num;
    return PSPEC_OK;
}

pspec_status ps_ranks_pack(ps_rank_bytes *out, const ps_table *table, ps_error *error) {
    FILE *stream = NULL;
    uint64_t num = 0;
    PS_TRY(ps_temporary_open(&stream, error));
    pspec_status status = write_table(table, stream, &num, error);
    if (status == PSPEC_OK) {
        status = add_bytes(out, stream, num, error);
    }
    fclose(stream);
    return status;
}

/* ---- bytes as tables ------------------------------------------------------------------------- */

static pspec_status read_table(ps_table **out, const char *data, uint64_t num, const char *name,
                               ps_error *error) {
    FILE *stream = NULL;
    ps_npz_file *file = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY(ps_temporary_open(&stream, error));
    if (fwrite(data, 1, num, stream) != num || fflush(stream) != 0 ||
        fseeko(stream, 0, SEEK_SET) != 0) {
        status = fail_file(error);
    }
    if (status == PSPEC_OK) {
        status = ps_npz_read(&file, fileno(stream), name, PS_NPZ_LIMIT, error);
    }
    if (status == PSPEC_OK) {
        status = ps_table_take_npz(out, file, error);
    }
    ps_npz_free(file);
    fclose(stream);
    return status;
}

pspec_status ps_ranks_unpack(ps_table **out, const ps_rank_bytes *bytes, size_t *at,
                             const char *name, ps_error *error) {
    uint64_t num = 0;
    const char *const data = (const char *)bytes->data + *at;
    const size_t left = bytes->num - *at;
    if (left >= sizeof num) {
        memcpy(&num, data, sizeof num);
    }
    if (num == 0 || num > left - sizeof num) {
        return ps_fail(error, PSPEC_ERROR_IO, "%s has not come whole", name);
    }
    *at += sizeof num + num;
    return read_table(out, data + sizeof num, num, name, error);
}
