/* Digital nets: equidistribution, the sequences they should be, scrambling. */
#include "test_samplers.h"

#include <math.h>

/* ---- nets -------------------------------------------------------------------------------------
 */

typedef struct net {
    const double *points;
    unsigned num_axes, stride; /* stride: coordinates per point */
    unsigned axes[PS_MAX_DIMENSION];
    unsigned m, t;                     /* 2^m points */
    unsigned digits[PS_MAX_DIMENSION]; /* the interval being tried has sides 2^-digits */
} net;

/* Every one of the 2^(m-t) boxes with these sides holds 2^t points. */
static bool boxes_are_full(const net *n) {
    const size_t num_boxes = (size_t)1 << (n->m - n->t);
    unsigned *counts = calloc(num_boxes, sizeof *counts);
    assert_non_null(counts);
    for (size_t j = 0; j < (size_t)1 << n->m; j++) {
        size_t box = 0;
        for (unsigned a = 0; a < n->num_axes; a++) {
            const double x = n->points[j * n->stride + n->axes[a]];
            box = box << n->digits[a] | (size_t)ldexp(x, (int)n->digits[a]);
        }
        counts[box]++;
    }
    bool is_full = true;
    for (size_t box = 0; box < num_boxes; box++) {
        is_full = is_full && counts[box] == 1u << n->t;
    }
    free(counts);
    return is_full;
}

/* All ways to share the remaining digits among the axes from number a on. */
static bool all_boxes_are_full(net *n, unsigned a, unsigned num_left) {
    if (a + 1 == n->num_axes) {
        n->digits[a] = num_left;
        return boxes_are_full(n);
    }
    for (unsigned taken = 0; taken <= num_left; taken++) {
        n->digits[a] = taken;
        if (!all_boxes_are_full(n, a + 1, num_left - taken)) {
            return false;
        }
    }
    return true;
}

static bool is_net(net n, unsigned t) {
    n.t = t < n.m ? t : n.m;
    return all_boxes_are_full(&n, 0, n.m - n.t);
}

static const char *const PLANE_NETS[] = {
    "sobol",
    "sobol:scramble=xor",
    "sobol:scramble=owen",
    "sobol:scramble=hash",
    "pmj02",
    "hammersley",
    "lp",
    "lp:centred=yes",
    "lp:scramble=xor",
    "lp:scramble=owen",
    "lp:scramble=xor,centred=yes",
};

static void plane_sets_are_0_m_2_nets(void **state) {
    (void)state;
    for (size_t v = 0; v < sizeof PLANE_NETS / sizeof PLANE_NETS[0]; v++) {
        for (unsigned m = 0; m <= 12; m++) {
            const ps_sampler_request request = make_request(PLANE_NETS[v], (size_t)1 << m, 2);
            double *points = generate_points(&request, m);
            const net n = {.points = points, .num_axes = 2, .stride = 2, .axes = {0, 1}, .m = m};
            assert_true(is_net(n, 0));
            free(points);
        }
    }
}

/* t of a Sobol' sequence is at most the sum of (degree - 1) over its polynomials; axes 0 and 1
 * count as degree 1 (I. M. Sobol' 1967, theorem 3.4). Holds for every choice of axes. */
static const unsigned DEGREES[PS_MAX_DIMENSION] = {1, 1, 2, 3, 3, 4};

static void assert_sobol_t(const double *points, unsigned m, unsigned chosen_axes) {
    net n = {.points = points, .stride = PS_MAX_DIMENSION, .m = m};
    unsigned t = 0;
    for (unsigned i = 0; i < PS_MAX_DIMENSION; i++) {
        if (chosen_axes >> i & 1) {
            n.axes[n.num_axes++] = i;
            t += DEGREES[i] - 1;
        }
    }
    assert_true(is_net(n, t));
}

