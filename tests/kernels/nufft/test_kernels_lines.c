/* nufft/line.h and nufft/lines.cl alone: the line of frequency 0 that nufft_tile leaves against
 * windows added in double precision, and powers of lines against sums of their cells; groups of
 * lanes that are full and not, windows as narrow and as wide as there are, points at the ends of
 * the torus and many in a cell.
 */
#include "harness_kernels.h"
#include "window_cells.h"

#include "engines/nufft/grid_axis.h"
#include "engines/torus/nufft/layout.h"
#include "engines/torus/nufft/variant.h"
#include "engines/nufft/window.h"
#include "math/pi.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

static ps_device *device;
static uint64_t seed = 15;

enum { NUM_SETS = 5, FIRST_ROW = 1, NUM_ROWS = FIRST_ROW + NUM_SETS };
static const size_t set_points[NUM_SETS] = {1, 45, 16, 20, 3};
static const uint64_t set_begin[NUM_SETS + 1] = {0, 16, 64, 80, 112, 128};
enum { NUM_PLACES = 128 };

typedef struct lines_case {
    unsigned precision, lanes;
    uint32_t n[2]; /* cells of the line; of the axis across, where there is one */
    uint32_t K;
    unsigned width;
    bool is_simulated; /* on Oclgrind, too */
} lines_case;

static const lines_case cases[] = {
    {32, 16, {64, 24}, 16, 7, false}, {32, 4, {40, 20}, 8, 12, true}, {32, 1, {16, 18}, 3, 2, true},
    {64, 8, {28, 32}, 8, 9, false},   {64, 4, {45, 21}, 4, 16, true}, {64, 2, {36, 16}, 6, 5, true},
};

static ps_precision precision_of(const lines_case *one) {
    return one->precision == 32 ? PS_SINGLE : PS_DOUBLE;
}

static double unit_of(const lines_case *one) {
    return one->precision == 32 ? 0x1p-24 : 0x1p-53;
}

static bool is_run(const lines_case *one) {
    const bool is_simulated = ps_device_get_limits(device)->has_dedicated_local_memory;
    return test_has_precision(device, one->precision) && (!is_simulated || one->is_simulated);
}

static void make_plan(const lines_case *one, unsigned which, ps_nufft_plan *plan) {
    ps_nufft_axis axis = {
        .axis = 1, .factor = 1, .max_frequency = (int32_t)one->K, .n = one->n[which]};
    axis.window = ps_nufft_window_make(one->width, (int32_t)one->K, one->n[which]);
    assert_ok(ps_nufft_plan_create(plan, &axis, true, 1e-14, precision_of(one), device, error));
}

static void make_scales(double scales[NUM_ROWS]) {
    for (size_t r = 0; r < NUM_ROWS; r++) {
        scales[r] = ldexp(1, (int)r);
    }
}

/* ---- points on a line -------------------------------------------------------------------- */

typedef struct places {
    uint64_t x[NUM_PLACES][2];
    double weights[NUM_PLACES], means[NUM_SETS];
} places;

static const ps_nufft_axis *sorted_by;

static int compare_cells(const void *a, const void *b) {
    double fraction = 0;
    const uint32_t one = first_cell(sorted_by, ((const uint64_t *)a)[1], &fraction);
    const uint32_t other = first_cell(sorted_by, ((const uint64_t *)b)[1], &fraction);
    return (one > other) - (one < other);
}

/* Ends of the torus, one cell, and anywhere. */
static uint64_t random_coordinate(const ps_nufft_axis *axis) {
    enum { KINDS = 4 };
    switch ((int)(test_uniform(&seed) * KINDS)) {
    case 0:
        return test_uniform(&seed) < 0.5 ? 0 : UINT64_MAX;
    case 1:
        return first_in_cell(axis, axis->n / 2) + random_u64(&seed) % (UINT64_MAX / axis->n);
    default:
        return random_u64(&seed);
    }
}

static void make_places(const ps_nufft_axis *axis, places *out) {
    sorted_by = axis;
    for (size_t set = 0; set < NUM_SETS; set++) {
        const size_t first = set_begin[set];
        out->means[set] = set == 1 ? 0 : (double)(float)test_uniform(&seed);
        for (size_t j = 0; j < set_points[set]; j++) {
            out->x[first + j][0] = random_u64(&seed);
            out->x[first + j][1] = random_coordinate(axis);
        }
        qsort(out->x[first], set_points[set], sizeof out->x[0], compare_cells);
        for (size_t j = 0; j < set_begin[set + 1] - first; j++) {
            const size_t last = set_points[set] - 1;
            out->weights[first + j] = j <= last ? (double)(float)(2 * test_uniform(&seed) - 1) : 0;
            out->x[first + j][0] = out->x[first + (j < last ? j : last)][0];
            out->x[first + j][1] = out->x[first + (j < last ? j : last)][1];
        }
    }
}

