/* Logarithms of variances, of which exponents, factors and crossings are made, with errors that
 * know how they depend on each other: realization r of a sampler with N points and with 2 N, or of
 * two samplers of one seed, may be made of the same random numbers. docs/mathematics/statistics.md,
 * Rates. */
#ifndef PS_JOBS_VARIANCE_LOG_VARIANCE_H
#define PS_JOBS_VARIANCE_LOG_VARIANCE_H

#include "spectra/accumulate/accumulate.h"

#include <math.h>

typedef struct ps_log_variance {
    double points;     /* N */
    double value;      /* without the bias of a logarithm; not finite: there is none */
    double error;      /* nan: nobody knows; 0: of a sampler without randomness */
    size_t num_blocks; /* from which the error was estimated; 0 if it is exact */
    double scatter;    /* the relative variance of a block */
    /* Sums of their products are covariances; 0 where there is no error */
    double deviations[PS_MOST_BLOCKS];
} ps_log_variance;

typedef struct ps_uncertain {
    double value, error;
    double plain;   /* the error without the part that Student's distribution has in it, */
    double freedom; /* of which it has so many degrees; not looked at where the error is 0 */
} ps_uncertain;
#define PS_UNCERTAIN_NONE ((ps_uncertain){.value = NAN, .error = NAN, .plain = NAN})

void ps_log_variance_make(ps_log_variance *out, double points, ps_mean variance,
                          const ps_block_sums *blocks);
/* ln(a/b), at the N of a: 0 errors on both sides are one of 0 */
ps_log_variance ps_log_variances_difference(const ps_log_variance *a, const ps_log_variance *b);
/* sum of factors[i] * logs[i]. From few blocks errors are told badly: their inverse mean square is
 * that of Student's distribution, which is counted in. nan from less than four. */
ps_uncertain ps_log_variances_combine(const ps_log_variance *logs, const double *factors,
                                      size_t num);
/* How probable it is to be at least so far from `exact`, by chance; nan where nobody knows. The
 * degrees of freedom are those of blocks that scatter like gamma variables, as means of powers and
 * of squares do; what comes out is confirmed by simulation (docs/mathematics/statistics.md). */
double ps_uncertain_p_value(const ps_uncertain *found, double exact);

#endif
