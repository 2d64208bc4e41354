/* Reading and writing point sets of the torus: UTK text and NPY, from files or standard input.
 *
 * A reader yields one set (realization) at a time and holds no more than that set (up to 64 MiB of
 * sets for NPY arrays of several sets in Fortran order, which lie scattered over the file). Sets,
 * rows and lines are counted from 1 in messages. A read that a signal interrupts is
 * PSPEC_ERROR_CANCELLED; a handler installed with SA_RESTART does not interrupt.
 * Another format is another row in the table of formats in points.c and another file beside it.
 */
#ifndef PS_IO_POINTS_H
#define PS_IO_POINTS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* One point set; {0} is empty. The arrays belong to the set and are reused by the next read. */
typedef struct ps_point_set {
    unsigned dimension;
    size_t num_points;
    double *points;  /* [num_points][dimension], in [0,1) */
    double *weights; /* [num_points], meaningful only when has_weights */
    bool has_weights;
    size_t points_capacity, weights_capacity; /* in doubles */
} ps_point_set;

void ps_point_set_free(ps_point_set *set);

typedef struct ps_point_options {
    const char *format; /* "utk-text", "npy", or NULL: detected (NPY by its magic, else text) */
    unsigned dimension; /* 0: from the file; otherwise it must agree */
    bool weight_column; /* the last column holds the weight */
    bool wrap;          /* coordinates outside [0,1) are reduced mod 1 instead of refused */
} ps_point_options;

typedef struct ps_point_reader ps_point_reader;

/* Opens path, or standard input for "-". */
pspec_status ps_points_open(ps_point_reader **out, const char *path,
                            const ps_point_options *options, ps_error *error) PS_MUST_CHECK;
/* Reads the next set. *has_set is false at the end of the input; a file without any point is an
 * error. Errors name file, line (or set and row for NPY), value and what would be right. */
pspec_status ps_points_next(ps_point_reader *reader, ps_point_set *set, bool *has_set,
                            ps_error *error) PS_MUST_CHECK;
/* Name of the format in use, for the header of results; static storage. */
const char *ps_points_format(const ps_point_reader *reader);
void ps_points_close(ps_point_reader *reader);

typedef struct ps_point_writer ps_point_writer;

/* Creates path ("-": standard output). Format by name, or NULL: by ending (.npy, else UTK text,
 * 17 digits). num_sets and the shape are needed in advance by NPY: (num_sets, num_points, d)
 * float64. The file appears under its name only when ps_points_commit succeeds. */
pspec_status ps_points_create(ps_point_writer **out, const char *path, const char *format,
                              size_t num_sets, size_t num_points, unsigned dimension,
                              ps_error *error) PS_MUST_CHECK;
pspec_status ps_points_write(ps_point_writer *writer, const double *points,
                             ps_error *error) PS_MUST_CHECK;
pspec_status ps_points_commit(ps_point_writer *writer, ps_error *error) PS_MUST_CHECK;
/* Frees the writer; what was not committed is removed. NULL is allowed. */
void ps_points_discard(ps_point_writer *writer);

/* Reads a list of integer frequency vectors, one per line, columns separated by blanks or commas,
 * '#' lines skipped; *vectors is [num_vectors][*dimension], freed by the caller. The dimension is
 * that of the first line (1 to 6). |k| <= 2^30. */
pspec_status ps_read_frequencies(const char *path, int **vectors, size_t *num_vectors,
                                 unsigned *dimension, ps_error *error) PS_MUST_CHECK;

/* Reads weights: one number per line or token, or a one-dimensional NPY array. */
pspec_status ps_read_weights(const char *path, double **weights, size_t *num_weights,
                             ps_error *error) PS_MUST_CHECK;

#endif
