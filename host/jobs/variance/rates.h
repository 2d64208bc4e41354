/* The exponent r of variances that fall like N^-r, and where two samplers change places.
 * docs/mathematics/statistics.md, Rates. */
#ifndef PS_JOBS_VARIANCE_RATES_H
#define PS_JOBS_VARIANCE_RATES_H

#include "base/status.h"
#include "jobs/variance/log_variance.h"

#include <stdbool.h>

/* Of logs [num] by N. */
typedef struct ps_rate {
    size_t num;
    double from, to;     /* N */
    ps_uncertain rate;   /* by a line: a mean of the slopes from N to N, whatever the curve is */
    ps_uncertain change; /* of the rate when N doubles, by a parabola; nan of two N */
} ps_rate;

/* PSPEC_ERROR_INPUT with a sentence where logs do not say it: fewer than two N, no errors. */
pspec_status ps_rate_fit(ps_rate *out, const ps_log_variance *logs, size_t num,
                         ps_error *error) PS_MUST_CHECK;
/* Between two N. */
ps_uncertain ps_rate_between(const ps_log_variance *first, const ps_log_variance *second);

typedef struct ps_crossing {
    bool is_a_below;     /* before it a has the smaller variance, then b; else the other way */
    ps_uncertain points; /* N */
} ps_crossing;

typedef struct ps_crossings {
    size_t num;
    ps_crossing *found;  /* [number of N], borrowed */
    size_t num_a, num_b; /* numbers of N at which it is a, or b, that has less */
} ps_crossings;

/* Are their N the same, or differ by less than a tenth of the gap to the next N on a logarithmic
 * axis? Then b is taken at those of a, along a line to the next. */
bool ps_crossings_have_same_points(const ps_log_variance *a, const ps_log_variance *b, size_t num);
/* Of a and b at the same num N, as above, ascending. found [num] holds what is found. Two variances
 * are told apart where a ratio such as theirs has no more than this probability. A crossing lies
 * between two N at which one and the other have less; a line is fitted to ln(a/b) from the one
 * to the other, and to what lies between them, which is not told apart. */
pspec_status ps_crossings_find(ps_crossings *out, ps_crossing *found, const ps_log_variance *a,
                               const ps_log_variance *b, size_t num, double p_value,
                               ps_error *error) PS_MUST_CHECK;

#endif