static void expect_line(const ps_nufft_axis *axis, const places *some, size_t set, double *line) {
    for (uint32_t i = 0; i < axis->n; i++) {
        line[i] = -some->means[set];
    }
    for (size_t j = set_begin[set]; j < set_begin[set + 1]; j++) {
        double fraction = 0;
        const uint32_t first = first_cell(axis, some->x[j][1], &fraction);
        for (unsigned i = 0; i < axis->window.width; i++) {
            const double t = i + 1 - axis->window.width / 2.0 - fraction;
            line[(first + i) % axis->n] +=
                some->weights[j] * ps_nufft_window_value(&axis->window, t);
        }
    }
}

/* Windows are of size 1; polynomials are as good as the tolerance that they are made for. */
static void check_lines(const lines_case *one, const ps_nufft_axis *axis, const places *some,
                        const double *lines) {
    double *expected = malloc(axis->n * sizeof *expected);
    for (size_t set = 0; set < NUM_SETS; set++) {
        const double *line = lines + (FIRST_ROW + set) * axis->n;
        const double allowed = 8 * unit_of(one) * (double)set_points[set];
        expect_line(axis, some, set, expected);
        for (uint32_t i = 0; i < axis->n; i++) {
            if (!(fabs(line[i] - expected[i]) <= allowed)) {
                fail_msg("precision %u, lanes %u, width %u, set %zu: cell %u is %g, not %g",
                         one->precision, one->lanes, one->width, set, i, line[i], expected[i]);
            }
        }
    }
    free(expected);
}

enum { PLACES, SORTED, HEIGHTS, MEANS, PATTERN, SCALES, NUM_INPUTS };

static void upload(const lines_case *one, const places *some, test_memory in[NUM_INPUTS]) {
    double scales[NUM_ROWS];
    double *pattern = calloc(2 * (size_t)one->n[0], sizeof *pattern);
    make_scales(scales);
    in[PLACES] = test_memory_create(device, set_begin, sizeof set_begin);
    in[SORTED] = test_memory_create(device, some->x, sizeof some->x);
    in[HEIGHTS] = test_reals_create(device, one->precision, some->weights, NUM_PLACES);
    in[MEANS] = test_reals_create(device, one->precision, some->means, NUM_SETS);
    in[PATTERN] = test_reals_create(device, one->precision, pattern, 2 * (size_t)one->n[0]);
    in[SCALES] = test_reals_create(device, one->precision, scales, NUM_ROWS);
    free(pattern);
}

/* Local memory of a line. */
static size_t line_reals(const ps_nufft_axis *axis) {
    const ps_nufft_choice choice = {
        .variant = &ps_nufft_tiles, .num_axes = 1, .has_line = true, .axes = {*axis}};
    return ps_nufft_lines_measure(&choice, 1).spread_reals;
}

/* One tile from frequency 1 on, whose powers are tests of engines' matter. */
static void spread(const lines_case *one, size_t items) {
    ps_nufft_plan plan = {0};
    places some;
    test_memory in[NUM_INPUTS];
    make_plan(one, 0, &plan);
    make_places(&plan.axis, &some);
    upload(one, &some, in);
    const size_t real_bytes = one->precision / 8, n = one->n[0];
    const size_t stride = (2 * (size_t)one->K + 1) * one->lanes;
    const size_t chunk = PS_NUFFT_CHUNK * (plan.pitch + 2 * (size_t)one->lanes + 4);
    const tile_numbers numbers = {.stride = stride,
                                  .along = ps_nufft_axis_numbers(&plan),
                                  .first_row = FIRST_ROW,
                                  .base = 1,
                                  .num_tiles = 1,
                                  .group = 1,
                                  .dimension = 2,
                                  .K = one->K};
    test_memory power = test_reals_create(device, one->precision, NULL, NUM_ROWS * stride);
    test_memory lines = test_reals_create(device, one->precision, NULL, NUM_ROWS * n);
    ps_kernel *kernel =
        test_kernel(device, "nufft/tile.cl", "nufft_tile", "-DPRECISION=%u -DLANES=%u -DLINE=1",
                    one->precision, one->lanes);
    TEST_LAUNCH(
        device, kernel, items, 1, 1, NUM_SETS, PS_STRUCT(numbers), PS_BUFFER(in[PLACES].buffer),
        PS_BUFFER(in[SORTED].buffer), PS_BUFFER(in[HEIGHTS].buffer), PS_BUFFER(plan.coefficients),
        PS_BUFFER(plan.fft.radices), PS_BUFFER(plan.fft.twiddles), PS_BUFFER(plan.fft.position),
        PS_BUFFER(plan.gains), PS_BUFFER(in[MEANS].buffer), PS_BUFFER(in[PATTERN].buffer),
        PS_BUFFER(in[SCALES].buffer), PS_BUFFER(power.buffer), PS_BUFFER(lines.buffer),
        PS_LOCAL(ps_nufft_row_cells(&plan.axis) * 2 * one->lanes * real_bytes),
        PS_LOCAL(line_reals(&plan.axis) * real_bytes), PS_LOCAL(chunk * real_bytes),
        PS_LOCAL(PS_NUFFT_CHUNK * sizeof(uint64_t)), PS_LOCAL(PS_NUFFT_CHUNK * sizeof(uint32_t)));
    double *found = test_reals_read(&lines, one->precision);
    check_lines(one, &plan.axis, &some, found);
    free(found);
    free(test_reals_read(&power, one->precision)); /* for what stands around them */
    test_memory_free(&lines);
    test_memory_free(&power);
    for (size_t i = 0; i < NUM_INPUTS; i++) {
        test_memory_free_unchanged(&in[i]);
    }
    ps_nufft_plan_free(&plan);
}

