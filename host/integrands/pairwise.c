/* Sums over pairs of points, (V2), (S1') and (H1'): docs/mathematics/integrands.md#pairs. */
#include "integrands/integrand_kind.h"
#include "math/neumaier.h"

/* What correlation takes: the difference of two points, or the cosine of their angle, whose chord
 * keeps its digits. */
static double correlate(const ps_integrand *self, const double *a, const double *b) {
    const unsigned dimension = self->place.dimension;
    double difference[PS_MAX_DIMENSION];
    double chord2 = 0;
    for (unsigned i = 0; i < dimension; i++) {
        difference[i] = a[i] - b[i];
        chord2 += difference[i] * difference[i];
    }
    if (self->place.where != PS_SAMPLES_TORUS) {
        difference[0] = 1 - chord2 / 2;
    }
    return self->kind->correlation(self, difference);
}

static double weight(const double *weights, size_t i) {
    return weights != NULL ? weights[i] : 1;
}

/* sum_ij w_i w_j A(x_i - x_j)/W^2, every pair once. */
static double mean_correlation(const ps_integrand *self, const double *points,
                               const double *weights, size_t num) {
    const unsigned dimension = self->place.dimension;
    ps_neumaier total = {0};
    ps_neumaier sum = {0};
    for (size_t i = 0; i < num; i++) {
        const double own = weight(weights, i);
        const double *const point = points + i * dimension;
        ps_neumaier_add(&sum, own);
        ps_neumaier_add(&total, own * own * correlate(self, point, point));
        for (size_t j = 0; j < i; j++) {
            ps_neumaier_add(&total, 2 * own * weight(weights, j) *
                                        correlate(self, point, points + j * dimension));
        }
    }
    const double w = ps_neumaier_value(&sum);
    return ps_neumaier_value(&total) / (w * w);
}

bool ps_integrand_has_pairs(const ps_integrand *integrand) {
    const double pole[PS_MAX_DIMENSION] = {0, 0, 1}; /* any point will do */
    return integrand->kind->correlation != NULL && !isnan(correlate(integrand, pole, pole));
}

pspec_status ps_integrand_pairwise(const ps_integrand *integrand, const double *points,
                                   const double *weights, size_t num, double *variance,
                                   ps_error *error) {
    if (!ps_integrand_has_pairs(integrand)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "integrand %s has no closed form for pairs of points",
                       integrand->kind->name);
    }
    const double whole = ps_integrand_integral(integrand);
    *variance = ps_integrand_factor(integrand) * mean_correlation(integrand, points, weights, num) -
                whole * whole;
    return PSPEC_OK;
}
