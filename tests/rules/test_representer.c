/* kappa and kappa_0 of wide lobes, whose series converge slowest, against integrals over rings. */
#include "harness_quadrature.h"

#include "integrands/lobes/brdf.h"
#include "math/pi.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- quadrature: tanh-sinh, whose error does not mind what happens at the ends --------------- */

typedef long double (*integrand)(const void *payload, long double x);

/* Of f from a to b; nodes come as near to the ends as a long double can tell. */
static long double integrate(integrand f, const void *payload, long double a, long double b) {
    enum { NODES = 100 };
    const long double step = 0.04L;
    const long double half = (b - a) / 2;
    long double sum = 0;
    for (int k = -NODES; k <= NODES; k++) {
        const long double t = step * k;
        const long double u = PS_PI_L / 2 * sinhl(t);
        const long double gap = half * expl(-fabsl(u)) / coshl(u); /* to the nearer end */
        const long double x = k < 0 ? a + gap : b - gap;
        if (x > a && x < b) {
            sum += PS_PI_L / 2 * coshl(t) / (coshl(u) * coshl(u)) * f(payload, x);
        }
    }
    return half * step * sum;
}

/* ---- the distance from u to the lobe, by rings around u -------------------------------------- */

typedef struct ring {
    const ps_brdf *brdf;
    long double smoothness, cosine, sine; /* of the angle between u and the axis */
    long double x, y;                     /* z = x + y cos phi on the ring */
} ring;

static long double on_ring(const void *payload, long double phi) {
    const ring *const circle = payload;
    const long double z = circle->x + circle->y * cosl(phi);
    return ps_brdf_density(circle->brdf, (double)fmaxl(z, 0));
}

/* |u-v|^(2s-2) phat over the ring of radius g around u. */
static long double of_ring(const void *payload, long double g) {
    ring circle = *(const ring *)payload;
    circle.x = circle.cosine * cosl(g);
    circle.y = circle.sine * sinl(g);
    if (circle.x <= -circle.y) {
        return 0;
    }
    const long double last =
        circle.x >= circle.y ? PS_PI_L : acosl(-circle.x / circle.y); /* above the horizon */
    const long double mean = integrate(on_ring, &circle, 0, last);
    return powl(2 * sinl(g / 2), 2 * circle.smoothness - 2) * 2 * mean * sinl(g);
}

/* D(u) = int |u-v|^(2s-2) phat(v) dS(v), split where rings begin and end to cross the horizon. */
static long double distance_from(const ps_brdf *brdf, double smoothness, long double z) {
    ring circle = {
        .brdf = brdf, .smoothness = smoothness, .cosine = z, .sine = sqrtl((1 - z) * (1 + z))};
    const long double theta = acosl(z);
    const long double first = fabsl(PS_PI_L / 2 - theta);
    const long double second = theta <= PS_PI_L / 2 ? PS_PI_L / 2 + theta : 3 * PS_PI_L / 2 - theta;
    return integrate(of_ring, &circle, 0, first) + integrate(of_ring, &circle, first, second) +
           integrate(of_ring, &circle, second, PS_PI_L);
}

/* ---- tests ----------------------------------------------------------------------------------- */

static const char *const lobes[] = {"glossy:n=0.01", "glossy:n=0.1", "glossy:n=1", "phong:n=0.1",
                                    "phong:n=0.5",   "diffuse",      "phong:n=2",  "glossy:n=8"};
enum { NUM_LOBES = sizeof lobes / sizeof lobes[0] };

/* The integrals themselves: the diffuse lobe at the poles has a closed form. */
static void rings_are_right(void **state) {
    (void)state;
    ps_brdf *brdf = NULL;
    assert_ok(ps_brdf_parse(&brdf, "diffuse", error));
    for (double s = 1.1; s < 2; s += 0.4) {
        const long double top = powl(2, s) / (s * (s + 1));
        const long double bottom =
            powl(2, s) * ((powl(2, s + 1) - 1) / (s + 1) - (powl(2, s) - 1) / s);
        assert_true(fabsl(distance_from(brdf, s, 1) - top) <= 1e-15L);
        assert_true(fabsl(distance_from(brdf, s, -1) - bottom) <= 1e-15L);
    }
    ps_brdf_destroy(brdf);
}

