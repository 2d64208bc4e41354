#include "jobs/quadrature/quadrature_rules.h"

#include "base/memory.h"
#include "base/pieces.h"
#include "rules/kernel/kernel_product.h"
#include "math/linear/cholesky.h"
#include "points/lists/weight_list.h"
#include "rules/optimal_weights.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* ---- the source ---------------------------------------------------------------------------- */

static pspec_status open_source(ps_rules *rules, ps_error *error) {
    const ps_quadrature_question *const question = rules->question;
    if (question->sampler != NULL) {
        ps_sets_options options = ps_limits_sets(&question->limits, question->accuracy.no_skip);
        options.taken = options.memory_limit / 2; /* by sums, rules and their weights */
        return ps_source_sampler(&rules->source, question->sampler, question->num_realizations,
                                 &options, &question->watch, error);
    }
    const ps_source_options options = {.points = question->point_options,
                                       .whole_bytes = UINT64_MAX}; /* rules are whole */
    return ps_source_files(&rules->source, question->paths, question->num_paths, &options, error);
}

/* Whether files have one set or several decides how they are taken. */
static pspec_status read_ahead(ps_rules *rules, ps_error *error) {
    ps_source_part part;
    bool has_set = true;
    while (has_set && rules->num_waiting < PS_RULES_AHEAD) {
        PS_TRY(ps_source_next(rules->source, &rules->waiting[rules->num_waiting], &part, &has_set,
                              error));
        rules->num_waiting += has_set ? 1 : 0;
    }
    return rules->num_waiting > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "there are no point sets to integrate with");
}

pspec_status ps_rules_open(ps_rules *rules, ps_rule_shape *shape, ps_error *error) {
    const ps_quadrature_question *const question = rules->question;
    *shape = (ps_rule_shape){0};
    PS_TRY(open_source(rules, error));
    if (question->sampler != NULL) {
        shape->num_points = question->sampler->num_points;
        shape->most_points = ps_sampler_most_points(question->sampler);
        shape->num_sets = question->num_realizations;
    } else {
        PS_TRY(read_ahead(rules, error));
        shape->num_points = rules->waiting[0].num_points;
        shape->most_points = shape->num_points;
        /* A set alone has ways of its own in some engines, wherever it came from. */
        shape->num_sets = rules->num_waiting > 1 ? question->num_realizations : 1;
    }
    return question->weights.path == NULL
               ? PSPEC_OK
               : ps_read_weights(question->weights.path, shape->num_points, &rules->file_weights,
                                 &rules->num_file_weights, error);
}

static void free_batch(ps_rules *rules) {
    for (size_t i = 0; i < rules->capacity; i++) {
        ps_point_set_free(&rules->batch[i].set);
        free(rules->batch[i].weights);
    }
    free(rules->batch);
    free(rules->patterns);
    rules->batch = NULL;
    rules->patterns = NULL;
    rules->capacity = 0;
}

void ps_rules_free(ps_rules *rules) {
    ps_source_destroy(rules->source);
    free(rules->file_weights);
    free(rules->places);
    for (size_t i = 0; i < PS_RULES_AHEAD; i++) {
        ps_point_set_free(&rules->waiting[i]);
    }
    free_batch(rules);
    *rules = (ps_rules){0};
}

pspec_status ps_rules_rewind(ps_rules *rules, ps_error *error) {
    rules->num_waiting = 0;
    rules->num_taken = 0;
    rules->num_read = 0;
    rules->facts = (ps_rule_facts){0};
    return ps_source_rewind(rules->source, error);
}

pspec_status ps_rules_allocate(ps_rules *rules, size_t capacity, ps_error *error) {
    free_batch(rules);
    PS_TRY(PS_NEW(&rules->patterns, capacity, "rules", error));
    PS_TRY(PS_NEW(&rules->batch, capacity, "rules", error));
    rules->capacity = capacity;
    return PSPEC_OK;
}

static pspec_status read_set(ps_rules *rules, ps_point_set *set, bool *has_set, ps_error *error) {
    ps_source_part part;
    if (rules->num_taken < rules->num_waiting) {
        ps_point_set *const waiting = &rules->waiting[rules->num_taken++];
        const ps_point_set kept = *set;
        *set = *waiting;
        *waiting = kept;
        *has_set = true;
        return PSPEC_OK;
    }
    return ps_source_next(rules->source, set, &part, has_set, error);
}

/* ---- points -------------------------------------------------------------------------------- */

static pspec_status reserve(ps_weighted_rule *rule, ps_error *error) {
    const size_t num = rule->set.num_points;
    if (num > rule->capacity) {
        free(rule->weights);
        rule->weights = NULL;
        PS_TRY(PS_NEW(&rule->weights, num * 2, "weights", error));
        rule->kappa = rule->weights + num;
        rule->capacity = num;
    }
    return PSPEC_OK;
}

