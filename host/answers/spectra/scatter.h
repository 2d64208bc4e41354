/* --scatter: S(k) of every set at one frequency, in the complex plane, and what can be said of it.
 */
#ifndef PS_ANSWERS_SPECTRA_SCATTER_H
#define PS_ANSWERS_SPECTRA_SCATTER_H

#include "answers/figure.h"
#include "jobs/spectrum/power_job.h"

/* S(j, k_2, .., k_d) of every set for j = -K .. K: the row of the grid that goes through the
 * frequency k. */
typedef struct ps_scatter {
    size_t num_sets;
    const ps_frequencies_spec *asked; /* has k; borrowed */
    int32_t max_frequency;            /* K */
    const double *rows;               /* [num_sets][2K+1][2], borrowed */
} ps_scatter;

/* Takes the rows from a job that has run; *rows is freed by the caller, also after an error. */
pspec_status ps_scatter_take(ps_scatter *out, double **rows, const ps_frequencies_spec *asked,
                             const ps_power_job *job, ps_error *error) PS_MUST_CHECK;
/* Header lines: the mean of S(k), its error, the probability of such phases were they uniform. */
pspec_status ps_scatter_add_header(ps_table *table, const ps_frequencies_spec *asked,
                                   const ps_power_job *job, ps_error *error) PS_MUST_CHECK;

/* Real and imaginary parts of the first sets along the row, S(k) of all sets: the array scatter. */
ps_make_figure ps_scatter_figure;

#endif
