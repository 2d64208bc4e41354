/* sphere_nufft at high degree: of one point all Q(l) are 1, by the addition theorem, wherever it
 * is. At the pole, at the equator and between them Lambda_lm comes from recurrences of different
 * form (docs/engines/sphere_nufft.md).
 */
#include "harness_sphere.h"

#include "engines/engine.h"

#include <math.h>
#include <stdlib.h>

enum { DEGREE = 1500 };

static ps_device *device;

/* By the angle from the pole, each its own realization. */
static const double angles[] = {0,    1e-8,  1e-3,   0.008,  0.03,
                                0.3,  0.785, 0.79,   1.1,    1.5,
                                1.55, 1.56,  1.5685, 1.5706, 1.5707963267948966};
enum { NUM_ANGLES = sizeof angles / sizeof angles[0] };

/* sqrt of the sum over l of (2l + 1) (d sqrt Q(l))^2, over that of white noise: no more than the
 * tolerance. */
static double error_of_row(const ps_frequencies *degrees, const double *row) {
    double sum = 0;
    double num = 0;
    for (size_t i = 0; i < degrees->num; i++) {
        const double weight = 2.0 * degrees->vectors[i] + 1;
        const double difference = sqrt(row[i]) - 1;
        sum += weight * difference * difference;
        num += weight;
    }
    return sqrt(sum / num);
}

/* expected: a set alone has a kernel of its own. */
static void check(ps_precision precision, double tolerance, uint64_t expected) {
    if (!ps_device_get_limits(device)->has_fp64) {
        return; /* needed in single precision, too */
    }
    ps_frequencies degrees = test_degrees(DEGREE, false);
    const ps_problem problem = {.frequencies = &degrees,
                                .num_points = 1,
                                .num_realizations = expected,
                                .has_weights = false,
                                .tolerance = tolerance};
    double points[NUM_ANGLES][3];
    pspec_pattern patterns[NUM_ANGLES];
    for (size_t r = 0; r < NUM_ANGLES; r++) {
        test_sphere_point(points[r], angles[r], 0.1 + (double)r, r % 2 == 0 ? 1 : -1);
        patterns[r] = (pspec_pattern){.dimension = 3, .num_points = 1, .points = points[r]};
    }
    double *rows = test_run_problem(&ps_sphere_nufft, &problem, precision, device, patterns,
                                    NUM_ANGLES, NUM_ANGLES);
    for (size_t r = 0; r < NUM_ANGLES; r++) {
        const double error = error_of_row(&degrees, rows + r * degrees.num);
        if (!(error <= tolerance)) {
            fail_msg("angle %g from the pole: %g, allowed %g", angles[r], error, tolerance);
        }
    }
    free(rows);
    ps_frequencies_free(&degrees);
}

static void single(void **state) {
    (void)state;
    check(PS_SINGLE, 1e-5, NUM_ANGLES);
    check(PS_SINGLE, 1e-5, 1);
    check(PS_SINGLE, 3e-5, 1); /* Lambda_lm is in single precision, too */
}

static void double_precision(void **state) {
    (void)state;
    check(PS_DOUBLE, 1e-12, NUM_ANGLES);
    check(PS_DOUBLE, 1e-12, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(single),
                                       cmocka_unit_test(double_precision)};
    device = test_open_device();
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    ps_device_close(device);
    return failed;
}
