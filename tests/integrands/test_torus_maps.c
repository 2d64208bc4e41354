/* Images on the torus: their powers against sums over pixels and closed forms, Parseval, shifts,
 * values between pixels, and the sentences of what is refused. */
#include "harness_integrands.h"

#include "images/torus_map.h"
#include "math/gauss_legendre.h"
#include "math/pi.h"

#include <complex.h>
#include <math.h>

static test_light made;

static ps_integrand *write_and_read(void) {
    test_light_write("image.pfm", &made);
    return test_integrand("map:file=image.pfm", TEST_PLANE);
}

/* sin(pi k/n)/(pi k/n) */
static long double sinc(int k, size_t n) {
    const long double t = PS_PI_L * k / (long double)n;
    return k == 0 ? 1 : k % (int)n == 0 ? 0 : sinl(t) / t;
}

static double power_of(const ps_integrand *self, int k1, int k2) {
    const int32_t k[] = {k1, k2};
    double power = 0;
    assert_ok(ps_integrand_powers(self, k, 1, &power, error));
    return power;
}

/* ---- sums over pixels ---------------------------------------------------------------------- */

static long double power_by_sum(int k1, int k2) {
    const size_t num = made.width * made.height;
    long double re = 0;
    long double im = 0;
    for (size_t i = 0; i < num; i++) {
        const long double turns =
            (long double)k1 * (long double)(i / made.width) / (long double)made.height +
            (long double)k2 * (long double)(i % made.width) / (long double)made.width;
        re += (long double)made.light[i] * cosl(2 * PS_PI_L * turns);
        im -= (long double)made.light[i] * sinl(2 * PS_PI_L * turns);
    }
    const long double factor = sinc(k1, made.height) * sinc(k2, made.width);
    return (re * re + im * im) / ((long double)num * (long double)num) * powl(factor, 4);
}

static void powers_are_sums_over_pixels(void **state) {
    static const size_t sizes[][2] = {{1, 1}, {1, 5}, {4, 1}, {2, 2}, {6, 4}, {5, 7}, {3, 8}};
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        test_light_fill(&made, sizes[i][0], sizes[i][1]);
        ps_integrand *const self = write_and_read();
        for (int k1 = -18; k1 <= 18; k1++) {
            for (int k2 = -18; k2 <= 18; k2++) {
                if (k1 != 0 || k2 != 0) {
                    test_near("image", "a power", power_of(self, k1, k2),
                              (double)power_by_sum(k1, k2), 1e-15);
                }
            }
        }
        ps_integrand_destroy(self);
    }
}

/* Two nodes a pixel are exact: squares of linear pieces are of degree 2. */
static void energy_is_that_of_values(void **state) {
    double nodes[2];
    double weights[2];
    (void)state;
    ps_gauss_legendre(2, nodes, weights);
    test_light_fill(&made, 7, 5);
    ps_integrand *const self = write_and_read();
    double mean = 0;
    double square = 0;
    for (size_t i = 0; i < 4 * made.width * made.height; i++) {
        const size_t row = i / 4 / made.width;
        const size_t column = i / 4 % made.width;
        const double x[] = {fmod((double)row + 0.5 + nodes[i % 2], 5) / 5,
                            fmod((double)column + 0.5 + nodes[i / 2 % 2], 7) / 7};
        double value = 0;
        ps_integrand_values(self, x, 1, &value);
        mean += value / (4 * 35);
        square += value * value / (4 * 35);
    }
    test_near("image", "the integral", ps_integrand_integral(self), mean, 1e-15);
    test_near("image", "the energy", ps_integrand_energy(self), square - mean * mean, 1e-15);
    ps_integrand_destroy(self);
}

/* |k|^-4 along an axis: what is beyond 240 is some 1e-9 of the energy. */
static void all_powers_are_the_energy(void **state) {
    enum { CUTOFF = 240 };
    double sum = 0;
    (void)state;
    test_light_fill(&made, 6, 4);
    ps_integrand *const self = write_and_read();
    for (int k1 = -CUTOFF; k1 <= CUTOFF; k1++) {
        for (int k2 = -CUTOFF; k2 <= CUTOFF; k2++) {
            sum += k1 != 0 || k2 != 0 ? power_of(self, k1, k2) : 0;
        }
    }
    assert_true(sum < ps_integrand_energy(self));
    test_near("image", "the energy", sum, ps_integrand_energy(self), 1e-6 * sum);
    ps_integrand_destroy(self);
}

