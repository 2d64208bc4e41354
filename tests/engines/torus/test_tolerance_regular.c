/* The error formula of torus_nufft for the sets that harm it most: regular along an axis, with
 * peaks where aliases are strongest for the fine grid that is chosen; and for larger sets of the
 * kinds of test_tolerance_sweep.c; and lattices in space, made for the grid, whose points may lie
 * together, where sums of a large set are plain.
 *
 * Of a comb of m points along the last axis, frequencies k and k + m are the same. With m = n - K
 * all that it has at k = 0, be that a peak or the power of all its rows, comes back at K and -K;
 * with m a divisor of n aliases are in step. torus_direct in double precision stands for the
 * referee, which is too slow here.
 */
#include "harness_shapes.h"

#include "engines/torus/nufft/choice.h"
#include "engines/engine.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;

typedef struct regular_case {
    unsigned dimension;
    int32_t k;
    size_t num_rows; /* places in all axes but the last */
    bool is_lattice; /* rows are a lattice themselves, else anywhere */
} regular_case;

/* One row and many; power 1 at all frequencies of a row, or in peaks. */
static const regular_case cases[] = {{1, 37, 1, false}, {1, 200, 1, false}, {2, 4, 1, false},
                                     {2, 12, 3, false}, {2, 12, 16, true},  {2, 32, 9, false},
                                     {2, 32, 64, true}, {2, 48, 4, false},  {3, 5, 2, false},
                                     {3, 5, 49, true},  {3, 8, 12, false}};

static pspec_pattern make_comb(const regular_case *what, size_t num_teeth) {
    const unsigned d = what->dimension;
    const size_t num = num_teeth * what->num_rows;
    const double shift = 0.3;
    double *points = calloc(num * d, sizeof(double));
    uint64_t state = 5;
    for (size_t row = 0; row < what->num_rows; row++) {
        for (unsigned axis = 0; axis + 1 < d; axis++) {
            const double place = what->is_lattice
                                     ? (double)row * (axis == 0 ? 1 : 18) / (double)what->num_rows
                                     : test_uniform(&state);
            for (size_t tooth = 0; tooth < num_teeth; tooth++) {
                points[(row * num_teeth + tooth) * d + axis] = place - floor(place);
            }
        }
        for (size_t tooth = 0; tooth < num_teeth; tooth++) {
            points[(row * num_teeth + tooth) * d + d - 1] =
                ((double)tooth + shift) / (double)num_teeth;
        }
    }
    return (pspec_pattern){d, num, points, NULL};
}

/* Where nothing was expected the difference is the error itself, else the part of it in step with
 * S. */
static double error_between(const double *found, const double *expected, size_t num) {
    double sum = 0;
    for (size_t i = 0; i < num; i++) {
        const double square = pow(sqrt(found[i]) - sqrt(expected[i]), 2);
        sum += (expected[i] > square ? 2 : 1) * square;
    }
    return sqrt(sum / (double)num);
}

/* Bound / error. */
static double slack_of(const pspec_pattern *pattern, const ps_frequencies *grid,
                       ps_precision precision, double tolerance) {
    const ps_problem problem = {.frequencies = grid,
                                .num_points = pattern->num_points,
                                .num_realizations = 2, /* one is not done in strips */
                                .tolerance = tolerance};
    double *expected = test_run_engine(&ps_torus_direct, PS_DOUBLE, device, grid, pattern, 1, 1);
    double *found = test_run_problem(&ps_torus_nufft, &problem, precision, device, pattern, 1, 1);
    const double squares = test_sum_of_squares(pattern);
    const double error = error_between(found, expected, grid->num) / sqrt(squares);
    double power = 0;
    for (size_t i = 0; i < grid->num; i++) {
        power += expected[i] / squares / (double)grid->num;
    }
    free(found);
    free(expected);
    return test_engine_error(&ps_torus_nufft, &problem, precision, device, power) / error;
}

static double slack_of_comb(const regular_case *what, const ps_frequencies *grid, size_t num_teeth,
                            double tolerance) {
    pspec_pattern pattern = make_comb(what, num_teeth);
    const double slack = slack_of(&pattern, grid, PS_DOUBLE, tolerance);
    if (slack < 1) {
        print_message("ABOVE: d=%u K=%d comb of %zu in %zu rows, tolerance %.0e: slack %.2f\n",
                      what->dimension, (int)what->k, num_teeth, what->num_rows, tolerance, slack);
    }
    test_free_pattern(&pattern);
    return slack;
}

/* Cells along the last axis, in one dimension of all strides together. */
static double cells_of(const regular_case *what, const ps_frequencies *grid, double tolerance) {
    const ps_problem problem = {.frequencies = grid,
                                .num_points = what->num_rows * 2 * (size_t)what->k,
                                .num_realizations = 1,
                                .tolerance = tolerance};
    const ps_nufft_choice choice =
        ps_nufft_choose(&problem, ps_device_get_limits(device), PS_DOUBLE);
    return (double)choice.axes[choice.num_axes - 1].n * fmax(1, choice.stride);
}

