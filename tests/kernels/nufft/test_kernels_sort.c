/* nufft/order.cl alone, against a stable sort of the host: the same order, starts and points for
 * tiles of every size of local memory, groups of any number of items, sets of one tile and of many,
 * keys of one digit and of several.
 */
#include "harness_kernels.h"

#include "engines/nufft/axis.h"
#include "engines/nufft/order.h"

#include <stdlib.h>
#include <string.h>

static ps_device *device;
static uint64_t seed = 58;

enum { MOST_SETS = 4, DIMENSION = 2 };

typedef enum key_kind { RANDOM, EQUAL, DESCENDING, LAST } key_kind;

typedef struct sort_case {
    size_t num_sets, points[MOST_SETS];
    uint32_t num_keys;
    key_kind kind;
    uint32_t local_kib, group; /* 0: as the device has them, with work-groups that suit tiles */
    bool is_simulated;         /* on Oclgrind, too */
} sort_case;

static const sort_case cases[] = {
    {4, {0, 1, 300, 77}, 23, RANDOM, 0, 0, true},
    {3, {0, 1, 500}, 1, EQUAL, 16, 3, true},
    {2, {1025, 0}, 5000, RANDOM, 16, 64, true},
    {2, {2100, 5}, 1 << 12, DESCENDING, 16, 0, true},
    {2, {4095, 4096}, 1 << 20, RANDOM, 0, 0, false},
    {3, {4097, 4095, 0}, 1 << 20, RANDOM, 0, 0, false},
    {2, {4096, 100}, 5184, DESCENDING, 32, 64, false},
    {2, {4097, 4096}, 5184, LAST, 0, 1, false},
    {1, {100000}, 5184, RANDOM, 0, 0, false},
    {1, {100000}, 1, EQUAL, 16, 64, false},
    {1, {100000}, 1 << 20, RANDOM, 32, 512, false},
    {1, {100000}, UINT32_MAX, RANDOM, 48, 0, false},
};

static uint32_t make_key(const sort_case *one, size_t j, size_t num) {
    switch (one->kind) {
    case RANDOM:
        return (uint32_t)(test_uniform(&seed) * one->num_keys);
    case DESCENDING:
        return (uint32_t)((num - 1 - j) * one->num_keys / num);
    case LAST:
        return one->num_keys - 1;
    default:
        return 0;
    }
}

static size_t begin_of(const sort_case *one, size_t set) {
    return set == 0 ? 0 : begin_of(one, set - 1) + one->points[set - 1];
}

static size_t place_of(const sort_case *one, size_t set) {
    const size_t unit = PS_NUFFT_PLACE_UNIT;
    return set == 0 ? 0 : place_of(one, set - 1) + (one->points[set - 1] + unit - 1) / unit * unit;
}

/* Keys and where they came from: those of a key stay in their order. */
typedef struct entry {
    uint32_t key, from;
} entry;

static int compare_entries(const void *a, const void *b) {
    const entry *const one = a, *const other = b;
    return one->key != other->key ? (one->key > other->key) - (one->key < other->key)
                                  : (one->from > other->from) - (one->from < other->from);
}

/* The coordinates of point `from` of all; its weight is the first one. */
static uint64_t coordinate(size_t from, size_t axis) {
    return (uint64_t)from * DIMENSION + axis + 1;
}

static void check_places(const entry *order, size_t num, size_t first, const uint64_t *sorted,
                         const float *heights) {
    const size_t unit = PS_NUFFT_PLACE_UNIT;
    for (size_t i = 0; i < (num + unit - 1) / unit * unit; i++) {
        const size_t from = first + order[i < num ? i : num - 1].from;
        assert_true(sorted[i * DIMENSION] == coordinate(from, 0));
        assert_true(sorted[i * DIMENSION + 1] == coordinate(from, 1));
        assert_true(heights[i] == (i < num ? (float)coordinate(from, 0) : 0));
    }
}

/* Of keys that nobody has, too. */
static void check_starts(const entry *order, size_t num, uint32_t row, const uint32_t *starts) {
    for (size_t key = 0, i = 0; key < row; key++) {
        while (i < num && order[i].key < key) {
            i++;
        }
        assert_int_equal(starts[key], i);
    }
}

static void check_set(const sort_case *one, size_t set, const uint32_t *keys, uint32_t row,
                      const uint64_t *sorted, const float *heights, const uint32_t *starts) {
    const size_t num = one->points[set], first = begin_of(one, set), place = place_of(one, set);
    entry *const order = calloc(num + 1, sizeof *order);
    assert_non_null(order);
    for (size_t j = 0; j < num; j++) {
        order[j] = (entry){keys[first + j], (uint32_t)j};
    }
    qsort(order, num, sizeof *order, compare_entries);
    check_places(order, num, first, sorted + place * DIMENSION, heights + place);
    check_starts(order, num, row, starts + set * row);
    free(order);
}

