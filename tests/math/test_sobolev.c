/* The Sobolev kernel, Gauss-Legendre rules and the conversion of hemispherical harmonics against
 * tests/reference and against laws. */
#include "harness.h"

#include "math/gauss_legendre.h"
#include "rules/truncation.h"
#include "math/pi.h"
#include "math/sobolev.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of a_l, tau_l and b_l, from the reference's own README. */
static const double RELATIVE = 3e-12;

static double cell(const cJSON *row, int column) {
    return test_number(cJSON_GetArrayItem(row, column));
}

static void eigenvalues(void **state) {
    enum { LAST = 10000 };
    cJSON *json = test_read_reference("tables.json");
    const cJSON *rows = cJSON_GetObjectItem(cJSON_GetObjectItem(json, "a_l"), "rows");
    const cJSON *row = NULL;
    double *a = calloc(LAST + 2, sizeof *a);
    int num_rows = 0;
    (void)state;
    cJSON_ArrayForEach(row, rows) {
        const double s = cell(row, 0);
        const size_t l = (size_t)cell(row, 1);
        assert_true(l <= LAST);
        ps_sobolev_eigenvalues(s, LAST + 1, a);
        assert_true(fabs(a[l] / cell(row, 2) - 1) <= RELATIVE);
        assert_true(fabs(ps_sobolev_tail(s, l, a[l + 1]) / cell(row, 3) - 1) <= RELATIVE);
        num_rows++;
    }
    assert_true(num_rows > 100);
    free(a);
    cJSON_Delete(json);
}

/* s = 3/2: a_l = 16 pi/((2l-1)(2l+1)(2l+3)); the kernel at distance 0 is the sum of all degrees. */
static void closed_forms(void **state) {
    double a[101];
    (void)state;
    ps_sobolev_eigenvalues(1.5, 100, a);
    for (double l = 1; l <= 100; l++) {
        const double exact = 16 * PS_PI / ((2 * l - 1) * (2 * l + 1) * (2 * l + 3));
        assert_true(fabs(a[(int)l] / exact - 1) <= 1e-13);
    }
    for (double s = 1.05; s < 2; s += 0.1) {
        ps_sobolev_eigenvalues(s, 1, a);
        const double tail = ps_sobolev_tail(s, 0, a[1]);
        assert_true(fabs(tail - exp2(2 * s - 2) / s) <= 1e-14);
        assert_true(fabs(a[0] / PS_FOUR_PI + tail - ps_sobolev_constant(s)) <= 1e-14);
    }
}

static void distances(void **state) {
    const double u[3] = {0.6, 0, 0.8};
    const double v[9] = {0.6, 0, 0.8, -0.6, 0, -0.8, 0, 1, 0};
    const double weights[3] = {3, -0.5, 2};
    (void)state;
    for (double s = 1.1; s < 2; s += 0.4) {
        assert_true(ps_sobolev_distance(s, u, v) == 0); /* no rounding of a dot product */
        assert_true(fabs(ps_sobolev_distance(s, u, v + 3) - pow(4, s - 1)) <= 1e-15);
        assert_true(fabs(ps_sobolev_distance(s, u, v + 6) - pow(2, s - 1)) <= 1e-15);
        const double sum = ps_sobolev_distance_sum(s, u, 3, v, weights);
        assert_true(fabs(sum - (2 * pow(2, s - 1) - 0.5 * pow(4, s - 1))) <= 1e-15);
        const double plain = ps_sobolev_distance_sum(s, u, 3, v, NULL);
        assert_true(fabs(plain - (pow(2, s - 1) + pow(4, s - 1))) <= 2e-15);
    }
}

/* Rows of weights that share their distances have the bits of one row at a time, wherever the last
 * chunk ends. */
static void sums_side_by_side(void **state) {
    enum { NUM = 2 * PS_SOBOLEV_CHUNK + 7, ROWS = 3 };
    const double u[3] = {0, 0.6, 0.8};
    double points[3 * NUM];
    double weights[ROWS * NUM];
    (void)state;
    for (size_t j = 0; j < NUM; j++) {
        const double t = (double)j;
        points[3 * j] = cos(t) * cos(3 * t);
        points[3 * j + 1] = cos(t) * sin(3 * t);
        points[3 * j + 2] = sin(t);
    }
    for (size_t k = 0; k < ROWS * NUM; k++) {
        weights[k] = sin(7 * (double)k);
    }
    for (double s = 1.1; s < 2; s += 0.4) {
        double sums[ROWS];
        ps_sobolev_distance_sums(s, u, NUM, points, ROWS, weights, sums);
        for (size_t row = 0; row < ROWS; row++) {
            const double *const own = weights + row * NUM;
            double expected = 0;
            for (size_t j = 0; j < NUM; j++) {
                expected += own[j] * ps_sobolev_distance(s, u, points + 3 * j);
            }
            assert_true(fabs(sums[row] - expected) <= 1e-12);
            assert_true(sums[row] == ps_sobolev_distance_sum(s, u, NUM, points, own));
        }
    }
}

