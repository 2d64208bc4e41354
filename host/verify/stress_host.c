/* What the host computes alone, against other formulas in long double
 * (docs/mathematics/quadrature.md, docs/mathematics/numerics.md). */
#include "verify/stress.h"

#include "base/memory.h"
#include "engines/host/host_direct.h"
#include "integrands/lobes/brdf.h"
#include "math/gauss_legendre.h"
#include "math/pi.h"
#include "math/sobolev.h"
#include "rules/optimal_weights.h"
#include "rules/worst_case_error.h"
#include "verify/stress_shapes.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* ---- eigenvalues --------------------------------------------------------------------------- */

/* a_l = a_1 G(l + 1 - s) G(2 + s) / (G(2 - s) G(l + 1 + s)): Gamma itself would overflow at l =
 * 170. */
static pspec_status measure_eigenvalues(ps_device *device, ps_precision precision, double *found,
                                        double *bound, ps_error *error) {
    enum { LAST = 10000 };
    static const double smoothnesses[] = {1.1, 1.5, 1.9};
    double *a = NULL;
    (void)device, (void)precision;
    PS_TRY(PS_NEW(&a, LAST + 1, "eigenvalues", error));
    *found = 0;
    *bound = 1e-12; /* math/sobolev.h */
    for (size_t i = 0; i < sizeof smoothnesses / sizeof smoothnesses[0]; i++) {
        const long double s = smoothnesses[i];
        const long double first =
            PS_FOUR_PI_L * powl(2, 2 * s - 2) / s * (s - 1) / (s + 1); /* a_1 */
        ps_sobolev_eigenvalues(smoothnesses[i], LAST, a);
        for (int l = 1; l <= LAST; l++) {
            const long double other = first * expl(lgammal(l + 1 - s) - lgammal(l + 1 + s) +
                                                   lgammal(2 + s) - lgammal(2 - s));
            *found = fmax(*found, fabs((double)(a[l] / other - 1)));
        }
    }
    free(a);
    return PSPEC_OK;
}

const ps_stress_probe ps_probe_eigenvalues = {
    .engine = "host", .has_precision = {false, true, false}, .measure = measure_eigenvalues};

/* ---- lobes --------------------------------------------------------------------------------- */

/* int e^-t P_l(1 - t/n) dt over int e^-t dt for l <= last, 0 <= t <= end, by Gauss-Legendre rules
 * in panels; P_l from differences, which keep the digits of small t. */
static void integrate_lobe(double n, double end, size_t last, long double *ratios) {
    enum { NODES = 32, PANELS = 64 };
    double nodes[NODES];
    double weights[NODES];
    ps_gauss_legendre(NODES, nodes, weights);
    for (size_t l = 0; l <= last; l++) {
        ratios[l] = 0;
    }
    for (int i = 0; i < NODES * PANELS; i++) {
        const long double t = (i / NODES + (long double)nodes[i % NODES]) * end / PANELS;
        const long double weight = weights[i % NODES] * expl(-t);
        const long double x = t / n;
        long double p = 1;
        long double d = 0;
        ratios[0] += weight;
        for (size_t l = 1; l <= last; l++) {
            d = ((long double)(l - 1) * d - (2 * (long double)l - 1) * x * p) / (long double)l;
            p += d;
            ratios[l] += weight * p;
        }
    }
    for (size_t l = last + 1; l-- > 0;) {
        ratios[l] /= ratios[0];
    }
}

/* The coefficients of glossy lobes up to where they have fallen to a hundredth. */
static pspec_status compare_lobe(const char *name, double n, double end, size_t last, double *found,
                                 ps_error *error) {
    ps_brdf *brdf = NULL;
    double *b = NULL;
    long double *ratios = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, ps_brdf_parse(&brdf, name, error));
    PS_TRY_OUT(status, PS_NEW(&b, last + 1, "coefficients", error));
    PS_TRY_OUT(status, PS_NEW(&ratios, last + 1, "coefficients", error));
    PS_TRY_OUT(status, ps_brdf_spherical(brdf, last, b, error));
    integrate_lobe(n, end, last, ratios);
    *found = 0;
    for (size_t l = 0; l <= last; l++) {
        const long double other = sqrtl((2 * (long double)l + 1) / PS_FOUR_PI_L) * ratios[l];
        *found = fmax(*found, fabs((double)(b[l] / other - 1)));
    }
out:
    free(b);
    free(ratios);
    ps_brdf_destroy(brdf);
    return status;
}

/* integrands/lobes/brdf.h */
static const double lobe_bound = 3e-12;

/* I_{l+1/2}(n) overflows for n > 713 and e^-n is 0 above 745: only their quotients can be had. */
static pspec_status measure_sharp_lobe(ps_device *device, ps_precision precision, double *found,
                                       double *bound, ps_error *error) {
    const double n = 1e5;
    const double end = 80; /* e^-80 = 2e-35 */
    (void)device, (void)precision;
    *bound = lobe_bound;
    return compare_lobe("glossy:n=1e5", n, end, 3 * (size_t)sqrt(n), found, error);
}

