/* Radical inverses, exactly; and the discrepancies that are known of sets of the plane. */
#include "test_samplers.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- radical inverses -------------------------------------------------------------------------
 */

static void first_points_of_halton_are_exact(void **state) {
    (void)state;
    static const double expected[6][4] = {
        {0, 0, 0, 0},
        {1.0 / 2, 1.0 / 3, 1.0 / 5, 1.0 / 7},
        {1.0 / 4, 2.0 / 3, 2.0 / 5, 2.0 / 7},
        {3.0 / 4, 1.0 / 9, 3.0 / 5, 3.0 / 7},
        {1.0 / 8, 4.0 / 9, 4.0 / 5, 4.0 / 7},
        {5.0 / 8, 7.0 / 9, 1.0 / 25, 5.0 / 7},
    };
    const ps_sampler_request request = make_request("halton", 6, 4);
    double *points = generate_points(&request, 0);
    assert_memory_equal(points, expected, sizeof expected);
    free(points);
}

/* In exact whole numbers: the last index of 13 digits of each base mirrors to its complement. */
static void halton_is_correctly_rounded_far_out(void **state) {
    (void)state;
    static const uint64_t primes[PS_MAX_DIMENSION] = {2, 3, 5, 7, 11, 13};
    for (unsigned i = 0; i < PS_MAX_DIMENSION; i++) {
        uint64_t power = 1;
        while (power <= ((uint64_t)1 << 47) / primes[i]) {
            power *= primes[i];
        }
        char text[64];
        snprintf(text, sizeof text, "halton:start=%llu", (unsigned long long)(power - 1));
        const ps_sampler_request request = make_request(text, 2, PS_MAX_DIMENSION);
        double *points = generate_points(&request, 0);
        assert_true(points[i] == (double)(power - 1) / (double)power);
        assert_true(points[PS_MAX_DIMENSION + i] == 1 / (double)(power * primes[i]));
        free(points);
    }
}

static void start_moves_along_the_sequence(void **state) {
    (void)state;
    const ps_sampler_request whole = make_request("halton", 300, 3);
    const ps_sampler_request part = make_request("halton:start=200", 100, 3);
    double *points = generate_points(&whole, 0);
    double *last = generate_points(&part, 0);
    assert_memory_equal(points + 600, last, 300 * sizeof(double));
    free(points);
    free(last);
}

static void hammersley_is_halton_behind_a_grid(void **state) {
    (void)state;
    enum { N = 1000, D = 6 };
    const ps_sampler_request hammersley_request = make_request("hammersley", N, D);
    const ps_sampler_request halton_request = make_request("halton", N, D - 1);
    double *hammersley = generate_points(&hammersley_request, 0);
    double *halton = generate_points(&halton_request, 0);
    for (unsigned j = 0; j < N; j++) {
        assert_true(hammersley[j * D] == (double)j / N);
        assert_memory_equal(hammersley + j * D + 1, halton + j * (D - 1), (D - 1) * sizeof(double));
    }
    free(hammersley);
    free(halton);
}

/* ---- discrepancy ------------------------------------------------------------------------------
 */

