/* nufft/strips.cl alone, against windows added and transformed in double precision: grids of one
 * strip and of several, of one part and of some side by side, windows as narrow and as wide as
 * there are. Points stand at the borders of cells and strips and at both ends of the torus, too;
 * one work-group does several realizations.
 */
#include "harness_kernels.h"
#include "window_cells.h"

#include "engines/nufft/grid_axis.h"
#include "engines/torus/nufft/layout.h"
#include "engines/torus/nufft/variant.h"
#include "engines/nufft/window.h"
#include "math/pi.h"
#include "nufft/strips.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

static ps_device *device;
static uint64_t seed = 14;

/* Points of the realizations, the first of which is a piece of a chunk; whole units of places. */
enum { NUM_SETS = 3, MOST_POINTS = 45, GROUPS = 2, FIRST_ROW = 1 };
static const size_t set_points[NUM_SETS] = {1, 45, 20};
static const uint64_t set_begin[NUM_SETS + 1] = {0, 16, 64, 96};
enum { NUM_PLACES = 96 };

typedef struct strips_case {
    unsigned precision, lanes;
    uint32_t n[2];
    uint32_t K;
    unsigned widths[2];
    bool is_simulated; /* on Oclgrind, too */
} strips_case;

static const strips_case cases[] = {
    {32, 16, {27, 64}, 9, {4, 7}, false},   {32, 4, {24, 48}, 8, {7, 12}, true},
    {32, 1, {20, 32}, 6, {5, 2}, true},     {64, 8, {28, 16}, 5, {6, 9}, true},
    {64, 4, {45, 48}, 15, {16, 11}, false}, {64, 1, {16, 16}, 4, {2, 16}, true},
};

typedef struct place {
    uint64_t x[2];
    double weight;
} place;

typedef struct strips_data {
    ps_nufft_choice choice;
    ps_nufft_plan plans[2];
    place places[NUM_PLACES];
    uint32_t *starts; /* [set][cell of axis 1 + 2] */
    double means[NUM_SETS], scales[FIRST_ROW + NUM_SETS];
} strips_data;

/* ---- points ------------------------------------------------------------------------------ */

/* Ends of the torus, borders of strips (those of axis 0 are cells) and anywhere. */
static uint64_t random_coordinate(const ps_nufft_axis *axis, uint32_t columns) {
    enum { KINDS = 4 };
    const uint64_t less = test_uniform(&seed) < 0.5 ? 1 : 0; /* just before the border */
    switch ((int)(test_uniform(&seed) * KINDS)) {
    case 0:
        return 0 - less;
    case 1:
        return first_in_cell(axis, (uint32_t)(test_uniform(&seed) * axis->n) / columns * columns) -
               less;
    default:
        return random_u64(&seed);
    }
}

static int compare_cells(const void *a, const void *b) {
    const uint64_t one = ((const place *)a)->x[0];
    const uint64_t other = ((const place *)b)->x[0];
    return (one > other) - (one < other);
}

/* In the order of cells of axis 1, which x[0] holds while they are sorted. What follows up to the
 * next set has no weight. */
static void make_set(strips_data *data, size_t set, uint32_t columns) {
    const ps_nufft_axis *along = &data->choice.axes[1];
    place *const places = data->places + set_begin[set];
    uint32_t *const starts = data->starts + set * (along->n + 2);
    const size_t num = set_points[set];
    double fraction = 0;
    for (size_t j = 0; j < num; j++) {
        places[j].x[1] = random_coordinate(along, columns);
        places[j].x[0] = first_cell(along, places[j].x[1], &fraction);
        places[j].weight = (double)(float)(2 * test_uniform(&seed) - 1);
    }
    qsort(places, num, sizeof *places, compare_cells);
    for (size_t j = 0, cell = 0; cell < along->n + 2; cell++) {
        starts[cell] = (uint32_t)j;
        while (j < num && places[j].x[0] == cell) {
            j++;
        }
    }
    for (size_t j = 0; j < num; j++) {
        places[j].x[0] = random_coordinate(&data->choice.axes[0], 1);
    }
    for (size_t j = num; j < set_begin[set + 1] - set_begin[set]; j++) {
        places[j] = (place){{places[num - 1].x[0], places[num - 1].x[1]}, 0};
    }
}

/* ---- what is expected -------------------------------------------------------------------- */

