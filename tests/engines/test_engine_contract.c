/* The contract of host/engines/engine.h, for every engine in every precision and variant, by sets
 * of every kind and number of points beside each other. What an engine alone promises is in the
 * tests of its folder. The argument is the name of an engine, which has a process to itself;
 * without one all engines are asked.
 */
#include "harness_contract.h"

#include "engines/host/host_direct.h"
#include "engines/engine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;
static const ps_engine *asked; /* NULL: all */

/* Its bits are way->expected, whatever the batch. */
static double *run_all(const contract_way *way, size_t batch) {
    return contract_powers(way, &way->problem, way->sets, CONTRACT_SETS, batch);
}

/* ---- the same bits ----------------------------------------------------------------------- */

/* Alone, beside some and beside all, with the longest before or behind. */
static void batches_change_no_bit(const contract_way *way) {
    static const size_t batches[] = {1, 5, CONTRACT_SETS + 3};
    pspec_pattern reversed[CONTRACT_SETS];
    for (size_t i = 0; i < sizeof batches / sizeof batches[0]; i++) {
        contract_check_rows(way, "batches", CONTRACT_SETS, run_all(way, batches[i]), way->expected);
    }
    for (size_t r = 0; r < CONTRACT_SETS; r++) {
        reversed[r] = way->sets[CONTRACT_SETS - 1 - r];
    }
    double *const found = contract_powers(way, &way->problem, reversed, CONTRACT_SETS, 4);
    for (size_t r = 0; r < CONTRACT_SETS; r++) {
        const size_t from = (CONTRACT_SETS - 1 - r) * way->frequencies.num;
        assert_memory_equal(found + from, way->expected + r * way->frequencies.num,
                            contract_row_bytes(way));
    }
    free(found);
}

/* Of files nobody knows how many sets they have, unless it is one. */
static void unknown_numbers_change_no_bit(const contract_way *way) {
    ps_problem problem = way->problem;
    problem.num_realizations = 0;
    contract_check_rows(way, "an unknown number", CONTRACT_SETS,
                        contract_powers(way, &problem, way->sets, CONTRACT_SETS, 5), way->expected);
}

/* PoCL 3.1 gets groups of fewer items than lanes wrong, and all those for grids
 * (docs/engines/torus_nufft.md). */
static bool has_work_groups(const contract_way *way) {
    return way->engine->needs_device && strstr(way->what->name, "grid of") == NULL;
}

static void work_groups_change_no_bit(const contract_way *way) {
    if (!has_work_groups(way)) {
        return;
    }
    const size_t most = 256; /* whose numbers PoCL keeps on 8 MiB of stack, of sphere_nufft */
    ps_device_set_group_size(device, test_group(32) < most ? test_group(32) : most);
    double *const found = run_all(way, 5);
    ps_device_set_group_size(device, 0);
    contract_check_rows(way, "work-groups", CONTRACT_SETS, found, way->expected);
}

/* Room for more points than were planned leaves a job what it has. */
static void growth_changes_no_bit(const contract_way *way) {
    ps_problem problem = way->problem;
    problem.planned_points = (uint64_t)ps_planned_points(&way->problem);
    problem.num_points = 20000;
    contract_check_rows(way, "growth", CONTRACT_SETS,
                        contract_powers(way, &problem, way->sets, CONTRACT_SETS, 2), way->expected);
}

/* ---- memory ------------------------------------------------------------------------------ */

static double announced(const contract_way *way, size_t batch) {
    const ps_device_limits *const limits = ps_device_get_limits(device);
    ps_problem problem = way->problem;
    problem.num_realizations = batch;
    const ps_work work = way->engine->survey(&problem, limits, way->precision).work;
    return work.fixed_bytes - work.host_bytes +
           (work.bytes_per_realization + work.point_bytes + work.coordinate_bytes) * (double)batch;
}

