/* torus/list.cl alone: every entry of its table against long double, its sums against its table.
 * Launches cover empty chunks, realizations shorter than the table and tiles nobody has.
 */
#include "harness_kernels.h"

#include "engines/torus/torus_layout.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

__extension__ typedef __int128 wide;

static ps_device *device;
static uint64_t seed = 3;

typedef struct list_case {
    unsigned precision, lanes, dimension;
    bool has_table;
    size_t run, chunk, tiles, weighted_tiles; /* the first tiles of the table */
    double largest_frequency;
} list_case;

/* Points of the realizations: nothing, one, two, a prime, and one either side of run and chunk. */
enum { REALIZATIONS = 9 };

static void make_counts(const list_case *one, size_t counts[REALIZATIONS]) {
    const size_t wanted[REALIZATIONS] = {
        0, 1, 2, 7, one->run - 1, one->run + 1, one->chunk - 1, one->chunk + 1, 2 * one->chunk};
    for (size_t r = 0; r < REALIZATIONS; r++) {
        counts[r] = wanted[r];
    }
}

typedef struct list_data {
    size_t num_points, table_points, num_chunks, table_length, sums_length;
    size_t counts[REALIZATIONS];
    uint64_t offsets[REALIZATIONS + 1];
    uint64_t *points;
    int32_t *k; /* [dimension][tiles * lanes] */
    double *weights;
} list_data;

static uint64_t random_u64(void) {
    const uint64_t high = (uint64_t)(test_uniform(&seed) * 0x1p32);
    return high << 32 | (uint64_t)(test_uniform(&seed) * 0x1p32);
}

/* Weights are signed powers of two where the table has them, so that w cos is exact. */
static double random_weight(const list_case *one) {
    const double x = 2 * test_uniform(&seed) - 1;
    return one->weighted_tiles > 0 ? copysign(ldexp(1, (int)(8 * fabs(x)) - 4), x)
                                   : (double)(float)x;
}

static list_data make_data(const list_case *one) {
    list_data data = {.num_chunks = 3}; /* the last one is empty */
    make_counts(one, data.counts);
    for (size_t r = 0; r < REALIZATIONS; r++) {
        data.offsets[r + 1] = data.offsets[r] + data.counts[r];
    }
    data.num_points = (size_t)data.offsets[REALIZATIONS];
    data.table_points = 2 * one->chunk + 1;
    data.table_length = REALIZATIONS * one->tiles * data.table_points * 2 * one->lanes;
    data.sums_length = REALIZATIONS * data.num_chunks * one->tiles * 4 * one->lanes;
    data.points = calloc(data.num_points * one->dimension, sizeof *data.points);
    data.weights = calloc(data.num_points, sizeof *data.weights);
    data.k = calloc(one->dimension * one->tiles * one->lanes, sizeof *data.k);
    for (size_t i = 0; i < data.num_points * one->dimension; i++) {
        data.points[i] = i % 5 == 0 ? random_u64() & ~(uint64_t)0 << 61 : random_u64();
    }
    for (size_t j = 0; j < data.num_points; j++) {
        data.weights[j] = random_weight(one);
    }
    for (size_t i = 0; i < one->dimension * one->tiles * one->lanes; i++) {
        const double size = pow(one->largest_frequency, test_uniform(&seed));
        data.k[i] = (int32_t)copysign(rint(size), test_uniform(&seed) - 0.5);
    }
    return data;
}

static void free_data(list_data *data) {
    free(data->points);
    free(data->weights);
    free(data->k);
}

/* ---- launch ------------------------------------------------------------------------------ */

static test_memory upload_frequencies(const list_case *one, const list_data *data) {
    const size_t num = one->dimension * one->tiles * one->lanes;
    int64_t *words = calloc(num, sizeof *words);
    for (size_t i = 0; i < num; i++) {
        if (one->precision == 64) {
            words[i] = data->k[i];
        } else {
            ((int32_t *)words)[i] = data->k[i];
        }
    }
    const test_memory memory = test_memory_create(device, words, num * one->precision / 8);
    free(words);
    return memory;
}

static ps_kernel *create_kernel(const list_case *one) {
    return test_kernel(device, "torus/list.cl", "torus_list",
                       "-DPRECISION=%u -DLANES=%u -DDIMENSION=%u -DLIST_RUN=%zu -DSTORE_TABLE=%d",
                       one->precision, one->lanes, one->dimension, one->run, one->has_table);
}

