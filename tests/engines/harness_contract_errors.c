/* Errors of engines against the referees. */
#include "harness_contract.h"

#include "harness_pairs.h"
#include "harness_shapes.h"
#include "harness_sphere.h"
#include "harness_sphere_shapes.h"

#include "engines/error_units.h"
#include "engines/host/host_direct.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double weight_share(const pspec_pattern *pattern) {
    const double sizes = test_weight_sizes(pattern);
    return test_sum_of_squares(pattern) / (sizes * sizes);
}

/* All frequencies, or of many some in equal steps, which tell the root of a mean square to 2 %. */
static ps_frequencies make_some(const ps_frequencies *frequencies, size_t *step) {
    enum { MOST = 2000 };
    const size_t dimension = frequencies->dimension;
    *step = (frequencies->num + MOST - 1) / MOST;
    const size_t num = (frequencies->num + *step - 1) / *step;
    int32_t *const vectors = malloc(num * dimension * sizeof *vectors);
    ps_frequencies some = {0};
    for (size_t i = 0; i < num; i++) {
        memcpy(vectors + i * dimension, frequencies->vectors + i * *step * dimension,
               dimension * sizeof *vectors);
    }
    assert_ok(ps_frequencies_list(&some, frequencies->dimension, num, vectors, error));
    return some;
}

/* Error of a set in the units of the engine, and the power that it has. */
static double error_on_torus(const contract_way *way, const pspec_pattern *set, const double *found,
                             double *power) {
    const double squares = test_sum_of_squares(set);
    size_t step = 1;
    ps_frequencies some = make_some(&way->frequencies, &step);
    double *const expected = test_run_engine(&ps_host_direct, PS_EXTENDED, NULL, &some, set, 1, 1);
    double sum = 0;
    *power = 0;
    for (size_t i = 0; i < some.num; i++) {
        sum += pow(sqrt(found[i * step]) - sqrt(expected[i]), 2) / (double)some.num;
        *power += expected[i] / squares / (double)some.num;
    }
    free(expected);
    ps_frequencies_free(&some);
    return sqrt(2 * sum / squares); /* dS has no preferred direction (test_tolerance.c) */
}

double *contract_coefficients(const contract_way *way, void *state, const pspec_pattern *set,
                              double *powers) {
    double *const found = calloc(ps_num_coefficients_at(&way->frequencies), sizeof *found);
    const ps_batch one = {.num_patterns = 1, .patterns = set, .scales = &(double){1}};
    ps_rows rows = {0};
    assert_ok(way->engine->coefficients(state, &one, powers != NULL ? &rows : NULL, found, error));
    if (powers != NULL) {
        test_read_rows(way->engine, state, &way->frequencies, way->device, &rows, powers);
    }
    return found;
}

double contract_power_of(const contract_way *way, const double *c, size_t i) {
    if (way->what->dimension > 0) {
        return c[2 * i] * c[2 * i] + c[2 * i + 1] * c[2 * i + 1];
    }
    const int32_t l = way->frequencies.vectors[i];
    double sum = 0;
    for (int32_t m = 0; m <= l; m++) {
        const double *const at = c + 2 * test_coefficient(way->frequencies.max_frequency, l, m);
        sum += (m == 0 ? 1 : 2) * (at[0] * at[0] + at[1] * at[1]);
    }
    return PS_FOUR_PI / (2.0 * l + 1) * sum;
}

static double error_on_sphere(const contract_way *way, void *state, const pspec_pattern *set,
                              double *power) {
    const int32_t last = way->frequencies.max_frequency;
    const int32_t step = way->what->is_part ? 2 : 1;
    double *const found = contract_coefficients(way, state, set, NULL);
    double *const expected = test_sphere_coefficients(set, last, step);
    const double off = test_sphere_error(found, expected, last, step, set, power);
    free(found);
    free(expected);
    return off;
}

static double error_of_pairs(const contract_way *way, const pspec_pattern *set, const double *found,
                             double *power) {
    const double sizes = test_weight_sizes(set);
    long double *const exact = test_pair_sums(set, way->frequencies.max_frequency);
    double worst = 0;
    double modes = 0;
    *power = 0;
    for (size_t i = 0; i < way->frequencies.num; i++) {
        const int32_t l = way->frequencies.vectors[i];
        worst = fmax(worst, (double)fabsl(found[i] - exact[l]) / (sizes * sizes));
        *power += (2 * l + 1) * (double)exact[l] / test_sum_of_squares(set);
        modes += 2 * l + 1;
    }
    *power /= modes;
    free(exact);
    return worst;
}

double contract_error(const contract_way *way, void *state, const pspec_pattern *set,
                      const double *found, double *bound) {
    double power = 0;
    const double off = way->what->measure == PS_OF_PAIR_SUMS
                           ? error_of_pairs(way, set, found, &power)
                       : way->what->dimension > 0 ? error_on_torus(way, set, found, &power)
                                                  : error_on_sphere(way, state, set, &power);
    ps_problem problem = way->problem;
    problem.weight_share = weight_share(set);
    *bound = ps_engine_error_in(way->engine, &problem,
                                way->engine->error_of_state(state, power, problem.weight_share));
    return off;
}
