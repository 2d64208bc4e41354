#include "jobs/quadrature/quadrature_needs.h"

#include "plan/cost_model.h"
#include "rules/distance_split.h"

#include <math.h>
#include <stdio.h>

/* ---- realizations -------------------------------------------------------------------------- */

/* Independent coefficients of degree 1, of degree 0 none is left where weights sum to 1. */
static const double fewest_independent = 1.5;

void ps_quadrature_needs_find(ps_quadrature_setup *setup, const ps_quadrature_question *question) {
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

double ps_quadrature_needs_accuracy(const ps_quadrature_setup *setup,
                                    const ps_quadrature_question *question, bool has_several) {
    const double share = 0.01; /* of the tolerance */
    const double most = 1e-9;  /* still below the E^2 of any rule */
    return has_several && !setup->needs.no_skip
               ? fmin(fmax(share * question->accuracy.tolerance, PS_REPRESENTER_TOLERANCE), most)
               : PS_REPRESENTER_TOLERANCE;
}

void ps_quadrature_needs_terms(ps_quadrature_setup *setup, double accuracy) {
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
    const pspec_status status = ps_plan_make(
        &plan, &problem, setup->device != NULL ? ps_device_get_limits(setup->device) : NULL,
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

pspec_status ps_quadrature_needs_rate(ps_quadrature_setup *setup,
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

pspec_status ps_quadrature_needs_plan(ps_quadrature_setup *setup,
                                      const ps_quadrature_question *question, uint64_t held,
                                      ps_error *error) {
    const ps_needs_strict strict = {setup->problem.tolerance, other_seconds(setup)};
    ps_plan_constraints constraints = question->limits.constraints;
    ps_memory_room room;
    ps_memory_room_find(&room, held);
    constraints.room = &room;
    PS_TRY(ps_needs_plan(&setup->needs, &setup->plan, &setup->problem,
                         setup->device != NULL ? ps_device_get_limits(setup->device) : NULL,
                         &constraints, &strict, error));
    if (setup->plan.chosen == NULL || setup->needs.no_skip) {
        return PSPEC_OK;
    }
    list_degrees(setup);
    list_terms(setup);
    return PSPEC_OK;
}
