#include "jobs/quadrature/quadrature_rules.h"

#include "base/memory.h"
#include "base/pieces.h"
#include "math/linear/cholesky.h"
#include "points/lists/weight_list.h"
#include "rules/optimal_weights.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- the source ---------------------------------------------------------------------------- */

static pspec_status open_source(ps_rules *rules, ps_error *error) {
    const ps_quadrature_question *const question = rules->question;
    ps_source **const source = &rules->sets.source;
    if (question->sampler != NULL) {
        ps_sets_options options = ps_limits_sets(&question->limits, question->accuracy.no_skip);
        options.taken = options.memory_limit / 2; /* by sums, rules and their weights */
        return ps_source_sampler(source, question->sampler, question->num_realizations, &options,
                                 &question->watch, error);
    }
    const ps_source_options options = {.points = question->point_options,
                                       .whole_bytes = UINT64_MAX}; /* rules are whole */
    return ps_source_files(source, question->paths, question->num_paths, &options, error);
}

/* Whether files have one set or several decides how they are taken. */
static pspec_status read_ahead(ps_rules *rules, bool *is_last, ps_error *error) {
    bool has_set = false;
    PS_TRY(ps_power_sets_peek(&rules->sets, &has_set, error));
    return has_set ? ps_power_sets_is_last(&rules->sets, is_last, error)
                   : ps_fail(error, PSPEC_ERROR_INPUT, "there are no point sets to integrate with");
}

/* Directions that every rule has beside its points. */
static size_t num_cut(const ps_quadrature_question *question) {
    return question->horizon != NULL ? question->horizon->num : 0;
}

pspec_status ps_rules_open(ps_rules *rules, ps_rule_shape *shape, ps_error *error) {
    const ps_quadrature_question *const question = rules->question;
    const ps_sampler_request *const sampler = question->sampler;
    bool is_last = false;
    PS_TRY(open_source(rules, error));
    if (sampler != NULL) {
        *shape = (ps_rule_shape){sampler->num_points, ps_sampler_most_points(sampler),
                                 question->num_realizations};
    } else {
        PS_TRY(read_ahead(rules, &is_last, error));
        const size_t num = rules->sets.next.num_points;
        /* A set alone has ways of its own in some engines, wherever it came from. */
        *shape = (ps_rule_shape){num, num, is_last ? 1 : question->num_realizations};
    }
    if (question->weights.path != NULL) {
        PS_TRY(ps_power_sets_read_weights(&rules->sets, question->weights.path, shape->num_points,
                                          error));
    }
    shape->num_points += num_cut(question);
    shape->most_points += num_cut(question);
    return PSPEC_OK;
}

static void free_batch(ps_rules *rules) {
    for (size_t i = 0; i < rules->capacity; i++) {
        free(rules->batch[i].weights);
    }
    free(rules->batch);
    rules->batch = NULL;
    rules->capacity = 0;
}

void ps_rules_free(ps_rules *rules) {
    ps_power_sets_free(&rules->sets);
    free(rules->places);
    free_batch(rules);
    ps_kernel_product_destroy(rules->distances);
    *rules = (ps_rules){0};
}

pspec_status ps_rules_rewind(ps_rules *rules, ps_error *error) {
    rules->num_read = 0;
    return ps_power_sets_rewind(&rules->sets, error);
}

pspec_status ps_rules_allocate(ps_rules *rules, size_t capacity, ps_error *error) {
    free_batch(rules);
    PS_TRY(ps_power_sets_allocate(&rules->sets, capacity, error));
    PS_TRY(PS_NEW(&rules->batch, capacity, "rules", error));
    rules->capacity = capacity;
    return PSPEC_OK;
}

/* ---- points -------------------------------------------------------------------------------- */

static pspec_status reserve(ps_weighted_rule *rule, size_t num, ps_error *error) {
    if (num > rule->capacity) {
        free(rule->weights);
        rule->weights = NULL;
        PS_TRY(PS_NEW(&rule->weights, num * 2, "weights", error));
        rule->kappa = rule->weights + num;
        rule->capacity = num;
    }
    return PSPEC_OK;
}