static double least_slack(const regular_case *what, double tolerance) {
    ps_frequencies grid = test_make_grid(what->dimension, what->k);
    const double n = cells_of(what, &grid, tolerance);
    const double edge = n - what->k;
    const double teeth[] = {edge,     edge + 1,    edge + 2, edge / 2,   (edge + 1) / 2,
                            edge / 3, n,           n / 2,    n / 3,      2 * n / 3,
                            what->k,  what->k + 1, edge * 2, n + what->k};
    double least = HUGE_VAL;
    for (size_t i = 0; i < sizeof teeth / sizeof teeth[0]; i++) {
        least = fmin(least, slack_of_comb(what, &grid, (size_t)fmax(1, teeth[i]), tolerance));
    }
    ps_frequencies_free(&grid);
    return least;
}

static void combs(void **state) {
    (void)state;
    double least = HUGE_VAL;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double least_of_case = HUGE_VAL;
        for (double tolerance = 1e-1; tolerance > 1e-11; tolerance /= 10) {
            least_of_case = fmin(least_of_case, least_slack(&cases[i], tolerance));
        }
        print_message("combs: d=%u K=%d rows %zu%s smallest slack %.2f\n", cases[i].dimension,
                      (int)cases[i].k, cases[i].num_rows, cases[i].is_lattice ? " (lattice)" : "",
                      least_of_case);
        least = fmin(least, least_of_case);
    }
    assert_true(least >= 1);
}

/* Many equal terms in a cell round the same way every time. */
static void dense_columns(void **state) {
    (void)state;
    static const struct {
        unsigned dimension;
        int32_t k;
        size_t side;
    } grids[] = {{2, 64, 90},  {2, 64, 150}, {2, 64, 170}, {2, 16, 150},
                 {2, 16, 250}, {3, 8, 24},   {3, 8, 28}};
    for (size_t i = 0; i < sizeof grids / sizeof grids[0]; i++) {
        const size_t side = grids[i].side;
        const regular_case what = {grids[i].dimension, grids[i].k,
                                   grids[i].dimension == 2 ? side : side * side, true};
        pspec_pattern pattern = make_comb(&what, side);
        ps_frequencies grid = test_make_grid(what.dimension, what.k);
        for (double tolerance = 1e-5; tolerance > 1e-8; tolerance /= 10) {
            const double slack = slack_of(&pattern, &grid, PS_SINGLE, tolerance);
            print_message(
                "columns: d=%u K=%d %zu along an axis, single, tolerance %.0e: slack %.2f\n",
                what.dimension, (int)what.k, side, tolerance, slack);
            assert_true(slack >= 1);
        }
        ps_frequencies_free(&grid);
        test_free_pattern(&pattern);
    }
}

/* ---- lattices of large sets ----------------------------------------------------------------- */

/* Points on top of each other follow one another. */
static pspec_pattern make_lattice(const size_t sides[3], size_t copies) {
    const double shift = 0.3;
    const size_t num = sides[0] * sides[1] * sides[2] * copies;
    double *points = calloc(3 * num, sizeof(double));
    for (size_t i = 0; i < num; i++) {
        size_t rest = i / copies;
        for (unsigned axis = 3; axis-- > 0; rest /= sides[axis]) {
            points[3 * i + axis] = ((double)(rest % sides[axis]) + shift) / (double)sides[axis];
        }
    }
    return (pspec_pattern){3, num, points, NULL};
}

static ps_nufft_choice choose_single(const ps_frequencies *grid, size_t num_points,
                                     double tolerance) {
    const ps_problem problem = {.frequencies = grid,
                                .num_points = num_points,
                                .num_realizations = 1,
                                .tolerance = tolerance};
    return ps_nufft_choose(&problem, ps_device_get_limits(device), PS_SINGLE);
}

static bool is_plain(const ps_nufft_choice *choice) {
    return choice->variant == &ps_nufft_large && choice->chunk == 0;
}

/* Lattices that are finer than K have no power: what is found is the error. HUGE_VAL: there is none
 * of so many points, or its sums are not plain. */
static double slack_of_lattice(const ps_frequencies *grid, const size_t sides[3], size_t num_points,
                               double tolerance) {
    const size_t places = sides[0] * sides[1] * sides[2];
    const size_t copies = num_points > places ? num_points / places : 1;
    const ps_nufft_choice choice = choose_single(grid, places * copies, tolerance);
    for (unsigned axis = 0; axis < 3; axis++) {
        if (sides[axis] <= (size_t)grid->max_frequency || !is_plain(&choice)) {
            return HUGE_VAL;
        }
    }
    pspec_pattern pattern = make_lattice(sides, copies);
    const ps_problem problem = {.frequencies = grid,
                                .num_points = pattern.num_points,
                                .num_realizations = 1,
                                .tolerance = tolerance};
    double *found =
        test_run_engine_to(&ps_torus_nufft, PS_SINGLE, tolerance, device, grid, &pattern, 1, 1);
    double sum = 0;
    for (size_t i = 0; i < grid->num; i++) {
        sum += found[i];
    }
    const double error = sqrt(sum / (double)grid->num / (double)pattern.num_points);
    free(found);
    test_free_pattern(&pattern);
    return test_engine_error(&ps_torus_nufft, &problem, PS_SINGLE, device, 0) / error;
}