/* Work-items alone, and a group that shares cells, of few lanes: PoCL takes seconds to compile it
 * for more. */
static void points_on_lines(void **state) {
    (void)state;
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        if (is_run(&cases[c])) {
            spread(&cases[c], 1);
        }
        if (is_run(&cases[c]) && cases[c].lanes <= 4) {
            spread(&cases[c], 32);
        }
    }
}

/* ---- lines to powers --------------------------------------------------------------------- */

/* The transform at (q, k) of cells [row][n]. */
static double complex transform(const double *cells, uint32_t rows, uint32_t n, int32_t q,
                                int32_t k) {
    double complex sum = 0;
    for (uint32_t m = 0; m < rows; m++) {
        for (uint32_t i = 0; i < n; i++) {
            const int64_t across = (int64_t)m * k % rows, along = (int64_t)i * q % n;
            const double turns = (double)across / rows + (double)along / n;
            sum += cells[m * n + i] * cexp(-I * PS_TWO_PI * turns);
        }
    }
    return sum;
}

/* What a frequency must be: |sum|^2 times gains and scale; off by roundings of |sum|. */
static void check_power(const lines_case *one, const char *what, double found, double expected,
                        double most) {
    const double allowed = 32 * unit_of(one) * sqrt(most);
    if (!(fabs(sqrt(found) - sqrt(expected)) <= allowed)) {
        fail_msg("precision %u, lanes %u, %s: %g, not %g", one->precision, one->lanes, what, found,
                 expected);
    }
}

static double *make_cells(size_t num) {
    double *cells = malloc(num * sizeof *cells);
    for (size_t i = 0; i < num; i++) {
        cells[i] = (double)(float)(2 * test_uniform(&seed) - 1);
    }
    return cells;
}

static line_numbers numbers_of(const ps_nufft_plan *plan, size_t stride) {
    enum { FIRST_POWER = 3 };
    return (line_numbers){.stride = stride,
                          .first_power = FIRST_POWER,
                          .transform = ps_nufft_transform_numbers(plan),
                          .first_row = FIRST_ROW,
                          .num_realizations = NUM_SETS};
}

#define TRANSFORM(plan)                                                                            \
    PS_BUFFER((plan).fft.radices), PS_BUFFER((plan).fft.twiddles), PS_BUFFER((plan).fft.position)

static size_t num_groups(const lines_case *one) {
    return (NUM_SETS + one->lanes - 1) / one->lanes;
}

static size_t row_bytes(const lines_case *one, const ps_nufft_plan *plan) {
    return (size_t)plan->axis.n * 2 * one->lanes * (one->precision / 8);
}

static void run_powers(const lines_case *one) {
    ps_nufft_plan plan = {0};
    double scales[NUM_ROWS];
    make_scales(scales);
    make_plan(one, 0, &plan);
    const uint32_t n = one->n[0];
    const size_t stride = one->K + 8;
    const line_numbers numbers = numbers_of(&plan, stride);
    double *cells = make_cells(NUM_SETS * (size_t)n);
    test_memory lines = test_reals_create(device, one->precision, cells, NUM_SETS * (size_t)n);
    test_memory scale = test_reals_create(device, one->precision, scales, NUM_ROWS);
    test_memory out = test_reals_create(device, one->precision, NULL, NUM_ROWS * stride);
    ps_kernel *kernel = test_kernel(device, "nufft/lines.cl", "nufft_line_powers",
                                    "-DPRECISION=%u -DLANES=%u", one->precision, one->lanes);
    TEST_LAUNCH(device, kernel, 1, 1, num_groups(one), 1, PS_STRUCT(numbers),
                PS_BUFFER(lines.buffer), TRANSFORM(plan), PS_BUFFER(plan.gains),
                PS_BUFFER(scale.buffer), PS_BUFFER(out.buffer), PS_LOCAL(row_bytes(one, &plan)));
    double *power = test_reals_read(&out, one->precision);
    for (size_t set = 0; set < NUM_SETS; set++) {
        for (uint32_t q = 0; q <= one->K; q++) {
            const double gain = ps_nufft_gain(&plan.axis, q) * scales[FIRST_ROW + set];
            const double size = cabs(transform(cells + set * n, 1, n, (int32_t)q, 0));
            check_power(one, "powers", power[(FIRST_ROW + set) * stride + numbers.first_power + q],
                        size * size * gain, n * gain);
        }
    }
    free(power);
    free(cells);
    test_memory_free_unchanged(&lines);
    test_memory_free_unchanged(&scale);
    test_memory_free(&out);
    ps_nufft_plan_free(&plan);
}

