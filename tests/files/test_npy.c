/* Arrays that are written, alone and in archives: the bytes that NumPy reads. */
#include "files/input_file.h"
#include "files/npy_array.h"
#include "files/packed/npz.h"
#include "test_folder.h"

#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static void writes_what_numpy_reads(void **state) {
    static double data[] = {0.5, 0.25, 0.125, -1};
    const size_t shapes[][3] = {{4}, {2, 2}, {1, 2, 2}};
    static const char *const texts[] = {"'shape': (4,), }", "'shape': (2, 2), }",
                                        "'shape': (1, 2, 2), }"};
    for (unsigned rank = 1; rank <= 3; rank++) {
        char path[TEST_PATH_BYTES];
        ps_error error = {0};
        size_t length = 0;
        test_path(*state, "array.npy", path);
        ps_npy_array array = {.rank = rank, .num = 4, .data = data};
        memcpy(array.shape, shapes[rank - 1], rank * sizeof *array.shape);
        assert_int_equal(ps_npy_write_array(path, &array, &error), PSPEC_OK);
        char *const file = test_read_file(path, &length);
        assert_memory_equal(file, "\x93NUMPY\x01\0", 8);
        const size_t header = 10 + (size_t)(unsigned char)file[8] + 256 * (size_t)file[9];
        assert_int_equal(header % 64, 0);
        assert_int_equal(file[header - 1], '\n');
        assert_int_equal(length, header + sizeof data);
        assert_memory_equal(file + header, data, sizeof data);
        file[header - 1] = '\0';
        assert_non_null(strstr(file + 10, "{'descr': '<f8', 'fortran_order': False, 'shape': ("));
        assert_non_null(strstr(file + 10, texts[rank - 1]));
        free(file);
    }
}

/* ---- archives ------------------------------------------------------------------------------ */

static const size_t shapes[][2] = {{3, 2}, {2, 0}};
static const double numbers[] = {0.1, -0.0, INFINITY, -INFINITY, NAN, 5e-324};
static const int64_t integers[] = {INT64_MIN, INT64_MAX, -1};
static const uint32_t letters[] = {'a', 0xe9, 0x1f600, 0};
static const ps_npz_array arrays[] = {
    {"numbers", 'f', sizeof *numbers, 2, shapes[0], numbers},
    {"integers", 'i', sizeof *integers, 1, shapes[0], integers},
    {"pairs", 'c', 2 * sizeof *numbers, 1, shapes[0], numbers},
    {"none", 'f', sizeof *numbers, 2, shapes[1], numbers},
    {"texts", 'U', 2 * sizeof *letters, 1, shapes[1], letters},
    {"text", 'U', sizeof letters, 0, NULL, letters},
};
enum { NUM_ARRAYS = sizeof arrays / sizeof arrays[0] };
static const char *const headers[] = {"'<f8', 'fortran_order': False, 'shape': (3, 2)",
                                      "'<i8', 'fortran_order': False, 'shape': (3,)",
                                      "'<c16', 'fortran_order': False, 'shape': (3,)",
                                      "'<f8', 'fortran_order': False, 'shape': (2, 0)",
                                      "'<U2', 'fortran_order': False, 'shape': (2,)",
                                      "'<U4', 'fortran_order': False, 'shape': ()"};
static const size_t sizes[] = {48, 24, 48, 0, 16, 16};

static char *write_arrays(void **state, const char *name, uint64_t limit, size_t *num) {
    char path[TEST_PATH_BYTES];
    ps_npz *npz = NULL;
    ps_error error = {0};
    assert_int_equal(ps_npz_open(&npz, test_path(*state, name, path), limit, &error), PSPEC_OK);
    for (size_t i = 0; i < NUM_ARRAYS; i++) {
        assert_int_equal(ps_npz_add(npz, &arrays[i], &error), PSPEC_OK);
    }
    assert_int_equal(ps_npz_commit(&npz, &error), PSPEC_OK);
    assert_null(npz);
    char *const file = test_read_file(path, num);
    assert_non_null(file);
    return file;
}

