/* A user's own integrands by their coefficients on the torus: values against the sum itself,
 * powers, integral, energy and sums over pairs against means over a lattice that is finer than they
 * are, arrays of every kind against text, and the sentences of what is refused. */
#include "harness_integrands.h"

#include "math/pi.h"
#include "test_folder.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const ps_integrand_place plane = {PS_SAMPLES_TORUS, 2};

/* f of the half lattice; the text has both halves, in an order of its own. */
static const struct {
    int32_t k[2];
    double re, im;
} half[] = {{{0, 0}, 0.5, 0},        {{1, 0}, 0.25, 0.1},    {{2, -3}, -0.125, 0.5},
            {{2, 3}, 0.0625, -0.25}, {{0, 2}, 0.03125, 0.5}, {{1, 1}, 1, 0},
            {{1, 2}, 0, -1}};
enum { NUM_HALF = sizeof half / sizeof half[0], K = 3, SIDE = 2 * K + 1 };

static void write_text(void) {
    FILE *const stream = fopen("own.txt", "w");
    assert_non_null(stream);
    fprintf(stream, "# k1,k2,re,im\n");
    for (size_t i = NUM_HALF; i-- > 0;) {
        fprintf(stream, "%d,%d,%.17g,%.17g\n", half[i].k[0], half[i].k[1], half[i].re, half[i].im);
    }
    for (size_t i = 1; i < NUM_HALF; i++) {
        fprintf(stream, "%d %d %.17g\t%.17g\n", -half[i].k[0], -half[i].k[1], half[i].re,
                -half[i].im);
    }
    assert_int_equal(fclose(stream), 0);
}

/* The array of --coefficients, -3..3 on both axes. */
static void fill_box(double box[SIDE * SIDE][2]) {
    memset(box, 0, SIDE * SIDE * sizeof *box);
    for (size_t i = 0; i < NUM_HALF; i++) {
        const int32_t at = (half[i].k[0] + K) * SIDE + half[i].k[1] + K;
        box[at][0] = box[SIDE * SIDE - 1 - at][0] = half[i].re;
        box[at][1] = half[i].im;
        box[SIDE * SIDE - 1 - at][1] = -half[i].im;
    }
}

static double sum_at(const double *x) {
    double sum = half[0].re;
    for (size_t i = 1; i < NUM_HALF; i++) {
        const double angle = PS_TWO_PI * (half[i].k[0] * x[0] + half[i].k[1] * x[1]);
        sum += 2 * (half[i].re * cos(angle) - half[i].im * sin(angle));
    }
    return sum;
}

static double value_at(const ps_integrand *self, const double *x) {
    double value = 0;
    ps_integrand_values(self, x, 1, &value);
    return value;
}

/* ---- what is known ------------------------------------------------------------------------- */

static bool is_at(const int32_t *k, size_t i, int32_t side) {
    return k[0] == side * half[i].k[0] && k[1] == side * half[i].k[1];
}

static double power_of(const int32_t *k) {
    double power = 0;
    for (size_t i = 1; i < NUM_HALF; i++) {
        if (is_at(k, i, 1) || is_at(k, i, -1)) {
            power += half[i].re * half[i].re + half[i].im * half[i].im;
        }
    }
    return power;
}

static void known(const char *text) {
    ps_integrand *const self = test_integrand(text, plane);
    double energy = 0;
    for (int32_t x = -K - 1; x <= K + 1; x++) {
        for (int32_t y = -K - 1; y <= K + 1; y++) {
            const int32_t k[2] = {x, y};
            double power = 0;
            if (x != 0 || y != 0) {
                assert_int_equal(ps_integrand_powers(self, k, 1, &power, NULL), PSPEC_OK);
            }
            test_near(text, "a power", power, power_of(k), 1e-15);
            energy += power;
        }
    }
    test_near(text, "the integral", ps_integrand_integral(self), half[0].re, 0);
    test_near(text, "the energy", ps_integrand_energy(self), energy, 1e-14);
    test_near(text, "the reach", ps_integrand_reach(self), K, 0);
    assert_true(ps_integrand_steps(self) >= NUM_HALF - 1);
    for (int i = 0; i < 50; i++) {
        const double at[2] = {fmod(0.37 * i, 1), fmod(0.618 * i + 0.01, 1)};
        test_near(text, "a value", value_at(self, at), sum_at(at), 1e-14);
    }
    ps_integrand_destroy(self);
}

static void text_is_the_sum(void **state) {
    (void)state;
    known("coefficients:file=own.txt");
}

