/* Spectra in files: the sums, bit by bit, with a checksum. The format is in
 * docs/user/spectrum_file.md. */
#ifndef PS_SPECTRA_FILE_SPECTRUM_FILE_H
#define PS_SPECTRA_FILE_SPECTRUM_FILE_H

#include "spectra/spectrum_sums.h"

/* The file appears when it is complete (files/output_file.h). */
pspec_status ps_spectrum_write(const ps_spectrum_sums *sums, const char *path,
                               ps_error *error) PS_MUST_CHECK;

/* *bins are those of the frequencies. What is no such file, incomplete or damaged is
 * PSPEC_ERROR_INPUT; no more memory is allocated than a few times the size of the file. */
pspec_status ps_spectrum_read(ps_spectrum_sums *out, ps_bins *bins, const char *path,
                              ps_error *error) PS_MUST_CHECK;

#endif