static int compare_first(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* N D* in the plane, exactly, O(N^2): the supremum is approached at corners (x, y) made of
 * coordinates of points, or 1, from inside (open box) or outside (closed box). */
typedef struct corner_sweep {
    size_t n;
    double *points;   /* sorted by x; the sets measured here have distinct x and distinct y */
    double *heights;  /* all y, sorted, then 1 */
    unsigned *counts; /* per height: points so far */
    double worst;
} corner_sweep;

/* sign 1: volume above count of the open box, with the points before rank; sign -1: count of the
 * closed box above its volume. */
static void sweep_heights(corner_sweep *s, double x, int sign) {
    double num_inside = 0;
    for (size_t rank = 0; rank <= s->n; rank++) {
        const double volume = (double)s->n * x * s->heights[rank];
        const double num_closed = num_inside + s->counts[rank];
        s->worst = fmax(s->worst, sign > 0 ? volume - num_inside : num_closed - volume);
        num_inside = num_closed;
    }
}

static double star_discrepancy(const double *points, size_t n) {
    corner_sweep s = {n, malloc(2 * n * sizeof(double)), malloc((n + 1) * sizeof(double)),
                      calloc(n + 1, sizeof(unsigned)), 0};
    assert_true(s.points != NULL && s.heights != NULL && s.counts != NULL);
    memcpy(s.points, points, 2 * n * sizeof(double));
    qsort(s.points, n, 2 * sizeof(double), compare_first);
    for (size_t j = 0; j < n; j++) {
        s.heights[j] = points[2 * j + 1];
    }
    s.heights[n] = 1;
    qsort(s.heights, n, sizeof(double), compare_first);
    for (size_t j = 0; j < n; j++) {
        const double *point = s.points + 2 * j;
        sweep_heights(&s, point[0], 1);
        const double *height = bsearch(point + 1, s.heights, n, sizeof(double), compare_first);
        s.counts[height - s.heights]++;
        sweep_heights(&s, point[0], -1);
    }
    sweep_heights(&s, 1, 1);
    free(s.points);
    free(s.heights);
    free(s.counts);
    return s.worst;
}

/* N L2* in the plane by Warnock's formula. */
static double l2_discrepancy(const double *points, size_t n) {
    double singles = 0;
    double pairs = 0;
    for (size_t i = 0; i < n; i++) {
        const double *p = points + 2 * i;
        singles += (1 - p[0] * p[0]) * (1 - p[1] * p[1]);
        for (size_t j = 0; j < n; j++) {
            const double *q = points + 2 * j;
            pairs += (1 - fmax(p[0], q[0])) * (1 - fmax(p[1], q[1]));
        }
    }
    const double count = (double)n;
    return sqrt(count * count / 9 - count * singles / 2 + pairs);
}

typedef struct discrepancies {
    const char *text;
    /* N = 64, 256, 1024; docs/mathematics/samplers.md#discrepancies; 0: none */
    double star[3], l2[3];
} discrepancies;

static const discrepancies DISCREPANCIES[] = {
    {"sobol", {3.44, 3.73, 4.40}, {0.82, 0.85, 0.89}},
    {"lp", {2.63, 3.05, 3.42}, {0.793, 0.823, 0.854}},
    {"lp:centred=yes", {2.06, 2.41, 2.86}, {0.520, 0.568, 0.612}},
    {"hammersley", {0, 0, 0}, {1.357, 1.607, 1.857}},
};

static void assert_near(const char *text, double value, double expected, double tolerance) {
    if (!(fabs(value - expected) <= tolerance)) {
        fail_msg("%s: %.6f is not %.6f within %g", text, value, expected, tolerance);
    }
}

static void discrepancies_are_the_published_ones(void **state) {
    (void)state;
    const double star_digits = 0.0051; /* half of the last digit given */
    for (size_t v = 0; v < sizeof DISCREPANCIES / sizeof DISCREPANCIES[0]; v++) {
        const discrepancies *row = &DISCREPANCIES[v];
        for (unsigned s = 0; s < 3; s++) {
            const size_t n = (size_t)64 << 2 * s;
            const ps_sampler_request request = make_request(row->text, n, 2);
            double *points = generate_points(&request, 0);
            assert_near(row->text, l2_discrepancy(points, n), row->l2[s],
                        v == 0 ? 0.0051 : 0.00051);
            if (row->star[s] > 0) {
                assert_near(row->text, star_discrepancy(points, n), row->star[s], star_digits);
            }
            free(points);
        }
    }
}

/* N D* = m/3 + 13/9 - (-1)^m 4/(9 2^m) from m = 2 on (enumeration gives 3/2 for m = 1), and
 * (N L2*)^2 = m^2/64 + 29m/192 + 3/8 - m/(16N) + 1/(4N) - 1/(72N^2). */
static void hammersley_has_its_exact_discrepancies(void **state) {
    (void)state;
    for (unsigned m = 2; m <= 10; m++) {
        const size_t n = (size_t)1 << m;
        const double count = (double)n;
        const double star = m / 3.0 + 13.0 / 9 - (m % 2 == 0 ? 4 : -4) / (9 * count);
        const double l2_squared = m * m / 64.0 + 29 * m / 192.0 + 3.0 / 8 - m / (16 * count) +
                                  1 / (4 * count) - 1 / (72 * count * count);
        const ps_sampler_request request = make_request("hammersley", n, 2);
        double *points = generate_points(&request, 0);
        assert_near("star", star_discrepancy(points, n), star, 1e-12);
        assert_near("l2", l2_discrepancy(points, n), sqrt(l2_squared), 1e-8);
        free(points);
    }
}

/* Means over realizations; the reference is a mean of 10 whose own error we measured here. */
static void assert_mean_l2(const char *text, size_t n, double expected) {
    enum { M = 40, REFERENCE_M = 10 };
    double sum = 0;
    double sum_of_squares = 0;
    const ps_sampler_request request = make_request(text, n, 2);
    for (uint64_t r = 0; r < M; r++) {
        double *points = generate_points(&request, r);
        const double value = l2_discrepancy(points, n);
        sum += value;
        sum_of_squares += value * value;
        free(points);
    }
    const double variance = (sum_of_squares - sum * sum / M) / (M - 1);
    const double standard_error = sqrt(variance * (1.0 / M + 1.0 / REFERENCE_M));
    assert_near(text, sum / M, expected, 4 * standard_error + 0.005);
}

static void random_sets_have_the_published_mean_discrepancies(void **state) {
    (void)state;
    assert_mean_l2("sobol:scramble=owen", 64, 0.61);
    assert_mean_l2("sobol:scramble=owen", 256, 0.69);
    assert_mean_l2("sobol:scramble=hash", 64, 0.61);
    assert_mean_l2("pmj02", 256, 0.69);
    assert_mean_l2("jittered", 64, 1.17);
    assert_mean_l2("jittered", 256, 1.64);
}

/* E (N L2*)^2 = N (2^-d - 3^-d) for independent points. */
static void white_noise_has_its_mean_square_discrepancy(void **state) {
    (void)state;
    enum { N = 64, M = 400 };
    double sum = 0;
    double sum_of_squares = 0;
    const ps_sampler_request request = make_request("white", N, 2);
    for (uint64_t r = 0; r < M; r++) {
        double points[2 * N];
        generate_into(&request, r, points);
        const double square = pow(l2_discrepancy(points, N), 2);
        sum += square;
        sum_of_squares += square * square;
    }
    const double variance = (sum_of_squares - sum * sum / M) / (M - 1);
    assert_near("white", sum / M, N * 5.0 / 36, 4 * sqrt(variance / M));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(first_points_of_halton_are_exact),
        cmocka_unit_test(halton_is_correctly_rounded_far_out),
        cmocka_unit_test(start_moves_along_the_sequence),
        cmocka_unit_test(hammersley_is_halton_behind_a_grid),
        cmocka_unit_test(discrepancies_are_the_published_ones),
        cmocka_unit_test(hammersley_has_its_exact_discrepancies),
        cmocka_unit_test(random_sets_have_the_published_mean_discrepancies),
        cmocka_unit_test(white_noise_has_its_mean_square_discrepancy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