/* No more is taken than announced, up to small tables, and at least half of it; nothing stays. */
static void memory_is_announced(const contract_way *way) {
    static const size_t batches[] = {1, CONTRACT_SETS};
    const double page = 4096;
    for (size_t i = 0; i < 2 && way->engine->needs_device; i++) {
        ps_problem problem = way->problem;
        const double before = contract_bytes;
        const double expected = announced(way, batches[i]);
        problem.num_realizations = batches[i];
        contract_most_bytes = before;
        free(contract_powers(way, &problem, way->sets, batches[i], batches[i]));
        assert_true(contract_bytes == before);
        if (!(contract_most_bytes - before <= expected + page &&
              expected <= 2 * (contract_most_bytes - before) + page)) {
            CONTRACT_FAIL(way, "batches of %zu take %.0f bytes, announced were %.0f", batches[i],
                          contract_most_bytes - before, expected);
        }
    }
}

/* ---- errors ------------------------------------------------------------------------------ */

/* (host_direct is the referee of the torus and of coefficients; sums over pairs have another.) */
static void errors_are_announced(const contract_way *way) {
    void *const state = contract_state(way);
    const bool is_referee = way->engine == &ps_host_direct;
    for (size_t r = 0; r < CONTRACT_SETS; r++) {
        const pspec_pattern *const set = &way->sets[r];
        const double *const row = way->expected + r * way->frequencies.num;
        double bound = 0;
        for (size_t i = 0; i < way->frequencies.num && set->num_points == 0; i++) {
            assert_true(row[i] == 0);
        }
        if (set->num_points == 0 || (is_referee && way->what->measure != PS_OF_PAIR_SUMS)) {
            continue;
        }
        const double off = contract_error(way, state, set, row, &bound);
        if (!(off <= bound)) {
            CONTRACT_FAIL(way, "set %zu of %zu points: error %.3g, announced %.3g", r,
                          set->num_points, off, bound);
        }
    }
    ps_engine_destroy(way->engine, state);
}

/* ---- weights, scales, coefficients ------------------------------------------------------- */

/* Ones are no weights; twice the weights four times the power, which scales and exponents bring
 * back. */
static void weights_scale_exactly(const contract_way *way) {
    enum { POINTS = CONTRACT_ODD, NUM = 5 };
    double weights[3][POINTS];
    double *const q = calloc(NUM * way->frequencies.num, sizeof *q);
    pspec_pattern plain = way->sets[CONTRACT_ODD_SET];
    assert_int_equal(plain.num_points, POINTS);
    plain.weights = NULL;
    for (size_t j = 0; j < POINTS; j++) {
        weights[0][j] = 1;
        weights[1][j] = 2;
        weights[2][j] = 1024;
    }
    pspec_pattern patterns[NUM] = {plain, plain, plain, plain, plain};
    patterns[1].weights = weights[0];
    patterns[2].weights = patterns[3].weights = weights[1];
    patterns[4].weights = weights[2];
    const double scales[NUM] = {1, 1, 1, 0.25, 1};
    const int exponents[NUM] = {0, 0, 0, 0, 10};
    const ps_batch batch = {
        .num_patterns = NUM, .patterns = patterns, .scales = scales, .exponents = exponents};
    void *state = NULL;
    assert_ok(
        ps_engine_create(way->engine, &state, &way->problem, way->precision, NUM, device, error));
    test_run_batch(way->engine, state, &way->frequencies, device, &batch, q);
    ps_engine_destroy(way->engine, state);
    for (size_t i = 0; i < way->frequencies.num; i++) {
        const size_t num = way->frequencies.num;
        assert_true(q[num + i] == q[i]);
        assert_true(q[2 * num + i] == 4 * q[i]);
        assert_true(q[3 * num + i] == q[i]);
        assert_true(q[4 * num + i] == q[i]);
    }
    free(q);
}

/* Powers beside coefficients have the bits of powers alone, and are those of the coefficients up to
 * the rounding of a power in single precision. */
