/* A whole NPY array in memory. */
#ifndef PS_FILES_NPY_ARRAY_H
#define PS_FILES_NPY_ARRAY_H

#include "files/npy.h"

/* In C order, whatever the order of the file. */
typedef struct ps_npy_array {
    unsigned rank;
    size_t shape[PS_NPY_MAX_RANK];
    size_t num;
    bool is_complex;
    double *data; /* [num], of complex numbers [num][2] */
} ps_npy_array;

/* Reads the array that comes next, to the end of the input. All of its numbers are finite. An array
 * without elements is refused. */
pspec_status ps_npy_read_array(ps_npy_array *out, ps_input *input, bool may_be_complex,
                               ps_error *error) PS_MUST_CHECK;
void ps_npy_array_free(ps_npy_array *array);
/* An array of zeros; shape [rank] has at most PS_NPY_MAX_RANK axes. */
pspec_status ps_npy_make_array(ps_npy_array *out, unsigned rank, const size_t *shape,
                               bool is_complex, ps_error *error) PS_MUST_CHECK;
/* Doubles of its data. */
size_t ps_npy_num_doubles(const ps_npy_array *array);
/* Writes it to path through ps_output_file, as float64 or complex128. */
pspec_status ps_npy_write_array(const char *path, const ps_npy_array *array,
                                ps_error *error) PS_MUST_CHECK;

/* Numbers of axes as Python shows them, "(3, 4)" and "(3,)". */
enum { PS_NPY_PLACE_BYTES = PS_NPY_MAX_RANK * 22 + 4 };
const char *ps_npy_show(unsigned num, const size_t *numbers, char text[PS_NPY_PLACE_BYTES]);
/* Place i of the array so, counted from 0. */
const char *ps_npy_place(const ps_npy_array *array, size_t i, char text[PS_NPY_PLACE_BYTES]);
/* "an array of shape (3, 4)" */
enum { PS_NPY_SHAPE_BYTES = PS_NPY_PLACE_BYTES + 24 };
const char *ps_npy_shape(const ps_npy_array *array, char text[PS_NPY_SHAPE_BYTES]);

#endif
