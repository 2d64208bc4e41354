/* Importance morphing: t against long double, distributions of morphed sets, the words of samplers.
 */
#include "harness.h"

#include "math/morph.h"
#include "samplers/sampler.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* t by the textbook's formula with more digits than are asked for: long double has 64 bits, and
 * -log1p(-v) loses those of v near 1, where t is not small and 1 - v is known. height and polar are
 * exact numbers. */
static long double exact_polar(const ps_morph *morph, long double height, long double polar) {
    const long double n = (long double)morph->exponent;
    switch (morph->kind) {
    case PS_MORPH_NONE:
        break;
    case PS_MORPH_DIFFUSE:
        return polar / (1 + sqrtl(height));
    case PS_MORPH_GLOSSY:
    case PS_MORPH_GLOSSY_SPHERE: {
        const long double range = morph->kind == PS_MORPH_GLOSSY ? 1 : 2;
        const long double v = -polar * expm1l(-n * range);
        return v < 0.9L ? -log1pl(-v) / n : -logl(height + polar * expl(-n * range)) / n;
    }
    case PS_MORPH_PHONG:
        return -expm1l((polar < 0.5L ? log1pl(-polar) : logl(height)) / (n + 1));
    }
    return polar;
}

/* docs/mathematics/quadrature.md#morphing. */
static const double T_ERROR = 4e-16;

static void polar_is_exact(void **state) {
    static const double exponents[] = {1, 2, 5.5, 30, 700, 710, 1e3, 1e4, 1e5};
    static const ps_morph_kind kinds[] = {PS_MORPH_DIFFUSE, PS_MORPH_GLOSSY, PS_MORPH_GLOSSY_SPHERE,
                                          PS_MORPH_PHONG};
    uint64_t random = 7;
    double worst = 0;
    (void)state;
    for (int i = 0; i < 200000; i++) {
        const ps_morph morph = {kinds[i % 4], exponents[i / 4 % 9]};
        /* multiples of 2^-52: 1 - x is exact; every tenth near one end or the other */
        double x = floor(test_uniform(&random) * 0x1p52) * 0x1p-52;
        x = i % 10 == 0   ? floor(x * 4096) * 0x1p-52
            : i % 10 == 1 ? 1 - floor(x * 4096) * 0x1p-52
                          : x;
        const double t = ps_morph_polar(&morph, 1 - x, x);
        const long double exact = exact_polar(&morph, 1 - (long double)x, x);
        if (exact > 0) {
            worst = fmax(worst, (double)fabsl(t / exact - 1));
        } else {
            assert_true(t == 0);
        }
        assert_true(t >= 0 && t <= (morph.kind == PS_MORPH_GLOSSY_SPHERE ? 2 : 1));
    }
    print_message("relative error of t: %.3g\n", worst);
    assert_true(worst <= T_ERROR);
}

static ps_sampler_request request_of(const char *text, size_t num_points) {
    ps_sampler_request request = {.num_points = num_points, .seed = 3};
    assert_ok(ps_sampler_parse(&request, text, error));
    assert_ok(ps_sampler_resolve(&request, error));
    return request;
}