/* Those of the set, before any point is dropped; 1 where there are none. */
static pspec_status copy_weights(const ps_rules *rules, ps_weighted_rule *rule, bool *is_equal,
                                 ps_error *error) {
    const size_t num = rule->set.num_points;
    const double *given = rule->set.has_weights ? rule->set.weights : NULL;
    if (rules->file_weights != NULL) {
        if (rules->num_file_weights != num) {
            return ps_fail(error, PSPEC_ERROR_INPUT, "%s has %zu weights for %zu points",
                           rules->question->weights.path, rules->num_file_weights, num);
        }
        given = rules->file_weights;
    }
    *is_equal = rules->question->weights.kind == PS_WEIGHTS_EQUAL || given == NULL;
    for (size_t j = 0; j < num; j++) {
        rule->weights[j] = *is_equal ? 1 : given[j];
    }
    return PSPEC_OK;
}

static pspec_status refuse(const ps_rules *rules, size_t j, double z, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "point %zu of set %llu, z = %.17g, is below the horizon, where this BRDF is 0; "
                   "--drop-below-horizon leaves such points out",
                   j + 1, (unsigned long long)rules->num_read + 1, z);
}

/* Files may have vectors whose length is 1 within 1e-6: they stand for their directions. */
static void straighten(double u[3]) {
    const double square = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    if (fabs(square - 1) > 4 * DBL_EPSILON) {
        const double length = sqrt(square);
        for (int i = 0; i < 3; i++) {
            u[i] /= length;
        }
    }
}

