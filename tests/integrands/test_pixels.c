/* Images as integrands: powers from their points against the transform of a piecewise constant
 * function, Parseval over aliases, a box, values, sums over pairs against means over shifts, and
 * the sentences of what is refused. Sizes are primes, too. */
#include "harness_integrands.h"

#include "math/pi.h"
#include "test_folder.h"

#include <complex.h>
#include <math.h>
#include <string.h>

enum { ROWS = 5, COLUMNS = 7, NUM = ROWS * COLUMNS };

static const ps_integrand_place plane = {PS_SAMPLES_TORUS, 2};

static double pixel(int i) {
    return fmod(0.754877666 * (i + 1), 1) - 0.25;
}

static ps_integrand *make_image(void) {
    double image[NUM];
    for (int i = 0; i < NUM; i++) {
        image[i] = pixel(i);
    }
    assert_true(test_write_array("image.npy", "<f8", "False", "(5, 7)", image, sizeof image));
    return test_integrand("pixels:file=image.npy", plane);
}

/* |f_k|^2 as a job forms it from an engine's sums. */
static double power_by_points(const ps_integrand *self, const int32_t *k) {
    ps_integrand_points points;
    double factor = 0;
    double complex sum = 0;
    assert_true(ps_integrand_has_points(self));
    assert_ok(ps_integrand_make_points(self, &points, error));
    for (size_t j = 0; j < points.num; j++) {
        const double turns = k[0] * points.points[2 * j] + k[1] * points.points[2 * j + 1];
        sum += points.weights[j] * cexp(-I * PS_TWO_PI * fmod(turns, 1));
    }
    ps_integrand_factors(self, k, 1, &factor);
    ps_integrand_points_free(&points);
    return factor * creal(sum * conj(sum));
}

/* int over [a/n, (a+1)/n] of e^{-2 pi i k x} */
static double complex cell(int32_t k, int a, int n) {
    const double begin = (double)a / n;
    const double end = (a + 1.0) / n;
    return k == 0 ? 1.0 / n
                  : (cexp(-I * PS_TWO_PI * k * end) - cexp(-I * PS_TWO_PI * k * begin)) /
                        (-I * PS_TWO_PI * k);
}

static void powers(void **state) {
    ps_integrand *const self = make_image();
    double total = 0;
    double mean = 0;
    double square = 0;
    (void)state;
    for (int i = 0; i < NUM; i++) {
        mean += pixel(i) / NUM;
        square += pixel(i) * pixel(i) / NUM;
    }
    for (int32_t x = -16; x <= 16; x++) {
        for (int32_t y = -16; y <= 16; y++) {
            const int32_t k[2] = {x, y};
            double complex f = 0;
            if (x == 0 && y == 0) {
                continue;
            }
            for (int i = 0; i < NUM; i++) {
                f += pixel(i) * cell(x, i / COLUMNS, ROWS) * cell(y, i % COLUMNS, COLUMNS);
            }
            const double power = power_by_points(self, k);
            test_near("image.npy", "a power", power, creal(f * conj(f)), 1e-16);
            total += power;
        }
    }
    test_near("image.npy", "the integral", ps_integrand_integral(self), mean, 1e-15);
    test_near("image.npy", "the energy", ps_integrand_energy(self), square - mean * mean, 1e-14);
    assert_true(total < square - mean * mean && total > 0.8 * (square - mean * mean));
    ps_integrand_destroy(self);
}

/* sum over m of sinc^2(q/n + m) = 1: all aliases of a frequency have the power of the transform,
 * 1e-4 of which lies beyond 1000. */
static void aliases(void **state) {
    static const double image[] = {3, 1, 4, 1, 5};
    (void)state;
    assert_true(test_write_array("line.npy", "<f8", "False", "(5,)", image, sizeof image));
    ps_integrand *const self =
        test_integrand("pixels:file=line.npy", (ps_integrand_place){PS_SAMPLES_TORUS, 1});
    double sum = 0;
    for (int32_t m = -1000; m <= 1000; m++) {
        const int32_t k = 2 + 5 * m;
        double factor = 0;
        ps_integrand_factors(self, &k, 1, &factor);
        sum += factor * 25; /* 1/n^2 is in it */
    }
    test_near("line.npy", "the sum over aliases", sum, 1, 2e-4);
    ps_integrand_destroy(self);
}