/* Powers side by side against long double, over all sizes of distances; 0 stays 0. */
static void powers(void **state) {
    enum { ROUNDS = 500 };
    const double range = 70; /* e^-70 is the square of a distance that coordinates cannot have */
    uint64_t seed = 1;
    double worst = 0;
    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        double values[PS_POWERS];
        double given[PS_POWERS];
        const double exponent = test_uniform(&seed);
        for (int i = 0; i < PS_POWERS; i++) {
            const double u = test_uniform(&seed);
            given[i] = round % 2 == 0 ? 4 * u : 4 * exp(-range * u);
        }
        given[0] = 0;
        given[1] = 4;
        given[2] = 1;
        given[3] = 5e-324;
        memcpy(values, given, sizeof values);
        ps_powers(exponent, values);
        assert_true(values[0] == 0 && values[2] == 1 && values[3] == 0);
        for (int i = 0; i < PS_POWERS; i++) {
            if (i != 3) {
                worst = fmax(worst, (double)fabsl(values[i] - powl(given[i], exponent)));
            }
        }
    }
    print_message("powers: worst error %.2g\n", worst);
    assert_true(worst <= 1e-15);
}

static void refusals(void **state) {
    const double bad[] = {1, 2, 0.5, 2.5, -1, NAN, INFINITY};
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        ps_error error = {0};
        assert_int_equal(ps_sobolev_check(bad[i], &error), PSPEC_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(error.message, "is not between 1 and 2: functions of H^s"));
    }
    assert_ok(ps_sobolev_check(1.0001, error));
}

static void gauss_legendre(void **state) {
    enum { MOST = 1500 };
    static const size_t nums[] = {1, 2, 3, 10, 151, MOST};
    double *nodes = calloc(MOST, sizeof *nodes);
    double *weights = calloc(MOST, sizeof *weights);
    (void)state;
    for (size_t i = 0; i < sizeof nums / sizeof nums[0]; i++) {
        const size_t num = nums[i];
        ps_gauss_legendre(num, nodes, weights);
        for (size_t power = 0; power < 2 * num && power < 3000; power = 2 * power + 1) {
            double sum = 0;
            for (size_t j = 0; j < num; j++) {
                sum += weights[j] * pow(nodes[j], (double)power);
                assert_true(j == 0 || nodes[j] > nodes[j - 1]);
            }
            assert_true(fabs(sum * (double)(power + 1) - 1) <= 1e-12);
        }
    }
    free(nodes);
    free(weights);
}

static void conversion(void **state) {
    enum { FROM = 40, TO = 300 };
    cJSON *json = test_read_reference("tables.json");
    const cJSON *rows = cJSON_GetObjectItem(cJSON_GetObjectItem(json, "conversion_M"), "rows");
    const cJSON *row = NULL;
    double *matrix = calloc((FROM + 1) * (TO + 1), sizeof *matrix);
    double worst = 0;
    (void)state;
    assert_ok(ps_half_range_matrix(FROM, TO, matrix, error));
    cJSON_ArrayForEach(row, rows) {
        const size_t i = (size_t)cell(row, 0) * (TO + 1) + (size_t)cell(row, 1);
        worst = fmax(worst, fabs(matrix[i] - cell(row, 2)));
    }
    print_message("M: worst error %.2g\n", worst);
    assert_true(worst <= 1e-13); /* docs/mathematics/quadrature.md#hemispherical-harmonics */
    for (size_t i = 0; i <= FROM; i++) {
        double sum = 0;
        for (size_t l = 0; l <= TO; l++) {
            const double value = matrix[i * (TO + 1) + l];
            sum += value * value;
            assert_true(l >= i || value == 0);
        }
        assert_true(sum < 1 && sum > 0.9); /* what is left of 1 falls like 1/L */
    }
    free(matrix);
    cJSON_Delete(json);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eigenvalues), cmocka_unit_test(closed_forms),
        cmocka_unit_test(distances),   cmocka_unit_test(powers),
        cmocka_unit_test(refusals),    cmocka_unit_test(gauss_legendre),
        cmocka_unit_test(conversion),  cmocka_unit_test(sums_side_by_side)};
    return cmocka_run_group_tests_name("sobolev", tests, NULL, NULL);
}
