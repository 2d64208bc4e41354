/* Sums of powers of chords on the device against long double. */
#include "harness_pairs.h"

#include "rules/kernel/kernel_chords.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;
static uint64_t seed = 1;

static void chord_sums(void **state) {
    (void)state;
    enum { NUM = 77, SETS = 2 };
    static const double powers[] = {0.5, 0.1, 0.9};
    double *points = test_sphere_white_set(NUM * SETS, &seed);
    double weights[NUM];
    for (size_t j = 0; j < NUM; j++) {
        weights[j] = test_uniform(&seed) - 0.3;
    }
    memcpy(points + 6, points, 3 * sizeof(double)); /* a duplicate: its chord is 0 */
    const pspec_pattern patterns[SETS] = {{3, NUM, points, weights},
                                          {3, NUM - 10, points + 3 * NUM, NULL}};
    const ps_batch batch = {.num_patterns = SETS, .patterns = patterns};
    for (int precision = PS_SINGLE; precision <= PS_DOUBLE; precision++) {
        const double limit = precision == PS_SINGLE ? 3e-7 : 2e-15;
        if (precision == PS_DOUBLE && !ps_device_get_limits(device)->has_fp64) {
            continue;
        }
        for (size_t p = 0; p < sizeof powers / sizeof powers[0]; p++) {
            double sums[SETS];
            assert_ok(ps_kernel_chord_sums(device, (ps_precision)precision, powers[p], &batch, sums,
                                           error));
            for (size_t r = 0; r < SETS; r++) {
                const pspec_pattern *set = &patterns[r];
                const double sizes = test_weight_sizes(set);
                long double sum = 0;
                for (size_t i = 0; i < set->num_points; i++) {
                    for (size_t j = 0; j < i; j++) {
                        const double *u = set->points + 3 * i, *v = set->points + 3 * j;
                        const long double x = (long double)u[0] - v[0];
                        const long double y = (long double)u[1] - v[1];
                        const long double z = (long double)u[2] - v[2];
                        const long double both =
                            set->weights != NULL ? (long double)set->weights[i] * set->weights[j]
                                                 : 1;
                        sum += 2 * both * powl(x * x + y * y + z * z, (long double)powers[p]);
                    }
                }
                assert_true(fabs(sums[r] - (double)sum) <= limit * sizes * sizes);
            }
        }
    }
    free(points);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(chord_sums)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernel_chords", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