static void check_array(void **state, const char *name, size_t i) {
    enum { HEADER = 128 }; /* bytes of a short one */
    char path[TEST_PATH_BYTES];
    char found[256] = "";
    size_t num = 0;
    ps_input input = {0};
    ps_error error = {0};
    assert_int_equal(
        ps_input_open_array(&input, test_path(*state, name, path), arrays[i].name, &error),
        PSPEC_OK);
    assert_int_equal(ps_input_read(&input, found, sizeof found, &num, &error), PSPEC_OK);
    ps_input_close(&input);
    assert_int_equal(num, HEADER + sizes[i]);
    assert_memory_equal(found, "\x93NUMPY\1\0\x76\0{'descr': ", 20);
    assert_memory_equal(found + 20, headers[i], strlen(headers[i]));
    assert_int_equal(found[HEADER - 1], '\n');
    assert_memory_equal(found + HEADER, arrays[i].data, sizes[i]);
}

/* The same arrays come back; with another limit the file is one of nobody. */
static void check_read(void **state, const char *name, uint64_t limit) {
    char path[TEST_PATH_BYTES];
    ps_npz_file *file = NULL;
    ps_error error = {0};
    const int descriptor = open(test_path(*state, name, path), O_RDONLY);
    assert_int_equal(ps_npz_read(&file, descriptor, path, limit, &error), PSPEC_OK);
    for (size_t i = 0; i < NUM_ARRAYS; i++) {
        const ps_npz_array *const array = ps_npz_find(file, arrays[i].name);
        assert_non_null(array);
        assert_int_equal(array->kind, arrays[i].kind);
        assert_int_equal(array->element_bytes, arrays[i].element_bytes);
        assert_int_equal(array->rank, arrays[i].rank);
        assert_memory_equal(array->shape, arrays[i].rank > 0 ? arrays[i].shape : shapes[0],
                            arrays[i].rank * sizeof *array->shape);
        assert_memory_equal(array->data, arrays[i].data, sizes[i]);
    }
    assert_null(ps_npz_find(file, "other"));
    ps_npz_free(file);
    lseek(descriptor, 0, SEEK_SET);
    assert_int_equal(ps_npz_read(&file, descriptor, path, limit + 1000, &error),
                     limit == PS_NPZ_LIMIT ? PSPEC_OK : PSPEC_ERROR_INPUT);
    ps_npz_free(file);
    close(descriptor);
}

/* Whether sizes and places stand in fields of 32 bits, of 64, or some here and some there. */
static void writes_archives(void **state) {
    static const struct {
        uint64_t limit;
        bool has_end64;
    } cases[] = {{PS_NPZ_LIMIT, false}, {1, true}, {160, true}};
    if (ps_host_is_big_endian()) {
        skip(); /* the headers above are of the other order */
    }
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        size_t num = 0;
        size_t num_again = 0;
        char *const once = write_arrays(state, "once.npz", cases[c].limit, &num);
        char *const again = write_arrays(state, "again.npz", cases[c].limit, &num_again);
        assert_int_equal(num, num_again);
        assert_memory_equal(once, again, num);
        assert_memory_equal(once + num - 22, "PK\5\6", 4);
        assert_int_equal(memcmp(once + num - 42, "PK\6\7", 4) == 0, cases[c].has_end64);
        for (size_t i = 0; i < NUM_ARRAYS; i++) {
            check_array(state, "once.npz", i);
        }
        check_read(state, "once.npz", cases[c].limit);
        free(once);
        free(again);
    }
}

/* A file that is not completed has no name. */
static void discards_archives(void **state) {
    char path[TEST_PATH_BYTES];
    ps_npz *npz = NULL;
    ps_error error = {0};
    assert_int_equal(ps_npz_open(&npz, "", PS_NPZ_LIMIT, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_null(npz);
    test_path(*state, "no.npz", path);
    assert_int_equal(ps_npz_open(&npz, path, PS_NPZ_LIMIT, &error), PSPEC_OK);
    assert_int_equal(ps_npz_add(npz, &arrays[0], &error), PSPEC_OK);
    ps_npz_discard(&npz);
    assert_int_equal(access(path, F_OK), -1);
}

#define TEST_IN_FOLDER(test)                                                                       \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST_IN_FOLDER(writes_what_numpy_reads),
        TEST_IN_FOLDER(writes_archives),
        TEST_IN_FOLDER(discards_archives),
    };
    return cmocka_run_group_tests_name("npy", tests, NULL, NULL);
}
