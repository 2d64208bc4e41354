#include "jobs/quadrature/quadrature_setup.h"

#include "files/input_file.h"
#include "jobs/quadrature/quadrature_needs.h"
#include "jobs/quadrature/quadrature_rules.h"
#include "math/pi.h"
#include "math/sobolev.h"
#include "rules/distance_split.h"
#include "store/figures_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- degrees ------------------------------------------------------------------------------- */

/* 4 sqrt N, as for a spectrum: beyond it rules of N points have C_l^2 like random ones. */
static size_t most_degrees(size_t num_points) {
    const double times = 4;
    return (size_t)fmin(ceil(times * sqrt((double)num_points)), PS_MAX_DEGREE);
}

/* E^2 beyond degree L is at most that, for sum |w| = 1 (docs/mathematics/quadrature.md#tail). */
static double bound_tail(const ps_representer *representer, size_t last) {
    double half_width = 0;
    const double rest = ps_representer_rest(representer, last, &half_width);
    const double root =
        sqrt(ps_sobolev_tail(representer->smoothness, last, representer->a[last + 1])) +
        sqrt(rest + half_width);
    return root * root;
}

/* Bounds fall with the degree. */
static size_t find_degree(const ps_representer *representer, size_t most, double wanted) {
    size_t low = 0;
    size_t high = most;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (bound_tail(representer, middle) <= wanted) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return high;
}

static void choose_degrees(ps_quadrature_setup *out, double tolerance, size_t most) {
    const double wanted = tolerance * out->representer.constant;
    const size_t last = find_degree(&out->representer, most, wanted);
    const double bound = bound_tail(&out->representer, last);
    out->max_degree = last;
    out->beyond_bound = bound;
    if (bound <= wanted) {
        snprintf(out->degrees_note, sizeof out->degrees_note,
                 "%zu, where what is beyond, at most %.3g of E^2, meets the tolerance %.3g", last,
                 bound, wanted);
        return;
    }
    const double power =
        2 * out->representer.smoothness - 2; /* of the tail, which goes as L^-power */
    snprintf(out->degrees_note, sizeof out->degrees_note,
             "%zu = 4 sqrt N: the bound of the rest, %.3g, meets the tolerance %.3g near degree "
             "%.1g only; -l asks for more, and E has all degrees in any case",
             last, bound, wanted, (double)last * pow(bound / wanted, 1 / power));
}

/* ---- engine -------------------------------------------------------------------------------- */

/* N Q(l) of points with the density of the lobe is 1 + (N - 1) 4 pi / (2l + 1) b_l^2: what the
 * errors of engines that sum squares depend on, with a margin. */
static double expect_power(const ps_representer *representer, size_t last, size_t num_points) {
    const double margin = 2;
    double sum = 0;
    for (size_t l = 1; l <= last; l++) {
        sum += PS_FOUR_PI / (2 * (double)l + 1) * representer->b[l] * representer->b[l];
    }
    return margin * (1 + (double)(num_points - 1) * sum / (double)last);
}

static bool is_for_pairs(const char *name) {
    for (size_t i = 0; name != NULL && ps_engines[i] != NULL; i++) {
        if (strcmp(ps_engines[i]->name, name) == 0) {
            return ps_engines[i]->sums_pairs;
        }
    }
    return false;
}

static ps_problem make_problem(const ps_quadrature_setup *setup,
                               const ps_quadrature_question *question, const ps_rule_shape *shape) {
    /* |dc_lm| is e relative to white noise: Q is then off by 4 e at most */
    const double amplitudes = 4;
    return (ps_problem){
        .frequencies = &setup->frequencies,
        .num_points = shape->most_points,
        .planned_points = shape->num_points,
        .num_realizations = setup->planned_realizations,
        .has_weights = true,
        .making_bytes = question->sampler != NULL ? ps_sampler_work_bytes(question->sampler) : 0,
        .measure = setup->by_pairs ? PS_OF_PAIR_SUMS : PS_OF_AMPLITUDES,
        .tolerance = setup->by_pairs ? question->accuracy.tolerance
                                     : question->accuracy.tolerance / amplitudes,
        .expected_power = setup->by_pairs ? expect_power(&setup->representer, setup->max_degree,
                                                         shape->num_points)
                                          : 0};
}

static pspec_status open_device(ps_quadrature_setup *out, const ps_quadrature_question *question,
                                ps_error *error) {
    if (out->device != NULL || !ps_plan_may_need_device(&question->limits.constraints)) {
        return PSPEC_OK;
    }
    out->device = question->open_device;
    if (out->device != NULL) {
        return PSPEC_OK;
    }
    const pspec_status status =
        ps_figures_open_device(&out->device, question->limits.device, question->limits.profile,
                               question->limits.cache_folder, error);
    out->owns_device = status == PSPEC_OK;
    return status == PSPEC_ERROR_NO_DEVICE && question->may_lack_device ? PSPEC_OK : status;
}