static void coefficients_have_the_powers(const contract_way *way) {
    const double rounding = 1e-6;
    if (way->engine->coefficients == NULL) {
        return;
    }
    void *const state = contract_state(way);
    for (size_t r = 0; r < CONTRACT_SETS; r++) {
        double *const powers = malloc(contract_row_bytes(way));
        double *const c = contract_coefficients(way, state, &way->sets[r], powers);
        for (size_t i = 0; i < way->frequencies.num; i++) {
            const double power = contract_power_of(way, c, i);
            if (!(fabs(power - powers[i]) <= rounding * power)) {
                CONTRACT_FAIL(way, "set %zu, frequency %zu: %g of coefficients, %g", r, i, power,
                              powers[i]);
            }
        }
        contract_check_rows(way, "beside coefficients", 1, powers,
                            way->expected + r * way->frequencies.num);
        free(c);
    }
    ps_engine_destroy(way->engine, state);
}

/* ---- streams, stops, bad points ---------------------------------------------------------- */

/* The longest set, blocks of it being as small as the engine makes them. */
static void blocks_change_no_bit(const contract_way *way) {
    enum { UNIT = 32 };
    const ps_engine_stream *const stream = way->engine->stream;
    const pspec_pattern *const set = &way->sets[CONTRACT_LONGEST_SET];
    ps_problem problem = way->problem;
    void *state = NULL;
    ps_rows rows = {0};
    problem.num_points = UNIT;
    problem.num_realizations = 1;
    if (stream == NULL) {
        return;
    }
    assert_ok(ps_engine_create(way->engine, &state, &problem, way->precision, 1, device, error));
    const size_t unit = stream->unit(state);
    if (unit > 0) {
        double *const powers = malloc(contract_row_bytes(way));
        double *const expected = contract_powers(way, &problem, set, 1, 1);
        pspec_pattern block = *set;
        assert_ok(stream->begin(state, error));
        for (size_t done = 0; done < set->num_points; done += block.num_points) {
            const size_t left = set->num_points - done;
            block.num_points = left < unit ? left : unit;
            block.points = set->points + done * set->dimension;
            block.weights = set->weights != NULL ? set->weights + done : NULL;
            assert_ok(
                stream->add(state, &(ps_batch){.num_patterns = 1, .patterns = &block}, error));
        }
        assert_ok(stream->finish(state, 1, &rows, error));
        test_read_rows(way->engine, state, &way->frequencies, device, &rows, powers);
        contract_check_rows(way, "blocks", 1, powers, expected);
        free(expected);
    }
    ps_engine_destroy(way->engine, state);
}

static bool stop(void *payload) {
    return --*(int *)payload <= 0;
}

/* A run that is stopped says so, and leaves an engine that does the next one. */
static void runs_stop(const contract_way *way) {
    double scales[CONTRACT_SETS];
    int calls = 1;
    for (size_t r = 0; r < CONTRACT_SETS; r++) {
        scales[r] = 1;
    }
    double *const found = malloc(CONTRACT_SETS * contract_row_bytes(way));
    ps_batch batch = {.num_patterns = CONTRACT_SETS,
                      .patterns = way->sets,
                      .scales = scales,
                      .should_stop = stop,
                      .payload = &calls};
    void *const state = contract_state(way);
    ps_rows rows = {0};
    ps_error error = {0};
    assert_int_equal(way->engine->run(state, &batch, &rows, &error), PSPEC_ERROR_CANCELLED);
    batch.should_stop = NULL;
    test_run_batch(way->engine, state, &way->frequencies, device, &batch, found);
    contract_check_rows(way, "after a stop", CONTRACT_SETS, found, way->expected);
    ps_engine_destroy(way->engine, state);
}