/* Returns the sums; *table_values receives the table when there is one. */
static double *run_list(const list_case *one, const list_data *data, size_t group,
                        double **table_values) {
    ps_kernel *kernel = create_kernel(one);
    test_memory points = test_memory_create(device, data->points,
                                            data->num_points * one->dimension * sizeof(uint64_t));
    test_memory weights =
        test_reals_create(device, one->precision, data->weights, data->num_points);
    test_memory offsets = test_memory_create(device, data->offsets, sizeof data->offsets);
    test_memory frequencies = upload_frequencies(one, data);
    test_memory sums = test_reals_create(device, one->precision, NULL, data->sums_length);
    test_memory table = test_reals_create(device, one->precision, NULL, data->table_length);
    TEST_LAUNCH(device, kernel, group, one->tiles, data->num_chunks, REALIZATIONS,
                PS_BUFFER(points.buffer), PS_BUFFER(weights.buffer), PS_BUFFER(offsets.buffer),
                PS_BUFFER(frequencies.buffer), PS_BUFFER(sums.buffer), PS_U64(0),
                PS_U64(one->tiles), PS_U64(one->chunk), PS_BUFFER(table.buffer),
                PS_U64(data->table_points), PS_U64(one->weighted_tiles));
    double *values = test_reals_read(&sums, one->precision);
    *table_values = one->has_table ? test_reals_read(&table, one->precision) : NULL;
    test_memory_free_unchanged(&points);
    test_memory_free_unchanged(&weights);
    test_memory_free_unchanged(&offsets);
    test_memory_free_unchanged(&frequencies);
    test_memory_free(&sums);
    test_memory_free(&table);
    return values;
}

/* ---- checks ------------------------------------------------------------------------------ */

/* cos and sin of 2 pi k.x; *allowed is how far the kernel may be off. */
static void expected_terms(const list_case *one, const list_data *data, size_t frequency,
                           size_t point, long double terms[2], double *allowed) {
    wide turn = 0;
    double sum_k = 0;
    for (unsigned axis = 0; axis < one->dimension; axis++) {
        const int32_t k = data->k[axis * one->tiles * one->lanes + frequency];
        turn += (wide)k * (wide)data->points[point * one->dimension + axis];
        sum_k += fabs((double)k);
    }
    const long double angle = PS_TWO_PI_L * ldexpl((long double)(int64_t)(uint64_t)turn, -64);
    const double units = 2 + (2 + one->dimension) * sum_k * 0x1p-24; /* as in shared_cases.h */
    terms[0] = cosl(angle);
    terms[1] = sinl(angle);
    *allowed = one->precision == 64 ? 4e-16 : 1.8e-7 + (double)PS_TWO_PI_L * units * 0x1p-32;
}

static void check_table(const list_case *one, const list_data *data, const double *table) {
    for (size_t r = 0; r < REALIZATIONS; r++) {
        for (size_t i = 0; i < one->tiles * data->table_points * one->lanes; i++) {
            const size_t lane = i % one->lanes, j = i / one->lanes % data->table_points;
            const size_t tile = i / one->lanes / data->table_points;
            const double *row =
                table + ((r * one->tiles + tile) * data->table_points + j) * 2 * one->lanes + lane;
            if (j >= data->counts[r]) { /* between the realizations nothing is written */
                assert_true(isnan(row[0]) && isnan(row[one->lanes]));
                continue;
            }
            long double terms[2];
            double allowed = 0;
            const size_t point = (size_t)data->offsets[r] + j;
            const double weight = tile < one->weighted_tiles ? data->weights[point] : 1;
            expected_terms(one, data, tile * one->lanes + lane, point, terms, &allowed);
            assert_true(fabsl((long double)row[0] - weight * terms[0]) <= allowed * fabs(weight));
            assert_true(fabsl((long double)row[one->lanes] - weight * terms[1]) <=
                        allowed * fabs(weight));
        }
    }
}

static double fused(const list_case *one, double a, double b, double c) {
    return one->precision == 64 ? fma(a, b, c) : (double)fmaf((float)a, (float)b, (float)c);
}

/* The sum of one chunk as the table has it: runs in working precision, the rest exact. */
static long double sum_of_runs(const list_case *one, const list_data *data, const double *table,
                               size_t r, size_t chunk, size_t tile, size_t column) {
    long double sum = 0;
    for (size_t run = 0; run < one->chunk; run += one->run) {
        double part = 0;
        for (size_t i = run; i < run + one->run && i < one->chunk; i++) {
            const size_t j = chunk * one->chunk + i;
            if (j < data->counts[r]) {
                const double term =
                    table[((r * one->tiles + tile) * data->table_points + j) * 2 * one->lanes +
                          column];
                const double weight =
                    tile < one->weighted_tiles ? 1 : data->weights[(size_t)data->offsets[r] + j];
                part = fused(one, weight, term, part);
            }
        }
        sum += part;
    }
    return sum;
}

