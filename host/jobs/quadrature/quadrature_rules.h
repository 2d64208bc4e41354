/* The rules of a quadrature job on their way from the source: points above the horizon, weights,
 * kernel form. */
#ifndef PS_JOBS_QUADRATURE_QUADRATURE_RULES_H
#define PS_JOBS_QUADRATURE_QUADRATURE_RULES_H

#include "jobs/quadrature/quadrature_setup.h"
#include "jobs/spectrum/power_sets.h"
#include "rules/kernel/kernel_product.h"
#include "rules/worst_case_error.h"

/* For the result: of a rule, or of all that were added. */
typedef struct ps_rule_facts {
    /* Points that rules were given with, in all, and of the smallest and the largest */
    uint64_t num_points, smallest_points, largest_points;
    uint64_t num_dropped, num_duplicates;
    double largest_condition; /* 0 without optimal weights */
    bool is_ill_conditioned, has_matrices;
    size_t most_steps; /* of conjugate gradients */
    double largest_residual;
} ps_rule_facts;

/* Of a set of points. */
typedef struct ps_weighted_rule {
    double *weights, *kappa; /* [capacity] in one block */
    size_t capacity;
    ps_weight_sums weight;
    double distance; /* of the kernel form, where a device has summed it */
    bool has_distance;
    ps_kernel_error kernel;
    bool is_complete; /* with its kernel form */
    ps_rule_facts facts;
} ps_weighted_rule;

typedef struct ps_rules {
    const ps_quadrature_question *question;
    /* for systems without a matrix, and on GPUs sums of distances; NULL: none. Borrowed, set before
     * the first batch */
    ps_device *device;
    ps_kernel_product *distances; /* on GPUs; NULL: none yet */
    ps_power_sets sets;           /* points, which are whole, and weights of a file */
    ps_weighted_rule *batch;      /* [capacity] of these */
    size_t capacity, num;         /* rules in batch */
    uint64_t num_read, most;      /* rules; others are left unread */
    size_t *places;   /* [num_given] of the points of the only rule that are kept, where its */
    size_t num_given; /* weights are, too: points that it was given with */
} ps_rules;

/* {.question}: opens the source and says what is known of the rules. Freed by ps_rules_free, also
 * after an error. */
pspec_status ps_rules_open(ps_rules *rules, ps_rule_shape *shape, ps_error *error) PS_MUST_CHECK;
void ps_rules_free(ps_rules *rules);
/* Room for batches of so many, instead of what there was. */
pspec_status ps_rules_allocate(ps_rules *rules, size_t capacity, ps_error *error) PS_MUST_CHECK;
/* The next batch, complete, of num_rules at most, and of rules->most in all; rules->num is 0 behind
 * the last. */
pspec_status ps_rules_next(ps_rules *rules, const ps_representer *representer, uint64_t num_rules,
                           ps_error *error) PS_MUST_CHECK;
/* On a GPU sums the distances of rules of the batch (quadrature_distances.c). */
pspec_status ps_rules_sum_distances(ps_rules *rules, double smoothness,
                                    ps_error *error) PS_MUST_CHECK;
/* Adds those of a rule to those of the rules before; {0} before the first. */
void ps_rule_facts_join(ps_rule_facts *facts, const ps_rule_facts *rule);
/* To a checkpoint or from one. */
pspec_status ps_rule_facts_walk(ps_rule_facts *facts, ps_snapshot *snapshot,
                                ps_error *error) PS_MUST_CHECK;
/* Back to the first rule. */
pspec_status ps_rules_rewind(ps_rules *rules, ps_error *error) PS_MUST_CHECK;

#endif