static void every_projection_of_sobol_is_a_net(void **state) {
    (void)state;
    const char *variants[] = {"sobol", "sobol:scramble=xor", "sobol:scramble=owen",
                              "sobol:scramble=hash"};
    for (size_t v = 0; v < sizeof variants / sizeof variants[0]; v++) {
        const unsigned m = 10;
        const ps_sampler_request request =
            make_request(variants[v], (size_t)1 << m, PS_MAX_DIMENSION);
        double *points = generate_points(&request, 1);
        for (unsigned axes = 1; axes < 1u << PS_MAX_DIMENSION; axes++) {
            assert_sobol_t(points, m, axes);
        }
        free(points);
    }
}

/* The first points that Joe and Kuo print (notes to their program), in Gray code order there. */
static void sobol_agrees_with_joe_and_kuo(void **state) {
    (void)state;
    static const double printed[10][3] = {
        {0, 0, 0},
        {.5, .5, .5},
        {.75, .25, .25},
        {.25, .75, .75},
        {.375, .375, .625},
        {.875, .875, .125},
        {.625, .125, .875},
        {.125, .625, .375},
        {.1875, .3125, .9375},
        {.6875, .8125, .4375},
    };
    const ps_sampler_request request = make_request("sobol", 16, 3);
    double *points = generate_points(&request, 0);
    for (unsigned j = 0; j < 10; j++) {
        assert_memory_equal(points + (j ^ j >> 1) * 3, printed[j], sizeof printed[j]);
    }
    free(points);
}

/* m_1, m_2, .. of axes 2 to 5, where point 2^b has the coordinate m_(b+1) / 2^(b+1). The first
 * ones, as many as the degree of the polynomial, stand in new-joe-kuo-6.21201 under the dimensions
 * 3 to 6; the rest are what Joe and Kuo's recurrence makes of them, as in SciPy's qmc.Sobol(6). */
static void sobol_has_the_published_direction_numbers(void **state) {
    (void)state;
    enum { FIRST_AXIS = 2, NUM_DIGITS = 10 };
    static const double m[][NUM_DIGITS] = {
        {1, 3, 3, 9, 29, 23, 71, 197, 209, 627},
        {1, 3, 1, 5, 31, 29, 81, 147, 433, 149},
        {1, 1, 1, 11, 31, 55, 61, 157, 181, 191},
        {1, 1, 3, 3, 25, 9, 43, 251, 449, 449},
    };
    const ps_sampler_request request = make_request("sobol", 1 << NUM_DIGITS, PS_MAX_DIMENSION);
    double *points = generate_points(&request, 0);
    for (unsigned axis = FIRST_AXIS; axis < PS_MAX_DIMENSION; axis++) {
        for (int b = 0; b < NUM_DIGITS; b++) {
            const double x = points[((size_t)1 << b) * PS_MAX_DIMENSION + axis];
            assert_true(x == ldexp(m[axis - FIRST_AXIS][b], -b - 1));
        }
    }
    free(points);
}

/* The plane by the recipe of docs/mathematics/samplers.md#digital-nets, one point at a time. */
static void digital_sets_follow_the_recipe(void **state) {
    (void)state;
    enum { N = 4096 };
    const ps_sampler_request sobol_request = make_request("sobol", N, 2);
    const ps_sampler_request lp_request = make_request("lp", N, 2);
    double *sobol = generate_points(&sobol_request, 0);
    double *lp = generate_points(&lp_request, 0);
    for (uint32_t j = 0; j < N; j++) {
        uint32_t x = 0;
        uint32_t y = 0;
        uint32_t z = 0;
        uint32_t v = (uint32_t)1 << 31;
        uint32_t u = v;
        for (unsigned b = 0; b < 32; b++) {
            const uint32_t mask = 0u - (j >> b & 1);
            x |= (j >> b & 1) << (31 - b);
            y ^= v & mask;
            z ^= u & mask;
            v ^= v >> 1;
            u |= u >> 1;
        }
        assert_true(sobol[2 * j] == x * 0x1p-32 && sobol[2 * j + 1] == y * 0x1p-32);
        assert_true(lp[2 * j] == (double)j / N && lp[2 * j + 1] == z * 0x1p-32);
    }
    free(sobol);
    free(lp);
}