/* Sums are those of the table up to the rounding of the pairs; high and low do not overlap. */
static void check_sums(const list_case *one, const list_data *data, const double *table,
                       const double *sums) {
    const double epsilon = one->precision == 64 ? 0x1p-53 : 0x1p-24;
    const double rounding = one->precision == 64 ? 0x1p-62 : 0x1p-44; /* long double: 64 bits */
    for (size_t i = 0; i < REALIZATIONS * data->num_chunks * one->tiles * 2 * one->lanes; i++) {
        const size_t column = i % (2 * one->lanes), tile = i / (2 * one->lanes) % one->tiles;
        const size_t chunk = i / (2 * one->lanes) / one->tiles % data->num_chunks;
        const size_t r = i / (2 * one->lanes) / one->tiles / data->num_chunks;
        const size_t part = column / one->lanes * 2, lane = column % one->lanes;
        const double *found =
            sums + ((r * data->num_chunks + chunk) * one->tiles + tile) * 4 * one->lanes;
        const double high = found[part * one->lanes + lane];
        const double low = found[(part + 1) * one->lanes + lane];
        const long double expected = sum_of_runs(one, data, table, r, chunk, tile, column);
        const double size = 16.0 * (double)one->chunk; /* no weight is larger */
        assert_true(fabsl((long double)high + low - expected) <= rounding * size);
        assert_true(fabs(low) <= epsilon * size);
    }
}

/* Without a table the sums are compared with long double as a whole. */
static void check_sums_alone(const list_case *one, const list_data *data, const double *sums) {
    const double run_error = (double)one->run * (one->precision == 64 ? 0x1p-53 : 0x1p-24);
    for (size_t i = 0; i < REALIZATIONS * data->num_chunks * one->tiles * one->lanes; i++) {
        const size_t lane = i % one->lanes, tile = i / one->lanes % one->tiles;
        const size_t chunk = i / one->lanes / one->tiles % data->num_chunks;
        const size_t r = i / one->lanes / one->tiles / data->num_chunks;
        const double *found =
            sums + ((r * data->num_chunks + chunk) * one->tiles + tile) * 4 * one->lanes + lane;
        long double expected[2] = {0, 0};
        double allowed = 0;
        for (size_t j = chunk * one->chunk; j < (chunk + 1) * one->chunk && j < data->counts[r];
             j++) {
            const size_t point = (size_t)data->offsets[r] + j;
            long double terms[2];
            double term_error = 0;
            expected_terms(one, data, tile * one->lanes + lane, point, terms, &term_error);
            expected[0] += data->weights[point] * terms[0];
            expected[1] += data->weights[point] * terms[1];
            allowed += (term_error + run_error) * fabs(data->weights[point]);
        }
        for (size_t part = 0; part < 2; part++) {
            const long double sum =
                (long double)found[2 * part * one->lanes] + found[(2 * part + 1) * one->lanes];
            assert_true(fabsl(sum - expected[part]) <= allowed);
        }
    }
}

static void check_case(const list_case *one, size_t num_groups) {
    if (!test_has_precision(device, one->precision)) {
        return;
    }
    list_data data = make_data(one);
    for (size_t g = 0; g < num_groups; g++) {
        double *table = NULL;
        double *sums = run_list(one, &data, TEST_GROUP_SIZES[2 - g], &table);
        check_sums_alone(one, &data, sums);
        if (one->has_table) {
            check_table(one, &data, table);
            check_sums(one, &data, table, sums);
        }
        free(sums);
        free(table);
    }
    free_data(&data);
}

static unsigned native_lanes(ps_precision precision) {
    return ps_engine_lanes(ps_device_get_limits(device), precision);
}

/* Weights in all tiles, in some and in none. */
static void table_single(void **state) {
    (void)state;
    check_case(&(list_case){32, 4, 2, true, 8, 16, 3, 2, 100}, 3);
    check_case(&(list_case){32, native_lanes(PS_SINGLE), 3, true, 7, 16, 2, 0, 1e6}, 1);
}

static void table_double(void **state) {
    (void)state;
    check_case(&(list_case){64, native_lanes(PS_DOUBLE), 2, true, 5, 13, 5, 5, 1e6}, 1);
    check_case(&(list_case){64, 1, 1, true, 8, 16, 3, 1, 0x1p28}, 1);
}

static void sums_without_table(void **state) {
    (void)state;
    check_case(&(list_case){32, native_lanes(PS_SINGLE), 1, false, 16, 32, 3, 0, 0x1p28}, 1);
    check_case(&(list_case){64, native_lanes(PS_DOUBLE), 6, false, 8, 16, 3, 0, 0x1p28}, 3);
    check_case(&(list_case){32, 1, 6, false, 2, 5, 3, 0, 1000}, 1);
}

static void production_sizes(void **state) {
    (void)state;
    check_case(&(list_case){32, native_lanes(PS_SINGLE), 2, true, PS_TORUS_LIST_RUN, PS_TORUS_CHUNK,
                            1, 1, 1000},
               1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(table_single),
        cmocka_unit_test(table_double),
        cmocka_unit_test(sums_without_table),
        cmocka_unit_test(production_sizes),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_list", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
