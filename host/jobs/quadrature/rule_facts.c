/* What rules have for the result beside sums: of all that were added. */
#include "jobs/quadrature/quadrature_rules.h"

#include <math.h>

static uint64_t least(uint64_t a, uint64_t b) {
    return a < b ? a : b;
}

static uint64_t greatest(uint64_t a, uint64_t b) {
    return a > b ? a : b;
}

void ps_rule_facts_join(ps_rule_facts *facts, const ps_rule_facts *rule) {
    const bool is_first = facts->num_points == 0;
    facts->num_points += rule->num_points;
    facts->smallest_points =
        is_first ? rule->num_points : least(facts->smallest_points, rule->num_points);
    facts->largest_points = greatest(facts->largest_points, rule->num_points);
    facts->num_dropped += rule->num_dropped;
    facts->num_duplicates += rule->num_duplicates;
    facts->largest_condition = fmax(facts->largest_condition, rule->largest_condition);
    facts->is_ill_conditioned |= rule->is_ill_conditioned;
    facts->has_matrices |= rule->has_matrices;
    facts->most_steps = (size_t)greatest(facts->most_steps, rule->most_steps);
    facts->largest_residual = fmax(facts->largest_residual, rule->largest_residual);
}

pspec_status ps_rule_facts_walk(ps_rule_facts *facts, ps_snapshot *snapshot, ps_error *error) {
    double *const numbers[] = {&facts->largest_condition, &facts->largest_residual};
    enum { POINTS, SMALLEST, LARGEST, DROPPED, DUPLICATES, ILL, MATRICES, STEPS, NUM };
    uint64_t counts[NUM] = {facts->num_points,   facts->smallest_points, facts->largest_points,
                            facts->num_dropped,  facts->num_duplicates,  facts->is_ill_conditioned,
                            facts->has_matrices, facts->most_steps};
    PS_TRY(ps_snapshot_gather(snapshot, "rule_facts", numbers, 2, error));
    PS_TRY(ps_snapshot_counts(snapshot, "rule_counts", counts, NUM, error));
    facts->num_points = counts[POINTS];
    facts->smallest_points = counts[SMALLEST];
    facts->largest_points = counts[LARGEST];
    facts->num_dropped = counts[DROPPED];
    facts->num_duplicates = counts[DUPLICATES];
    facts->is_ill_conditioned = counts[ILL] != 0;
    facts->has_matrices = counts[MATRICES] != 0;
    facts->most_steps = (size_t)counts[STEPS];
    return PSPEC_OK;
}
