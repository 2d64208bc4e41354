#include "math/gsl/regression.h"

#include "math/gsl/fence.h"

#include <gsl/gsl_multifit.h>
#include <math.h>

static int fit(ps_regression *out, size_t num, size_t num_regressors, const double *regressors,
               const double *y, const double *weights, gsl_multifit_linear_workspace *work) {
    double memory[PS_MOST_REGRESSORS * PS_MOST_REGRESSORS];
    const gsl_matrix_const_view rows = gsl_matrix_const_view_array(regressors, num, num_regressors);
    const gsl_vector_const_view places = gsl_vector_const_view_array(y, num);
    const gsl_vector_const_view scales = gsl_vector_const_view_array(weights, num);
    gsl_vector_view found = gsl_vector_view_array(out->coefficients, num_regressors);
    gsl_matrix_view covariance = gsl_matrix_view_array(memory, num_regressors, num_regressors);
    const int code = gsl_multifit_wlinear(&rows.matrix, &scales.vector, &places.vector,
                                          &found.vector, &covariance.matrix, &out->chi2, work);
    for (size_t i = 0; i < num_regressors; i++) {
        out->errors[i] = sqrt(gsl_matrix_get(&covariance.matrix, i, i));
    }
    return code;
}

pspec_status ps_regress(ps_regression *out, size_t num, size_t num_regressors,
                        const double *regressors, const double *y, const double *weights,
                        ps_error *error) {
    int code = GSL_ENOMEM;
    *out = (ps_regression){0};
    ps_gsl_enter();
    gsl_multifit_linear_workspace *const work = gsl_multifit_linear_alloc(num, num_regressors);
    if (work != NULL) {
        code = fit(out, num, num_regressors, regressors, y, weights, work);
        gsl_multifit_linear_free(work);
    }
    ps_gsl_leave();
    if (code == GSL_ENOMEM) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "no memory for a regression of %zu rows", num);
    }
    return code == GSL_SUCCESS
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "a regression failed: %s", gsl_strerror(code));
}
