/* Integrands of the sphere and the hemisphere: what each says of itself against quadrature of its
 * values, its closed forms against its coefficients. */
#include "harness_integrands.h"

#include "integrands/files/series.h"
#include "math/gauss_legendre.h"
#include "math/pi.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* cut: height above the axis where it jumps, or anything. */
typedef struct example {
    const char *text;
    double axis[3]; /* of any length; all 0: z */
    double cut;
    bool on_hemisphere;
} example;

static const example examples[] = {
    {"cap", {0, 0, 0}, 0.5, false},
    {"cap:angle=2.5,axis=1x2x-3", {1, 2, -3}, -0.80114361554693371483, false},
    {"cap:angle=0.01,axis=-1x0.5x0.25", {-1, 0.5, 0.25}, 0.99995000041666527778, false},
    {"cap", {0, 0, 0}, 0.5, true},
    {"cap:angle=1.5", {0, 0, 0}, 0.070737201667702910088, true},
    {"cap:angle=1.5707963267948966", {0, 0, 0}, 0.5, true},
    {"harmonic", {0, 0, 0}, 0.5, false},
    {"harmonic:degree=1,axis=1x1x0", {1, 1, 0}, 0.5, false},
    {"harmonic:degree=31,axis=0x-1x0", {0, -1, 0}, 0.5, false},
    {"harmonic:degree=2", {0, 0, 0}, 0.5, true},
    {"harmonic:degree=36", {0, 0, 0}, 0.5, true},
    {"square:axis=3x4x12", {3, 4, 12}, 0.5, false},
    {"square", {0, 0, 0}, 0.5, true},
    {"lobe:axis=-2x1x-2", {-2, 1, -2}, 0.5, false},
    {"lobe:n=0.001", {0, 0, 0}, 0.5, false},
    {"lobe:n=0.9", {0, 0, 0}, 0.5, false},
    {"lobe:n=1.1", {0, 0, 0}, 0.5, false},
    {"lobe", {0, 0, 0}, 0.5, true},
    {"lobe:n=0.3", {0, 0, 0}, 0.5, true},
    {"lobe:n=3", {0, 0, 0}, 0.5, true},
    {"constant:value=-2", {0, 0, 0}, 0.5, false},
    {"constant:value=3", {0, 0, 0}, 0.5, true},
    {"diffuse", {0, 0, 0}, 0.5, false},
    {"diffuse", {0, 0, 0}, 0.5, true},
    {"glossy:n=3", {0, 0, 0}, 0.5, false},
    {"glossy:n=3,cut=none", {0, 0, 0}, 0.5, false},
    {"glossy:n=30", {0, 0, 0}, 0.5, true},
    {"phong:n=5", {0, 0, 0}, 0.5, false},
    {"phong:n=40", {0, 0, 0}, 0.5, true},
    {"zonal:file=lobe.txt", {0, 0, 0}, 0.5, false}, /* breaks are at -0.5, 0.5 */
    {"zonal:file=above.txt", {0, 0, 0}, 0.5, true},
};
enum { NUM_EXAMPLES = sizeof examples / sizeof examples[0] };

static ps_integrand *make(const example *one) {
    return test_integrand(one->text, one->on_hemisphere ? TEST_HEMISPHERE : TEST_SPHERE);
}

/* ---- quadrature about the axis -------------------------------------------------------------- */

enum { NODES = 200, TURNS = 5, LAST = 40, MOST_POINTS = 4 * NODES * TURNS };

/* Points at heights above the axis, TURNS about it for each, and their weights. */
typedef struct heights_rule {
    size_t num; /* of heights */
    double heights[4 * NODES], weights[4 * NODES];
    double points[3 * MOST_POINTS], values[MOST_POINTS];
} heights_rule;

static void add_heights(heights_rule *rule, double from, double until) {
    double nodes[NODES];
    double weights[NODES];
    ps_gauss_legendre(NODES, nodes, weights);
    for (size_t i = 0; i < NODES && until > from; i++) {
        rule->heights[rule->num] = from + (until - from) * nodes[i];
        rule->weights[rule->num++] = PS_TWO_PI * (until - from) * weights[i];
    }
}

/* e, and two directions across it. */
static void make_frame(const double *axis, double frame[3][3]) {
    const double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    for (int i = 0; i < 3; i++) {
        frame[0][i] = length > 0 ? axis[i] / length : i == 2;
    }
    const double *const e = frame[0];
    const int least = fabs(e[0]) < 0.6 ? 0 : 1; /* a coordinate axis far from e */
    double norm2 = 0;
    for (int i = 0; i < 3; i++) {
        frame[1][i] = (i == least) - e[least] * e[i];
        norm2 += frame[1][i] * frame[1][i];
    }
    for (int i = 0; i < 3; i++) {
        frame[1][i] /= sqrt(norm2);
    }
    for (int i = 0; i < 3; i++) {
        frame[2][i] =
            e[(i + 1) % 3] * frame[1][(i + 2) % 3] - e[(i + 2) % 3] * frame[1][(i + 1) % 3];
    }
}