static void add_point(const ps_nufft_choice *choice, const place *point, double *grid) {
    const ps_nufft_axis *axes = choice->axes;
    double fractions[2];
    const uint32_t row = first_cell(&axes[0], point->x[0], &fractions[0]);
    const uint32_t column = first_cell(&axes[1], point->x[1], &fractions[1]);
    for (unsigned i = 0; i < axes[0].window.width; i++) {
        const double t = i + 1 - axes[0].window.width / 2.0 - fractions[0];
        const double height = point->weight * ps_nufft_window_value(&axes[0].window, t);
        for (unsigned j = 0; j < axes[1].window.width; j++) {
            const double u = j + 1 - axes[1].window.width / 2.0 - fractions[1];
            grid[(row + i) % axes[0].n * axes[1].n + (column + j) % axes[1].n] +=
                height * ps_nufft_window_value(&axes[1].window, u);
        }
    }
}

/* The transform of the cells at (k, q), what windows do to it undone. */
static double complex transform(const ps_nufft_choice *choice, const double *grid, int32_t k,
                                int32_t q) {
    const ps_nufft_axis *axes = choice->axes;
    double complex sum = 0;
    for (uint32_t row = 0; row < axes[0].n; row++) {
        for (uint32_t column = 0; column < axes[1].n; column++) {
            const double turns = (double)row * k / axes[0].n + (double)column * q / axes[1].n;
            sum += grid[row * axes[1].n + column] * cexp(-I * PS_TWO_PI * turns);
        }
    }
    return sum *
           sqrt(ps_nufft_gain(&axes[0], (uint32_t)k) * ps_nufft_gain(&axes[1], (uint32_t)abs(q)));
}

/* power: of the set, [tile][2K + 1][lanes] */
static void check_set(const strips_case *one, const strips_data *data, size_t set,
                      const double *power) {
    const ps_nufft_axis *axes = data->choice.axes;
    const size_t num_cells = (size_t)axes[0].n * axes[1].n;
    const size_t num_q = 2 * (size_t)one->K + 1;
    const double allowed = (one->precision == 32 ? 2e-5 : 4e-14) * sqrt((double)set_points[set]) *
                           sqrt(ps_nufft_gain(&axes[0], one->K) * ps_nufft_gain(&axes[1], one->K));
    double *grid = malloc(num_cells * sizeof *grid);
    for (size_t i = 0; i < num_cells; i++) {
        grid[i] = -data->means[set];
    }
    for (size_t j = 0; j < set_points[set]; j++) {
        add_point(&data->choice, &data->places[set_begin[set] + j], grid);
    }
    for (size_t i = 0; i < (one->K / one->lanes + 1) * one->lanes * num_q; i++) {
        const size_t lane = i % one->lanes, tile = i / (num_q * one->lanes);
        const int32_t k = (int32_t)(tile * one->lanes + lane);
        const int32_t q = (int32_t)(i / one->lanes % num_q) - (int32_t)one->K;
        const double expected =
            k <= (int32_t)one->K ? cabs(transform(&data->choice, grid, k, q)) : 0;
        const double off = fabs(sqrt(power[i] / data->scales[FIRST_ROW + set]) - expected);
        if (!(off <= allowed)) {
            fail_msg(
                "precision %u, lanes %u, n %u x %u, set %zu: (%d, %d) is off by %g, allowed %g",
                one->precision, one->lanes, axes[0].n, axes[1].n, set, (int)k, (int)q, off,
                allowed);
        }
    }
    free(grid);
}

/* ---- launches ---------------------------------------------------------------------------- */

static void make_data(const strips_case *one, strips_data *data) {
    const ps_precision precision = one->precision == 32 ? PS_SINGLE : PS_DOUBLE;
    data->choice = (ps_nufft_choice){
        .lanes = one->lanes, .num_axes = 2, .span = one->K + 1, .variant = &ps_nufft_strips};
    for (unsigned i = 0; i < 2; i++) {
        ps_nufft_axis *const axis = &data->choice.axes[i];
        *axis = (ps_nufft_axis){
            .axis = i, .factor = 1, .max_frequency = (int32_t)one->K, .n = one->n[i]};
        axis->window = ps_nufft_window_make(one->widths[i], (int32_t)one->K, one->n[i]);
        assert_ok(
            ps_nufft_plan_create(&data->plans[i], axis, true, 1e-14, precision, device, error));
    }
    data->starts = calloc(NUM_SETS * (one->n[1] + 2), sizeof *data->starts);
    for (size_t set = 0; set < NUM_SETS; set++) {
        data->means[set] = set == 1 ? 0 : (double)(float)(test_uniform(&seed) / one->n[1]);
        data->scales[FIRST_ROW + set] = ldexp(1, (int)set);
        make_set(data, set, ps_nufft_strip_columns(one->lanes));
    }
}

/* What the kernel only reads. */
enum { PLACES, SORTED, HEIGHTS, STARTS, MEANS, SCALES, NUM_INPUTS };