static void check_columns(const lines_case *one, const ps_nufft_plan plans[2], const double *cells,
                          const double *scales, const double *power, const line_numbers *numbers) {
    const uint32_t n = one->n[0], rows = one->n[1];
    const int32_t K = (int32_t)one->K;
    for (size_t set = 0; set < NUM_SETS; set++) {
        for (int32_t q = 0; q <= K; q++) {
            for (int32_t k = -K; k <= K; k++) {
                const double gain = ps_nufft_gain(&plans[0].axis, (uint32_t)q) *
                                    ps_nufft_gain(&plans[1].axis, (uint32_t)abs(k)) *
                                    scales[FIRST_ROW + set];
                const double size = cabs(transform(cells + set * rows * n, rows, n, q, k));
                const size_t slot = numbers->first_power + (size_t)(q * (2 * K + 1) + K + k);
                check_power(one, "columns", power[(FIRST_ROW + set) * numbers->stride + slot],
                            size * size * gain, rows * n * gain);
            }
        }
    }
}

static void run_columns(const lines_case *one) {
    ps_nufft_plan plans[2] = {{.bins = 0}};
    double scales[NUM_ROWS];
    make_scales(scales);
    make_plan(one, 0, &plans[0]);
    make_plan(one, 1, &plans[1]);
    const size_t num = (size_t)one->n[0] * one->n[1], kept = one->K + 1;
    const size_t stride = kept * (2 * kept - 1) + 8;
    const line_numbers along = numbers_of(&plans[0], stride),
                       across = numbers_of(&plans[1], stride);
    double *cells = make_cells(NUM_SETS * num);
    test_memory lines = test_reals_create(device, one->precision, cells, NUM_SETS * num);
    test_memory scale = test_reals_create(device, one->precision, scales, NUM_ROWS);
    test_memory grid = test_reals_create(device, one->precision, NULL,
                                         num_groups(one) * kept * one->n[1] * 2 * one->lanes);
    test_memory out = test_reals_create(device, one->precision, NULL, NUM_ROWS * stride);
    ps_kernel *rows = test_kernel(device, "nufft/lines.cl", "nufft_line_rows",
                                  "-DPRECISION=%u -DLANES=%u", one->precision, one->lanes);
    ps_kernel *columns = test_kernel(device, "nufft/lines.cl", "nufft_line_columns",
                                     "-DPRECISION=%u -DLANES=%u", one->precision, one->lanes);
    TEST_LAUNCH(device, rows, 1, 1, num_groups(one) * one->n[1], 1, PS_STRUCT(along),
                PS_BUFFER(lines.buffer), TRANSFORM(plans[0]), PS_BUFFER(grid.buffer),
                PS_U32(one->n[1]), PS_LOCAL(row_bytes(one, &plans[0])));
    TEST_LAUNCH(device, columns, 1, 1, num_groups(one) * kept, 1, PS_STRUCT(across),
                PS_BUFFER(grid.buffer), TRANSFORM(plans[1]), PS_BUFFER(plans[1].gains),
                PS_BUFFER(plans[0].gains), PS_BUFFER(scale.buffer), PS_BUFFER(out.buffer),
                PS_U32(one->K), PS_LOCAL(row_bytes(one, &plans[1])));
    double *power = test_reals_read(&out, one->precision);
    check_columns(one, plans, cells, scales, power, &across);
    free(power);
    free(cells);
    free(test_reals_read(&grid, one->precision)); /* for what stands around it */
    test_memory_free_unchanged(&lines);
    test_memory_free_unchanged(&scale);
    test_memory_free(&grid);
    test_memory_free(&out);
    ps_nufft_plan_free(&plans[0]);
    ps_nufft_plan_free(&plans[1]);
}

static void powers_of_lines(void **state) {
    (void)state;
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        if (is_run(&cases[c])) {
            run_powers(&cases[c]);
            run_columns(&cases[c]);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(points_on_lines),
                                       cmocka_unit_test(powers_of_lines)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_lines", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
