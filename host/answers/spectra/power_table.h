/* Results of power jobs as a table and arrays. */
#ifndef PS_ANSWERS_SPECTRA_POWER_TABLE_H
#define PS_ANSWERS_SPECTRA_POWER_TABLE_H

#include "answers/spectra/question.h"
#include "tables/table.h"

/* Header lines and rows of num jobs that have run, behind the columns of their lead. */
pspec_status ps_power_table(ps_table **out, const ps_request *arguments,
                            const ps_power_job *const *jobs, size_t num,
                            ps_error *error) PS_MUST_CHECK;

/* Are the names after --full and --coefficients, if any, those of NPY files? */
pspec_status ps_power_check_arrays(const ps_request *arguments, ps_error *error) PS_MUST_CHECK;

/* --full: FILE.npy and FILE.standard_error.npy. */
pspec_status ps_power_write_full(const ps_request *arguments, const ps_power_job *job,
                                 ps_error *error) PS_MUST_CHECK;

/* --coefficients: S(k) of every set, complex128 [sets][2K+1]..[2K+1], or [sets][frequencies] of a
 * list; without the first axis where there is one set. */
typedef struct ps_complex_shape {
    unsigned rank;
    size_t shape[PS_MAX_DIMENSION + 1];
    size_t num_entries; /* of a set */
} ps_complex_shape;
/* The same in memory, pairs of doubles, freed by the caller. */
pspec_status ps_power_coefficients(const ps_power_job *job, double **out, ps_complex_shape *shape,
                                   ps_error *error) PS_MUST_CHECK;
pspec_status ps_power_write_coefficients(const ps_request *arguments, const ps_power_job *job,
                                         ps_error *error) PS_MUST_CHECK;

/* P(0) = N W^2 / W^2 = N, N being the mean over the realizations, a constant; or W^2 / V, which
 * each has its own of. */
ps_mean ps_power_dc(const ps_request *arguments, const ps_spectrum *spectrum);

#endif
