/* Lists of frequencies and of weights. */
#include "files/npy_array.h"
#include "points/lists/frequency_list.h"
#include "points/lists/weight_list.h"
#include "test_folder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static const char *put(void **state, const char *text, char path[TEST_PATH_BYTES]) {
    test_path(*state, "list", path);
    assert_true(test_write_file(path, text, strlen(text)));
    return path;
}

static void reads_frequencies(void **state) {
    static const struct {
        const char *text;
        size_t num_vectors;
        unsigned dimension;
        int last;
    } cases[] = {
        {"1 2\n-3 4\n", 2, 2, 4}, {"# k1,k2\n1,2\n\n-3 , 1e6\r\n", 2, 2, 1000000},
        {"1\n2\n3", 3, 1, 3},     {"0\t0,0 0 0 -1073741824\n", 1, 6, -1073741824},
        {"5.0 7.\n", 1, 2, 7},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char path[TEST_PATH_BYTES];
        ps_error error = {0};
        int *vectors = NULL;
        size_t num_vectors = 0;
        unsigned dimension = 0;
        if (ps_read_frequencies(put(state, cases[i].text, path), 0, &vectors, &num_vectors,
                                &dimension, &error) != PSPEC_OK) {
            fail_msg("%s: %s", cases[i].text, error.message);
        }
        assert_int_equal(num_vectors, cases[i].num_vectors);
        assert_int_equal(dimension, cases[i].dimension);
        assert_int_equal(vectors[num_vectors * dimension - 1], cases[i].last);
        free(vectors);
    }
}

