/* The two sides of a check: what was saved, and what is compared with it, a job that has run or
 * another saved spectrum. */
#ifndef PS_ANSWERS_CHECK_CHECK_SIDES_H
#define PS_ANSWERS_CHECK_CHECK_SIDES_H

#include "answers/check/saved_spectrum.h"
#include "jobs/spectrum/power_job.h"
#include "spectra/compare.h"

/* A side, and the name of its file; NULL: it was measured. */
typedef struct ps_check_side {
    const ps_saved_spectrum *spectrum;
    const char *path;
} ps_check_side;

/* "ring", "shell" or "degree" */
const char *ps_check_bin_name(const ps_saved_spectrum *saved);

/* What a job that has run would have saved; freed by ps_saved_spectrum_free, also after an error.
 */
pspec_status ps_check_measured(ps_saved_spectrum *out, const ps_power_job *job,
                               ps_error *error) PS_MUST_CHECK;

/* Refuses spectra of two kinds: of the torus and the sphere, of other frequencies, other rings, or
 * under another normalization. Both are of files. */
pspec_status ps_check_same_kind(const ps_check_side *saved, const ps_check_side *other,
                                ps_error *error) PS_MUST_CHECK;

/* rows [number of bins]: bin by bin. Refuses sets of other numbers of points, and bins that are not
 * the same. */
pspec_status ps_check_compare(ps_comparison *rows, const ps_check_side *saved,
                              const ps_check_side *measured, double false_alarm_rate,
                              ps_error *error) PS_MUST_CHECK;

#endif
