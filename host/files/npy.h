/* NPY arrays (format 1.0 of NumPy): their header, and its parser that readers use. */
#ifndef PS_FILES_NPY_H
#define PS_FILES_NPY_H

#include "files/elements.h"

enum { PS_NPY_MAX_RANK = 8 };

typedef struct ps_npy_header {
    unsigned rank;
    size_t shape[PS_NPY_MAX_RANK];
    size_t num_elements;
    bool is_fortran_order;
    ps_element_type type; /* of a complex element each of its two parts */
    bool is_complex, may_be_complex;
} ps_npy_header;

/* Does an array come next? The first byte tells: no text begins with it. */
pspec_status ps_npy_is_next(ps_input *input, bool *is_next, ps_error *error) PS_MUST_CHECK;

/* Reads magic and header (of versions 1 to 3); arrays that are complex are refused unless they may
 * be. Where the size of the file is known, it must be what the header says. */
pspec_status ps_npy_read_header(ps_input *input, ps_npy_header *out, bool may_be_complex,
                                ps_error *error) PS_MUST_CHECK;
/* Reads the next count numbers as doubles, in the order of the file; complex ones are two. */
pspec_status ps_npy_read_elements(ps_input *input, const ps_npy_header *header, double *out,
                                  size_t count, ps_error *error) PS_MUST_CHECK;
/* After the last element: the input must end here (a pipe does not tell its size in advance). */
pspec_status ps_npy_check_end(ps_input *input, ps_error *error) PS_MUST_CHECK;

/* Makes the header of an array in C order and in the byte order of this machine; element: "f8",
 * "c16", or what else NumPy calls so. Returns how many bytes it has. */
enum { PS_NPY_HEADER_BYTES = 384 }; /* 8 extents of 20 digits, words, and blanks up to 64 bytes */
size_t ps_npy_make_header(char out[PS_NPY_HEADER_BYTES], const char *element, unsigned rank,
                          const size_t *shape);
/* Writes it, so that the elements follow. Write errors show at commit. */
void ps_npy_write_header(ps_output_file *file, const char *element, unsigned rank,
                         const size_t *shape);

/* Does the path end in .npy, as the only format does that the option writes? */
pspec_status ps_npy_check_name(const char *option, const char *path, ps_error *error) PS_MUST_CHECK;

#endif