static pspec_status refuse(const ps_rules *rules, size_t j, double z, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "point %zu of set %llu, z = %.17g, is below the horizon, where this BRDF is 0; "
                   "--drop-below-horizon leaves such points out",
                   j + 1, (unsigned long long)rules->num_read + 1, z);
}

static pspec_status check_left(const ps_rules *rules, size_t kept, ps_error *error) {
    return kept > 0 ? PSPEC_OK
                    : ps_fail(error, PSPEC_ERROR_INPUT,
                              "no point of set %llu is above the horizon, where this BRDF is not 0",
                              (unsigned long long)rules->num_read + 1);
}

/* Leaves those that count, with weights [num_points] where they have any. */
static pspec_status accept_points(ps_rules *rules, ps_rule_facts *facts, ps_point_set *set,
                                  double *weights, ps_error *error) {
    const bool is_cut = !ps_brdf_is_below_horizon(rules->question->brdf);
    double *const points = set->points;
    size_t kept = 0;
    for (size_t j = 0; j < set->num_points; j++) {
        const double *const u = points + 3 * j;
        if (is_cut && !(u[2] >= 0)) {
            if (!rules->question->drops_below_horizon) {
                return refuse(rules, j, u[2], error);
            }
            continue;
        }
        for (int i = 0; i < 3; i++) {
            points[3 * kept + (size_t)i] = u[i];
        }
        ps_pattern_straighten(points + 3 * kept);
        if (rules->places != NULL) {
            rules->places[kept] = j;
        }
        weights[kept++] = weights[j];
    }
    facts->num_dropped = set->num_points - kept;
    set->num_points = kept;
    return check_left(rules, kept, error);
}

/* Puts the part of the lobe that is below the horizon of the normal in the place of the points
 * there. */
static pspec_status cut_at_horizon(const ps_rules *rules, ps_point_set *set, double *weights,
                                   ps_error *error) {
    size_t kept = 0;
    const ps_horizon *const horizon = rules->question->horizon;
    PS_TRY(ps_points_reserve(set, set->num_points + horizon->num, error));
    double *const points = set->points;
    for (size_t j = 0; j < set->num_points; j++) {
        if (ps_horizon_is_above(horizon, points + 3 * j)) {
            memmove(points + 3 * kept, points + 3 * j, 3 * sizeof *points);
            weights[kept++] = weights[j];
        }
    }
    if (horizon->num > 0) {
        memcpy(points + 3 * kept, horizon->points, 3 * horizon->num * sizeof *points);
        memcpy(weights + kept, horizon->weights, horizon->num * sizeof *weights);
    }
    set->num_points = kept + horizon->num;
    return check_left(rules, set->num_points, error);
}

/* ---- weights and kernel form --------------------------------------------------------------- */

/* A phase of work on a rule, by the name of what it is for. */
typedef struct phase {
    const ps_watch *watch;
    const char *purpose;
} phase;

static int tell(const ps_watch_report *report, void *payload) {
    const phase *const work = payload;
    char name[128];
    ps_watch_report named = *report;
    snprintf(name, sizeof name, "%s: %s", work->purpose, report->phase);
    named.phase = name;
    return work->watch->tell(&named, work->watch->payload);
}

/* {0} where nobody listens. */
static ps_watch watch_phase(const phase *work) {
    return work->watch->tell != NULL ? (ps_watch){tell, (void *)work} : (ps_watch){0};
}

static void take_facts(ps_rule_facts *facts, const ps_kernel_facts *found, size_t num_points) {
    facts->largest_condition = found->condition;
    facts->is_ill_conditioned = found->is_ill_conditioned;
    facts->has_matrices = found->is_dense;
    facts->most_steps = found->num_steps;
    facts->largest_residual = found->residual;
    facts->num_duplicates = num_points - found->num_distinct;
}

