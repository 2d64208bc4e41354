/* Lists of weights. */
#ifndef PS_POINTS_LISTS_WEIGHT_LIST_H
#define PS_POINTS_LISTS_WEIGHT_LIST_H

#include "files/npy_array.h"

/* Reads weights: one number per line or token, or a one-dimensional NPY array. num_wanted: how many
 * the caller can use; a file that goes on long after them is refused, since it may have no end. */
pspec_status ps_read_weights(const char *path, uint64_t num_wanted, double **weights,
                             size_t *num_weights, ps_error *error) PS_MUST_CHECK;

/* Writes weights that ps_read_weights reads: an array where the path ends in .npy, else text, one
 * number a line. "-" is standard output. */
pspec_status ps_write_weights(const char *path, const ps_npy_array *weights,
                              ps_error *error) PS_MUST_CHECK;
/* Whether the ending tells which of both it is: .npy, .txt, or none. */
pspec_status ps_weights_check_name(const char *path, ps_error *error) PS_MUST_CHECK;

#endif
