#include "jobs/spectrum/power_job_private.h"

#include <math.h>
#include <stdio.h>

/* Rotated points of the hemisphere that go below it become their antipodes. That changes no even
 * degree, but the odd ones, which points have when they are taken as points of the sphere. */
static bool folding_matters(const ps_power_question *question) {
    const ps_sampler_request *sampler = question->sampler;
    return sampler != NULL && sampler->homogenize && ps_sampler_is_on_hemisphere(sampler) &&
           !question->on_hemisphere;
}

/* Independent frequencies of the first ring, those of |k|^2 <= 2 where it has both norms; of the
 * first shell or degree. */
static double count_fewest(const ps_power_job *job) {
    const double d = job->dimension;
    if (job->question->on_sphere) {
        return job->question->on_hemisphere ? 2.5 : 1.5;
    }
    const ps_bin_rule *const bins = &job->frequencies.bins;
    return ps_bin_rule_find(bins, 1) == ps_bin_rule_find(bins, 2) ? d * d : d;
}

/* Of the whole box, or of all orders, that up to `largest` are, by counts. */
static double share_up_to(const ps_power_job *job, double largest, double uncut) {
    const double power = job->question->on_sphere ? 2 : job->dimension;
    const double both = job->question->on_sphere ? 1 : 2; /* signs */
    return pow((both * largest + 1) / (both * uncut + 1), power);
}

/* Frequencies that nobody needs. */
static void find_useless(ps_power_job *job) {
    const ps_power_question *const question = job->question;
    const double largest = job->frequencies.max_frequency;
    const double uncut =
        ps_power_frequencies_uncut(question, job->dimension, (size_t)job->num_points);
    if (!(uncut > largest)) {
        return;
    }
    snprintf(job->useless, sizeof job->useless, "%s beyond %d",
             question->on_sphere ? "degrees" : "frequencies", (int)job->frequencies.max_frequency);
    ps_needs_add(&job->needs, job->useless, question->useful_why,
                 1 - share_up_to(job, largest, uncut));
}

void ps_power_needs_find(ps_power_job *job) {
    const ps_power_question *question = job->question;
    const ps_sampler_request *sampler = question->sampler;
    const bool is_grid = question->frequencies.path == NULL && !question->on_sphere;
    /* coefficients, unlike powers, turn with the set */
    const bool is_invariant =
        sampler != NULL && !folding_matters(question) && question->harmonics == PS_NO_HARMONICS;
    /* C_l^2 turns with the set, too */
    const bool turns = question->wants_pair_sums && sampler != NULL && sampler->homogenize;
    const ps_needs_question needs = {
        .dimension = job->dimension,
        .max_frequency = is_grid ? job->frequencies.max_frequency : 0,
        .max_norm2 = job->frequencies.max_norm2,
        .on_sphere = question->on_sphere,
        .on_hemisphere = question->on_hemisphere,
        .wants_full_array = question->wants_full_array,
        .wants_frequency_errors = question->wants_full_array || question->frequencies.per_ring > 0,
        .share_not_drawn =
            1 - (double)job->frequencies.num / (double)ps_frequencies_population(&job->frequencies),
        .has_constant_power = is_invariant && !turns && ps_sampler_has_constant_power(sampler),
        .is_homogenized = is_invariant && !turns && sampler->homogenize,
        .num_realizations = question->num_realizations,
        .accuracy = question->accuracy,
        .expected_realizations =
            ps_sequential_expected(count_fewest(job), question->accuracy.standard_error),
    };
    job->needs = ps_needs_find(&needs);
    find_useless(job);
}

/* Without a statistical target. */
static double strict_tolerance(const ps_power_question *question) {
    return question->wants_pair_sums
               ? question->accuracy.tolerance
               : ps_plan_tolerance(question->accuracy.tolerance, question->accuracy.floor);
}

/* What is not done of a plan for these frequencies; -1: there is no such plan. */
static double find_share(const ps_power_job *job, const ps_frequencies *frequencies) {
    ps_plan plan;
    ps_problem problem = job->problem;
    problem.frequencies = frequencies;
    if (ps_plan_make(&plan, &problem, ps_device_get_limits(job->device),
                     &job->question->limits.constraints, NULL) != PSPEC_OK ||
        plan.chosen == NULL) {
        return -1;
    }
    const double share = 1 - job->plan.chosen->seconds / plan.chosen->seconds;
    return share > 0 ? share : 0;
}

static void rate(ps_power_job *job, const char *what, pspec_status is_possible,
                 const ps_frequencies *frequencies) {
    const double share = is_possible == PSPEC_OK ? find_share(job, frequencies) : -1;
    if (share >= 0) {
        ps_needs_rate(&job->needs, what, share);
    }
}

void ps_power_job_rate_skips(ps_power_job *job) {
    ps_frequencies more;
    const ps_frequencies *const set = &job->frequencies;
    const int32_t uncut =
        ps_power_frequencies_uncut(job->question, job->dimension, (size_t)job->num_points);
    if (job->plan.chosen == NULL) {
        return;
    }
    if (set->kind == PS_FREQUENCIES_BALL) {
        rate(job, PS_SKIP_CORNERS,
             ps_frequencies_lattice(&more, job->dimension, set->max_frequency, false, NULL), &more);
    }
    if (uncut > set->max_frequency && set->kind == PS_FREQUENCIES_DEGREES) {
        rate(job, job->useless,
             ps_frequencies_degrees(&more, uncut, job->question->on_hemisphere, NULL), &more);
    } else if (uncut > set->max_frequency) {
        rate(job, job->useless,
             ps_frequencies_lattice(&more, job->dimension, uncut, set->kind == PS_FREQUENCIES_BALL,
                                    NULL),
             &more);
    }
}

/* What the job holds already of what a plan counts: the set that was read, and the engine of a plan
 * before. */
static uint64_t find_held(const ps_power_job *job) {
    const ps_point_set *const set = &job->sets.next;
    return (set->points_capacity + set->weights_capacity) * sizeof(double) +
           ps_runner_held(&job->runner);
}

pspec_status ps_power_needs_plan(ps_power_job *job, ps_error *error) {
    const ps_power_question *question = job->question;
    ps_plan_constraints constraints = question->limits.constraints;
    ps_memory_room room;
    ps_memory_room_find(&room, find_held(job));
    constraints.room = &room;
    const ps_needs_strict strict = {
        question->may_loosen ? strict_tolerance(question) : job->problem.tolerance, 0};
    return ps_needs_plan(&job->needs, &job->plan, &job->problem, ps_device_get_limits(job->device),
                         &constraints, &strict, error);
}

uint64_t ps_power_needs_realizations(const ps_power_job *job) {
    const double expected =
        ps_sequential_expected(count_fewest(job), job->question->accuracy.standard_error);
    const bool is_less = job->needs.sequential && expected < (double)job->num_realizations;
    return is_less ? (uint64_t)expected : job->num_realizations;
}

double ps_power_needs_tolerance(const ps_power_question *question) {
    return question->may_loosen && !question->wants_pair_sums && !question->accuracy.no_skip
               ? ps_plan_statistical_tolerance(question->accuracy.standard_error,
                                               question->accuracy.floor)
               : strict_tolerance(question);
}
