/* Arrays that are written: the bytes that NumPy reads. */
#include "files/npy.h"
#include "test_folder.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void writes_what_numpy_reads(void **state) {
    static const double data[] = {0.5, 0.25, 0.125, -1};
    const size_t shapes[][3] = {{4}, {2, 2}, {1, 2, 2}};
    static const char *const texts[] = {"'shape': (4,), }", "'shape': (2, 2), }",
                                        "'shape': (1, 2, 2), }"};
    for (unsigned rank = 1; rank <= 3; rank++) {
        char path[TEST_PATH_BYTES];
        ps_error error = {0};
        size_t length = 0;
        test_path(*state, "array.npy", path);
        assert_int_equal(ps_npy_write(path, rank, shapes[rank - 1], data, &error), PSPEC_OK);
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(writes_what_numpy_reads, test_folder_create,
                                        test_folder_remove),
    };
    return cmocka_run_group_tests_name("npy", tests, NULL, NULL);
}
