/* Every row of every set of reference/torus.json, by the referee and by torus_direct in both
 * precisions, as lists of frequencies and on full grids; rings too. By torus_nufft in both
 * precisions, the rings and the rows within a box. Tolerances: those of the reference's README,
 * "suggested acceptance tolerances".
 */
#include "harness.h"

#include "engines/host/host_direct.h"
#include "engines/engine.h"
#include "math/pi.h"
#include "spectra/bins.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

static cJSON *reference;
static ps_device *device;

/* e with |dS| <= e sum|w|. Coordinates below 2^-11 that are not multiples of 2^-64 add their part.
 */
static double tolerance_of(ps_precision precision, const int32_t *k, unsigned dimension) {
    const double base = precision == PS_SINGLE ? 4e-7 : precision == PS_DOUBLE ? 4e-15 : 1e-17;
    double sum_k = 0;
    for (unsigned axis = 0; axis < dimension; axis++) {
        sum_k += fabs((double)k[axis]);
    }
    return base + (precision == PS_EXTENDED ? 0 : PS_TWO_PI * sum_k * ldexp(1, -65));
}

/* Asked of engines that can do with less. */
static double asked_of(ps_precision precision) {
    return precision == PS_SINGLE ? 4e-7 : 1e-15;
}

static ps_frequencies read_rows(const test_set *set) {
    const cJSON *rows = cJSON_GetObjectItem(set->json, "rows");
    const size_t num = (size_t)cJSON_GetArraySize(rows);
    int32_t *vectors = calloc(num * set->dimension, sizeof(int32_t));
    ps_frequencies list = {0};
    for (size_t i = 0; i < num; i++) {
        const cJSON *k = cJSON_GetArrayItem(cJSON_GetArrayItem(rows, (int)i), 0);
        for (unsigned axis = 0; axis < set->dimension; axis++) {
            vectors[i * set->dimension + axis] =
                (int32_t)cJSON_GetArrayItem(k, (int)axis)->valuedouble;
        }
    }
    assert_ok(ps_frequencies_list(&list, set->dimension, num, vectors, error));
    return list;
}

/* |P - P_reference| <= (2 |S| e + e^2) in units of |S|^2, and the rounding of the result itself. */
static void check_power(const test_set *set, const int32_t *k, ps_precision precision,
                        double square, double expected) {
    const double e = tolerance_of(precision, k, set->dimension) * set->weight_size_sum;
    const double allowed = 2 * sqrt(expected) * e + e * e + expected * 2 * DBL_EPSILON;
    if (!(fabs(square - expected) <= allowed)) {
        fail_msg("%s %s k=(%d,...): |S|^2 = %.17g, expected %.17g +- %.3g", set->name,
                 ps_precision_name(precision), (int)k[0], square, expected, allowed);
    }
}

/* square: of row i */
static void check_row(const test_set *set, const int32_t *k, ps_precision precision, size_t i,
                      double square) {
    const cJSON *row = cJSON_GetArrayItem(cJSON_GetObjectItem(set->json, "rows"), (int)i);
    const double n = (double)set->num_points;
    const double w2 = set->weight_sum * set->weight_sum;
    const double re = test_number(cJSON_GetArrayItem(row, 1));
    const double im = test_number(cJSON_GetArrayItem(row, 2));
    check_power(set, k, precision, square, re * re + im * im);
    check_power(set, k, precision, square, test_number(cJSON_GetArrayItem(row, 3)) / n * w2);
    check_power(set, k, precision, square,
                test_number(cJSON_GetArrayItem(row, 4)) * set->weight_square_sum);
}

static void check_rows(const test_set *set, const ps_engine *engine, ps_precision precision) {
    ps_frequencies list = read_rows(set);
    const pspec_pattern pattern = test_pattern(set);
    double *squares = test_run_engine(engine, precision, device, &list, &pattern, 1, 1);
    for (size_t i = 0; i < list.num; i++) {
        check_row(set, list.vectors + i * set->dimension, precision, i, squares[i]);
    }
    free(squares);
    ps_frequencies_free(&list);
}

/* k or -k, whichever the half lattice of the grid has: true, and *at, where it has one. */
static bool find_in_grid(const ps_frequencies *grid, const int32_t *k, size_t *at) {
    for (*at = 0; *at < grid->num; (*at)++) {
        const int32_t *vector = grid->vectors + *at * grid->dimension;
        bool is_same = true;
        bool is_opposite = true;
        for (unsigned axis = 0; axis < grid->dimension; axis++) {
            is_same = is_same && vector[axis] == k[axis];
            is_opposite = is_opposite && vector[axis] == -k[axis];
        }
        if (is_same || is_opposite) {
            return true;
        }
    }
    return false; /* 0, or outside */
}

/* Largest |k_i| of the box, by dimension. */
static const int32_t boxes[4] = {0, 1000000, 64, 24};