/* ---- laws ---------------------------------------------------------------------------------- */

static void shifts_change_nothing(void **state) {
    static test_light first;
    (void)state;
    test_light_fill(&made, 30, 15);
    first = made;
    ps_integrand *const one = write_and_read();
    for (size_t i = 0; i < made.width * made.height; i++) {
        made.light[i] = first.light[(i / 30 + 4) % 15 * 30 + (i + 11) % 30];
    }
    ps_integrand *const other = write_and_read();
    test_near("shifted", "the integral", ps_integrand_integral(other), ps_integrand_integral(one),
              1e-16);
    test_near("shifted", "the energy", ps_integrand_energy(other), ps_integrand_energy(one), 1e-16);
    for (int k = 1; k <= 40; k++) {
        test_near("shifted", "a power", power_of(other, k, 3 - k), power_of(one, k, 3 - k), 1e-17);
    }
    ps_integrand_destroy(one);
    ps_integrand_destroy(other);
}

/* So many pixels that threads share them: powers of the image that is repeated, and no others. */
static void tiles_have_the_powers_of_one(void **state) {
    enum { TILES = 8, WIDTH = 64, HEIGHT = 50 };
    static test_light tile;
    (void)state;
    test_light_fill(&tile, WIDTH, HEIGHT);
    made = tile;
    ps_integrand *const one = write_and_read();
    made.width *= TILES;
    made.height *= TILES;
    for (size_t i = 0; i < made.width * made.height; i++) {
        made.light[i] = tile.light[i / made.width % HEIGHT * WIDTH + i % WIDTH];
    }
    ps_integrand *const all = write_and_read();
    test_near("tiles", "the energy", ps_integrand_energy(all), ps_integrand_energy(one), 1e-15);
    for (int k = -30; k <= 30; k++) {
        test_near("tiles", "a power", power_of(all, TILES * k, 5 * TILES), power_of(one, k, 5),
                  1e-17);
        test_near("tiles", "no power", power_of(all, TILES * k + 1, 5 * TILES), 0, 1e-30);
    }
    ps_integrand_destroy(one);
    ps_integrand_destroy(all);
}

/* However far powers were asked for before. */
static void powers_do_not_depend_on_the_cutoff(void **state) {
    (void)state;
    test_light_fill(&made, 64, 100);
    ps_integrand *const one = write_and_read();
    ps_integrand *const other = write_and_read();
    const double first = power_of(one, 2, -3);
    assert_true(power_of(other, 501, 1) > 0);
    assert_true(first == power_of(other, 2, -3));
    assert_true(power_of(one, 45, -3) == power_of(other, 45, -3));
    assert_true(first == power_of(one, 2, -3) && first == power_of(one, -2, 3));
    ps_integrand_destroy(one);
    ps_integrand_destroy(other);
}

static void closed_forms(void **state) {
    enum { WIDTH = 32, HEIGHT = 20 };
    (void)state;
    made = (test_light){.width = WIDTH, .height = HEIGHT};
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        made.light[i] = 0.7f;
    }
    ps_integrand *self = write_and_read();
    assert_true(ps_integrand_integral(self) == (double)0.7f && ps_integrand_energy(self) == 0);
    assert_true(power_of(self, 1, 0) == 0 && power_of(self, 7, -9) == 0);
    ps_integrand_destroy(self);
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) { /* 1 + cos 2 pi (3 x + 5 y) */
        const double turns = 3 * (double)(i / WIDTH) / HEIGHT + 5 * (double)(i % WIDTH) / WIDTH;
        made.light[i] = (float)(1 + cos(PS_TWO_PI * turns));
    }
    self = write_and_read();
    test_near("wave", "the integral", ps_integrand_integral(self), 1, 1e-7);
    for (int k = -40; k <= 40; k++) {
        const bool is_alias = (k - 5) % WIDTH == 0;
        const double factor = (double)(sinc(3, HEIGHT) * sinc(k, WIDTH));
        test_near("wave", "a power", power_of(self, 3, k), is_alias ? pow(factor, 4) / 4 : 0, 1e-8);
    }
    ps_integrand_destroy(self);
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) { /* half of it is light */
        made.light[i] = i % WIDTH < WIDTH / 2 ? 2 : 0;
    }
    self = write_and_read();
    assert_true(ps_integrand_integral(self) == 1);
    test_near("step", "the energy", ps_integrand_energy(self), 1 - 4.0 / 3 / WIDTH, 1e-15);
    for (int k = 1; k < 3 * WIDTH; k++) {
        const double sum = k % 2 == 0 ? 0 : 2 / (WIDTH * sin(PS_PI * k / WIDTH));
        const double factor = (double)sinc(k, WIDTH);
        test_near("step", "a power", power_of(self, 0, k), sum * sum * pow(factor, 4), 1e-15);
        test_near("step", "a power", power_of(self, 2, k), 0, 1e-30);
    }
    ps_integrand_destroy(self);
}

