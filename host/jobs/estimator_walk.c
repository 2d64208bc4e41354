/* The state of an estimator, to a checkpoint or from one. */
#include "jobs/estimator_private.h"

/* Counts of ps_pattern_totals and of the accuracy, which are no doubles. */
static pspec_status walk_counts(ps_estimator *self, ps_snapshot *snapshot, ps_error *error) {
    ps_pattern_totals *const totals = &self->totals;
    uint64_t counts[] = {totals->num_realizations, totals->smallest_points, totals->largest_points,
                         self->accuracy.was_checked, self->options.problem.num_points};
    enum { REALIZATIONS, SMALLEST, LARGEST, CHECKED, POINTS, NUM };
    PS_TRY(ps_snapshot_counts(snapshot, "counts", counts, NUM, error));
    totals->num_realizations = counts[REALIZATIONS];
    totals->smallest_points = (size_t)counts[SMALLEST];
    totals->largest_points = (size_t)counts[LARGEST];
    self->accuracy.was_checked = counts[CHECKED] != 0;
    return ps_estimator_get_ready(self, counts[POINTS], error);
}

static pspec_status walk_numbers(ps_estimator *self, ps_snapshot *snapshot, ps_error *error) {
    ps_accuracy *const accuracy = &self->accuracy;
    double *const numbers[] = {&accuracy->length_error, &accuracy->largest_share,
                               &accuracy->self_check, &accuracy->largest_mean_power,
                               &accuracy->error};
    return ps_snapshot_gather(snapshot, "numbers", numbers, sizeof numbers / sizeof numbers[0],
                              error);
}

pspec_status ps_estimator_walk(ps_estimator *estimator, ps_snapshot *snapshot, ps_error *error) {
    PS_TRY(ps_estimator_settle(estimator, error));
    PS_TRY(walk_counts(estimator, snapshot, error));
    PS_TRY(walk_numbers(estimator, snapshot, error));
    PS_TRY(ps_running_sums_walk(&estimator->total_sums, snapshot, "totals", error));
    PS_TRY(estimator->options.want_c2
               ? ps_running_sums_walk(&estimator->c2.sums, snapshot, "c2", error)
               : PSPEC_OK);
    PS_TRY(ps_estimator_walk_segments(estimator, snapshot, error));
    return ps_accumulator_walk(estimator->accumulator, snapshot, error);
}