/* Of engines for grids only: the rows in the box. */
static void check_box(const test_set *set, const ps_engine *engine, ps_precision precision) {
    const pspec_pattern pattern = test_pattern(set);
    ps_frequencies list = read_rows(set);
    ps_frequencies grid = {0};
    size_t num_found = 0;
    assert_ok(ps_frequencies_lattice(&grid, set->dimension, boxes[set->dimension], false, error));
    assert_ok(ps_frequencies_enumerate(&grid, error));
    double *squares =
        test_run_engine_to(engine, precision, asked_of(precision), device, &grid, &pattern, 1, 1);
    for (size_t i = 0; i < list.num; i++) {
        const int32_t *k = list.vectors + i * set->dimension;
        size_t at = 0;
        if (find_in_grid(&grid, k, &at)) {
            check_row(set, k, precision, i, squares[at]);
            num_found++;
        }
    }
    assert_true(num_found >= 30);
    free(squares);
    ps_frequencies_free(&grid);
    ps_frequencies_free(&list);
}

/* Means over rings, from a full grid. */
static void check_rings(const test_set *set, const ps_engine *engine, ps_precision precision) {
    const cJSON *radial = cJSON_GetObjectItem(set->json, "radial");
    const int num_rings = cJSON_GetArraySize(radial);
    const pspec_pattern pattern = test_pattern(set);
    ps_frequencies grid = {0};
    ps_bins bins = {0};
    assert_ok(ps_frequencies_lattice(&grid, set->dimension, num_rings, true, error));
    assert_ok(ps_frequencies_enumerate(&grid, error));
    assert_ok(ps_bins_create(&bins, &grid, error));
    double *squares =
        test_run_engine_to(engine, precision, asked_of(precision), device, &grid, &pattern, 1, 1);
    assert_int_equal(bins.num_reported, num_rings);
    for (int b = 0; b < num_rings; b++) {
        const cJSON *row = cJSON_GetArrayItem(radial, b);
        const ps_bin *bin = &bins.bins[b];
        long double sum = 0;
        for (size_t i = bin->begin; i < bin->end; i++) {
            sum += squares[bins.members[i]];
        }
        const double w2 = set->weight_sum * set->weight_sum / (double)set->num_points;
        const double expected = test_number(cJSON_GetArrayItem(row, 3)) * w2;
        const int32_t k[6] = {num_rings, num_rings, num_rings, num_rings, num_rings, num_rings};
        assert_int_equal(bin->key, (int64_t)test_number(cJSON_GetArrayItem(row, 0)));
        assert_int_equal(2 * (bin->end - bin->begin),
                         (size_t)test_number(cJSON_GetArrayItem(row, 1)));
        assert_true(fabs(bin->mean_frequency / test_number(cJSON_GetArrayItem(row, 2)) - 1) <
                    4 * DBL_EPSILON);
        check_power(set, k, precision, (double)(sum / (long double)(bin->end - bin->begin)),
                    expected);
    }
    free(squares);
    ps_bins_free(&bins);
    ps_frequencies_free(&grid);
}

static void check_all(const ps_engine *engine, ps_precision precision) {
    const cJSON *json = NULL;
    if (precision == PS_DOUBLE && !ps_device_get_limits(device)->has_fp64) {
        skip();
    }
    cJSON_ArrayForEach(json, cJSON_GetObjectItem(reference, "sets")) {
        test_set set = test_read_set(json);
        if (engine == &ps_torus_nufft) {
            check_box(&set, engine, precision);
        } else {
            check_rows(&set, engine, precision);
        }
        check_rings(&set, engine, precision);
        test_free_set(&set);
    }
}

static void referee(void **state) {
    (void)state;
    check_all(&ps_host_direct, PS_EXTENDED);
}

static void torus_direct_double(void **state) {
    (void)state;
    check_all(&ps_torus_direct, PS_DOUBLE);
}

static void torus_direct_single(void **state) {
    (void)state;
    check_all(&ps_torus_direct, PS_SINGLE);
}

static void torus_nufft_double(void **state) {
    (void)state;
    check_all(&ps_torus_nufft, PS_DOUBLE);
}

static void torus_nufft_single(void **state) {
    (void)state;
    check_all(&ps_torus_nufft, PS_SINGLE);
}

/* Real and imaginary part, which powers do not show. */
static void referee_sums(void **state) {
    (void)state;
    const cJSON *json = NULL;
    cJSON_ArrayForEach(json, cJSON_GetObjectItem(reference, "sets")) {
        test_set set = test_read_set(json);
        ps_frequencies list = read_rows(&set);
        const pspec_pattern pattern = test_pattern(&set);
        for (size_t i = 0; i < list.num; i++) {
            const cJSON *row = cJSON_GetArrayItem(cJSON_GetObjectItem(json, "rows"), (int)i);
            long double re = 0;
            long double im = 0;
            const double allowed = 1e-17 * set.weight_size_sum;
            ps_host_sum(&pattern, list.vectors + i * set.dimension, &re, &im);
            assert_true(fabsl(re - test_long_number(cJSON_GetArrayItem(row, 1))) <= allowed);
            assert_true(fabsl(im - test_long_number(cJSON_GetArrayItem(row, 2))) <= allowed);
        }
        ps_frequencies_free(&list);
        test_free_set(&set);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(referee),
        cmocka_unit_test(referee_sums),
        cmocka_unit_test(torus_direct_double),
        cmocka_unit_test(torus_direct_single),
        cmocka_unit_test(torus_nufft_double),
        cmocka_unit_test(torus_nufft_single),
    };
    device = test_open_device();
    reference = test_read_reference("torus.json");
    const int failures = cmocka_run_group_tests_name("torus_reference", tests, NULL, NULL);
    cJSON_Delete(reference);
    ps_device_close(device);
    return failures;
}