static void place_points(heights_rule *rule, double frame[3][3]) {
    for (size_t i = 0; i < rule->num; i++) {
        const double z = rule->heights[i];
        const double radius = sqrt((1 - z) * (1 + z));
        for (size_t turn = 0; turn < TURNS; turn++) {
            const double phi = PS_TWO_PI * ((double)turn + 0.3) / TURNS;
            for (int k = 0; k < 3; k++) {
                rule->points[3 * (i * TURNS + turn) + (size_t)k] =
                    z * frame[0][k] + radius * (cos(phi) * frame[1][k] + sin(phi) * frame[2][k]);
            }
        }
    }
}

static heights_rule *make_rule(const example *one, const ps_integrand *self) {
    const double least = one->on_hemisphere ? 0 : -1;
    const double low = fmin(one->cut, one->cut < 0 ? 0 : -0.5);
    heights_rule *made = calloc(1, sizeof *made);
    double frame[3][3];
    add_heights(made, least, fmax(low, least));
    add_heights(made, fmax(low, least), 0);
    add_heights(made, 0, fmax(one->cut, 0));
    add_heights(made, fmax(one->cut, 0), 1);
    make_frame(one->axis, frame);
    place_points(made, frame);
    ps_integrand_values(self, made->points, made->num * TURNS, made->values);
    return made;
}

static double legendre(size_t degree, double x) {
    double before = 0;
    double value = 1;
    for (size_t l = 0; l < degree; l++) {
        const double d = (double)l;
        const double next = ((2 * d + 1) * x * value - d * before) / (d + 1);
        before = value;
        value = next;
    }
    return value;
}

/* int F P_l(u.e), int F^2 */
static double integrate(const heights_rule *by, size_t degree, bool is_squared) {
    double sum = 0;
    for (size_t i = 0; i < by->num; i++) {
        for (size_t turn = 0; turn < TURNS; turn++) {
            const double value = by->values[i * TURNS + turn];
            sum += by->weights[i] / TURNS *
                   (is_squared ? value * value : value * legendre(degree, by->heights[i]));
        }
    }
    return sum;
}

/* The function that the coefficients up to LAST make, at directions off the axis. */
static void check_harmonics(const example *one, const ps_integrand *self, const heights_rule *by) {
    static const double directions[][3] = {{0.6, 0, 0.8}, {-2. / 3, 1. / 3, -2. / 3}};
    double f[(LAST + 1) * (LAST + 2)];
    double frame[3][3];
    ps_sphere_series *series = NULL;
    assert_ok(ps_integrand_harmonics(self, LAST, f, error));
    assert_ok(ps_sphere_series_make(&series, LAST, f, error));
    make_frame(one->axis, frame);
    for (size_t i = 0; i < 2; i++) {
        const double *const u = directions[i];
        const double z = u[0] * frame[0][0] + u[1] * frame[0][1] + u[2] * frame[0][2];
        double sum = 0;
        for (size_t l = 0; l <= LAST; l++) {
            sum += (2 * (double)l + 1) / PS_FOUR_PI * integrate(by, l, false) * legendre(l, z);
        }
        test_near(one->text, "the harmonics", ps_sphere_series_value(series, u), sum,
                  1e-12 * sqrt(integrate(by, 0, true)) + 1e-15);
    }
    ps_sphere_series_destroy(series);
}

static void check_quadrature(const example *one) {
    ps_integrand *self = make(one);
    heights_rule *by = make_rule(one, self);
    double f[LAST + 1];
    const double whole = integrate(by, 0, false);
    const double squares = integrate(by, 0, true);
    const double area = one->on_hemisphere ? PS_PI : PS_FOUR_PI;
    const double energy = (one->on_hemisphere ? 2 : 1) * squares - whole * whole / area;
    const double rounding = 4e-14 * squares + 2e-15; /* the cut is rounded */
    test_near(one->text, "the integral", ps_integrand_integral(self), whole,
              4e-14 * sqrt(PS_FOUR_PI * squares));
    test_near(one->text, "the energy", ps_integrand_energy(self), energy, rounding);
    assert_ok(ps_integrand_degrees(self, LAST, f, error));
    for (size_t l = 0; l <= LAST; l++) {
        const double factor = !one->on_hemisphere ? 1 : l % 2 == 0 ? 2 : 0;
        const double projection =
            factor * integrate(by, l, false) * sqrt((2 * (double)l + 1) / PS_FOUR_PI);
        test_near(one->text, "a degree", f[l], projection * projection, rounding);
    }
    if (!one->on_hemisphere) {
        check_harmonics(one, self, by);
    }
    if (ps_integrand_has_pairs(self)) {
        const double pole[3] = {1, 0, 0};
        test_near(one->text, "the mean square", self->kind->correlation(self, pole),
                  (one->on_hemisphere ? 2 : 1) * squares, rounding);
    }
    free(by);
    ps_integrand_destroy(self);
}

