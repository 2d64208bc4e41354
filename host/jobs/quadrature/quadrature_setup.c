#include "jobs/quadrature/quadrature_setup.h"

#include "files/input_file.h"
#include "math/pi.h"
#include "math/sobolev.h"
#include "rules/distance_split.h"
#include "rules/kernel/kernel_product.h"
#include "plan/cost_model.h"
#include "spectra/sequential.h"

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

/* ---- realizations -------------------------------------------------------------------------- */

/* Independent coefficients of degree 1, of degree 0 none is left where weights sum to 1. */
static const double fewest_independent = 1.5;

/* From the question and setup->num_sets. Sets num_realizations, too. */
static void find_needs(ps_quadrature_setup *setup, const ps_quadrature_question *question) {
    const ps_sampler_request *const sampler = question->sampler;
    const double expected =
        ps_sequential_expected(fewest_independent, question->accuracy.standard_error);
    const ps_needs_question needs = {.on_sphere = true,
                                     /* c_l0 and C_l^2 turn with the set */
                                     .has_constant_power = sampler != NULL &&
                                                           !sampler->homogenize &&
                                                           ps_sampler_has_constant_power(sampler),
                                     .num_realizations = setup->num_sets,
                                     .accuracy = question->accuracy,
                                     .expected_realizations = expected};
    setup->needs = ps_needs_find(&needs);
    setup->num_realizations = setup->needs.one_realization ? 1 : setup->num_sets;
    const bool is_less = setup->needs.sequential && expected < (double)setup->num_realizations;
    setup->planned_realizations = is_less ? (uint64_t)expected : setup->num_realizations;
}

/* ---- kappa --------------------------------------------------------------------------------- */

/* What the representer is to be made to: looser for many small rules, whose work its degrees would
 * be. */
static double choose_accuracy(const ps_quadrature_setup *setup,
                              const ps_quadrature_question *question, bool has_several) {
    const double share = 0.01; /* of the tolerance */
    const double most = 1e-9;  /* still below the E^2 of any rule */
    return has_several && !setup->needs.no_skip
               ? fmin(fmax(share * question->accuracy.tolerance, PS_REPRESENTER_TOLERANCE), most)
               : PS_REPRESENTER_TOLERANCE;
}

/* Leaves out terms of kappa that cannot matter beside `accuracy`. */
static void skip_terms(ps_quadrature_setup *setup, double accuracy) {
    const double share = 0.1; /* beside the terms that are not there at all */
    if (!setup->needs.no_skip) {
        ps_representer_skip(&setup->representer, share * accuracy);
    }
}

/* ---- shares of the work -------------------------------------------------------------------- */

static double num_sets(const ps_quadrature_setup *setup) {
    return setup->problem.num_realizations > 0 ? (double)setup->problem.num_realizations : 1;
}

/* What the host's threads take for the sums of kappa with so many terms. */
static double seconds_of_terms(const ps_quadrature_setup *setup, double num_terms) {
    const double points = (double)setup->problem.num_points;
    return ps_cost_rule_seconds(0, num_sets(setup) * points * num_terms);
}

/* Kernel form and kappa. */
static double other_seconds(const ps_quadrature_setup *setup) {
    const double points = (double)setup->problem.num_points;
    return ps_cost_rule_seconds(num_sets(setup) * ps_distance_count(points), 0) +
           seconds_of_terms(setup, (double)setup->representer.num_terms);
}

static double share_of(double saved, const ps_quadrature_setup *setup) {
    const double seconds = setup->plan.chosen->seconds + other_seconds(setup);
    return saved > 0 ? saved / (saved + seconds) : 0;
}

static void list_terms(ps_quadrature_setup *setup) {
    const ps_representer *const representer = &setup->representer;
    const size_t all = representer->max_degree + 1;
    const size_t last =
        representer->only_even ? 2 * (representer->num_terms - 1) : representer->num_terms - 1;
    const double kept = (double)representer->num_terms;
    const size_t few = 16; /* a part of them that is worth a line */
    char what[sizeof setup->needs.skips[0].what];
    if (representer->only_even) {
        ps_needs_add(&setup->needs, "odd degrees above 1 of kappa", "they are 0 for this lobe",
                     share_of(seconds_of_terms(setup, kept), setup));
    }
    if (all - last > all / few) {
        const double left_out =
            (double)(representer->only_even ? (all - last) / 2 : all - 1 - last);
        snprintf(what, sizeof what, "degrees %zu to %zu of kappa", last + 1, all - 1);
        ps_needs_add(&setup->needs, what, "the lobe has decayed below the digits that are needed",
                     share_of(seconds_of_terms(setup, left_out), setup));
    }
}

