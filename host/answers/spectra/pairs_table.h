/* Results of jobs of pair sums as a table. */
#ifndef PS_ANSWERS_SPECTRA_PAIRS_TABLE_H
#define PS_ANSWERS_SPECTRA_PAIRS_TABLE_H

#include "answers/spectra/question.h"
#include "tables/table.h"

/* Header lines and rows of num jobs that have run; the table of several samplers begins with a
 * column `sampler`. */
pspec_status ps_pairs_table(ps_table **out, const ps_request *arguments,
                            const ps_power_job *const *jobs, size_t num,
                            ps_error *error) PS_MUST_CHECK;

#endif