static void quadrature(void **state) {
    (void)state;
    for (size_t i = 0; i < NUM_EXAMPLES; i++) {
        check_quadrature(&examples[i]);
    }
}

/* ---- sums over degrees ---------------------------------------------------------------------- */

/* Is its energy known to its own last digits, also where it is nearly constant? */
static bool is_closed(const example *one) {
    return strncmp(one->text, "lobe", 4) == 0;
}

/* What the sum to 8192 leaves: jumps L^-1, kinks L^-3. */
static double missing(const example *one) {
    const bool jumps =
        strcmp(one->text, "glossy:n=3") == 0 || strcmp(one->text, "zonal:file=lobe.txt") == 0;
    return jumps ? 1e-4 : 1e-9;
}

/* Squares of F_l fall like l^-2 at a jump, and the rest beyond L is some L^-1. */
static void parseval(void **state) {
    enum { MOST = 8192 };
    double *f = calloc(MOST + 1, sizeof *f);
    (void)state;
    for (size_t i = 0; i < NUM_EXAMPLES; i++) {
        ps_integrand *self = make(&examples[i]);
        const double energy = ps_integrand_energy(self);
        double sum = 0;
        assert_ok(ps_integrand_degrees(self, MOST, f, error));
        for (size_t l = MOST; l >= 1; l--) {
            assert_true(isfinite(f[l]) && f[l] >= 0);
            assert_true(!examples[i].on_hemisphere || l % 2 == 0 || f[l] == 0);
            sum += f[l];
        }
        const bool jumps = strncmp(examples[i].text, "cap", 3) == 0;
        const double t = acos(examples[i].cut);
        const double rest = !jumps                      ? 0
                            : examples[i].on_hemisphere ? 4 * sin(t) / (MOST + 1)
                                                        : 2 * sin(t) / (MOST + 0.5);
        print_message("%-32s energy %.6g, sum - energy %.3g, rest %.3g\n", examples[i].text, energy,
                      sum - energy, rest);
        if (jumps && energy > 1e-15) {
            test_near(examples[i].text, "the rest", energy - sum, rest, 0.02 * rest);
        }
        const double rounding = is_closed(&examples[i]) ? 1e-13 * energy : 1e-14 * (f[0] + energy);
        assert_true(jumps || sum <= energy + rounding);
        assert_true(jumps || sum >= energy - missing(&examples[i]) * energy - rounding);
        ps_integrand_destroy(self);
    }
    free(f);
}

/* C(cos g) = sum_l sum_m |F_lm|^2 P_l(cos g), with |P_l| <= sqrt(2/(pi (l + 1/2) sin g)). */
static void check_series(const example *one, double *f, size_t most) {
    static const double cosines[] = {0.999, 0.8, 0.3, 0, -0.2, -0.6, -0.97};
    ps_integrand *self = make(one);
    assert_ok(ps_integrand_degrees(self, most, f, error));
    double rest = ps_integrand_energy(self);
    for (size_t l = 1; l <= most; l++) {
        rest -= f[l];
    }
    for (size_t i = 0; ps_integrand_has_pairs(self) && i < sizeof cosines / sizeof *cosines; i++) {
        const double x = cosines[i];
        const double sine = sqrt((1 - x) * (1 + x));
        double before = 0;
        double value = 1;
        double sum = 0;
        for (size_t l = 0; l <= most; l++) {
            const double d = (double)l;
            const double next = ((2 * d + 1) * x * value - d * before) / (d + 1);
            sum += f[l] * value;
            before = value;
            value = next;
        }
        test_near(one->text, "the correlation", self->kind->correlation(self, &x), sum,
                  fmax(rest, 0) * sqrt(2 / (PS_PI * (double)most * sine)) +
                      1e-12 * (f[0] + ps_integrand_energy(self)));
    }
    ps_integrand_destroy(self);
}

static void series(void **state) {
    enum { MOST = 4096 };
    double *f = calloc(MOST + 1, sizeof *f);
    (void)state;
    for (size_t i = 0; i < NUM_EXAMPLES; i++) {
        check_series(&examples[i], f, MOST);
    }
    free(f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(quadrature, test_enter_lobes, test_leave_lobes),
        cmocka_unit_test_setup_teardown(parseval, test_enter_lobes, test_leave_lobes),
        cmocka_unit_test_setup_teardown(series, test_enter_lobes, test_leave_lobes)};
    return cmocka_run_group_tests_name("sphere integrands", tests, NULL, NULL);
}