static void kappa_of_wide_lobes(void **state) {
    static const double heights[] = {1, 0.1, 0, -1};
    enum { NUM = sizeof heights / sizeof heights[0] };
    (void)state;
    double points[3 * NUM];
    double kappa[NUM];
    for (int i = 0; i < NUM; i++) {
        points[3 * i] = sqrt(1 - heights[i] * heights[i]);
        points[3 * i + 1] = 0;
        points[3 * i + 2] = heights[i];
    }
    for (int k = 0; k < NUM_LOBES; k++) {
        ps_brdf *brdf = NULL;
        assert_ok(ps_brdf_parse(&brdf, lobes[k], error));
        for (double s = 1.1; s < 2; s += 0.4) {
            ps_representer r = test_representer(lobes[k], s, PS_REPRESENTER_TOLERANCE);
            double worst = 0;
            ps_representer_kappa(&r, NUM, points, kappa);
            for (int i = 0; i < NUM; i++) {
                const long double d = distance_from(brdf, s, heights[i]);
                worst = fmax(worst, fabs((double)((long double)r.constant - d - kappa[i])));
            }
            print_message("%-14s s %.1f: L %5zu, kappa off by %.1e, %.1e estimated\n", lobes[k], s,
                          r.max_degree, worst, r.kappa_estimate);
            /* and rounding */
            assert_true(worst <= r.kappa_estimate + 1e-14);
            assert_true(worst <= 7e-13 && worst <= r.kappa_bound + 1e-14);
            ps_representer_destroy(&r);
        }
        ps_brdf_destroy(brdf);
    }
}

/* Where degrees are too few for kappa: what it is off by is what is said. */
static void estimates(void **state) {
    static const double heights[] = {1, 0};
    (void)state;
    for (int k = 0; k < NUM_LOBES; k++) {
        ps_brdf *brdf = NULL;
        assert_ok(ps_brdf_parse(&brdf, lobes[k], error));
        for (double tolerance = 1e-5; tolerance > 1e-10; tolerance *= 1e-2) {
            ps_representer r = test_representer(lobes[k], 1.3, tolerance);
            double worst = 0;
            for (int i = 0; i < 2; i++) {
                const double u[3] = {1 - heights[i], 0, heights[i]};
                double kappa = 0;
                ps_representer_kappa(&r, 1, u, &kappa);
                const long double d = distance_from(brdf, 1.3, heights[i]);
                worst = fmax(worst, fabs((double)((long double)r.constant - d - kappa)));
            }
            assert_true(r.kappa_estimate <= tolerance);
            assert_true(worst <= r.kappa_estimate + 1e-14);
            assert_true(worst >= r.kappa_estimate / 50); /* it says something */
            ps_representer_destroy(&r);
        }
        ps_brdf_destroy(brdf);
    }
}

/* Without odd degrees that are 0 and degrees behind the decay kappa is what it was; other lobes
 * keep their terms. */
static void left_out(void **state) {
    static const struct {
        const char *lobe;
        bool is_even;
    } cases[] = {{"diffuse", true},
                 {"phong:n=1", true},
                 {"phong:n=2", false},
                 {"glossy:n=30", false},
                 {"glossy:n=200,cut=none", false}};
    enum { NUM = 41, LEAST = 600 };
    const double most = 1e-14;
    double points[3 * NUM], kept[NUM], all[NUM];
    (void)state;
    for (int i = 0; i < NUM; i++) {
        const double z = i / 20.0 - 1;
        points[3 * i] = 0.6 * sqrt(1 - z * z);
        points[3 * i + 1] = -0.8 * sqrt(1 - z * z);
        points[3 * i + 2] = z;
    }
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        ps_representer r;
        ps_brdf *brdf = NULL;
        assert_ok(ps_brdf_parse(&brdf, cases[k].lobe, error));
        assert_ok(ps_representer_create(&r, brdf, 1.5, PS_REPRESENTER_TOLERANCE, LEAST, error));
        const size_t num = r.num_terms;
        const double estimate = r.kappa_estimate;
        ps_representer_kappa(&r, NUM, points, all);
        ps_representer_skip(&r, most);
        ps_representer_kappa(&r, NUM, points, kept);
        for (int i = 0; i < NUM; i++) {
            assert_true(fabs(kept[i] - all[i]) <= most + 4e-15);
        }
        assert_true(r.only_even == cases[k].is_even);
        assert_true(r.kappa_estimate >= estimate && r.kappa_estimate <= estimate + most);
        assert_true(cases[k].is_even ? r.num_terms <= num / 2 + 1 : r.num_terms <= num);
        print_message("%-22s %zu terms of %zu\n", cases[k].lobe, r.num_terms, num);
        if (strncmp(cases[k].lobe, "glossy", strlen("glossy")) == 0) {
            assert_true(2 * r.num_terms < num);
        }
        ps_representer_destroy(&r);
        ps_brdf_destroy(brdf);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(rings_are_right),
                                       cmocka_unit_test(kappa_of_wide_lobes),
                                       cmocka_unit_test(estimates), cmocka_unit_test(left_out)};
    return cmocka_run_group_tests_name("representer", tests, NULL, NULL);
}