static void values_are_linear_between_pixels(void **state) {
    (void)state;
    made = (test_light){.width = 4, .height = 2, .light = {1, 2, 3, 4, 50, 60, 70, 80}};
    ps_integrand *const self = write_and_read();
    const double x[][2] = {{0.25, 0.125}, {0.75, 0.375}, {0.25, 0.25},   {0.5, 0.125},
                           {0, 0.125},    {0.25, 0},     {0.75, 0.9375}, {0, 0}};
    const double expected[] = {1, 60, 1.5, 25.5, 25.5, 2.5, 80 - 30.0 / 4, 33.75};
    double values[8];
    ps_integrand_values(self, &x[0][0], 8, values);
    for (size_t i = 0; i < 8; i++) {
        test_near("image", "a value", values[i], expected[i], 1e-14);
    }
    ps_integrand_destroy(self);
}

/* 17 binary digits, to the nearest even, of numbers of any size; what is finite stays so. */
static void large_images_have_short_pixels(void **state) {
    static const double expected[] = {0x1.0001p0, 0x1.0002p0, 0x1.0001p0,   0x1.ffffp127,
                                      0,          0,          0x1.ffffp-30, 0x1.2345p20};
    double row[8];
    (void)state;
    made = (test_light){.width = 8,
                        .height = 1,
                        .light = {0x1.0001p0f, 0x1.00018p0f, 0x1.0000fp0f, 0x1.fffffep127f,
                                  0x1p-149f, -0.0f, 0x1.ffffp-30f, 0x1.23456p20f}};
    test_light_write("image.pfm", &made);
    for (size_t most = 7; most <= 8; most++) {
        const ps_channel_source source = {.path = "image.pfm"};
        const ps_torus_map_limits limits = {.most_floats = most};
        ps_torus_map map;
        assert_ok(ps_torus_map_read(&map, &source, &limits, error));
        assert_int_equal(map.pixel_bytes, most == 7 ? 3 : 4);
        ps_torus_map_row(&map, 0, row);
        double sum = 0;
        for (size_t i = 0; i < 8; i++) {
            assert_true(row[i] == (most == 7 ? expected[i] : (double)made.light[i]));
            assert_false(signbit(row[i]));
            sum += row[i] / 8;
        }
        assert_true(fabs(map.mean / sum - 1) < 1e-15 && map.largest == row[3]);
        ps_torus_map_free(&map);
    }
}

/* Images of discs of any side are of one scene: a pixel has the light at its centre. */
static void discs_are_the_same_at_every_size(void **state) {
    enum { FEW = 40, TIMES = 3 };
    ps_integrand *const few = test_integrand("map:width=40", TEST_PLANE);
    ps_integrand *const many = test_integrand("map:width=120", TEST_PLANE);
    double largest = 0;
    (void)state;
    for (int i = 0; i < FEW * FEW; i++) {
        const double x[] = {(i / FEW + 0.5) / FEW, (i % FEW + 0.5) / FEW};
        double values[2] = {0, 0};
        ps_integrand_values(few, x, 1, &values[0]);
        ps_integrand_values(many, x, 1, &values[1]);
        test_near("discs", "light", values[0], values[1], 1e-11);
        assert_true(values[0] > 0x1p-6 - 1e-6 && values[0] < 0x1p6 + 1e-6);
        largest = fmax(largest, values[0]);
    }
    assert_true(largest > 32 && ps_integrand_energy(few) > 30);
    test_near("discs", "the integral", ps_integrand_integral(few), ps_integrand_integral(many),
              0.1 * ps_integrand_integral(many));
    ps_integrand_destroy(few);
    ps_integrand_destroy(many);
}