/* Of rule r of the batch, with a matrix for so many points at most. */
static pspec_status find_weights(ps_rules *rules, const ps_representer *representer, size_t r,
                                 size_t most_dense, ps_optimal_weights *found, ps_error *error) {
    const ps_point_set *const set = &rules->sets.sets[r];
    const ps_weighted_rule *const rule = &rules->batch[r];
    const phase weights = {&rules->question->watch, "weights"};
    const ps_watch watch = watch_phase(&weights);
    const ps_kernel_options options = {.watch = &watch,
                                       .memory_limit =
                                           rules->question->limits.constraints.memory_limit,
                                       .most_dense = most_dense,
                                       .device = rules->device};
    return ps_optimal_weights_find(representer, set->num_points, set->points, rule->kappa,
                                   rules->question->weights.sum_to_one, &options, rule->weights,
                                   found, error);
}

/* Rule r of the batch. A factor is exact in more cases than the iteration that GPUs begin with. */
static pspec_status find_optimal(ps_rules *rules, const ps_representer *representer, size_t r,
                                 ps_error *error) {
    const size_t num = rules->sets.sets[r].num_points;
    const size_t most_dense = ps_kernel_most_dense(rules->device);
    ps_optimal_weights found;
    ps_error own = {0};
    pspec_status status = find_weights(rules, representer, r, most_dense, &found, &own);
    if (status == PSPEC_ERROR_TOLERANCE && num > most_dense && num <= PS_KERNEL_MOST_DENSE) {
        own = (ps_error){0};
        status = find_weights(rules, representer, r, PS_KERNEL_MOST_DENSE, &found, &own);
    }
    PS_TRY(status == PSPEC_OK ? PSPEC_OK : ps_fail(error, status, "%s", own.message));
    take_facts(&rules->batch[r].facts, &found.facts, num);
    return PSPEC_OK;
}

/* E^2 is of degree two in the weights, and its standard error of degree four. */
static pspec_status check_largest(const double *weights, size_t num, uint64_t set,
                                  ps_error *error) {
    double largest = 0;
    for (size_t j = 0; j < num; j++) {
        largest = fabs(weights[j]) > largest ? fabs(weights[j]) : largest;
    }
    return ps_pattern_check_largest(largest, set, error);
}

static pspec_status reserve_places(ps_rules *rules, size_t num, ps_error *error) {
    if (!rules->question->keeps_weights) {
        return PSPEC_OK;
    }
    rules->num_given = num;
    free(rules->places);
    rules->places = NULL;
    return PS_NEW(&rules->places, num, "places of points", error);
}

/* Points and weights of a set that was just read, whose pattern is that of the rule from here on.
 */
static pspec_status begin_rule(ps_rules *rules, size_t r, ps_error *error) {
    const ps_weights_kind kind = rules->question->weights.kind;
    ps_rule_facts *const facts = &rules->batch[r].facts;
    ps_point_set *const set = &rules->sets.sets[r];
    pspec_pattern *const pattern = &rules->sets.patterns[r];
    const bool are_equal = kind == PS_WEIGHTS_EQUAL || pattern->weights == NULL;
    *facts = (ps_rule_facts){.num_points = set->num_points};
    PS_TRY(reserve_places(rules, set->num_points, error));
    PS_TRY(reserve(&rules->batch[r], set->num_points + num_cut(rules->question), error));
    double *const weights = rules->batch[r].weights;
    for (size_t j = 0; j < set->num_points; j++) {
        weights[j] = are_equal ? 1 : pattern->weights[j];
    }
    PS_TRY(accept_points(rules, facts, set, weights, error));
    for (size_t j = 0; are_equal && j < set->num_points; j++) {
        weights[j] = 1 / (double)set->num_points;
    }
    if (rules->question->horizon != NULL) {
        PS_TRY(cut_at_horizon(rules, set, weights, error));
    }
    pattern->num_points = set->num_points;
    pattern->points = set->points;
    pattern->weights = weights;
    return kind == PS_WEIGHTS_OPTIMAL
               ? PSPEC_OK
               : check_largest(weights, set->num_points, rules->num_read, error);
}

