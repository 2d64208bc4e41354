/* Every format writes what it reads: round trips to the bit, and what is said where bits are lost.
 */
#include "harness_points.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { NUM_POINTS = 1000, NUM_SETS = 3 };

static void fill(double *values, size_t count, uint64_t random, bool narrow) {
    for (size_t i = 0; i < count; i++) {
        random = random * 6364136223846793005U + 1442695040888963407U;
        values[i] = (double)(random >> 11) * 0x1p-53;
        values[i] = narrow ? (double)(float)(values[i] / 2) : values[i];
    }
}

/* Writes the sets, reads them back, compares bits; false when the format cannot hold them. */
static bool makes_round_trip(void **state, const char *format, const ps_point_set *sets,
                             size_t num_sets, bool shape_is_known) {
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    test_points all;
    const ps_point_options options = {.format = format,
                                      .dimension = sets[0].dimension,
                                      .points_per_set = NUM_POINTS,
                                      .weight_column = sets[0].has_weights};
    test_path(*state, "round", path);
    const pspec_status status =
        test_points_write(path, format, sets, num_sets, shape_is_known, NULL, &error);
    if (status != PSPEC_OK) {
        assert_int_equal(status, PSPEC_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(error.message, "hold"));
        assert_int_equal(access(path, F_OK), -1);
        return false;
    }
    if (test_points_read_blocks(&all, path, &options, 333, &error) != PSPEC_OK) {
        fail_msg("%s: %s", format, error.message);
    }
    assert_int_equal(all.num_sets, num_sets);
    assert_int_equal(all.num_points, num_sets * NUM_POINTS);
    for (size_t m = 0; m < num_sets; m++) {
        const size_t count = (size_t)NUM_POINTS * sets[0].dimension;
        assert_memory_equal(all.points + m * count, sets[m].points, count * sizeof(double));
        assert_true(!sets[0].has_weights || memcmp(all.weights + m * NUM_POINTS, sets[m].weights,
                                                   NUM_POINTS * sizeof(double)) == 0);
    }
    test_points_free(&all);
    remove(path);
    return true;
}

static void round_trips_are_bitwise(void **state) {
    static const struct {
        const char *format;
        unsigned most_dimensions;
        size_t most_sets;
        bool holds_weights;
    } limits[] = {
        {"utk-text", 6, 3, true}, {"csv", 6, 3, true},         {"psa-text", 2, 1, true},
        {"gbn", 6, 1, false},     {"edat", 6, 3, true},        {"eps", 2, 1, false},
        {"rps", 6, 3, false},     {"utk-binary", 6, 3, false}, {"npy", 6, 3, true},
    };
    static double points[NUM_SETS][NUM_POINTS * 6];
    static double weights[NUM_SETS][NUM_POINTS];
    for (size_t f = 0; f < sizeof limits / sizeof limits[0]; f++) {
        for (unsigned combination = 0; combination < 32; combination++) {
            static const unsigned dimensions[] = {1, 2, 3, 6};
            const unsigned d = dimensions[combination % 4];
            const size_t num_sets = combination / 4 % 2 != 0 ? NUM_SETS : 1;
            const bool has_weights = combination / 8 % 2 != 0;
            const bool is_known = combination / 16 % 2 != 0;
            const bool is_psa =
                strcmp(limits[f].format, "psa-text") == 0 || strcmp(limits[f].format, "eps") == 0;
            ps_point_set sets[NUM_SETS];
            for (size_t m = 0; m < num_sets; m++) {
                fill(points[m], (size_t)NUM_POINTS * d, m + combination,
                     strcmp(limits[f].format, "rps") == 0);
                fill(weights[m], NUM_POINTS, m + 77, false);
                sets[m] = (ps_point_set){.dimension = d,
                                         .num_points = NUM_POINTS,
                                         .points = points[m],
                                         .weights = weights[m],
                                         .has_weights = has_weights};
            }
            const bool fits = num_sets <= limits[f].most_sets &&
                              (is_psa ? d == 2 : d <= limits[f].most_dimensions) &&
                              (!has_weights || limits[f].holds_weights);
            if (makes_round_trip(state, limits[f].format, sets, num_sets, is_known) != fits) {
                fail_msg("%s, d = %u, %zu sets, weights %d", limits[f].format, d, num_sets,
                         has_weights);
            }
        }
    }
}

static void says_what_is_lost(void **state) {
    double points[] = {0.1, 0.5, 0.99999999999, 0.25};
    const ps_point_set set = {.dimension = 2, .num_points = 2, .points = points};
    const ps_point_shape shape = {.num_sets = 1, .num_points = 2, .dimension = 2};
    char path[TEST_PATH_BYTES];
    char loss[256];
    ps_error error = {0};
    test_points all;
    ps_point_writer *writer = NULL;
    test_path(*state, "a.rps", path);
    assert_int_equal(ps_points_create(&writer, path, NULL, &shape, &error), PSPEC_OK);
    assert_int_equal(ps_points_write(writer, &set, true, &error), PSPEC_OK);
    ps_points_describe_loss(writer, loss, sizeof loss);
    assert_string_equal(loss, "2 of 4 coordinates were rounded to float32, by at most 6e-08");
    assert_int_equal(ps_points_commit(writer, &error), PSPEC_OK);
    ps_points_discard(writer);
    const ps_point_options options = {0};
    assert_int_equal(test_points_read(&all, path, &options, &error), PSPEC_OK);
    assert_true(all.points[2] < 1); /* never rounded out of the torus */
    test_points_free(&all);
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {IN_FOLDER(round_trips_are_bitwise),
                                       IN_FOLDER(says_what_is_lost)};
    return cmocka_run_group_tests_name("points_round_trips", tests, NULL, NULL);
}
