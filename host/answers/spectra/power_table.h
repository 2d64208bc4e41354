/* Results of power jobs as a table and arrays. */
#ifndef PS_ANSWERS_SPECTRA_POWER_TABLE_H
#define PS_ANSWERS_SPECTRA_POWER_TABLE_H

#include "answers/spectra/measured.h"
#include "tables/table.h"

/* Header lines and rows of num questions, behind the columns of their lead, and the arrays of
 * ps_power_add_full of the first. */
pspec_status ps_power_table(ps_table **out, const ps_request *arguments, const ps_measured *all,
                            size_t num, ps_error *error) PS_MUST_CHECK;

/* Are the names after --full and --coefficients, if any, those of NPY files? */
pspec_status ps_power_check_arrays(const ps_request *arguments, ps_error *error) PS_MUST_CHECK;

/* The array full, and full_standard_error, where the request asks for them and there is a box. */
pspec_status ps_power_add_full(ps_table *table, const ps_request *request,
                               const ps_spectrum *spectrum, ps_error *error) PS_MUST_CHECK;
/* The array coefficients: S(k) of every set, complex128 [sets][2K+1]..[2K+1], or
 * [sets][frequencies] of a list; without the first axis where there is one set. */
pspec_status ps_power_add_coefficients(ps_table *table, const ps_power_job *job,
                                       ps_error *error) PS_MUST_CHECK;

#endif
