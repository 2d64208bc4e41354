/* What weights mean under each normalization, and what is known of patterns besides. */
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

void ps_estimator_count_patterns(ps_estimator *self, const pspec_pattern *patterns,
                                 size_t num_patterns) {
    ps_pattern_totals *totals = &self->totals;
    for (size_t r = 0; r < num_patterns; r++) {
        const size_t num_points = patterns[r].num_points;
        const bool is_first = totals->num_realizations == 0;
        totals->num_realizations++;
        self->accuracy.length_error = fmax(self->accuracy.length_error, self->sums[r].length_error);
        const double sums[PS_NUM_TOTALS] = {
            [PS_TOTAL_POINTS] = (double)num_points,
            [PS_TOTAL_SAMPLE_SIZES] = self->sums[r].weight_sum * self->sums[r].weight_sum /
                                      self->sums[r].weight_square_sum,
            [PS_TOTAL_WEIGHTS] = ps_estimator_weight_sum(self, &self->sums[r])};
        ps_running_sums_add(&self->total_sums, sums, NULL);
        ps_estimator_measure_share(self, &self->sums[r]);
        if (is_first || num_points < totals->smallest_points) {
            totals->smallest_points = num_points;
        }
        if (num_points > totals->largest_points) {
            totals->largest_points = num_points;
        }
    }
}