/* Means over 8 x 8 places are exact up to the frequency 7, and products have 6. */
static void pairs_are_means(void **state) {
    enum { PLACES = 8 };
    ps_integrand *const self = test_integrand("coefficients:file=own.txt", plane);
    double set[2 * 5];
    double exact = 0;
    double found = 0;
    (void)state;
    assert_true(ps_integrand_has_pairs(self));
    for (int i = 0; i < 2 * 5; i++) {
        set[i] = fmod(0.271828 * (i + 1), 1);
    }
    for (int place = 0; place < PLACES * PLACES; place++) {
        double sum = 0;
        for (int j = 0; j < 5; j++) {
            const double x[2] = {set[2 * j] + (place % PLACES) / (double)PLACES,
                                 set[2 * j + 1] + (place / PLACES) / (double)PLACES};
            sum += value_at(self, x) / 5;
        }
        exact += (sum - half[0].re) * (sum - half[0].re) / (PLACES * PLACES);
    }
    assert_ok(ps_integrand_pairwise(self, set, NULL, 5, &found, error));
    assert_true(exact > 0.01);
    test_near("own.txt", "the sum over pairs", found, exact, 1e-13);
    ps_integrand_destroy(self);
}

/* ---- arrays -------------------------------------------------------------------------------- */

static void arrays_are_the_text(void **state) {
    double box[SIDE * SIDE][2];
    double turned[SIDE * SIDE][2];
    float single[SIDE * SIDE][2];
    (void)state;
    fill_box(box);
    assert_true(test_write_array("own.npy", "<c16", "False", "(7, 7)", box, sizeof box));
    known("coefficients:file=own.npy");
    for (int i = 0; i < SIDE * SIDE; i++) {
        memcpy(turned[i % SIDE * SIDE + i / SIDE], box[i], sizeof *box);
    }
    assert_true(test_write_array("fortran.npy", "<c16", "True", "(7, 7)", turned, sizeof turned));
    known("coefficients:file=fortran.npy");
    for (int i = 0; i < SIDE * SIDE; i++) {
        single[i][0] = (float)box[i][0];
        single[i][1] = (float)box[i][1];
    }
    assert_true(test_write_array("single.npy", "<c8", "False", "(7, 7)", single, sizeof single));
    ps_integrand *const of_single = test_integrand("coefficients:file=single.npy", plane);
    const double x[2] = {0.3, 0.7};
    test_near("single.npy", "a value", value_at(of_single, x), sum_at(x), 1e-8);
    ps_integrand_destroy(of_single);
}

/* 1 + 2 cos(2 pi x) + 6 cos(4 pi x), by whole numbers. */
static void real_arrays(void **state) {
    static const int16_t line[] = {3, 1, 1, 1, 3};
    (void)state;
    assert_true(test_write_array("line.npy", "<i2", "False", "(5,)", line, sizeof line));
    ps_integrand *const self =
        test_integrand("coefficients:file=line.npy", (ps_integrand_place){PS_SAMPLES_TORUS, 1});
    const double x = 0.5;
    test_near("line.npy", "a value", value_at(self, &x), 1 - 2 + 6, 1e-14);
    test_near("line.npy", "the energy", ps_integrand_energy(self), 20, 0);
    ps_integrand_destroy(self);
}

/* Long series are summed by steps from one phase to the next: those are as good as phases of their
 * own, and pairs, which would take too long, are not had. */
static void long_series(void **state) {
    enum { LARGEST = 2000 };
    FILE *const stream = fopen("long.txt", "w");
    const double x = 0.123456789;
    double sum = 0;
    (void)state;
    assert_non_null(stream);
    for (int k = 1; k <= LARGEST; k++) {
        fprintf(stream, "%d %d %d\n%d %d %d\n", k, k % 7, k % 5, -k, k % 7, -(k % 5));
        const double turns = fmod(k * x, 1);
        sum += 2 * (k % 7 * cos(PS_TWO_PI * turns) - k % 5 * sin(PS_TWO_PI * turns));
    }
    assert_int_equal(fclose(stream), 0);
    ps_integrand *const self =
        test_integrand("coefficients:file=long.txt", (ps_integrand_place){PS_SAMPLES_TORUS, 1});
    test_near("long.txt", "a value", value_at(self, &x), sum, 1e-8);
    test_near("long.txt", "the reach", ps_integrand_reach(self), LARGEST, 0);
    assert_false(ps_integrand_has_pairs(self));
    ps_integrand_destroy(self);
}

/* ---- refused ------------------------------------------------------------------------------- */

static void refuses(const char *text, pspec_status status, const char *sentence) {
    ps_integrand *self = NULL;
    ps_error error = {0};
    assert_int_equal(ps_integrand_parse(&self, text, plane, &error), status);
    assert_null(self);
    if (strstr(error.message, sentence) == NULL) {
        fail_msg("%s: \"%s\", not \"%s\"", text, error.message, sentence);
    }
}

