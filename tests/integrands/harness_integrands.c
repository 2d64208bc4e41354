#include "harness_integrands.h"

#include "test_folder.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

ps_integrand *test_integrand(const char *text, ps_integrand_place place) {
    ps_integrand *self = NULL;
    assert_ok(ps_integrand_parse(&self, text, place, error));
    return self;
}

void test_near(const char *text, const char *what, double value, double exact, double tolerance) {
    if (!(fabs(value - exact) <= tolerance)) {
        fail_msg("%s: %s is %.17g, not %.17g (%.2g off)", text, what, value, exact, value - exact);
    }
}

static void write_text(const char *path, const char *text) {
    assert_true(test_write_file(path, text, strlen(text)));
}

void test_write_array(const char *path, const char *type, const char *order, const char *shape,
                      const void *data, size_t num_bytes) {
    char text[118];
    FILE *const stream = fopen(path, "wb");
    assert_non_null(stream);
    memset(text, ' ', sizeof text);
    const int length = snprintf(text, sizeof text,
                                "{'descr': '%s', 'fortran_order': %s, "
                                "'shape': %s, }",
                                type, order, shape);
    text[length] = ' ';
    text[sizeof text - 1] = '\n';
    assert_int_equal(fwrite("\x93NUMPY\x01\x00\x76\x00", 1, 10, stream), 10);
    assert_int_equal(fwrite(text, 1, sizeof text, stream), sizeof text);
    assert_int_equal(fwrite(data, 1, num_bytes, stream), num_bytes);
    assert_int_equal(fclose(stream), 0);
}

int test_enter_lobes(void **state) {
    if (test_folder_create(state) != 0 || chdir(((test_folder *)*state)->path) != 0) {
        return -1;
    }
    write_text("lobe.txt", "-0.5 1\n0 2\n0.5 0.25\n1 3\n");
    write_text("above.txt", "0 0\n0.5 1\n1 3\n");
    return 0;
}

int test_leave_lobes(void **state) {
    return test_folder_remove(state) == 0 ? chdir("/") : -1;
}
