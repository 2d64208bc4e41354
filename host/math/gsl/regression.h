/* Linear regression with weights on the host, by GSL. */
#ifndef PS_MATH_GSL_REGRESSION_H
#define PS_MATH_GSL_REGRESSION_H

#include "base/status.h"

#include <stddef.h>

enum { PS_MOST_REGRESSORS = 3 };

typedef struct ps_regression {
    double coefficients[PS_MOST_REGRESSORS];
    double errors[PS_MOST_REGRESSORS]; /* standard errors, where weights are 1 / variance */
    double chi2;                       /* sum of weights times squared residuals */
} ps_regression;

/* Least squares of y[num] on the columns of regressors[num][num_regressors], row by row; finite,
 * weights above 0, and no fewer rows than regressors. */
pspec_status ps_regress(ps_regression *out, size_t num, size_t num_regressors,
                        const double *regressors, const double *y, const double *weights,
                        ps_error *error) PS_MUST_CHECK;

#endif