pspec_status ps_quadrature_setup_begin(ps_quadrature_setup *out,
                                       const ps_quadrature_question *question, ps_error *error) {
    *out = (ps_quadrature_setup){0};
    PS_TRY(ps_plan_check_engine(question->limits.constraints.engine, PS_ON_SPHERE, error));
    PS_TRY(ps_points_check(question->paths, question->num_paths, &question->point_options, error));
    PS_TRY(ps_inputs_check(&question->weights.path, 1, error));
    return question->limits.device != NULL ? open_device(out, question, error) : PSPEC_OK;
}

static pspec_status plan_engine(ps_quadrature_setup *out, const ps_quadrature_question *question,
                                const ps_rule_shape *shape, ps_error *error) {
    PS_TRY(ps_frequencies_degrees(&out->frequencies, (int64_t)out->max_degree, false, error));
    PS_TRY(ps_frequencies_enumerate(&out->frequencies, error));
    PS_TRY(open_device(out, question, error));
    out->problem = make_problem(out, question, shape);
    return ps_quadrature_needs_plan(out, question, 0, error);
}

pspec_status ps_quadrature_setup_plan_again(ps_quadrature_setup *setup,
                                            const ps_quadrature_question *question, uint64_t held,
                                            ps_error *error) {
    ps_quadrature_needs_find(setup, question); /* with none of what the plan before has skipped */
    return ps_quadrature_needs_plan(setup, question, held, error);
}

pspec_status ps_quadrature_setup_make(ps_quadrature_setup *out,
                                      const ps_quadrature_question *question,
                                      const ps_rule_shape *shape, ps_error *error) {
    const size_t most = most_degrees(shape->num_points);
    const size_t asked = question->max_degree;
    out->max_degree = asked > 0 ? asked : most;
    out->most_degree = out->max_degree;
    out->num_sets = shape->num_sets;
    ps_quadrature_needs_find(out, question);
    const bool has_several = out->num_realizations != 1;
    const double accuracy = ps_quadrature_needs_accuracy(out, question, has_several);
    out->by_pairs = has_several || is_for_pairs(question->limits.constraints.engine);
    PS_TRY(ps_representer_create(&out->representer, question->brdf, question->smoothness, accuracy,
                                 2 * out->most_degree, error));
    if (asked == 0 && !question->accuracy.no_skip) {
        choose_degrees(out, question->accuracy.tolerance, most);
    }
    ps_quadrature_needs_terms(out, accuracy);
    PS_TRY(plan_engine(out, question, shape, error));
    ps_rules_plan_weights(question, shape->num_points, out->device, out->weights_note,
                          sizeof out->weights_note);
    return PSPEC_OK;
}

/* Points that lie together leave more pairs than those of samplers: where they are known they are
 * counted. For the seconds that plan prints alone. */
static pspec_status count_distances(ps_quadrature_setup *out, const ps_rules *rules,
                                    ps_error *error) {
    enum { DIMENSION = 3 };
    const ps_point_set *const set = &rules->waiting[0];
    if (rules->num_waiting == 0 || set->dimension != DIMENSION) {
        return PSPEC_OK;
    }
    const ps_rule rule = {.num_points = set->num_points, .points = set->points};
    return ps_distance_count_of(&rule, &out->num_distances, error);
}

pspec_status ps_quadrature_setup_ask(ps_quadrature_setup *out,
                                     const ps_quadrature_question *question, ps_error *error) {
    ps_rules rules = {.question = question};
    ps_rule_shape shape;
    pspec_status status = ps_quadrature_setup_begin(out, question, error);
    if (status == PSPEC_OK) {
        status = ps_rules_open(&rules, &shape, error);
    }
    if (status == PSPEC_OK) {
        status = ps_quadrature_setup_make(out, question, &shape, error);
    }
    if (status == PSPEC_OK) {
        status = count_distances(out, &rules, error);
    }
    if (status == PSPEC_OK) {
        status = ps_quadrature_needs_rate(out, question, error);
    }
    ps_rules_free(&rules);
    return status;
}

void ps_quadrature_setup_free(ps_quadrature_setup *setup) {
    ps_representer_destroy(&setup->representer);
    ps_frequencies_free(&setup->frequencies);
    if (setup->owns_device) {
        ps_device_close(setup->device);
    }
}
