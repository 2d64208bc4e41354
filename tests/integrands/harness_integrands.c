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

void test_light_fill(test_light *out, size_t width, size_t height) {
    uint64_t random = width + 100 * height;
    *out = (test_light){.width = width, .height = height};
    for (size_t i = 0; i < width * height; i++) {
        out->light[i] = (float)test_uniform(&random);
    }
}

void test_light_write(const char *path, const test_light *image) {
    FILE *const stream = fopen(path, "wb");
    assert_non_null(stream);
    fprintf(stream, "Pf %zu %zu -1\n", image->width, image->height);
    for (size_t y = image->height; y-- > 0;) {
        fwrite(image->light + y * image->width, sizeof(float), image->width, stream);
    }
    assert_int_equal(fclose(stream), 0);
}

static void write_text(const char *path, const char *text) {
    assert_true(test_write_file(path, text, strlen(text)));
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
