/* Binary point formats without NumPy's header: UTK binary, raw floats; and openquad. */
#include "harness_points.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#define ANY .domain = PS_DOMAIN_ANY

static bool is_same(double a, double b) {
    return memcmp(&a, &b, sizeof a) == 0;
}

/* ---- UTK binary -------------------------------------------------------------------------- */

static size_t make_utk(unsigned char *file, unsigned type, uint32_t m, uint32_t n, uint32_t d,
                       const void *values, size_t num_bytes) {
    const uint32_t counts[] = {m, n, d}; /* this machine is little-endian */
    memset(file, 0, 20);
    memcpy(file, "UTK!", 4);
    file[4] = (unsigned char)type;
    memcpy(file + 8, counts, sizeof counts);
    memcpy(file + 20, values, num_bytes);
    return 20 + num_bytes;
}

static pspec_status read_utk(void **state, const unsigned char *file, size_t num_bytes,
                             const ps_point_options *options, test_points *all, ps_error *error) {
    char path[TEST_PATH_BYTES];
    assert_true(test_write_file(test_path(*state, "a.bin", path), file, num_bytes));
    return test_points_read(all, path, options, error);
}

static void reads_every_type_of_utk(void **state) {
    static const double doubles[] = {0.5, 0.25, 0, 0.75};
    static const float floats[] = {0.5F, 0.25F, 0, 0.75F};
    static const uint32_t zeros[8] = {0};
    static const struct {
        unsigned type;
        const void *values;
        size_t num_bytes;
    } cases[] = {{0, zeros, 16}, {1, zeros, 32},  {2, zeros, 16},
                 {3, zeros, 32}, {4, floats, 16}, {5, doubles, 32}};
    for (size_t i = 0; i < 6; i++) {
        unsigned char file[64];
        ps_error error = {0};
        test_points all;
        const ps_point_options options = {0};
        const size_t num_bytes =
            make_utk(file, cases[i].type, 1, 2, 2, cases[i].values, cases[i].num_bytes);
        assert_int_equal(read_utk(state, file, num_bytes, &options, &all, &error), PSPEC_OK);
        assert_int_equal(all.num_points, 2);
        assert_true(is_same(all.points[3], i < 4 ? 0 : 0.75));
        test_points_free(&all);
    }
}