/* The share of density above height z. */
static double share_above(const ps_morph *morph, double z) {
    const double n = morph->exponent;
    switch (morph->kind) {
    case PS_MORPH_DIFFUSE:
        return 1 - z * z;
    case PS_MORPH_GLOSSY:
        return expm1(n * (z - 1)) / expm1(-n);
    case PS_MORPH_PHONG:
        return 1 - pow(z, n + 1);
    case PS_MORPH_NONE:
    case PS_MORPH_GLOSSY_SPHERE:
        break;
    }
    return 1 - z;
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Kolmogorov's largest deviation, of the shares above the points from those of equal areas. */
static double deviation(const ps_sampler_request *request) {
    const size_t num = request->num_points;
    double *points = calloc(3 * num, sizeof *points);
    double *shares = calloc(num, sizeof *shares);
    double worst = 0;
    assert_ok(ps_sampler_generate(request, 0, points, NULL, NULL, error));
    for (size_t j = 0; j < num; j++) {
        const double *u = points + 3 * j;
        assert_true(u[2] >= 0 && fabs(u[0] * u[0] + u[1] * u[1] + u[2] * u[2] - 1) <= 1e-15);
        shares[j] = share_above(&request->morph, u[2]);
    }
    qsort(shares, num, sizeof *shares, compare);
    for (size_t j = 0; j < num; j++) {
        worst = fmax(worst, fabs(shares[j] - ((double)j + 0.5) / (double)num));
    }
    free(points);
    free(shares);
    return worst;
}

static void distributions(void **state) {
    static const char *const lobes[] = {"morph=diffuse",      "morph=glossy,n=30",
                                        "morph=glossy,n=0.5", "morph=glossy,n=1000",
                                        "morph=phong,n=7",    "morph=none"};
    enum { NUM = 4096 };
    (void)state;
    for (size_t i = 0; i < sizeof lobes / sizeof lobes[0]; i++) {
        char text[96];
        snprintf(text, sizeof text, "fibonacci-hemisphere:%s", lobes[i]);
        ps_sampler_request request = request_of(text, NUM);
        assert_true(deviation(&request) <= 1e-11); /* z_j' = 1 - (2j+1)/(2N) */
        assert_true(ps_sampler_has_constant_power(&request));
        snprintf(text, sizeof text, "white-hemisphere:%s", lobes[i]);
        request = request_of(text, NUM);
        assert_true(deviation(&request) <= 2 / sqrt(NUM)); /* Kolmogorov: 7e-4 of all seeds */
        snprintf(text, sizeof text, "larcher-pillichshammer:lift=hemisphere,%s", lobes[i]);
        request = request_of(text, NUM);
        assert_true(deviation(&request) <= 1.0 / NUM);
    }
}

/* Azimuths stay, and so do the bits of sets that are not morphed. */
static void azimuths(void **state) {
    enum { NUM = 64 };
    const ps_sampler_request plain = request_of("white-hemisphere", NUM);
    const ps_sampler_request none = request_of("white:lift=hemisphere,morph=none", NUM);
    const ps_sampler_request glossy = request_of("white-hemisphere:n=12,morph=glossy", NUM);
    double a[3 * NUM];
    double b[3 * NUM];
    (void)state;
    assert_ok(ps_sampler_generate(&plain, 5, a, NULL, NULL, error));
    assert_ok(ps_sampler_generate(&none, 5, b, NULL, NULL, error));
    assert_memory_equal(a, b, sizeof a);
    assert_ok(ps_sampler_generate(&glossy, 5, b, NULL, NULL, error));
    for (size_t j = 0; j < NUM; j++) {
        const double *u = a + 3 * j;
        const double *v = b + 3 * j;
        assert_true(fabs(u[0] * v[1] - u[1] * v[0]) <= 1e-15);
        assert_true(u[0] * v[0] >= 0 && v[2] > u[2]);
    }
}

static void refuses(const char *text, const char *part) {
    ps_sampler_request request = {0};
    ps_error error = {0};
    assert_int_equal(ps_sampler_parse(&request, text, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    if (strstr(error.message, part) == NULL) {
        fail_msg("%s: \"%s\" lacks \"%s\"", text, error.message, part);
    }
}

static void refusals(void **state) {
    (void)state;
    refuses("fibonacci-hemisphere:morph=glossy", "needs n=");
    refuses("fibonacci-hemisphere:morph=diffuse,n=3", "n= is the exponent of");
    refuses("fibonacci-hemisphere:n=3", "n= is the exponent of");
    refuses("fibonacci-hemisphere:morph=mirror", "is not one of none, diffuse, glossy, phong");
    refuses("fibonacci-hemisphere:morph=glossy,n=0", "exponent n of the lobe");
    refuses("fibonacci:morph=diffuse", "makes points of the whole sphere");
    refuses("white:morph=diffuse", "add lift=hemisphere");
    refuses("white:lift=sphere,morph=diffuse", "add lift=hemisphere");
    refuses("white-hemisphere:lift=hemisphere", "without lift=");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(polar_is_exact),
                                       cmocka_unit_test(distributions), cmocka_unit_test(azimuths),
                                       cmocka_unit_test(refusals)};
    return cmocka_run_group_tests_name("morph", tests, NULL, NULL);
}