static double least_slack_of_lattices(const ps_frequencies *grid, size_t num_points,
                                      double tolerance) {
    static const double of_cells[] = {1.0 / 4, 1.0 / 3, 2.0 / 5, 1.0 / 2,
                                      3.0 / 5, 3.0 / 4, 4.0 / 5, 1};
    const ps_nufft_choice choice = choose_single(grid, num_points, tolerance);
    const size_t coarsest = (size_t)grid->max_frequency + 2;
    const size_t many[3] = {coarsest, coarsest, coarsest};
    double least = slack_of_lattice(grid, many, num_points, tolerance);
    for (size_t i = 0; is_plain(&choice) && i < sizeof of_cells / sizeof of_cells[0]; i++) {
        size_t sides[3];
        for (unsigned axis = 0; axis < 3; axis++) {
            sides[axis] = (size_t)lround(of_cells[i] * choice.axes[axis].n);
        }
        least = fmin(least, slack_of_lattice(grid, sides, num_points, tolerance));
    }
    return least;
}

/* The same numbers are added up in every period of lattice and grid, and round the same way. */
static void lattices_of_large_sets(void **state) {
    (void)state;
    static const struct {
        int32_t k;
        size_t num_points;
        double tolerance;
    } sets[] = {{16, 100000, 1e-6},  {16, 200000, 1e-4},  {16, 700000, 1e-5},
                {16, 1500000, 2e-5}, {16, 1500000, 1e-4}, {32, 700000, 1e-6}};
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        ps_frequencies grid = test_make_grid(3, sets[i].k);
        const double least = least_slack_of_lattices(&grid, sets[i].num_points, sets[i].tolerance);
        print_message("lattices: K=%d N=%zu single, tolerance %.0e: smallest slack %.2f\n",
                      (int)sets[i].k, sets[i].num_points, sets[i].tolerance, least);
        ps_frequencies_free(&grid);
        assert_true(least >= 1 && least < HUGE_VAL);
    }
}

/* ---- larger sets ---------------------------------------------------------------------------- */

/* Tolerances from the first to the last. */
static void check_larger(unsigned dimension, int32_t k, size_t num_points, ps_precision precision,
                         double first, double last) {
    ps_frequencies grid = test_make_grid(dimension, k);
    double least = HUGE_VAL;
    for (size_t s = 0; s < TEST_SHAPES; s++) {
        pspec_pattern pattern = test_make_pattern(&test_shapes[s], dimension, num_points, 3);
        for (double tolerance = first; tolerance > 0.9 * last; tolerance /= 10) {
            const double slack = slack_of(&pattern, &grid, precision, tolerance);
            if (slack < 1) {
                print_message("ABOVE: %s, tolerance %.0e: slack %.2f\n", test_shapes[s].name,
                              tolerance, slack);
            }
            least = fmin(least, slack);
        }
        test_free_pattern(&pattern);
    }
    print_message("larger: d=%u K=%d N=%zu %s smallest slack %.2f\n", dimension, (int)k, num_points,
                  ps_precision_name(precision), least);
    ps_frequencies_free(&grid);
    assert_true(least >= 1);
}

/* Many and few points for the frequencies, and a set that is spread on a grid of all axes. */
static void larger(void **state) {
    (void)state;
    static const struct {
        unsigned dimension;
        int32_t k;
        size_t num_points;
    } sets[] = {{1, 2000, 4000}, {2, 16, 1000}, {2, 20, 4000}, {2, 64, 4000},
                {2, 64, 100},    {3, 9, 3000},  {2, 16, 40000}};
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        check_larger(sets[i].dimension, sets[i].k, sets[i].num_points, PS_SINGLE, 1e-1, 1e-7);
        check_larger(sets[i].dimension, sets[i].k, sets[i].num_points, PS_DOUBLE, 1e-1, 1e-10);
    }
    check_larger(2, 130, 3000, PS_SINGLE, 1e-3,
                 1e-4); /* few cells for K: roundings grow 20 times */
    check_larger(2, 150, 9000, PS_SINGLE, 1e-6, 1e-7); /* strips */
    check_larger(2, 130, 9000, PS_DOUBLE, 1e-9, 1e-9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(combs),
        cmocka_unit_test(dense_columns),
        cmocka_unit_test(lattices_of_large_sets),
        cmocka_unit_test(larger),
    };
    device = test_open_device();
    if (!ps_device_get_limits(device)->has_fp64) {
        ps_device_close(device);
        return TEST_SKIPPED;
    }
    const int failures = cmocka_run_group_tests_name("tolerance_regular", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
