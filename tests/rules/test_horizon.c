/* The part of a lobe below the horizon of a normal aside of its axis: closed forms of its share and
 * moments, no matter how narrow the lobe, and shading integrals with it against sums over all
 * pixels of a grid. */
#include "harness.h"

#include "jobs/shade/light.h"
#include "math/pi.h"
#include "math/random/random.h"
#include "math/random/rotation.h"
#include "rules/horizon.h"

#include <complex.h>
#include <math.h>
#include <string.h>

enum { DEGREE = 90 };

static double radians(double degrees) {
    return degrees * PS_PI / 180;
}

static ps_brdf *lobe_of(const char *text) {
    ps_brdf *out = NULL;
    assert_ok(ps_brdf_parse(&out, text, error));
    return out;
}

/* int_0^pi sin^a cos^c, c even. */
static double beta(double a, double c) {
    return exp(lgamma((a + 1) / 2) + lgamma((c + 1) / 2) - lgamma((a + c) / 2 + 1));
}

/* Of (cos t) e^{imt} from -pi/2 to `end`. */
static double complex of_turns(int m, double end) {
    const double from = -PS_PI / 2;
    double complex sum = 0;
    for (int side = -1; side <= 1; side += 2) { /* cos t = (e^{it} + e^{-it})/2 */
        const double complex rate = I * (double)(m + side);
        sum +=
            m + side == 0 ? (end - from) / 2 : (cexp(rate * end) - cexp(rate * from)) / (2 * rate);
    }
    return sum;
}

/* The diffuse lobe z/pi: (cos b)^{2k} and (sin b)^m e^{imt} are polynomials of the directions. */
static void moments(void **state) {
    static const double views[] = {1, 30, 60, 89.5, 90};
    ps_brdf *const brdf = lobe_of("diffuse");
    (void)state;
    for (size_t i = 0; i < sizeof views / sizeof views[0]; i++) {
        const double end = radians(views[i]) - PS_PI / 2;
        ps_horizon horizon;
        assert_ok(ps_horizon_make(&horizon, brdf, views[i], DEGREE, error));
        assert_true(fabs(horizon.share - (1 - cos(radians(views[i]))) / 2) < 1e-14);
        for (int m = 0; m <= DEGREE; m += 9) {
            double complex turns = 0;
            double heights = 0;
            for (size_t j = 0; j < horizon.num; j++) {
                const double *const u = horizon.points + 3 * j;
                heights += horizon.weights[j] * pow(u[1], m);
                turns += horizon.weights[j] * cpow(u[2] + I * u[0], (double)m);
                assert_true(u[2] >= 0 && !ps_horizon_is_above(&horizon, u));
            }
            const double complex expected = beta(m + 2, 0) / PS_PI * of_turns(m, end);
            const double height = beta(2, m) * creal(of_turns(0, end)) / PS_PI;
            assert_true(cabs(turns - expected) < 1e-14);
            assert_true(fabs(heights - (m % 2 == 0 ? height : 0)) < 1e-14);
        }
        ps_horizon_free(&horizon);
    }
    ps_brdf_destroy(brdf);
}

/* Half of any lobe at 90 degrees: powers that are not whole end with a kink, and the cosine of a
 * narrow lobe has few digits left. And z^2 at other angles. */
static void shares(void **state) {
    static const struct {
        const char *lobe;
        double error;
    } halved[] = {{"phong:n=0.5", 3e-7},   {"phong:n=1e3", 1e-13},
                  {"phong:n=1e6", 1e-10},  {"glossy:n=0.01", 1e-14},
                  {"glossy:n=1e6", 1e-10}, {"glossy:n=3,cut=none", 1e-14}};
    static const double views[] = {5, 45, 80};
    ps_horizon horizon;
    (void)state;
    for (size_t i = 0; i < sizeof halved / sizeof halved[0]; i++) {
        ps_brdf *const brdf = lobe_of(halved[i].lobe);
        assert_ok(ps_horizon_make(&horizon, brdf, PS_MOST_VIEW, DEGREE, error));
        assert_true(fabs(horizon.share - 0.5) < halved[i].error);
        assert_true(horizon.num < 60000);
        ps_horizon_free(&horizon);
        ps_brdf_destroy(brdf);
    }
    ps_brdf *const square = lobe_of("phong:n=2");
    for (size_t i = 0; i < sizeof views / sizeof views[0]; i++) {
        const double angle = radians(views[i]);
        assert_ok(ps_horizon_make(&horizon, square, views[i], DEGREE, error));
        assert_true(fabs(horizon.share - (angle / PS_PI - sin(2 * angle) / PS_TWO_PI)) < 1e-14);
        ps_horizon_free(&horizon);
    }
    ps_brdf_destroy(square);
    ps_brdf *const narrow = lobe_of("glossy:n=1000"); /* e^{-1000 (1 - sin 45)} is nothing */
    assert_ok(ps_horizon_make(&horizon, narrow, 45, DEGREE, error));
    assert_true(horizon.num == 0 && horizon.share == 0);
    ps_horizon_free(&horizon);
    ps_brdf_destroy(narrow);
}

