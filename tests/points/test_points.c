/* UTK text: what is read, what is refused and with which words, and what is written. */
#include "harness_points.h"

#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <sys/stat.h>

#include <cmocka.h>

static const ps_point_options defaults = {0};

static const char *put(void **state, const char *text, char path[TEST_PATH_BYTES]) {
    test_path(*state, "points.txt", path);
    assert_true(test_write_file(path, text, strlen(text)));
    return path;
}

/* Reads all sets: their number, and the points of all in one array (freed by the caller). */
static pspec_status read_all(const char *path, const ps_point_options *options, size_t *num_sets,
                             size_t *num_points, double **all, ps_error *error) {
    test_points read;
    const pspec_status status = test_points_read(&read, path, options, error);
    *num_sets = read.num_sets;
    *num_points = read.num_points;
    *all = read.points;
    free(read.weights);
    return status;
}

static void reads_well_formed_text(void **state) {
    static const struct {
        const char *text;
        size_t num_sets, num_points;
        double last; /* coordinate of all */
        unsigned dimension;
    } cases[] = {
        {"0.5 0.25\n0 0.75\n", 1, 2, 0.75, 2},
        {"0.5 0.25\n0 0.75", 1, 2, 0.75, 2},
        {"0.5\t0.25\r\n 0 \t 0.75 \r\n", 1, 2, 0.75, 2},
        {"0.5 0.25\n#\n0 0.75\n0.1 0.2\n", 2, 3, 0.2, 2},
        {"# made by hand\n#\n0.5 0.25\n# next\n0 0.75\n", 2, 2, 0.75, 2},
        {"0.5 0.25\n#\n", 1, 1, 0.25, 2},
        {"0.5 0.25\n\n \n\r\n", 1, 1, 0.25, 2},
        {"0.5 0.25\n#\n0.1 0.2\n#\n\n", 2, 2, 0.2, 2},
        {"0.5", 1, 1, 0.5, 1},
        {"0 0 0 0 0 0\n1e-1 0.2 0.3 0.4 .5 6E-1\n", 1, 2, 0.6, 6},
        {"-0.0 0.99999999999999988898\n", 1, 1, 0.99999999999999988898, 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char path[TEST_PATH_BYTES];
        ps_error error = {0};
        size_t num_sets = 0;
        size_t num_points = 0;
        double *all = NULL;
        if (read_all(put(state, cases[i].text, path), &defaults, &num_sets, &num_points, &all,
                     &error) != PSPEC_OK) {
            fail_msg("%s: %s", cases[i].text, error.message);
        }
        assert_int_equal(num_sets, cases[i].num_sets);
        assert_int_equal(num_points, cases[i].num_points);
        assert_true(all[num_points * cases[i].dimension - 1] == cases[i].last);
        free(all);
    }
}

/* Every refusal names the file, the line and the value. */
static void refuses_bad_text(void **state) {
    const ps_point_options plane = {.dimension = 2};
    const ps_point_options weighted = {.weight_column = true};
    const ps_point_options wrapping = {.wrap = true};
    const struct {
        const char *text;
        const ps_point_options *options;
        const char *message;
    } cases[] = {
        {"", &defaults, "points.txt is empty"},
        {"#\n#\n", &defaults, "points.txt holds no points"},
        {"\n\n", &defaults, "points.txt holds no points"},
        {"0.5 0.25\n0.5\n", &defaults, "line 2: 1 column, where line 1 has 2"},
        {"# x\n0.5\n0.5 0.25 0.3\n", &defaults, "line 3: 3 columns, where line 2 has 1"},
        {"0.5 0.25\n#\n0.5 0.25 0.1\n", &defaults, "line 3: 3 columns, where line 1 has 2"},
        {"0.5 nan\n", &defaults, "line 1: \"nan\" is not a finite number"},
        {"0.5 0.1\n-Inf 0.1\n", &defaults, "line 2: \"-Inf\" is not a finite number"},
        {"0.5 1e999\n", &wrapping, "line 1: coordinate inf is not a finite number"},
        {"0.5 1\n", &defaults, "line 1: coordinate 1 is outside [0,1)"},
        {"0.5 0.99999999999999999\n", &defaults,
         "line 1: coordinate 1 is outside [0,1)"}, /* which it is as a double */
        {"0.5 0.5\n-1e-20 0.5\n", &defaults, "line 2: coordinate -1e-20 is outside [0,1)"},
        {"0.5 x0.5\n", &defaults, "line 1: \"x0.5\" is not a number"},
        {"0.5 0.5\n0.5,0.5\n", &defaults, "line 2: \",\" is not a number"},
        {"0.5 0x1p-3\n", &defaults, "line 1: \"0x1p-3\" is not a number"},
        {"0.5 0.5 # here\n", &defaults, "line 1: \"#\" is not a number"},
        {"0.5 0.5\r0.5 0.5\n", &defaults, "line 1: \"0.5\\x0d0.5\" is not a number"},
        {"\x8aPNG\x01\x02\n", &defaults, "points.txt is neither text nor begins like a format"},
        {"0.5 0.5\n\n0.5 0.5\n", &defaults, "line 2: a blank line, and more after it"},
        {"0.5 0.5\n#\n#\n0.5 0.5\n", &defaults, "line 3: set 2 has no points"},
        {".1 .1 .1 .1 .1 .1 .1\n.1\n", &defaults, "line 1: 7 columns; at most 6 dimensions"},
        {".1 .1 .1 .1 .1 .1 .1 .1\n.1\n", &weighted, "line 1: 8 columns; at most 6 dimensions"},
        {"0.5 0.5 2\n", &plane, "line 1: 3 columns, but the dimension asked for is 2 (is the last"},
        {"0.5\n", &plane, "line 1: 1 column, but the dimension asked for is 2"},
        {"0.5\n", &weighted, "line 1: 1 column; with a weight column there must be at least 2"},
        {"0.5 1\n0.5 1e999\n", &weighted, "line 2: weight inf is not a finite number"},
        {"0.5 1\n1.5 1\n", &weighted, "line 2: coordinate 1.5 is outside [0,1)"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char path[TEST_PATH_BYTES];
        ps_error error = {0};
        size_t num_sets = 0;
        size_t num_points = 0;
        double *all = NULL;
        const pspec_status status = read_all(put(state, cases[i].text, path), cases[i].options,
                                             &num_sets, &num_points, &all, &error);
        free(all);
        if (status != PSPEC_ERROR_INPUT || strstr(error.message, cases[i].message) == NULL ||
            strstr(error.message, "points.txt") == NULL) {
            fail_msg("%s: status %d, \"%s\", expected \"%s\"", cases[i].text, (int)status,
                     error.message, cases[i].message);
        }
    }
}

static void refuses_what_cannot_be_opened(void **state) {
    const test_folder *const folder = *state;
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    ps_point_reader *reader = NULL;
    assert_int_equal(ps_points_open(&reader, folder->path, &defaults, &error), PSPEC_ERROR_IO);
    assert_non_null(strstr(error.message, "Is a directory"));
    assert_int_equal(ps_points_open(&reader, test_path(folder, "missing", path), &defaults, &error),
                     PSPEC_ERROR_IO);
    assert_non_null(strstr(error.message, "missing: No such file"));
    put(state, "0.5 0.5\n", path);
    if (geteuid() != 0) { /* root reads everything */
        assert_int_equal(chmod(path, 0), 0);
        assert_int_equal(ps_points_open(&reader, path, &defaults, &error), PSPEC_ERROR_IO);
        assert_non_null(strstr(error.message, "Permission denied"));
        assert_int_equal(chmod(path, 0600), 0);
    }
    const ps_point_options unknown = {.format = "off"};
    assert_int_equal(ps_points_open(&reader, path, &unknown, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_string_equal(error.message, "point format \"off\" is none of " PS_INPUT_FORMATS);
    const ps_point_options too_many = {.dimension = 7};
    assert_int_equal(ps_points_open(&reader, path, &too_many, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_null(reader);
}

static void wraps_onto_the_torus(void **state) {
    const ps_point_options wrapping = {.wrap = true};
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    size_t num_sets = 0;
    size_t num_points = 0;
    double *all = NULL;
    put(state, "-1e-20 1\n1.25 -0.25\n-7 1e300\n", path);
    assert_int_equal(read_all(path, &wrapping, &num_sets, &num_points, &all, &error), PSPEC_OK);
    const double expected[] = {0, 0, 0.25, 0.75, 0, 0};
    for (size_t i = 0; i < 6; i++) {
        assert_true(all[i] == expected[i]);
    }
    free(all);
}

static void separates_the_weight_column(void **state) {
    const ps_point_options weighted = {.weight_column = true, .dimension = 2};
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    ps_point_reader *reader = NULL;
    ps_point_set set = {0};
    bool has_set = false;
    put(state, "0.5 0.25 -3\n0 0.75 1e6\n", path);
    assert_int_equal(ps_points_open(&reader, path, &weighted, &error), PSPEC_OK);
    assert_string_equal(ps_points_format(reader), "utk-text");
    assert_int_equal(test_points_next(reader, &set, &has_set, &error), PSPEC_OK);
    assert_true(has_set && set.has_weights && set.dimension == 2 && set.num_points == 2);
    assert_true(set.points[2] == 0 && set.points[3] == 0.75);
    assert_true(set.weights[0] == -3 && set.weights[1] == 1e6);
    ps_point_set_free(&set);
    ps_points_close(reader);
}

/* A set is handed out when its '#' line has come, not when the input ends. */
static void reads_standard_input_as_it_comes(void **state) {
    (void)state;
    int ends[2];
    const int kept = dup(STDIN_FILENO);
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(dup2(ends[0], STDIN_FILENO), STDIN_FILENO);
    close(ends[0]);
    const char first[] = "0.5 0.5\n0.25 0.25\n#\n0.1";
    const char second[] = " 0.125\n0.5 5\n";
    assert_int_equal(write(ends[1], first, strlen(first)), strlen(first));
    ps_error error = {0};
    ps_point_reader *reader = NULL;
    ps_point_set set = {0};
    bool has_set = false;
    assert_int_equal(ps_points_open(&reader, "-", &defaults, &error), PSPEC_OK);
    assert_int_equal(test_points_next(reader, &set, &has_set, &error), PSPEC_OK);
    assert_true(has_set && set.num_points == 2);
    assert_int_equal(write(ends[1], second, strlen(second)), strlen(second));
    close(ends[1]);
    assert_int_equal(test_points_next(reader, &set, &has_set, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "standard input, line 5: coordinate 5 is outside"));
    ps_point_set_free(&set);
    ps_points_close(reader);
    dup2(kept, STDIN_FILENO);
    close(kept);
}

/* Several MiB, so that lines and tokens fall on the ends of the buffer in many ways. */
static void survives_every_buffer_end(void **state) {
    enum { NUM_POINTS = 200000, DIMENSION = 3, NUM_VALUES = NUM_POINTS * DIMENSION };
    double *const points = malloc(NUM_VALUES * sizeof *points);
    assert_non_null(points);
    uint64_t random = 123456789;
    for (size_t i = 0; i < NUM_VALUES; i++) {
        random = random * 6364136223846793005U + 1442695040888963407U;
        points[i] = (double)(random >> 11) * 0x1p-53;
        points[i] = (random & 1) != 0 ? (double)(float)(points[i] / 2) : points[i];
    }
    for (int i = 0; i < 3; i++) { /* set by set: two of them, then both again as one */
        char path[TEST_PATH_BYTES];
        ps_error error = {0};
        ps_point_writer *writer = NULL;
        const size_t half = i == 0 ? 2 : 1;
        const ps_point_shape shape = {
            .num_sets = half, .num_points = NUM_POINTS / half, .dimension = DIMENSION};
        ps_point_set set = {
            .dimension = DIMENSION, .num_points = NUM_POINTS / half, .points = points};
        test_path(*state, i == 2 ? "large.npy" : "large.txt", path);
        assert_int_equal(ps_points_create(&writer, path, NULL, &shape, &error), PSPEC_OK);
        assert_int_equal(ps_points_write(writer, &set, true, &error), PSPEC_OK);
        if (i == 0) {
            set.points += NUM_VALUES / 2;
            assert_int_equal(ps_points_write(writer, &set, true, &error), PSPEC_OK);
        }
        assert_int_equal(ps_points_commit(writer, &error), PSPEC_OK);
        ps_points_discard(writer);
        size_t num_sets = 0;
        size_t num_points = 0;
        double *all = NULL;
        assert_int_equal(read_all(path, &defaults, &num_sets, &num_points, &all, &error), PSPEC_OK);
        assert_int_equal(num_sets, i == 0 ? 2 : 1);
        assert_int_equal(num_points, NUM_POINTS);
        assert_memory_equal(all, points, NUM_VALUES * sizeof *points);
        free(all);
    }
    free(points);
}

static void refuses_a_line_without_end(void **state) {
    enum { LENGTH = 5 << 20 };
    char path[TEST_PATH_BYTES];
    char *const text = malloc(LENGTH);
    assert_non_null(text);
    memset(text, '0', LENGTH);
    assert_true(test_write_file(test_path(*state, "long.txt", path), text, LENGTH));
    free(text);
    ps_error error = {0};
    size_t num_sets = 0;
    size_t num_points = 0;
    double *all = NULL;
    assert_int_equal(read_all(path, &defaults, &num_sets, &num_points, &all, &error),
                     PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "long.txt, line 1: no end of line within"));
}

static void writes_what_was_announced(void **state) {
    double points[] = {0.5, 0.25, 0.1, 1.0 / 3};
    const ps_point_set set = {.dimension = 2, .num_points = 2, .points = points};
    const ps_point_shape two = {.num_sets = 2, .num_points = 2, .dimension = 2};
    const ps_point_shape seven = {.num_sets = 1, .num_points = 1, .dimension = 7};
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    ps_point_writer *writer = NULL;
    test_path(*state, "written.dat", path);
    assert_int_equal(ps_points_create(&writer, path, NULL, &two, &error), PSPEC_OK);
    assert_int_equal(ps_points_write(writer, &set, true, &error), PSPEC_OK);
    assert_int_equal(ps_points_commit(writer, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(access(path, F_OK), -1);
    assert_int_equal(ps_points_write(writer, &set, true, &error), PSPEC_OK);
    assert_int_equal(ps_points_write(writer, &set, true, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(ps_points_commit(writer, &error), PSPEC_OK);
    ps_points_discard(writer);
    char *const text = test_read_file(path, NULL);
    assert_string_equal(text, "0.5 0.25\n0.1 0.3333333333333333\n#\n"
                              "0.5 0.25\n0.1 0.3333333333333333\n");
    free(text);
    assert_int_equal(ps_points_create(&writer, path, "ply", &two, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(ps_points_create(&writer, path, NULL, &seven, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    ps_points_discard(NULL);
}

static void reads_the_published_sets(void **state) {
    (void)state;
    const char *const data = getenv("POINTSPEC_TEST_DATA");
    char path[TEST_PATH_BYTES];
    snprintf(path, sizeof path, "%s/pointsets/utk_BNOT_4096.txt", data != NULL ? data : "");
    if (data == NULL || access(path, R_OK) != 0) {
        print_message("POINTSPEC_TEST_DATA does not name the folder of published sets: skipped\n");
        skip();
    }
    ps_error error = {0};
    size_t num_sets = 0;
    size_t num_points = 0;
    double *all = NULL;
    assert_int_equal(read_all(path, &defaults, &num_sets, &num_points, &all, &error), PSPEC_OK);
    assert_int_equal(num_sets, 1);
    assert_int_equal(num_points, 4096);
    FILE *const stream = fopen(path, "r");
    assert_non_null(stream);
    for (size_t i = 0; i < 2 * num_points; i++) {
        double value = 0;
        assert_int_equal(fscanf(stream, "%lf", &value), 1);
        assert_true(value == all[i]);
    }
    fclose(stream);
    free(all);
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(reads_well_formed_text),        IN_FOLDER(refuses_bad_text),
        IN_FOLDER(refuses_what_cannot_be_opened), IN_FOLDER(wraps_onto_the_torus),
        IN_FOLDER(separates_the_weight_column),   IN_FOLDER(reads_standard_input_as_it_comes),
        IN_FOLDER(survives_every_buffer_end),     IN_FOLDER(refuses_a_line_without_end),
        IN_FOLDER(writes_what_was_announced),     cmocka_unit_test(reads_the_published_sets),
    };
    return cmocka_run_group_tests_name("points", tests, NULL, NULL);
}
