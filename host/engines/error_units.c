#include "engines/error_units.h"

#include <math.h>

static const double spread = 2;
static const double deviations = 3;

/* An error of S that says nothing any more; engines are not asked for less. */
static const double largest_amplitude = 0.1;

double ps_weight_share(const ps_problem *problem) {
    return problem->weight_share > 0
               ? problem->weight_share
               : 1 / (double)(problem->num_points > 0 ? problem->num_points : 1);
}

double ps_floor_amplitude(double floor) {
    return PS_FLOOR_ERROR / 2 * sqrt(floor) / deviations;
}

bool ps_engine_sums_pairs(const ps_problem *problem, const char **why_not) {
    *why_not = "a small power would drown in the rounding of a sum over pairs";
    return problem->measure == PS_OF_PAIR_SUMS;
}

ps_problem ps_engine_problem(const ps_engine *engine, const ps_problem *problem) {
    const double share = ps_weight_share(problem);
    const double tolerance = problem->tolerance;
    ps_problem own = *problem;
    if (!engine->sums_pairs && problem->measure == PS_OF_PAIR_SUMS) {
        const double x = tolerance / (1 + sqrt(1 + tolerance));
        own.tolerance = fmin(x / (spread * sqrt(share)), largest_amplitude);
        own.tolerance = problem->floor > 0 ? fmin(own.tolerance, ps_floor_amplitude(problem->floor))
                                           : own.tolerance;
    }
    if (engine->sums_pairs && problem->measure == PS_OF_PAIR_SUMS && problem->floor > 0) {
        const double least_share = 1 / (double)problem->num_points;
        own.tolerance = fmin(tolerance, PS_FLOOR_ERROR / deviations * problem->floor * least_share);
    }
    return own;
}

double ps_pair_sums_error(double amplitude_error, double share) {
    const double x = spread * amplitude_error * sqrt(share);
    return x * (2 + x);
}

double ps_engine_error_in(const ps_engine *engine, const ps_problem *problem, double own_error) {
    return engine->sums_pairs || problem->measure == PS_OF_AMPLITUDES
               ? own_error
               : ps_pair_sums_error(own_error, ps_weight_share(problem));
}

double ps_engine_floor_error(const ps_engine *engine, const ps_problem *problem, double own_error) {
    if (problem->measure != PS_OF_PAIR_SUMS || !(problem->floor > 0)) {
        return 0;
    }
    return engine->sums_pairs
               ? deviations * own_error * (double)problem->num_points / problem->floor
               : deviations * 2 * own_error / sqrt(problem->floor);
}