/* Seconds of the engine for all degrees. */
static pspec_status plan_all(double *seconds, const ps_quadrature_setup *setup,
                             const ps_quadrature_question *question, ps_error *error) {
    ps_frequencies all = {0};
    ps_plan plan;
    ps_problem problem = setup->problem;
    PS_TRY(ps_frequencies_degrees(&all, (int64_t)setup->most_degree, false, error));
    problem.frequencies = &all;
    const pspec_status status = ps_plan_make(&plan, &problem, ps_device_get_limits(setup->device),
                                             &question->limits.constraints, error);
    *seconds = status == PSPEC_OK && plan.chosen != NULL ? plan.chosen->seconds : 0;
    ps_frequencies_free(&all);
    return status;
}

static void name_degrees(char *what, size_t size, const ps_quadrature_setup *setup) {
    snprintf(what, size, "degrees %zu to %zu", setup->max_degree + 1, setup->most_degree);
}

/* Degrees that would be there without the tolerance; their share of degrees, until it is rated. */
static void list_degrees(ps_quadrature_setup *setup) {
    char what[sizeof setup->needs.skips[0].what];
    char why[sizeof setup->needs.skips[0].why];
    if (setup->max_degree < setup->most_degree) {
        name_degrees(what, sizeof what, setup);
        snprintf(why, sizeof why, "their share of E^2 is below --tol, at most %.3g",
                 setup->beyond_bound);
        ps_needs_add(&setup->needs, what, why,
                     1 - (double)setup->max_degree / (double)setup->most_degree);
    }
}

pspec_status ps_quadrature_setup_rate(ps_quadrature_setup *setup,
                                      const ps_quadrature_question *question, ps_error *error) {
    char what[sizeof setup->needs.skips[0].what];
    double seconds = 0;
    if (setup->max_degree < setup->most_degree && setup->plan.chosen != NULL) {
        PS_TRY(plan_all(&seconds, setup, question, error));
        name_degrees(what, sizeof what, setup);
        ps_needs_rate(&setup->needs, what, share_of(seconds - setup->plan.chosen->seconds, setup));
    }
    return PSPEC_OK;
}

/* Makes the plan, and lists what it skips, degrees and terms of kappa among it. held: bytes of the
 * machine's memory that the plan need not count as taken. */
static pspec_status plan_needs(ps_quadrature_setup *setup, const ps_quadrature_question *question,
                               uint64_t held, ps_error *error) {
    const ps_needs_strict strict = {setup->problem.tolerance, other_seconds(setup)};
    ps_plan_constraints constraints = question->limits.constraints;
    ps_memory_room room;
    ps_memory_room_find(&room, held);
    constraints.room = &room;
    PS_TRY(ps_needs_plan(&setup->needs, &setup->plan, &setup->problem,
                         ps_device_get_limits(setup->device), &constraints, &strict, error));
    if (setup->plan.chosen == NULL || setup->needs.no_skip) {
        return PSPEC_OK;
    }
    list_degrees(setup);
    list_terms(setup);
    return PSPEC_OK;
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

/* Of what a GPU sums distances with (quadrature_distances.c). */
static double bytes_of_distances(const ps_quadrature_setup *setup,
                                 const ps_quadrature_question *question, uint64_t num_points) {
    const bool are_summed = question->weights.kind != PS_WEIGHTS_OPTIMAL &&
                            ps_kernel_distances_pay(setup->device, num_points);
    return are_summed
               ? (double)ps_kernel_product_bytes(num_points) *
                     (double)ps_kernel_distances_at_once(num_points, setup->planned_realizations)
               : 0;
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
        .making_bytes = (question->sampler != NULL ? ps_sampler_work_bytes(question->sampler) : 0) +
                        bytes_of_distances(setup, question, shape->most_points),
        .measure = setup->by_pairs ? PS_OF_PAIR_SUMS : PS_OF_AMPLITUDES,
        .tolerance = setup->by_pairs ? question->accuracy.tolerance
                                     : question->accuracy.tolerance / amplitudes,
        .expected_power = setup->by_pairs ? expect_power(&setup->representer, setup->max_degree,
                                                         shape->num_points)
                                          : 0};
}