/* ---- sums over all pixels ------------------------------------------------------------------ */

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Of light times lobe above the horizon, of a normal turned by R. */
static double sum_pixels(const ps_light *light, const ps_brdf *brdf, const ps_horizon *horizon,
                         const ps_rotation *turn) {
    enum { HEIGHT = 512, WIDTH = 2 * HEIGHT };
    double sum = 0;
    for (size_t i = 0; i < (size_t)HEIGHT * WIDTH; i++) {
        const double top = PS_PI * (double)(i / WIDTH) / HEIGHT;
        const double middle = top + PS_PI / (2 * HEIGHT);
        const double round = PS_TWO_PI * ((double)(i % WIDTH) + 0.5) / WIDTH;
        const double u[3] = {sin(middle) * cos(round), sin(middle) * sin(round), cos(middle)};
        double own[3]; /* R^-1 u */
        double value = 0;
        for (int k = 0; k < 3; k++) {
            const double column[3] = {turn->matrix[0][k], turn->matrix[1][k], turn->matrix[2][k]};
            own[k] = dot(column, u);
        }
        if (own[2] > -1 && ps_horizon_is_above(horizon, own)) {
            const double area = PS_TWO_PI / WIDTH * (cos(top) - cos(top + PS_PI / HEIGHT));
            ps_integrand_values(light->integrand, u, 1, &value);
            sum += area * value * ps_brdf_density(brdf, own[2]);
        }
    }
    return sum;
}

/* That of the whole lobe, which is exact, less what is below. */
static double integrate(const ps_light *light, const ps_horizon *horizon, const ps_rotation *turn) {
    const double r[3] = {turn->matrix[0][2], turn->matrix[1][2], turn->matrix[2][2]};
    double below = 0;
    for (size_t j = 0; j < horizon->num; j++) {
        double u[3];
        double value = 0;
        memcpy(u, horizon->points + 3 * j, sizeof u);
        ps_rotate(turn, u, 1);
        ps_integrand_values(light->integrand, u, 1, &value);
        below += horizon->weights[j] * value;
    }
    return ps_light_shading(light, r) - below;
}

static void pixels(void **state) {
    static const char *const lobes[] = {"phong:n=10", "diffuse", "glossy:n=4,cut=none"};
    static const double views[] = {70, 35, 80};
    static const char *const lights[] = {"map:width=64", "lobe:n=9,axis=1x2x3"};
    ps_random random = ps_random_init(3, PS_STREAM_TRIALS, 0);
    (void)state;
    for (size_t i = 0; i < 6; i++) {
        ps_brdf *const brdf = lobe_of(lobes[i / 2]);
        ps_light light;
        ps_horizon horizon;
        assert_ok(ps_light_make(&light, lights[i % 2], NULL, brdf, error));
        assert_ok(ps_horizon_make(&horizon, brdf, views[i / 2], light.max_degree, error));
        const ps_rotation turn = ps_rotation_random(&random);
        const double exact = integrate(&light, &horizon, &turn);
        const double sum = sum_pixels(&light, brdf, &horizon, &turn);
        assert_true(fabs(sum - exact) < 4e-5 && fabs(exact) > 5e-6 && horizon.share > 0.09);
        ps_horizon_free(&horizon);
        ps_light_free(&light);
        ps_brdf_destroy(brdf);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moments),
        cmocka_unit_test(shares),
        cmocka_unit_test(pixels),
    };
    return cmocka_run_group_tests_name("horizon", tests, NULL, NULL);
}