static void a_box(void **state) {
    uint8_t image[8] = {1, 1, 0, 0, 0, 0, 0, 0};
    (void)state;
    assert_true(test_write_array("box.npy", "|u1", "False", "(2, 4)", image, sizeof image));
    ps_integrand *const self = test_integrand("pixels:file=box.npy", plane);
    ps_integrand *const box = test_integrand("box:sides=0.5,centre=0.25", plane);
    for (int32_t i = 1; i < 100; i++) {
        const int32_t k[2] = {i % 10 - 4, i / 10};
        double power = 0;
        if (k[0] != 0 || k[1] != 0) {
            assert_ok(ps_integrand_powers(box, k, 1, &power, error));
            test_near("box.npy", "a power", power_by_points(self, k), power, 1e-16);
        }
    }
    ps_integrand_destroy(box);
    ps_integrand_destroy(self);
}

static void values(void **state) {
    ps_integrand *const self = make_image();
    (void)state;
    for (int i = 0; i < NUM; i++) {
        const int row = i / COLUMNS;
        const int column = i % COLUMNS;
        const double x[4] = {(row + 0.01) / ROWS, (column + 0.01) / COLUMNS, (row + 0.99) / ROWS,
                             (column + 0.99) / COLUMNS};
        double found[2];
        ps_integrand_values(self, x, 2, found);
        test_near("image.npy", "a value", found[0], pixel(i), 0);
        test_near("image.npy", "a value", found[1], pixel(i), 0);
    }
    const double last[2] = {nextafter(1, 0), nextafter(1, 0)};
    double found = 0;
    ps_integrand_values(self, last, 1, &found);
    test_near("image.npy", "a value", found, pixel(NUM - 1), 0);
    ps_integrand_destroy(self);
}

/* The mean over shifts, by the middles of cells that no edge of a moved pixel divides: points are
 * multiples of 1/5/4 and 1/7/4. */
static void pairs(void **state) {
    enum { FINE = 4, SHIFTS = NUM * FINE * FINE };
    static const int at[3][2] = {{0, 0}, {7, 3}, {18, 26}};
    ps_integrand *const self = make_image();
    double set[6];
    double exact = 0;
    double found = 0;
    (void)state;
    for (int j = 0; j < 3; j++) {
        set[2 * j] = at[j][0] / (double)(ROWS * FINE);
        set[2 * j + 1] = at[j][1] / (double)(COLUMNS * FINE);
    }
    for (int s = 0; s < SHIFTS; s++) {
        double sum = 0;
        for (int j = 0; j < 3; j++) {
            const int row = (at[j][0] + s / (COLUMNS * FINE)) % (ROWS * FINE);
            const int column = (at[j][1] + s % (COLUMNS * FINE)) % (COLUMNS * FINE);
            sum += pixel(row / FINE * COLUMNS + column / FINE) / 3;
        }
        exact += pow(sum - ps_integrand_integral(self), 2) / SHIFTS;
    }
    assert_ok(ps_integrand_pairwise(self, set, NULL, 3, &found, error));
    test_near("image.npy", "the sum over pairs", found, exact, 1e-14);
    ps_integrand_destroy(self);
}

static void refuses(const char *text, pspec_status status, const char *sentence) {
    ps_integrand *self = NULL;
    ps_error error = {0};
    assert_int_equal(ps_integrand_parse(&self, text, plane, &error), status);
    assert_null(self);
    if (strstr(error.message, sentence) == NULL) {
        fail_msg("%s: \"%s\", not \"%s\"", text, error.message, sentence);
    }
}

static void refused(void **state) {
    double image[4] = {1, 2, NAN, 4};
    const char text[] = "1 2\n3 4\n";
    (void)state;
    refuses("pixels", PSPEC_ERROR_INVALID_ARGUMENT, "integrand pixels needs its file");
    assert_true(test_write_array("bad.npy", "<f8", "False", "(2, 2)", image, sizeof image));
    refuses("pixels:file=bad.npy", PSPEC_ERROR_INPUT, "the entry at (1, 0) is nan");
    image[2] = -2e100;
    assert_true(test_write_array("bad.npy", "<f8", "False", "(2, 2)", image, sizeof image));
    refuses("pixels:file=bad.npy", PSPEC_ERROR_INPUT, "the pixel at (1, 0) is -2e+100");
    assert_true(test_write_array("bad.npy", "<f8", "False", "(4,)", image, sizeof image));
    refuses("pixels:file=bad.npy", PSPEC_ERROR_INPUT, "pixels have an axis for each of the 2");
    assert_true(test_write_array("bad.npy", "<c16", "False", "(1, 2)", image, sizeof image));
    refuses("pixels:file=bad.npy", PSPEC_ERROR_INPUT, "cannot be read");
    assert_true(test_write_file("bad.txt", text, strlen(text)));
    refuses("pixels:file=bad.txt", PSPEC_ERROR_INPUT, "is no NPY array");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers), cmocka_unit_test(aliases), cmocka_unit_test(a_box),
        cmocka_unit_test(values), cmocka_unit_test(pairs),   cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests_name("pixels", tests, test_enter_lobes, test_leave_lobes);
}
