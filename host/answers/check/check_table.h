/* The table of pointspec check: a row for every ring, shell or degree. */
#ifndef PS_ANSWERS_CHECK_CHECK_TABLE_H
#define PS_ANSWERS_CHECK_CHECK_TABLE_H

#include "answers/check/saved_spectrum.h"
#include "jobs/spectrum/power_job.h"
#include "request/request.h"
#include "spectra/compare.h"
#include "tables/table.h"

typedef struct ps_check_results {
    const ps_saved_spectrum *saved;
    const ps_power_job *job;   /* has run */
    const ps_comparison *rows; /* [saved->num_bins] */
    size_t num_different;
} ps_check_results;

/* "ring", "shell" or "degree" */
const char *ps_check_bin_name(const ps_saved_spectrum *saved);

pspec_status ps_check_table(ps_table **out, const ps_request *arguments,
                            const ps_check_results *results, ps_error *error) PS_MUST_CHECK;

#endif
