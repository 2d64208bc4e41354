/* Reading a spectrum file: its numbers one after the other, and its header. */
#ifndef PS_SPECTRA_FILE_SPECTRUM_HEAD_H
#define PS_SPECTRA_FILE_SPECTRUM_HEAD_H

#include "spectra/file/spectrum_format.h"
#include "spectra/sums.h"

#include <stdio.h>
#include <zlib.h>

/* A file, what is left of it, and the checksum of what was read. */
typedef struct ps_spectrum_reader {
    FILE *stream;
    const char *path;
    uint64_t rest;
    uLong checksum;
    ps_error *error;
} ps_spectrum_reader;

/* What the header says, before anything of that size is allocated. */
typedef struct ps_spectrum_head {
    int version; /* of the format */
    uint64_t dimension, per_ring, max_frequency, num_frequencies, num_bins;
    uint64_t realizations, smallest_points, largest_points;
    size_t kind, normalization; /* places in the tables of spectrum_format.h */
    ps_bin_rule bins;
} ps_spectrum_head;

/* A sentence that names the file. */
pspec_status ps_spectrum_fail(const ps_spectrum_reader *in, const char *what) PS_MUST_CHECK;
/* reason: an errno, or 0 */
pspec_status ps_spectrum_fail_system(const ps_spectrum_reader *in, int reason) PS_MUST_CHECK;

pspec_status ps_spectrum_read_integer(ps_spectrum_reader *in, size_t num_bytes,
                                      uint64_t *out) PS_MUST_CHECK;
pspec_status ps_spectrum_read_doubles(ps_spectrum_reader *in, double *numbers,
                                      size_t num) PS_MUST_CHECK;
pspec_status ps_spectrum_read_sums(ps_spectrum_reader *in, ps_sums *sums, size_t num) PS_MUST_CHECK;
pspec_status ps_spectrum_read_head(ps_spectrum_reader *in, ps_spectrum_head *out) PS_MUST_CHECK;

#endif