static void upload(const strips_case *one, const strips_data *data, test_memory in[NUM_INPUTS]) {
    uint64_t points[NUM_PLACES * 2];
    double weights[NUM_PLACES];
    for (size_t j = 0; j < NUM_PLACES; j++) {
        points[2 * j] = data->places[j].x[0];
        points[2 * j + 1] = data->places[j].x[1];
        weights[j] = data->places[j].weight;
    }
    in[PLACES] = test_memory_create(device, set_begin, sizeof set_begin);
    in[SORTED] = test_memory_create(device, points, sizeof points);
    in[HEIGHTS] = test_reals_create(device, one->precision, weights, NUM_PLACES);
    in[STARTS] =
        test_memory_create(device, data->starts, NUM_SETS * (one->n[1] + 2) * sizeof *data->starts);
    in[MEANS] = test_reals_create(device, one->precision, data->means, NUM_SETS);
    in[SCALES] = test_reals_create(device, one->precision, data->scales, FIRST_ROW + NUM_SETS);
}

static strips_numbers numbers_of(const strips_case *one, const strips_data *data,
                                 const ps_nufft_strip_sizes *sizes, size_t stride) {
    return (strips_numbers){.stride = stride,
                            .strip_reals = sizes->strip_reals,
                            .across = ps_nufft_window_numbers(&data->plans[0]),
                            .along = ps_nufft_window_numbers(&data->plans[1]),
                            .K = one->K,
                            .columns = sizes->columns,
                            .pitch = sizes->pitch,
                            .num_tiles = one->K / one->lanes + 1,
                            .num_realizations = NUM_SETS,
                            .first_row = FIRST_ROW};
}

#define AXIS(plan)                                                                                 \
    PS_BUFFER((plan).fft.radices), PS_BUFFER((plan).fft.twiddles), PS_BUFFER((plan).fft.position), \
        PS_BUFFER((plan).gains)

static void run_case(const strips_case *one, const strips_data *data) {
    const ps_nufft_strip_sizes sizes = ps_nufft_strips_measure(&data->choice, one->lanes);
    const size_t stride = (one->K / one->lanes + 1) * one->lanes * (2 * (size_t)one->K + 1);
    const strips_numbers numbers = numbers_of(one, data, &sizes, stride);
    const size_t real_bytes = one->precision / 8;
    ps_kernel *kernel = test_kernel(device, "nufft/strips.cl", "nufft_strips",
                                    "-DPRECISION=%u -DLANES=%u", one->precision, one->lanes);
    test_memory in[NUM_INPUTS];
    upload(one, data, in);
    test_memory strips =
        test_reals_create(device, one->precision, NULL, GROUPS * sizes.strip_reals);
    test_memory tiles = test_reals_create(device, one->precision, NULL, GROUPS * sizes.tile_reals);
    test_memory out =
        test_reals_create(device, one->precision, NULL, (FIRST_ROW + NUM_SETS) * stride);
    TEST_LAUNCH(device, kernel, 1, 1, GROUPS, 1, PS_STRUCT(numbers), PS_BUFFER(in[PLACES].buffer),
                PS_BUFFER(in[SORTED].buffer), PS_BUFFER(in[HEIGHTS].buffer),
                PS_BUFFER(in[STARTS].buffer), PS_BUFFER(data->plans[0].coefficients),
                PS_BUFFER(data->plans[1].coefficients), AXIS(data->plans[0]), AXIS(data->plans[1]),
                PS_BUFFER(in[MEANS].buffer), PS_BUFFER(in[SCALES].buffer), PS_BUFFER(out.buffer),
                PS_BUFFER(strips.buffer), PS_BUFFER(tiles.buffer),
                PS_LOCAL(sizes.window_reals * real_bytes),
                PS_LOCAL(2 * PS_NUFFT_CHUNK * sizeof(uint32_t)));
    double *power = test_reals_read(&out, one->precision);
    for (size_t set = 0; set < NUM_SETS; set++) {
        check_set(one, data, set, power + (FIRST_ROW + set) * stride);
    }
    free(power);
    free(test_reals_read(&strips, one->precision)); /* for what stands around them */
    free(test_reals_read(&tiles, one->precision));
    test_memory_free(&strips);
    test_memory_free(&tiles);
    test_memory_free(&out);
    for (size_t i = 0; i < NUM_INPUTS; i++) {
        test_memory_free_unchanged(&in[i]);
    }
}

static void powers_of_windows(void **state) {
    (void)state;
    const bool is_simulated = ps_device_get_limits(device)->has_dedicated_local_memory;
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        const strips_case *one = &cases[c];
        strips_data data = {.starts = NULL};
        if (test_has_precision(device, one->precision) && (!is_simulated || one->is_simulated)) {
            make_data(one, &data);
            run_case(one, &data);
        }
        ps_nufft_plan_free(&data.plans[0]);
        ps_nufft_plan_free(&data.plans[1]);
        free(data.starts);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(powers_of_windows)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_strips", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