static void refuses_bad_utk(void **state) {
    static const double doubles[] = {0.5, 0.25, 0.5, 0.25, 0.5, 0.25, 0.5, 0.25};
    static const int32_t integers[] = {3, 4};
    static const struct {
        unsigned type;
        uint32_t m, n, d;
        const void *values;
        size_t num_bytes;
        ps_point_options options;
        const char *message;
    } cases[] = {
        {5,
         1,
         2,
         2,
         doubles,
         24,
         {0},
         "is truncated: its header promises 32 bytes of values, there are 24"},
        {5, 1, 2, 2, doubles, 40, {0}, "is too long"},
        {5, 1, 2, 2, doubles, 64, {0}, "holds values of 16 bytes (long double)"},
        {6, 1, 2, 2, doubles, 32, {0}, "have the type 6; 0 to 5 are known"},
        {5, 0, 2, 2, doubles, 32, {0}, "holds no points"},
        {5, UINT32_MAX, UINT32_MAX, 6, doubles, 32, {0}, "its header promises 4294967295 sets"},
        {5, 1, 2, 8, doubles, 32, {0}, "dimension 8; at most 6 are read"},
        {0, 1, 1, 2, integers, 8, {0}, "coordinate 3 is outside [0,1)"},
        {0,
         1,
         1,
         2,
         integers,
         8,
         {.wrap = true},
         "holds whole numbers, which --wrap would all make 0"},
        {5, 2, 2, 2, doubles, 64, {0}, "set 2 repeats set 1, as in files that UTK 2.0.1 wrote"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        unsigned char file[128];
        ps_error error = {0};
        test_points all;
        const size_t num_bytes = make_utk(file, cases[i].type, cases[i].m, cases[i].n, cases[i].d,
                                          cases[i].values, cases[i].num_bytes);
        const pspec_status status =
            read_utk(state, file, num_bytes, &cases[i].options, &all, &error);
        test_points_free(&all);
        if (status != PSPEC_ERROR_INPUT || strstr(error.message, cases[i].message) == NULL) {
            fail_msg("case %zu: status %d, \"%s\"", i, (int)status, error.message);
        }
    }
}

/* Whoever says which sets are meant gets them, equal or not. */
static void reads_repeated_sets_when_told(void **state) {
    static const double doubles[] = {0.5, 0.25, 0.5, 0.25, 0.5, 0.25, 0.5, 0.25};
    unsigned char file[128];
    ps_error error = {0};
    test_points all;
    const ps_point_options first = {.sets = {1, 1}};
    const ps_point_options both = {.sets = {1, 2}};
    const size_t num_bytes = make_utk(file, 5, 2, 2, 2, doubles, sizeof doubles);
    assert_int_equal(read_utk(state, file, num_bytes, &first, &all, &error), PSPEC_OK);
    assert_int_equal(all.num_sets, 1);
    test_points_free(&all);
    assert_int_equal(read_utk(state, file, num_bytes, &both, &all, &error), PSPEC_OK);
    assert_int_equal(all.num_sets, 2);
    test_points_free(&all);
}

/* ---- raw floats and openquad ------------------------------------------------------------- */

static void reads_raw_floats(void **state) {
    static const float values[] = {0.5F, 0.25F, 0, 0.75F, 0.125F, 0.375F, 0.1F, 0.2F};
    static const struct {
        const char *name;
        ps_point_options options;
        size_t num_sets, num_points;
        unsigned dimension;
    } cases[] = {
        {"a.rps", {0}, 1, 4, 2},
        {"stdin.binary", {.points_per_set = 2}, 2, 4, 2},
        {"a.rps", {.points_per_set = 1}, 4, 4, 2},
        {"a.raw", {.format = "rps", .dimension = 4, .points_per_set = 1}, 2, 2, 4},
        {"a.rps", {.points_per_set = 1, .sets = {2, 3}}, 2, 2, 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char path[TEST_PATH_BYTES];
        ps_error error = {0};
        test_points all;
        assert_true(test_write_file(test_path(*state, cases[i].name, path), values, sizeof values));
        assert_int_equal(test_points_read(&all, path, &cases[i].options, &error), PSPEC_OK);
        assert_int_equal(all.num_sets, cases[i].num_sets);
        assert_int_equal(all.num_points, cases[i].num_points);
        assert_int_equal(all.dimension, cases[i].dimension);
        assert_true(cases[i].options.sets.last != 0 || is_same(all.points[7], (double)0.2F));
        test_points_free(&all);
    }
}

static void reads_openquad(void **state) {
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    test_points all;
    enum { NUM = 9 };
    double points[2 * NUM];
    double weights[NUM];
    for (int i = 0; i < NUM; i++) {
        points[2 * i] = 0.3 * i;
        points[2 * i + 1] = 0.7 * i;
        weights[i] = i - 3;
    }
    ps_point_set set = {.coordinates = PS_ANGLES,
                        .dimension = 2,
                        .num_points = NUM,
                        .points = points,
                        .weights = weights,
                        .has_weights = true};
    test_path(*state, "a.npy", path);
    assert_int_equal(test_points_write(path, "openquad", &set, 1, true, NULL, &error), PSPEC_OK);
    ps_point_options options = {ANY, .keep_angles = true, .format = "openquad"};
    assert_int_equal(test_points_read(&all, path, &options, &error), PSPEC_OK);
    assert_string_equal(all.format, "openquad");
    assert_string_equal(all.columns, "theta-phi-w");
    assert_int_equal(all.num_points, NUM);
    assert_memory_equal(all.points, points, sizeof points);
    assert_memory_equal(all.weights, weights, sizeof weights);
    test_points_free(&all);
    /* its rows could be anything: the options tell */
    options.format = NULL;
    assert_int_equal(test_points_read(&all, path, &options, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "no unit vectors"));
    test_points_free(&all);
    options.columns = "theta-phi-w";
    assert_int_equal(test_points_read(&all, path, &options, &error), PSPEC_OK);
    assert_string_equal(all.format, "npy");
    assert_memory_equal(all.points, points, sizeof points);
    assert_memory_equal(all.weights, weights, sizeof weights);
    test_points_free(&all);
    /* short rows could be points */
    set.num_points = 3;
    assert_int_equal(test_points_write(path, "openquad", &set, 1, true, NULL, &error), PSPEC_OK);
    assert_int_equal(test_points_read(&all, path, &options, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "shape (3, 3): are its rows the points, or its columns? "
                                          "--input-format npy or --transpose"));
    test_points_free(&all);
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(reads_every_type_of_utk),
        IN_FOLDER(refuses_bad_utk),
        IN_FOLDER(reads_repeated_sets_when_told),
        IN_FOLDER(reads_raw_floats),
        IN_FOLDER(reads_openquad),
    };
    return cmocka_run_group_tests_name("points_binary", tests, NULL, NULL);
}