/* ---- words --------------------------------------------------------------------------------- */

static void refuse(const char *text, uint64_t most_bytes, pspec_status status, const char *piece) {
    ps_integrand *self = NULL;
    ps_error error = {0};
    assert_int_equal(ps_integrand_parse_within(&self, text, TEST_PLANE, most_bytes, &error),
                     status);
    assert_null(self);
    if (strstr(error.message, piece) == NULL) {
        fail_msg("\"%s\" has no \"%s\"", error.message, piece);
    }
}

static void words(void **state) {
    (void)state;
    test_light_fill(&made, 4, 3);
    made.light[5] = NAN;
    test_light_write("image.pfm", &made);
    refuse("map:file=image.pfm", 0, PSPEC_ERROR_INPUT, "row 1, column 1, from 0, is nan");
    refuse("map:file=image.pfm,clamp=yes", 47, PSPEC_ERROR_MEMORY,
           "image.pfm: 4 x 3 pixels take 48 of memory, above 47, the limit of --memory");
    refuse("map:width=1.5", 0, PSPEC_ERROR_INVALID_ARGUMENT, "\"1.5\" is not a whole number");
    refuse("map:width=16385", 0, PSPEC_ERROR_INVALID_ARGUMENT, "16385 is not between 2 and 16384");
    refuse("map:width=9", 323, PSPEC_ERROR_MEMORY,
           "an image made up: 9 x 9 pixels take 324 of memory");
    ps_integrand *const self = test_integrand("map:file=image.pfm,clamp=yes", TEST_PLANE);
    assert_string_equal(ps_integrand_note(self),
                        "1 pixels were negative or not finite, and count as 0");
    ps_integrand_destroy(self);
    ps_integrand *none = NULL;
    ps_error error = {0};
    assert_int_equal(ps_integrand_parse(&none, "map:file=image.pfm",
                                        (ps_integrand_place){PS_SAMPLES_TORUS, 3}, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "points have 3 dimensions, and it has 2 to 2"));
}

/* Whoever asks for the same in the same place has the same one, and its powers. */
static void questions_share_an_image(void **state) {
    const ps_given_integrands none = {NULL, 0};
    const char *const text = "map:file=image.pfm";
    ps_made_integrands made_ones = {NULL, 0, 0};
    ps_integrand *taken[4] = {NULL};
    ps_error failure = {0};
    (void)state;
    test_light_fill(&made, 4, 3);
    test_light_write("image.pfm", &made);
    assert_ok(ps_integrand_take(&taken[0], &made_ones, &none, text, TEST_PLANE, 0, error));
    assert_ok(ps_integrand_take(&taken[1], &made_ones, &none, text, TEST_SPHERE, 0, error));
    assert_int_equal(ps_integrand_take(&taken[2], &made_ones, &none, "map:file=none.pfm",
                                       TEST_PLANE, 0, &failure),
                     PSPEC_ERROR_IO);
    assert_int_equal(remove("image.pfm"), 0);
    assert_ok(ps_integrand_take(&taken[3], &made_ones, &none, text, TEST_PLANE, 0, error));
    assert_true(taken[0] == taken[3] && taken[0] != taken[1] && taken[2] == NULL);
    assert_int_equal(made_ones.num, 2);
    ps_made_integrands_free(&made_ones);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_are_sums_over_pixels),
        cmocka_unit_test(energy_is_that_of_values),
        cmocka_unit_test(all_powers_are_the_energy),
        cmocka_unit_test(shifts_change_nothing),
        cmocka_unit_test(tiles_have_the_powers_of_one),
        cmocka_unit_test(powers_do_not_depend_on_the_cutoff),
        cmocka_unit_test(closed_forms),
        cmocka_unit_test(values_are_linear_between_pixels),
        cmocka_unit_test(large_images_have_short_pixels),
        cmocka_unit_test(discs_are_the_same_at_every_size),
        cmocka_unit_test(words),
        cmocka_unit_test(questions_share_an_image),
    };
    return cmocka_run_group_tests_name("torus_maps", tests, test_enter_lobes, test_leave_lobes);
}
