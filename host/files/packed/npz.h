/* NPZ: arrays by their names in one file, as numpy.savez writes them: a zip archive of NPY files.
 *
 * Members are stored as they are, one after the other in the order in which they were added, with
 * the date 1980-01-01: equal arrays make equal bytes. Nothing is written twice, so the file may be
 * a pipe. Sizes and places from 4 GiB on stand in fields of ZIP64. The last array, "file_digest",
 * is the digest of what is before it. What is read back is what was written, or nothing: every byte
 * of the file is checked. */
#ifndef PS_FILES_PACKED_NPZ_H
#define PS_FILES_PACKED_NPZ_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct ps_npz_array {
    const char *name; /* ASCII; no other array of the file has it */
    char kind;        /* f: double; i: int64_t; c: two doubles; U: text, of UTF-32; u: bytes */
    size_t element_bytes;
    unsigned rank; /* at most PS_NPY_MAX_RANK; 0: one element */
    const size_t *shape;
    const void *data; /* not NULL, in C order, of files at any address; texts that are shorter than
                       * their elements end in zeros */
} ps_npz_array;

typedef struct ps_npz ps_npz;

/* The last array: the digest (XXH3, 128 bits) of all bytes before its record, as two integers, the
 * lower one first. */
#define PS_NPZ_DIGEST "file_digest"

/* What does not fit into a field of 32 bits: the limit for all but tests. */
#define PS_NPZ_LIMIT ((uint64_t)UINT32_MAX)

/* Opens path as ps_output_open does. Sizes and places from `limit` on are written as ZIP64. */
pspec_status ps_npz_open(ps_npz **out, const char *path, uint64_t limit,
                         ps_error *error) PS_MUST_CHECK;
/* The same to a stream of the caller, a temporary file, which stays open. */
pspec_status ps_npz_open_stream(ps_npz **out, FILE *stream, uint64_t limit,
                                ps_error *error) PS_MUST_CHECK;
/* Writes the array; nothing of it is kept. */
pspec_status ps_npz_add(ps_npz *npz, const ps_npz_array *array, ps_error *error) PS_MUST_CHECK;
/* Writes the digest and the directory, behind which nothing comes. *num_bytes: of the file. */
pspec_status ps_npz_end(ps_npz *npz, uint64_t *num_bytes, ps_error *error) PS_MUST_CHECK;
/* Writes that, where it was not done, and gives the file its name. The handle is freed in every
 * case and *npz set to NULL. */
pspec_status ps_npz_commit(ps_npz **npz, ps_error *error) PS_MUST_CHECK;
/* A NULL handle is allowed. */
void ps_npz_discard(ps_npz **npz);

/* ---- reading ------------------------------------------------------------------------------- */

typedef struct ps_npz_file ps_npz_file;

/* Reads a whole file that was written with this limit, by a machine of this byte order. Any bytes
 * may come: what is damaged, cut off, compressed or of another program is PSPEC_ERROR_INPUT. Memory
 * is in proportion to the file. name: for sentences; the descriptor, at the beginning of the file,
 * stays the caller's. */
pspec_status ps_npz_read(ps_npz_file **out, int descriptor, const char *name, uint64_t limit,
                         ps_error *error) PS_MUST_CHECK;
const char *ps_npz_name(const ps_npz_file *file);
/* NULL: it has no array of that name. As long as the file is there. */
const ps_npz_array *ps_npz_find(const ps_npz_file *file, const char *name);
/* NULL is allowed. */
void ps_npz_free(ps_npz_file *file);

#endif