/* watch: NULL where small rules are done side by side. */
static pspec_status find_kernel_form(const ps_representer *representer, const ps_rules *rules,
                                     size_t r, const ps_watch *watch, ps_error *error) {
    ps_weighted_rule *const rule = &rules->batch[r];
    const ps_point_set *const set = &rules->sets.sets[r];
    const phase e = {watch, "E"};
    const ps_watch told = watch != NULL ? watch_phase(&e) : (ps_watch){0};
    const ps_rule view = {set->num_points, set->points, rule->weights};
    rule->weight = ps_rule_weight_sums(&view);
    return ps_kernel_error_of(representer, &view, rule->kappa,
                              rule->has_distance ? &rule->distance : NULL, &told, &rule->kernel,
                              error);
}

typedef struct work {
    const ps_rules *rules;
    const ps_representer *representer;
} work;

/* What a rule gives does not depend on who does it. */
static void do_small(void *payload, size_t r) {
    const work *const shared = payload;
    ps_weighted_rule *const rule = &shared->rules->batch[r];
    const ps_point_set *const set = &shared->rules->sets.sets[r];
    ps_representer_kappa(shared->representer, set->num_points, set->points, rule->kappa);
    rule->is_complete =
        shared->rules->question->weights.kind != PS_WEIGHTS_OPTIMAL &&
        find_kernel_form(shared->representer, shared->rules, r, NULL, NULL) == PSPEC_OK;
}

/* kappa, of a number of points at a time. */
static pspec_status find_kappa(const ps_rules *rules, const ps_representer *representer, size_t r,
                               ps_error *error) {
    enum { TERMS = 1 << 26, UNIT = 1024 }; /* some hundredths of a second; whole groups of lanes */
    const ps_point_set *const set = &rules->sets.sets[r];
    const size_t num = set->num_points;
    const size_t at_a_time = (TERMS / (representer->num_terms + 1) / UNIT + 1) * UNIT;
    rules->batch[r].is_complete = false;
    for (size_t begin = 0; begin < num; begin += at_a_time) {
        const size_t left = num - begin;
        PS_TRY(ps_watch_tell(&rules->question->watch, "points of the integral with the kernel",
                             begin, num, NULL, error));
        ps_representer_kappa(representer, left < at_a_time ? left : at_a_time,
                             set->points + 3 * begin, rules->batch[r].kappa + begin);
    }
    return PSPEC_OK;
}

/* kappa and kernel form of the batch: small rules side by side, in large ones pairs of points. */
static pspec_status complete(ps_rules *rules, const ps_representer *representer, ps_error *error) {
    enum { SMALL = 2048 };
    const ps_watch *const watch = &rules->question->watch;
    const work all = {rules, representer};
    size_t most = 1;
    size_t num_pairs = 0;
    for (size_t r = 0; r < rules->num; r++) {
        const size_t num = rules->sets.sets[r].num_points;
        most = num > most ? num : most;
        num_pairs += num * (num / 2 + 1);
    }
    PS_TRY(ps_rules_sum_distances(rules, representer->smoothness, error));
    if (most <= SMALL) {
        PS_TRY(
            ps_pieces_share(watch, "rules", num_pairs, rules->num, do_small, (void *)&all, error));
    }
    for (size_t r = 0; r < rules->num; r++) {
        PS_TRY(most > SMALL ? find_kappa(rules, representer, r, error) : PSPEC_OK);
        if (rules->question->weights.kind == PS_WEIGHTS_OPTIMAL) {
            PS_TRY(find_optimal(rules, representer, r, error));
        }
        PS_TRY(rules->batch[r].is_complete ? PSPEC_OK
                                           : find_kernel_form(representer, rules, r, watch, error));
    }
    return PSPEC_OK;
}

pspec_status ps_rules_next(ps_rules *rules, const ps_representer *representer, uint64_t num_rules,
                           ps_error *error) {
    const uint64_t left = rules->most - rules->num_read;
    PS_TRY(ps_power_sets_fill(&rules->sets, false, num_rules < left ? num_rules : left, &rules->num,
                              error));
    for (size_t r = 0; r < rules->num; r++, rules->num_read++) {
        PS_TRY(begin_rule(rules, r, error));
    }
    return complete(rules, representer, error);
}
