/* Sums of distances of the rules of a batch by a GPU, which the kernel form of worst-case errors
 * needs; on CPUs the threads of the host have half the pairs to do (rules/worst_case_error.h). */
#include "jobs/quadrature/quadrature_rules.h"

#include "base/memory.h"

#include <stdlib.h>

/* A product with room for so many points of a rule, instead of one with less. */
static pspec_status reserve(ps_rules *rules, double smoothness, size_t most_points,
                            ps_error *error) {
    if (ps_kernel_distances_most_points(rules->distances) >= most_points) {
        return PSPEC_OK;
    }
    ps_kernel_product_destroy(rules->distances);
    rules->distances = NULL;
    return ps_kernel_distances_create(&rules->distances, rules->device, smoothness - 1, most_points,
                                      ps_kernel_distances_at_once(most_points), error);
}

/* Rules first .. first + num - 1 of the batch. */
static pspec_status sum_some(ps_rules *rules, size_t first, size_t num, ps_rule *views,
                             double *sums, ps_error *error) {
    for (size_t i = 0; i < num; i++) {
        const ps_point_set *const set = &rules->sets.sets[first + i];
        views[i] = (ps_rule){set->num_points, set->points, rules->batch[first + i].weights};
    }
    PS_TRY(ps_kernel_distances_sum(rules->distances, views, num, sums, error));
    for (size_t i = 0; i < num; i++) {
        rules->batch[first + i].distance = sums[i];
        rules->batch[first + i].has_distance = true;
    }
    return PSPEC_OK;
}

static pspec_status sum_all(ps_rules *rules, size_t at_once, ps_rule *views, double *sums,
                            ps_error *error) {
    for (size_t first = 0; first < rules->num; first += at_once) {
        const size_t left = rules->num - first;
        PS_TRY(ps_watch_tell(&rules->question->watch, "rules", first, rules->num, NULL, error));
        PS_TRY(sum_some(rules, first, left < at_once ? left : at_once, views, sums, error));
    }
    return PSPEC_OK;
}

pspec_status ps_rules_sum_distances(ps_rules *rules, double smoothness, size_t most_points,
                                    ps_error *error) {
    ps_rule *views = NULL;
    double *sums = NULL;
    for (size_t r = 0; r < rules->num; r++) {
        rules->batch[r].has_distance = false;
    }
    if (rules->num == 0 || rules->question->weights.kind == PS_WEIGHTS_OPTIMAL ||
        !ps_kernel_distances_pay(rules->device, most_points)) {
        return PSPEC_OK;
    }
    PS_TRY(reserve(rules, smoothness, most_points, error));
    /* as many as there is room for of the largest rules so far */
    const size_t at_once =
        ps_kernel_distances_at_once(ps_kernel_distances_most_points(rules->distances));
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, PS_NEW(&views, at_once, "rules", error));
    PS_TRY_OUT(status, PS_NEW(&sums, at_once, "sums of distances", error));
    status = sum_all(rules, at_once, views, sums, error);
out:
    free(views);
    free(sums);
    return status;
}
