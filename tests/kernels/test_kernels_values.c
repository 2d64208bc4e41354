/* integrands/values.cl alone: hits with whole weights that need a pair, in pieces of any length,
 * must be equal, not near.
 */
#include "harness_kernels.h"

#include "integrands/values.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;
static uint64_t seed = 3;

enum { GRID = 64, DIMENSION = 2, SETS = 2, TRIALS = 3, PIECES = 4 };

/* Vectors of the pieces, and their sets; a vector between them belongs to none. */
static const values_piece pieces[PIECES] = {{0, 3, 0}, {3, 1, 0}, {5, 2, 1}, {7, 0, 1}};
enum { VECTORS = 8 };

/* Where a box around 1/2 with sides 1/2 is: multiples of 1/GRID are exact in either precision. */
static const double box_numbers[16] = {
    [0] = 0.5, [1] = 0.5, [6] = 0.5, [7] = 0.5}; /* centre, sides */

static bool is_hit(const double *x, const double *shift) {
    for (int i = 0; i < DIMENSION; i++) {
        const double sum = x[i] + shift[i];
        if (fabs(sum - floor(sum) - 0.5) >= 0.25) {
            return false;
        }
    }
    return true;
}

static double *grid_numbers(size_t num) {
    double *numbers = calloc(num, sizeof *numbers);
    assert_non_null(numbers);
    for (size_t i = 0; i < num; i++) {
        numbers[i] = floor(test_uniform(&seed) * GRID) / GRID;
    }
    return numbers;
}

/* points [axis][capacity] */
static void check_sums(const double *sums, size_t lanes, const double *points,
                       const double *weights, const double *moves) {
    const size_t capacity = VECTORS * lanes;
    for (size_t i = 0; i < PIECES * TRIALS; i++) {
        const values_piece piece = pieces[i / TRIALS];
        const double *const shift = moves + (piece.set * TRIALS + i % TRIALS) * DIMENSION;
        int64_t expected = 0;
        for (size_t j = piece.first * lanes; j < (piece.first + piece.num_vectors) * lanes; j++) {
            const double x[DIMENSION] = {points[j], points[capacity + j]};
            expected += is_hit(x, shift) ? (int64_t)weights[j] : 0;
        }
        assert_true(isfinite(sums[2 * i]) && isfinite(sums[2 * i + 1]));
        assert_true((int64_t)sums[2 * i] + (int64_t)sums[2 * i + 1] == expected);
    }
}

static void launch(ps_kernel *kernel, size_t group, unsigned precision, size_t lanes,
                   const double *points, const double *weights, const double *moves) {
    const size_t capacity = VECTORS * lanes;
    const values_sizes sizes = {capacity, TRIALS};
    values_doubles doubles;
    values_singles singles;
    for (size_t i = 0; i < 16; i++) {
        doubles.numbers[i] = box_numbers[i];
        singles.numbers[i] = (float)box_numbers[i];
    }
    test_memory at = test_reals_create(device, precision, points, DIMENSION * capacity);
    test_memory with = test_reals_create(device, precision, weights, capacity);
    test_memory parts = test_memory_create(device, pieces, sizeof pieces);
    test_memory moved = test_reals_create(device, precision, moves, SETS * TRIALS * DIMENSION);
    test_memory sums = test_reals_create(device, precision, NULL, 2 * PIECES * TRIALS);
    const ps_argument numbers = precision == 64 ? PS_STRUCT(doubles) : PS_STRUCT(singles);
    TEST_LAUNCH(device, kernel, group, TRIALS, PIECES, 1, PS_STRUCT(sizes), numbers,
                PS_BUFFER(at.buffer), PS_BUFFER(with.buffer), PS_BUFFER(parts.buffer),
                PS_BUFFER(moved.buffer), PS_BUFFER(with.buffer), PS_BUFFER(sums.buffer));
    double *found = test_reals_read(&sums, precision);
    check_sums(found, lanes, points, weights, moves);
    free(found);
    test_memory_free_unchanged(&at);
    test_memory_free_unchanged(&with);
    test_memory_free_unchanged(&parts);
    test_memory_free_unchanged(&moved);
    test_memory_free(&sums);
}

static void check_build(unsigned precision, size_t lanes) {
    const size_t capacity = VECTORS * lanes;
    double *points = grid_numbers(DIMENSION * capacity);
    double *moves = grid_numbers((size_t)SETS * TRIALS * DIMENSION);
    double *weights = test_whole_numbers(&seed, capacity, precision == 64 ? 0x1p53 : 0x1p24);
    ps_kernel *kernel = test_kernel(device, "integrands/values.cl", "integrand_values",
                                    "-DINTEGRAND=box -DPRECISION=%u -DLANES=%zu -DDIMENSION=%d",
                                    precision, lanes, DIMENSION);
    for (size_t g = 0; g < sizeof TEST_GROUP_SIZES / sizeof TEST_GROUP_SIZES[0]; g++) {
        launch(kernel, TEST_GROUP_SIZES[g], precision, lanes, points, weights, moves);
    }
    free(points);
    free(moves);
    free(weights);
}

static void hits(void **state) {
    static const struct {
        unsigned precision;
        size_t lanes;
    } builds[] = {{32, 4}, {32, 16}, {32, 1}, {64, 4}, {64, 8}};
    (void)state;
    for (size_t i = 0; i < sizeof builds / sizeof builds[0]; i++) {
        if (test_has_precision(device, builds[i].precision)) {
            check_build(builds[i].precision, builds[i].lanes);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(hits)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_values", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