static void refuses_bad_frequencies(void **state) {
    static const char *const cases[][2] = {
        {"", "list is empty"},
        {"# nothing\n", "list holds no numbers"},
        {"1 2\n3\n", "line 2: 1 column, the first line has 2"},
        {"1 2\n3 4 5\n", "line 2: 3 columns, the first line has 2"},
        {"1 2.5\n", "line 1: frequency 2.5 is not a whole number"},
        {"1 2e9\n", "line 1: frequency 2000000000 is not a whole number between -1073741824"},
        {"1,,2\n", "line 1: \"\" is not a number"},
        {"1,2,\n", "line 1: \"\" is not a number"},
        {"1 x\n", "line 1: \"x\" is not a number"},
        {"1 nan\n", "line 1: \"nan\" is not a number"},
        {"1 2 3 4 5 6 7\n", "line 1: 7 columns; frequency vectors have at most 6"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char path[TEST_PATH_BYTES];
        ps_error error = {0};
        int *vectors = NULL;
        size_t num_vectors = 0;
        unsigned dimension = 0;
        const pspec_status status = ps_read_frequencies(put(state, cases[i][0], path), 0, &vectors,
                                                        &num_vectors, &dimension, &error);
        if (status != PSPEC_ERROR_INPUT || strstr(error.message, cases[i][1]) == NULL) {
            fail_msg("%s: status %d, \"%s\", expected \"%s\"", cases[i][0], (int)status,
                     error.message, cases[i][1]);
        }
        assert_null(vectors);
    }
}

static void reads_weights(void **state) {
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    double *weights = NULL;
    size_t num_weights = 0;
    put(state, "# w\n1 -2.5\t3e-3\r\n\n4\n", path);
    assert_int_equal(ps_read_weights(path, UINT32_MAX, &weights, &num_weights, &error), PSPEC_OK);
    assert_int_equal(num_weights, 4);
    assert_true(weights[0] == 1 && weights[1] == -2.5 && weights[2] == 3e-3 && weights[3] == 4);
    free(weights);
    double values[] = {1, -1e300, 0.5};
    const ps_npy_array array = {1, {3}, 3, false, values};
    assert_int_equal(ps_npy_write_array(path, &array, &error), PSPEC_OK);
    assert_int_equal(ps_read_weights(path, UINT32_MAX, &weights, &num_weights, &error), PSPEC_OK);
    assert_int_equal(num_weights, array.num);
    assert_memory_equal(weights, values, sizeof values);
    free(weights);
}

/* As data frames are written: quotes, the name of the column, an index that has none or one. */
static void reads_weights_of_data_frames(void **state) {
    static const char *const cases[] = {
        "w\n1\n\n2\r\n",
        "\"w\"\n\"1\"\n\"2\"\n",
        "\"1\"\n\"2\"\n",
        "\"1\" 2\n",
        ",w\n0,1\n1,2\n",
        "\"\",\"w\"\n\"0\",\"1\"\n\"1\",\"2\"\n",
        "\"\";\"the weight\"\r\n\"a\";1\r\n\"b\";2\r\n",
        ",0\n0,1\n1,2\n",
        "id,w\n7,1\n3,2\n",
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char path[TEST_PATH_BYTES];
        ps_error error = {0};
        double *weights = NULL;
        size_t num = 0;
        put(state, cases[i], path);
        if (ps_read_weights(path, 2, &weights, &num, &error) != PSPEC_OK) {
            fail_msg("%s: %s", cases[i], error.message);
        }
        assert_int_equal(num, 2);
        assert_true(weights[0] == 1 && weights[1] == 2);
        free(weights);
    }
}

static void refuses_bad_weights(void **state) {
    static const char *const cases[][2] = {{"# none\n", "list holds no numbers"},
                                           {"1\n1,5\n", "line 2: a comma"},
                                           {"1\ninf\n", "line 2: \"inf\" is not a finite number"},
                                           {"1e999\n", "\"1e999\" is not a finite number"},
                                           {"1 a\n", "line 1: \"a\" is not a finite number"},
                                           {"w\nw\n1\n", "line 2: \"w\" is not a number"},
                                           {"1 \"\"\n", "line 1: \"\" is not a finite number"},
                                           {"w\nnan\n", "line 2: \"nan\" is not a finite number"},
                                           {"w\n1e999\n", "line 2: weight inf is not a finite"},
                                           {"w\n1 2\n", "line 2: \"1 2\" is not a number"},
                                           {"w\n1,2\n", "line 2: 2 columns, where the header"},
                                           {"\"\",w\n0,1\n5,2\n", "line 3: \"5\" in a column"},
                                           {"x,y,w\n0,1,2\n", "line 1: columns x,y,w; weights"},
                                           {"w\n", "holds no numbers"}};
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    double *weights = NULL;
    size_t num_weights = 0;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        put(state, cases[i][0], path);
        assert_int_equal(ps_read_weights(path, UINT32_MAX, &weights, &num_weights, &error),
                         PSPEC_ERROR_INPUT);
        if (strstr(error.message, cases[i][1]) == NULL) {
            fail_msg("%s: \"%s\", expected \"%s\"", cases[i][0], error.message, cases[i][1]);
        }
    }
    double values[] = {1, (double)NAN};
    ps_npy_array array = {2, {1, 2}, 2, false, values};
    assert_int_equal(ps_npy_write_array(path, &array, &error), PSPEC_OK);
    assert_int_equal(ps_read_weights(path, UINT32_MAX, &weights, &num_weights, &error),
                     PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "an array with 2 axes; weights have one"));
    array = (ps_npy_array){1, {2}, 2, false, values};
    assert_int_equal(ps_npy_write_array(path, &array, &error), PSPEC_OK);
    assert_int_equal(ps_read_weights(path, UINT32_MAX, &weights, &num_weights, &error),
                     PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "weight 2 is nan, not a finite number"));
    assert_int_equal(ps_read_weights("/nowhere/at all", UINT32_MAX, &weights, &num_weights, &error),
                     PSPEC_ERROR_IO);
    assert_null(weights);
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(reads_frequencies),   IN_FOLDER(refuses_bad_frequencies),
        IN_FOLDER(reads_weights),       IN_FOLDER(reads_weights_of_data_frames),
        IN_FOLDER(refuses_bad_weights),
    };
    return cmocka_run_group_tests_name("lists", tests, NULL, NULL);
}