static pspec_status accept_points(ps_rules *rules, ps_weighted_rule *rule, ps_error *error) {
    const bool is_cut = !ps_brdf_is_below_horizon(rules->question->brdf);
    double *const points = rule->set.points;
    size_t kept = 0;
    for (size_t j = 0; j < rule->set.num_points; j++) {
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
        straighten(points + 3 * kept);
        if (rules->places != NULL) {
            rules->places[kept] = j;
        }
        rule->weights[kept++] = rule->weights[j];
    }
    rules->facts.num_dropped += rule->set.num_points - kept;
    rule->set.num_points = kept;
    return kept > 0 ? PSPEC_OK
                    : ps_fail(error, PSPEC_ERROR_INPUT,
                              "no point of set %llu is above the horizon, where this BRDF is not 0",
                              (unsigned long long)rules->num_read + 1);
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

static void add_facts(ps_rule_facts *facts, const ps_kernel_facts *found, size_t num_points) {
    facts->largest_condition = fmax(facts->largest_condition, found->condition);
    facts->is_ill_conditioned |= found->is_ill_conditioned;
    facts->has_matrices |= found->is_dense;
    facts->most_steps = found->num_steps > facts->most_steps ? found->num_steps : facts->most_steps;
    facts->largest_residual = fmax(facts->largest_residual, found->residual);
    facts->num_duplicates += num_points - found->num_distinct;
}

static pspec_status find_optimal(ps_rules *rules, const ps_representer *representer,
                                 ps_weighted_rule *rule, ps_error *error) {
    ps_optimal_weights found;
    const size_t num = rule->set.num_points;
    const phase weights = {&rules->question->watch, "weights"};
    const ps_watch watch = watch_phase(&weights);
    const ps_kernel_options options = {.watch = &watch,
                                       .memory_limit =
                                           rules->question->limits.constraints.memory_limit,
                                       .device = rules->device};
    PS_TRY(ps_optimal_weights_find(representer, num, rule->set.points, rule->kappa,
                                   rules->question->weights.sum_to_one, &options, rule->weights,
                                   &found, error));
    add_facts(&rules->facts, &found.facts, num);
    return PSPEC_OK;
}

/* E^2 is of degree two in the weights, and its standard error of degree four. */
static pspec_status check_largest(const ps_weighted_rule *rule, uint64_t set, ps_error *error) {
    double largest = 0;
    for (size_t j = 0; j < rule->set.num_points; j++) {
        largest = fabs(rule->weights[j]) > largest ? fabs(rule->weights[j]) : largest;
    }
    return ps_pattern_check_largest(largest, set, error);
}

static pspec_status reserve_places(ps_rules *rules, const ps_weighted_rule *rule, ps_error *error) {
    if (!rules->question->keeps_weights) {
        return PSPEC_OK;
    }
    rules->num_given = rule->set.num_points;
    free(rules->places);
    rules->places = NULL;
    return PS_NEW(&rules->places, rules->num_given, "places of points", error);
}

static void count_points(ps_rule_facts *facts, uint64_t num_points) {
    const bool is_first = facts->num_points == 0;
    facts->num_points += num_points;
    facts->smallest_points =
        is_first || num_points < facts->smallest_points ? num_points : facts->smallest_points;
    facts->largest_points = num_points > facts->largest_points ? num_points : facts->largest_points;
}

/* Points and weights of a set that was just read. */
static pspec_status begin_rule(ps_rules *rules, ps_weighted_rule *rule, ps_error *error) {
    bool is_equal = false;
    count_points(&rules->facts, rule->set.num_points);
    PS_TRY(reserve_places(rules, rule, error));
    PS_TRY(reserve(rule, error));
    PS_TRY(copy_weights(rules, rule, &is_equal, error));
    PS_TRY(accept_points(rules, rule, error));
    for (size_t j = 0; is_equal && j < rule->set.num_points; j++) {
        rule->weights[j] = 1 / (double)rule->set.num_points;
    }
    return rules->question->weights.kind == PS_WEIGHTS_OPTIMAL
               ? PSPEC_OK
               : check_largest(rule, rules->num_read, error);
}

/* watch: NULL where small rules are done side by side. */
static pspec_status find_kernel_form(const ps_representer *representer, ps_weighted_rule *rule,
                                     const ps_watch *watch, ps_error *error) {
    const phase e = {watch, "E"};
    const ps_watch told = watch != NULL ? watch_phase(&e) : (ps_watch){0};
    const ps_rule view = {rule->set.num_points, rule->set.points, rule->weights};
    rule->weight = ps_rule_weight_sums(&view);
    return ps_kernel_error_of(representer, &view, rule->kappa, &told, &rule->kernel, error);
}

typedef struct work {
    const ps_rules *rules;
    const ps_representer *representer;
} work;

/* What a rule gives does not depend on who does it. */
static void do_small(void *payload, size_t r) {
    const work *const shared = payload;
    ps_weighted_rule *const rule = &shared->rules->batch[r];
    ps_representer_kappa(shared->representer, rule->set.num_points, rule->set.points, rule->kappa);
    rule->is_complete = shared->rules->question->weights.kind != PS_WEIGHTS_OPTIMAL &&
                        find_kernel_form(shared->representer, rule, NULL, NULL) == PSPEC_OK;
}

/* kappa, of a number of points at a time. */
static pspec_status find_kappa(const ps_rules *rules, const ps_representer *representer,
                               ps_weighted_rule *rule, ps_error *error) {
    enum { TERMS = 1 << 26, UNIT = 1024 }; /* some hundredths of a second; whole groups of lanes */
    const size_t num = rule->set.num_points;
    const size_t at_a_time = (TERMS / (representer->num_terms + 1) / UNIT + 1) * UNIT;
    rule->is_complete = false;
    for (size_t begin = 0; begin < num; begin += at_a_time) {
        const size_t left = num - begin;
        PS_TRY(ps_watch_tell(&rules->question->watch, "points of the integral with the kernel",
                             begin, num, NULL, error));
        ps_representer_kappa(representer, left < at_a_time ? left : at_a_time,
                             rule->set.points + 3 * begin, rule->kappa + begin);
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
        const size_t num = rules->batch[r].set.num_points;
        most = num > most ? num : most;
        num_pairs += num * (num / 2 + 1);
    }
    if (most <= SMALL) {
        PS_TRY(
            ps_pieces_share(watch, "rules", num_pairs, rules->num, do_small, (void *)&all, error));
    }
    for (size_t r = 0; r < rules->num; r++) {
        ps_weighted_rule *const rule = &rules->batch[r];
        PS_TRY(most > SMALL ? find_kappa(rules, representer, rule, error) : PSPEC_OK);
        if (rules->question->weights.kind == PS_WEIGHTS_OPTIMAL) {
            PS_TRY(find_optimal(rules, representer, rule, error));
        }
        PS_TRY(rule->is_complete ? PSPEC_OK : find_kernel_form(representer, rule, watch, error));
    }
    return PSPEC_OK;
}

static pspec_status read_batch(ps_rules *rules, uint64_t num_rules, ps_error *error) {
    const uint64_t most = num_rules < rules->capacity ? num_rules : rules->capacity;
    for (rules->num = 0; rules->num < most && rules->num_read < rules->most; rules->num++) {
        ps_weighted_rule *const rule = &rules->batch[rules->num];
        bool has_set = false;
        PS_TRY(read_set(rules, &rule->set, &has_set, error));
        if (!has_set) {
            return PSPEC_OK;
        }
        PS_TRY(begin_rule(rules, rule, error));
        rules->patterns[rules->num] =
            (pspec_pattern){3, rule->set.num_points, rule->set.points, rule->weights};
        rules->num_read++;
    }
    return PSPEC_OK;
}

pspec_status ps_rules_next(ps_rules *rules, const ps_representer *representer, uint64_t num_rules,
                           ps_error *error) {
    PS_TRY(read_batch(rules, num_rules, error));
    return complete(rules, representer, error);
}
