/* What is known of realizations beside their powers; and realizations that several estimators
 * share: what one adds to the averages, as a row of bytes. */
#include "jobs/estimator_private.h"

#include <math.h>
#include <string.h>

/* Powers follow: of all bins, then weighted sums. */
typedef struct row {
    double totals[PS_NUM_TOTALS];
    double unit; /* of effective powers */
    uint64_t num_points;
    double powers[];
} row;

size_t ps_estimator_row_bytes(const ps_estimator *estimator) {
    return sizeof(row) + (estimator->bins.num + estimator->options.num_weighted) * sizeof(double);
}

/* One realization more, with its totals: [PS_NUM_TOTALS]. */
static void count(ps_estimator *self, size_t num_points, const double *totals) {
    ps_pattern_totals *const known = &self->totals;
    ps_running_sums_add(&self->total_sums, totals, NULL);
    if (known->num_realizations++ == 0 || num_points < known->smallest_points) {
        known->smallest_points = num_points;
    }
    if (num_points > known->largest_points) {
        known->largest_points = num_points;
    }
}

/* ---- made ------------------------------------------------------------------------------------ */

void ps_estimator_begin_rows(ps_estimator *estimator, uint64_t first, void *rows) {
    ps_estimator_go_to(estimator, first);
    estimator->next_counts = estimator->next_powers = rows;
}

static void put_counts(ps_estimator *self, size_t pattern, size_t num_points,
                       const double *totals) {
    row *const next = (void *)self->next_counts;
    memcpy(next->totals, totals, sizeof next->totals);
    next->unit = self->scales[pattern] * self->sums[pattern].weight_square_sum;
    next->num_points = num_points;
    self->next_counts += ps_estimator_row_bytes(self);
    self->num_elsewhere++;
}

void ps_estimator_count_patterns(ps_estimator *self, const pspec_pattern *patterns,
                                 size_t num_patterns) {
    for (size_t r = 0; r < num_patterns; r++) {
        const size_t num_points = patterns[r].num_points;
        self->accuracy.length_error = fmax(self->accuracy.length_error, self->sums[r].length_error);
        const double sums[PS_NUM_TOTALS] = {
            [PS_TOTAL_POINTS] = (double)num_points,
            [PS_TOTAL_SAMPLE_SIZES] = self->sums[r].weight_sum * self->sums[r].weight_sum /
                                      self->sums[r].weight_square_sum,
            [PS_TOTAL_WEIGHTS] = ps_estimator_weight_sum(self, &self->sums[r])};
        ps_estimator_measure_share(self, &self->sums[r]);
        if (self->options.makes_rows) {
            put_counts(self, r, num_points, sums);
        } else {
            count(self, num_points, sums);
        }
    }
}

void ps_estimator_put_powers(void *payload, const double *bins, const double *weighted) {
    ps_estimator *const self = payload;
    row *const next = (void *)self->next_powers;
    memcpy(next->powers, bins, self->bins.num * sizeof(double));
    memcpy(next->powers + self->bins.num, weighted, self->options.num_weighted * sizeof(double));
    self->next_powers += ps_estimator_row_bytes(self);
}

/* ---- added ----------------------------------------------------------------------------------- */

pspec_status ps_estimator_take_row(ps_estimator *estimator, const void *realization,
                                   ps_error *error) {
    const row *const next = realization;
    PS_TRY(ps_running_sums_reserve(&estimator->total_sums, estimator->totals.num_realizations + 1,
                                   error));
    PS_TRY(ps_accumulator_add_one(estimator->accumulator, next->powers,
                                  next->powers + estimator->bins.num, next->unit, error));
    count(estimator, (size_t)next->num_points, next->totals);
    return PSPEC_OK;
}