/* Coordinates outside of [0, 1) in the last set are found by the engines that look. */
static void points_are_checked(const contract_way *way) {
    static const double bad[] = {1, -0x1p-1074, NAN, INFINITY};
    double x[8] = {0};
    const pspec_pattern sets[2] = {way->sets[0], {way->what->dimension, 1, x, NULL}};
    const ps_batch batch = {.num_patterns = 2, .patterns = sets, .scales = (const double[]){1, 1}};
    void *state = NULL;
    if (!way->engine->checks_points) {
        return;
    }
    assert_ok(
        ps_engine_create(way->engine, &state, &way->problem, way->precision, 2, device, error));
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        ps_rows rows = {0};
        x[way->what->dimension - 1] = bad[i];
        assert_int_equal(way->engine->run(state, &batch, &rows, NULL), PSPEC_ERROR_INPUT);
    }
    ps_engine_destroy(way->engine, state);
}

/* ---- who is asked ------------------------------------------------------------------------ */

static bool is_asked[3];

/* A law of so many of them. */
static void keep(const contract_way *way, const contract_named_law *laws, size_t num) {
    is_asked[way->precision] = true;
    for (size_t i = 0; i < num; i++) {
        contract_way named = *way;
        named.law = laws[i].name;
        laws[i].law(&named);
    }
}

#define LAW(law)                                                                                   \
    { #law, law }

static void keep_laws(const contract_way *way) {
    static const contract_named_law laws[] = {
        LAW(batches_change_no_bit),     LAW(unknown_numbers_change_no_bit),
        LAW(work_groups_change_no_bit), LAW(growth_changes_no_bit),
        LAW(memory_is_announced),       LAW(errors_are_announced),
        LAW(weights_scale_exactly),     LAW(coefficients_have_the_powers),
        LAW(blocks_change_no_bit),      LAW(runs_stop),
        LAW(points_are_checked),
    };
    keep(way, laws, sizeof laws / sizeof laws[0]);
}

static void every_engine_in_every_precision(void **state) {
    (void)state;
    for (size_t e = 0; ps_engines[e] != NULL; e++) {
        if (asked != NULL && ps_engines[e] != asked) {
            continue;
        }
        memset(is_asked, 0, sizeof is_asked);
        assert_true(contract_walk(device, ps_engines[e], keep_laws) > 0);
        for (int precision = PS_SINGLE; precision <= PS_EXTENDED; precision++) {
            const bool needs_double =
                precision == PS_DOUBLE || ps_engines[e]->domains == PS_ON_SPHERE;
            if (!needs_double || ps_device_get_limits(device)->has_fp64) {
                assert_true(is_asked[precision] == ps_engines[e]->has_precision[precision]);
            }
        }
    }
}

/* PoCL is slow with the kernels of GPUs: two sizes of batches do. */
static void keep_laws_of_gpus(const contract_way *way) {
    static const contract_named_law laws[] = {
        LAW(memory_is_announced),
        LAW(errors_are_announced),
        LAW(unknown_numbers_change_no_bit),
    };
    if (has_work_groups(way)) {
        keep(way, laws, sizeof laws / sizeof laws[0]);
    }
}

static void layouts_of_gpus_keep_the_laws(void **state) {
    (void)state;
    ps_device_set_dedicated_local_memory(device, true);
    ps_device_set_group_size(device, test_group(0));
    /* sphere_grid refuses GPUs */
    assert_true((contract_walk(device, asked, keep_laws_of_gpus) > 0) ==
                (asked != &ps_sphere_grid));
    if (asked == NULL || asked == &ps_torus_direct) { /* which has matrix units */
        ps_device_set_units(device, PS_UNITS_EMULATED);
        contract_walk(device, &ps_torus_direct, keep_laws_of_gpus);
        ps_device_set_units(device, PS_UNITS_NONE);
    }
    ps_device_set_group_size(device, 0);
    ps_device_set_dedicated_local_memory(device, false);
}

int main(int num, char **words) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_engine_in_every_precision),
        cmocka_unit_test(layouts_of_gpus_keep_the_laws),
    };
    for (size_t e = 0; num > 1 && ps_engines[e] != NULL; e++) {
        asked = strcmp(ps_engines[e]->name, words[1]) == 0 ? ps_engines[e] : asked;
    }
    if (num > 1 && asked == NULL) {
        return EXIT_FAILURE;
    }
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("engine_contract", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
