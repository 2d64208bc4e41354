/* Numbers of binary files as doubles: the conversions that UTK binary, NPY and RPS share. For
 * host/files and host/points. */
#ifndef PS_FILES_ELEMENTS_H
#define PS_FILES_ELEMENTS_H

#include "files/input_file.h"
#include "files/output_file.h"

typedef enum ps_element_kind {
    PS_ELEMENT_FLOAT,
    PS_ELEMENT_SIGNED,
    PS_ELEMENT_UNSIGNED
} ps_element_kind;

typedef struct ps_element_type {
    ps_element_kind kind;
    unsigned num_bytes; /* floats 2, 4 or 8, whole numbers 1, 2, 4 or 8 */
    bool is_big_endian;
} ps_element_type;

bool ps_host_is_big_endian(void);

/* The number that the bytes of one element are. */
double ps_element_number(ps_element_type type, const unsigned char *bytes);

/* Reads count elements as doubles; whole numbers beyond 2^53 may be rounded. *num_read is smaller
 * only at the end of the input. */
pspec_status ps_elements_read(ps_input *input, ps_element_type type, double *out, size_t count,
                              size_t *num_read, ps_error *error) PS_MUST_CHECK;

/* Writes doubles as little-endian float64. */
void ps_elements_write(ps_output_file *file, const double *values, size_t count);

#endif