/* ---- scrambling -------------------------------------------------------------------------------
 */

/* All 53 digits are random: below those that the net fixes, each is 1 for half of the points. */
static void owen_fills_every_digit(void **state) {
    (void)state;
    enum { M = 14, DIGITS = 53 };
    const double n = 1 << M;
    const ps_sampler_request request = make_request("sobol:scramble=owen", 1 << M, 2);
    double *points = generate_points(&request, 0);
    for (unsigned i = 0; i < 2; i++) {
        for (unsigned digit = 0; digit < DIGITS; digit++) {
            double num_ones = 0;
            for (size_t j = 0; j < 1 << M; j++) {
                const uint64_t bits = (uint64_t)ldexp(points[2 * j + i], DIGITS);
                num_ones += (double)(bits >> (DIGITS - 1 - digit) & 1);
            }
            assert_true(fabs(num_ones - n / 2) <= (digit < M ? 0 : 4 * sqrt(n) / 2));
        }
    }
    free(points);
}

/* Of two points that differ in the first digit, the digits below are scrambled independently; a
 * digital shift keeps them equal. */
static void owen_is_nested_and_xor_is_not(void **state) {
    (void)state;
    enum { M = 20000 };
    const ps_sampler_request owen = make_request("sobol:scramble=owen", 2, 1);
    const ps_sampler_request shift = make_request("sobol:scramble=xor", 2, 1);
    double correlation = 0;
    double mean = 0;
    for (uint64_t r = 0; r < M; r++) {
        double x[2];
        generate_into(&owen, r, x);
        correlation += 12 * (fmod(2 * x[0], 1) - 0.5) * (fmod(2 * x[1], 1) - 0.5);
        mean += x[0] - 0.5;
        generate_into(&shift, r, x);
        assert_true(fmod(2 * x[0], 1) == fmod(2 * x[1], 1));
    }
    assert_true(fabs(correlation) < 4 * sqrt(M));
    assert_true(fabs(mean) < 4 * sqrt(M / 12.0));
}

/* x and the fraction of 2^shift x, for uniform x with independent digits: correlation 2^-shift. One
 * point, so that every chunk of the tree of flips is entered at its first block. */
static void digits_of_owen_are_independent(void **state) {
    (void)state;
    enum { M = 20000, MOST = 35 };
    const ps_sampler_request request = make_request("sobol:scramble=owen", 1, 2);
    double correlation[2][MOST] = {{0}};
    for (uint64_t r = 0; r < M; r++) {
        double x[2];
        generate_into(&request, r, x);
        for (unsigned i = 0; i < 2; i++) {
            for (int shift = 1; shift < MOST; shift++) {
                const double lower = fmod(ldexp(x[i], shift), 1);
                correlation[i][shift] += 12 * (x[i] - 0.5) * (lower - 0.5);
            }
        }
    }
    for (int shift = 1; shift < MOST; shift++) {
        assert_true(fabs(correlation[0][shift] - ldexp(M, -shift)) < 4 * sqrt(M));
        assert_true(fabs(correlation[1][shift] - ldexp(M, -shift)) < 4 * sqrt(M));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plane_sets_are_0_m_2_nets),
        cmocka_unit_test(every_projection_of_sobol_is_a_net),
        cmocka_unit_test(sobol_agrees_with_joe_and_kuo),
        cmocka_unit_test(sobol_has_the_published_direction_numbers),
        cmocka_unit_test(digital_sets_follow_the_recipe),
        cmocka_unit_test(owen_fills_every_digit),
        cmocka_unit_test(owen_is_nested_and_xor_is_not),
        cmocka_unit_test(digits_of_owen_are_independent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
