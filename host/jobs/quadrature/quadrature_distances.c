/* Sums of distances of the rules of a batch by a GPU, which the kernel form of worst-case errors
 * needs; on CPUs the threads of the host have half the pairs to do (rules/worst_case_error.h). */
#include "jobs/quadrature/quadrature_rules.h"

#include "base/memory.h"

#include <stdlib.h>

static size_t points_of(const ps_rules *rules, size_t r) {
    return rules->sets.sets[r].num_points;
}

/* Each for itself: what a rule gives depends on no other. */
static bool is_summed(const ps_rules *rules, size_t r) {
    return ps_kernel_distances_pay(rules->device, points_of(rules, r));
}

/* A product with room for so many points of a rule, instead of one with less. */
static pspec_status reserve(ps_rules *rules, double smoothness, size_t most_points,
                            ps_error *error) {
    if (ps_kernel_distances_most_points(rules->distances) >= most_points) {
        return PSPEC_OK;
    }
    ps_kernel_product_destroy(rules->distances);
    rules->distances = NULL;
    return ps_kernel_distances_create(&rules->distances, rules->device, smoothness - 1, most_points,
                                      ps_kernel_distances_at_once(most_points, rules->capacity),
                                      error);
}

/* Some rules of the batch, by their numbers. */
static pspec_status sum_some(ps_rules *rules, const size_t *which, size_t num, ps_rule *views,
                             double *sums, ps_error *error) {
    for (size_t i = 0; i < num; i++) {
        const ps_point_set *const set = &rules->sets.sets[which[i]];
        views[i] = (ps_rule){set->num_points, set->points, rules->batch[which[i]].weights};
    }
    PS_TRY(ps_kernel_distances_sum(rules->distances, views, num, sums, error));
    for (size_t i = 0; i < num; i++) {
        rules->batch[which[i]].distance = sums[i];
        rules->batch[which[i]].has_distance = true;
    }
    return PSPEC_OK;
}

/* The num rules that are numbered so. */
static pspec_status sum_all(ps_rules *rules, const size_t *which, size_t num, ps_error *error) {
    const size_t at_once = ps_kernel_distances_most_rules(rules->distances);
    ps_rule *views = NULL;
    double *sums = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, PS_NEW(&views, at_once, "rules", error));
    PS_TRY_OUT(status, PS_NEW(&sums, at_once, "sums of distances", error));
    for (size_t first = 0; first < num; first += at_once) {
        const size_t left = num - first, own = left < at_once ? left : at_once;
        PS_TRY_OUT(status,
                   ps_watch_tell(&rules->question->watch, "rules", first, num, NULL, error));
        PS_TRY_OUT(status, sum_some(rules, which + first, own, views, sums, error));
    }
out:
    free(views);
    free(sums);
    return status;
}

pspec_status ps_rules_sum_distances(ps_rules *rules, double smoothness, ps_error *error) {
    const bool is_asked = rules->question->weights.kind != PS_WEIGHTS_OPTIMAL; /* known later */
    size_t *which = NULL;
    size_t num = 0;
    size_t most_points = 1;
    PS_TRY(PS_NEW(&which, rules->num + 1, "rules", error));
    for (size_t r = 0; r < rules->num; r++) {
        rules->batch[r].has_distance = false;
        if (is_asked && is_summed(rules, r)) {
            which[num++] = r;
            most_points = points_of(rules, r) > most_points ? points_of(rules, r) : most_points;
        }
    }
    pspec_status status = PSPEC_OK;
    if (num > 0) {
        status = reserve(rules, smoothness, most_points, error);
    }
    if (num > 0 && status == PSPEC_OK) {
        status = sum_all(rules, which, num, error);
    }
    free(which);
    return status;
}