static void refuses_rows(const char *rows, const char *sentence) {
    assert_true(test_write_file("bad.txt", rows, strlen(rows)));
    refuses("coefficients:file=bad.txt", PSPEC_ERROR_INPUT, sentence);
}

static void bad_texts(void **state) {
    (void)state;
    refuses("coefficients", PSPEC_ERROR_INVALID_ARGUMENT, "needs its file, as in");
    refuses("coefficients:file=-", PSPEC_ERROR_INVALID_ARGUMENT, "read more than once");
    refuses("coefficients:file=none.txt", PSPEC_ERROR_IO, "none.txt");
    refuses_rows("1,0,0.5,0.3\n",
                 "line 1: the coefficient at k = (1, 0) is that of no real function "
                 "without its opposite at k = (-1, 0)");
    refuses_rows("1,0,0.5,0.3\n0 0 1 0\n-1,0,0.5,0.3\n", "lines 1 and 3: the coefficients at k");
    refuses_rows("0,0,1,0.5\n", "has the imaginary part 0.5");
    refuses_rows("0,0,1,0\n\n0,0,1,0\n",
                 "lines 1 and 3: the coefficient at k = (0, 0) is given twice");
    refuses_rows("0.5,0,1,0\n", "frequency 0.5 is not a whole number");
    refuses_rows("0,268435457,1,0\n", "frequency 268435457 is not a whole number between");
    refuses_rows("0,0,1e101,0\n", "is 1e+101+0i, and the largest");
    refuses_rows("0,0,nan,0\n", "line 1: \"nan\" is not a finite number");
    refuses_rows("0,0,1\n", "line 1");
    refuses_rows("0,0,1,0,0\n", "more than 4 numbers; rows have 4 columns");
}

static void bad_arrays(void **state) {
    double box[SIDE * SIDE][2];
    (void)state;
    fill_box(box);
    assert_true(test_write_array("bad.npy", "<c16", "False", "(7, 6)", box, sizeof *box * 42));
    refuses("coefficients:file=bad.npy", PSPEC_ERROR_INPUT, "shape (7, 6); frequencies -K..K");
    assert_true(test_write_array("bad.npy", "<c16", "False", "(49,)", box, sizeof box));
    refuses("coefficients:file=bad.npy", PSPEC_ERROR_INPUT,
            "shape (49,); coefficients have an axis");
    assert_true(test_write_array("bad.npy", "<c16", "False", "(7, 7)", box, sizeof box - 16));
    refuses("coefficients:file=bad.npy", PSPEC_ERROR_INPUT, "bad.npy");
    assert_true(test_write_array("bad.npy", "<c16", "False", "(0, 7)", box, 0));
    refuses("coefficients:file=bad.npy", PSPEC_ERROR_INPUT, "has no entries");
    assert_true(test_write_array("bad.npy", ">c32", "False", "(7, 7)", box, sizeof box));
    refuses("coefficients:file=bad.npy", PSPEC_ERROR_INPUT, "cannot be read");
    box[8][1] = NAN;
    assert_true(test_write_array("bad.npy", "<c16", "False", "(7, 7)", box, sizeof box));
    refuses("coefficients:file=bad.npy", PSPEC_ERROR_INPUT, "the entry at (1, 1) is nan");
    box[8][1] = 0.25;
    assert_true(test_write_array("bad.npy", "<c16", "False", "(7, 7)", box, sizeof box));
    refuses(
        "coefficients:file=bad.npy", PSPEC_ERROR_INPUT,
        "bad.npy: the coefficients at k = (2, 2) and k = (-2, -2) are those of no real function");
}

/* What transforms round by is no fault. */
static void rounding(void **state) {
    const char rows[] = "0 0 1 1e-13\n1 0 3 1\n-1 0 3 -1.0000000000001\n5 0 1e-14 0\n";
    (void)state;
    assert_true(test_write_file("round.txt", rows, strlen(rows)));
    ps_integrand_destroy(test_integrand("coefficients:file=round.txt", plane));
}

static int enter(void **state) {
    if (test_enter_lobes(state) != 0) {
        return -1;
    }
    write_text();
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_is_the_sum),     cmocka_unit_test(pairs_are_means),
        cmocka_unit_test(arrays_are_the_text), cmocka_unit_test(real_arrays),
        cmocka_unit_test(long_series),         cmocka_unit_test(bad_texts),
        cmocka_unit_test(bad_arrays),          cmocka_unit_test(rounding),
    };
    return cmocka_run_group_tests_name("coefficient_files", tests, enter, test_leave_lobes);
}
