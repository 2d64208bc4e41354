/* What weights mean under each normalization. */
#include "jobs/estimator_private.h"

#include <math.h>

void ps_estimator_set_sums(ps_estimator *self, size_t pattern, uint64_t num_points,
                           const ps_pattern_sums *sums) {
    const double sum = sums->weight_sum;
    self->sums[pattern] = *sums;
    self->exponents[pattern] = sums->exponent;
    switch (self->options.normalization) {
    case PSPEC_NORMALIZATION_POWER:
        self->scales[pattern] = (double)num_points / (sum * sum);
        break;
    case PSPEC_NORMALIZATION_INTEGRAL:
        self->scales[pattern] = self->reference_points / (sum * sum);
        break;
    case PSPEC_NORMALIZATION_EFFECTIVE:
        self->scales[pattern] = 1 / sums->weight_square_sum;
        break;
    case PSPEC_NORMALIZATION_PAIRS: /* weights 1/N where there are none */
        self->scales[pattern] = sums->is_plain ? 1 / (sum * sum) : ldexp(1, 2 * sums->exponent);
        break;
    }
}

double ps_estimator_weight_sum(const ps_estimator *self, const ps_pattern_sums *sums) {
    return self->options.normalization == PSPEC_NORMALIZATION_PAIRS && sums->is_plain
               ? 1
               : ldexp(sums->weight_sum, sums->exponent);
}

void ps_estimator_measure_share(ps_estimator *self, const ps_pattern_sums *sums) {
    ps_accuracy *accuracy = &self->accuracy;
    const double size = sums->weight_size_sum;
    const double share = sums->weight_square_sum / (size * size);
    accuracy->largest_share = fmax(accuracy->largest_share, share);
}