/* Room for the starts of all keys, or of the first where they would fill the memory. */
static uint32_t row_of(const sort_case *one) {
    const uint32_t most = 1 << 21;
    return one->num_keys < most ? one->num_keys + 1 : most;
}

static void check_case(const sort_case *one) {
    size_t most = 0;
    uint64_t offsets[MOST_SETS + 1], places[MOST_SETS + 1];
    for (size_t s = 0; s <= one->num_sets; s++) {
        offsets[s] = begin_of(one, s);
        places[s] = place_of(one, s);
        most = s < one->num_sets && one->points[s] > most ? one->points[s] : most;
    }
    const size_t num = offsets[one->num_sets], num_places = places[one->num_sets];
    const uint32_t row = row_of(one);
    uint32_t *const keys = calloc(num, sizeof *keys);
    uint64_t *const points = calloc(num * DIMENSION, sizeof *points);
    float *const weights = calloc(num, sizeof *weights);
    for (size_t s = 0, j = 0; s < one->num_sets; s++) {
        for (size_t i = 0; i < one->points[s]; i++, j++) {
            keys[j] = make_key(one, i, one->points[s]);
            points[j * DIMENSION] = coordinate(j, 0);
            points[j * DIMENSION + 1] = coordinate(j, 1);
            weights[j] = (float)coordinate(j, 0);
        }
    }
    ps_device_set_local_bytes(device, one->local_kib << 10);
    ps_device_set_group_size(device, one->group);
    const ps_nufft_order_sizes sizes =
        ps_nufft_order_measure(ps_device_get_limits(device), most, one->num_keys, row);
    ps_nufft_order order;
    assert_ok(
        ps_nufft_order_create(&order, &sizes, one->num_sets, DIMENSION, PS_SINGLE, device, error));
    assert_ok(ps_buffer_write(device, &order.keys, 0, keys, num * sizeof *keys, error));
    test_memory from = test_memory_create(device, points, num * DIMENSION * sizeof *points);
    test_memory of = test_memory_create(device, weights, num * sizeof *weights);
    test_memory begins = test_memory_create(device, offsets, sizeof offsets);
    test_memory to = test_memory_create(device, places, sizeof places);
    test_memory sorted =
        test_memory_create(device, NULL, num_places * DIMENSION * sizeof(uint64_t));
    test_memory heights = test_memory_create(device, NULL, num_places * sizeof(float));
    test_memory starts = test_memory_create(device, NULL, one->num_sets * row * sizeof(uint32_t));
    assert_ok(ps_nufft_order_run(&order,
                                 &(ps_nufft_order_points){.points = &from.buffer,
                                                          .weights = &of.buffer,
                                                          .offsets = &begins.buffer,
                                                          .places = &to.buffer,
                                                          .sorted = &sorted.buffer,
                                                          .heights = &heights.buffer,
                                                          .starts = &starts.buffer,
                                                          .has_weights = true},
                                 one->num_sets, error));
    uint64_t *const found = test_memory_read(&sorted);
    float *const found_heights = test_memory_read(&heights);
    uint32_t *const found_starts = test_memory_read(&starts);
    for (size_t s = 0; s < one->num_sets; s++) {
        check_set(one, s, keys, row, found, found_heights, found_starts);
    }
    free(found);
    free(found_heights);
    free(found_starts);
    test_memory_free_unchanged(&from);
    test_memory_free_unchanged(&of);
    test_memory_free_unchanged(&begins);
    test_memory_free_unchanged(&to);
    test_memory_free(&sorted);
    test_memory_free(&heights);
    test_memory_free(&starts);
    ps_nufft_order_free(&order);
    ps_device_set_local_bytes(device, 0);
    ps_device_set_group_size(device, 0);
    free(keys);
    free(points);
    free(weights);
}

static void orders_are_those_of_a_stable_sort(void **state) {
    (void)state;
    const bool is_simulated = ps_device_is_simulator(ps_device_get_limits(device));
    ps_device_set_dedicated_local_memory(device, true);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        if (!is_simulated || cases[i].is_simulated) {
            check_case(&cases[i]);
        }
    }
    ps_device_set_dedicated_local_memory(device, false);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(orders_are_those_of_a_stable_sort)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_sort", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