static pspec_status open_device(ps_quadrature_setup *out, const ps_quadrature_question *question,
                                ps_error *error) {
    return ps_limits_open_device(&question->limits, question->open_device,
                                 question->may_lack_device, &out->device, &out->owns_device, error);
}

pspec_status ps_quadrature_setup_begin(ps_quadrature_setup *out,
                                       const ps_quadrature_question *question, ps_error *error) {
    *out = (ps_quadrature_setup){0};
    PS_TRY(ps_plan_check_engine(question->limits.constraints.engine, PS_ON_SPHERE, error));
    PS_TRY(ps_points_check(question->paths, question->num_paths, &question->point_options, error));
    PS_TRY(ps_input_check(question->weights.path, error));
    return question->limits.device != NULL ? open_device(out, question, error) : PSPEC_OK;
}

static pspec_status plan_engine(ps_quadrature_setup *out, const ps_quadrature_question *question,
                                const ps_rule_shape *shape, ps_error *error) {
    PS_TRY(ps_frequencies_degrees(&out->frequencies, (int64_t)out->max_degree, false, error));
    PS_TRY(ps_frequencies_enumerate(&out->frequencies, error));
    PS_TRY(open_device(out, question, error));
    out->problem = make_problem(out, question, shape);
    return plan_needs(out, question, 0, error);
}

pspec_status ps_quadrature_setup_plan_again(ps_quadrature_setup *setup,
                                            const ps_quadrature_question *question, uint64_t held,
                                            ps_error *error) {
    find_needs(setup, question); /* with none of what the plan before has skipped */
    return plan_needs(setup, question, held, error);
}

/* How optimal weights of so many points will be made and in what memory, for `plan`; "" without
 * such weights. */
static void describe_weights(const ps_quadrature_question *question, size_t num_points,
                             const ps_device *device, char *text, size_t size) {
    const uint64_t limit = question->limits.constraints.memory_limit;
    const double dense = (double)ps_kernel_system_bytes(num_points, true);
    const double sparse = (double)ps_kernel_system_bytes(num_points, false);
    text[0] = '\0';
    if (question->weights.kind != PS_WEIGHTS_OPTIMAL) {
        return;
    }
    const size_t most_dense = ps_kernel_most_dense(device);
    if (ps_kernel_system_is_dense(num_points, most_dense, limit)) {
        snprintf(text, size, "optimal, by Cholesky; a matrix of %zu x %zu, %.4g bytes", num_points,
                 num_points, dense);
        return;
    }
    snprintf(text, size,
             "optimal, by conjugate gradients with products %s, %.4g bytes; a matrix would take "
             "%.4g bytes, and %s",
             ps_kernel_product_is_possible(device) ? "on the device" : "in threads", sparse, dense,
             num_points <= most_dense ? "--memory is less"
             : most_dense < PS_KERNEL_MOST_DENSE
                 ? "on GPUs matrices are made for 4096 points and fewer"
                 : "matrices are made for 20000 points and fewer");
}

pspec_status ps_quadrature_setup_make(ps_quadrature_setup *out,
                                      const ps_quadrature_question *question,
                                      const ps_rule_shape *shape, ps_error *error) {
    const size_t most = most_degrees(shape->num_points);
    const size_t asked = question->max_degree;
    out->max_degree = asked > 0 ? asked : most;
    out->most_degree = out->max_degree;
    out->num_sets = shape->num_sets;
    find_needs(out, question);
    const bool has_several = out->num_realizations != 1;
    const double accuracy = choose_accuracy(out, question, has_several);
    out->by_pairs = has_several || is_for_pairs(question->limits.constraints.engine);
    PS_TRY(ps_representer_create(&out->representer, question->brdf, question->smoothness, accuracy,
                                 2 * out->most_degree, error));
    if (asked == 0 && !question->accuracy.no_skip) {
        choose_degrees(out, question->accuracy.tolerance, most);
    }
    skip_terms(out, accuracy);
    PS_TRY(plan_engine(out, question, shape, error));
    describe_weights(question, shape->num_points, out->device, out->weights_note,
                     sizeof out->weights_note);
    return PSPEC_OK;
}

void ps_quadrature_setup_free(ps_quadrature_setup *setup) {
    ps_representer_destroy(&setup->representer);
    ps_frequencies_free(&setup->frequencies);
    if (setup->owns_device) {
        ps_device_close(setup->device);
    }
}