/* Wide enough for its edge at the horizon to matter, where recurrences are unstable both ways. */
static pspec_status measure_wide_lobe(ps_device *device, ps_precision precision, double *found,
                                      double *bound, ps_error *error) {
    enum { LAST = 8 };
    const double n = 3;
    (void)device, (void)precision;
    *bound = lobe_bound;
    return compare_lobe("glossy:n=3", n, n, LAST, found, error);
}

const ps_stress_probe ps_probe_sharp_lobe = {
    .engine = "host", .has_precision = {false, true, false}, .measure = measure_sharp_lobe};
const ps_stress_probe ps_probe_wide_lobe = {
    .engine = "host", .has_precision = {false, true, false}, .measure = measure_wide_lobe};

/* ---- the kernel ---------------------------------------------------------------------------- */

/* |u-v|^0.2: the rounding of 2 - 2 u.v would give equal points a distance of 0.03. */
static pspec_status measure_diagonal(ps_device *device, ps_precision precision, double *found,
                                     double *bound, ps_error *error) {
    enum { NUM = 400 };
    const double smoothness = 1.1;
    pspec_pattern pattern;
    long double truth = 0;
    double sum = 0;
    (void)device, (void)precision;
    PS_TRY(ps_stress_shape_make(ps_stress_shape_find(ps_vector_shapes, "duplicates"),
                                PS_SPHERE_DIMENSION, NUM, 1, &pattern, error));
    const ps_rule rule = {NUM, pattern.points, NULL};
    pspec_status status = ps_rule_distance(&rule, smoothness, NULL, &sum, error);
    if (status == PSPEC_OK) {
        status = ps_host_chords(&pattern, smoothness - 1, &truth, error);
    }
    *found = fabs((double)(sum - truth / NUM / NUM));
    *bound = 16 * DBL_EPSILON * ps_sobolev_constant(smoothness); /* as in worst_case_error.c */
    ps_stress_pattern_free(&pattern);
    return status;
}

const ps_stress_probe ps_probe_diagonal = {
    .engine = "host", .has_precision = {false, true, false}, .measure = measure_diagonal};

/* ---- optimal weights ----------------------------------------------------------------------- */

/* Pairs of points a thousandth apart: K is nearly singular. E^2 from the system that was solved
 * against the kernel form with its weights, which knows nothing of the system; and no rule may be
 * better. */
static pspec_status compare_weights(const ps_representer *representer, const double *points,
                                    size_t num, double *weights, double *found, double *bound,
                                    ps_error *error) {
    ps_optimal_weights optimal;
    ps_kernel_error own;
    ps_kernel_error equal;
    const ps_rule rule = {num, points, weights};
    const ps_rule equal_rule = {num, points, NULL};
    PS_TRY(ps_optimal_weights_find(representer, num, points, NULL, false, NULL, weights, &optimal,
                                   error));
    PS_TRY(ps_kernel_error_of(representer, &rule, NULL, NULL, NULL, &own, error));
    PS_TRY(ps_kernel_error_of(representer, &equal_rule, NULL, NULL, NULL, &equal, error));
    *found = fmax(fabs(optimal.squared - own.squared), own.squared - equal.squared);
    *bound = own.bound;
    return PSPEC_OK;
}

static pspec_status measure_optimal_weights(ps_device *device, ps_precision precision,
                                            double *found, double *bound, ps_error *error) {
    enum { NUM = 200 };
    const double smoothness = 1.9;
    const double gap = 1e-3;
    const double tolerance = 1e-13;
    double points[3 * NUM];
    double weights[NUM];
    ps_brdf *brdf = NULL;
    ps_representer representer = {0};
    (void)device, (void)precision;
    for (size_t j = 0; j < NUM; j++) { /* of the hemisphere, in equal areas */
        const double z = ((double)(j / 2) + 0.5) / (NUM / 2);
        const double phi = 2.399963229728653 * (double)(j / 2) + gap * (double)(j % 2);
        const double rho = sqrt((1 - z) * (1 + z));
        points[3 * j] = rho * cos(phi);
        points[3 * j + 1] = rho * sin(phi);
        points[3 * j + 2] = z;
    }
    pspec_status status = ps_brdf_parse(&brdf, "glossy:n=30", error);
    if (status == PSPEC_OK) {
        status = ps_representer_create(&representer, brdf, smoothness, tolerance, 1, error);
    }
    if (status == PSPEC_OK) {
        status = compare_weights(&representer, points, NUM, weights, found, bound, error);
    }
    ps_representer_destroy(&representer);
    ps_brdf_destroy(brdf);
    return status;
}

const ps_stress_probe ps_probe_optimal_weights = {
    .engine = "host", .has_precision = {false, true, false}, .measure = measure_optimal_weights};
