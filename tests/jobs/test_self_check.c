/* The self-check given powers that are wrong by a known amount: eight entries are looked at, and
 * one may be off by eight times the engine's error, no more.
 */
#include "harness.h"

#include "engines/host/host_direct.h"
#include "jobs/self_check.h"

#include <math.h>
#include <stdlib.h>

enum { POINTS = 16, ALLOWED = 8, ENTRIES = 8 };

/* Just inside and just outside of what is allowed. */
static const double inside = 1 - 1e-6, outside = 1 + 1e-6;

/* One set with the referee's powers, which lie in the slots backwards. */
typedef struct checked {
    ps_frequencies frequencies;
    double points[3 * POINTS];
    pspec_pattern pattern;
    double *powers, *expected;
    uint32_t *slots;
    ps_rows rows;
    ps_self_check_input input;
} checked;

static void make_powers(checked *out) {
    const size_t num = out->frequencies.num;
    out->expected = calloc(num, sizeof(double));
    out->powers = calloc(num, sizeof(double));
    out->slots = calloc(num, sizeof(uint32_t));
    for (size_t i = 0; i < num; i++) {
        long double power = 0;
        assert_ok(ps_host_power(&out->pattern, &out->frequencies, i, 0, &power, error));
        out->expected[i] = (double)power;
        out->slots[i] = (uint32_t)(num - 1 - i);
        out->powers[out->slots[i]] = (double)power;
    }
    out->rows =
        (ps_rows){.num_rows = 1, .stride = num, .precision = PS_DOUBLE, .host = out->powers};
    out->input = (ps_self_check_input){.rows = &out->rows,
                                       .slots = out->slots,
                                       .frequencies = &out->frequencies,
                                       .pattern = &out->pattern,
                                       .scale = 1,
                                       .weight_square_sum = POINTS,
                                       .engine_error = 1e-3};
}

static void make_on_torus(checked *out, int32_t max_frequency) {
    uint64_t random = 17;
    assert_ok(ps_frequencies_lattice(&out->frequencies, 2, max_frequency, false, error));
    assert_ok(ps_frequencies_enumerate(&out->frequencies, error));
    for (size_t i = 0; i < 2 * (size_t)POINTS; i++) {
        out->points[i] = test_uniform(&random);
    }
    out->pattern = (pspec_pattern){2, POINTS, out->points, NULL};
    make_powers(out);
}

static void make_on_sphere(checked *out, int64_t max_degree) {
    uint64_t random = 18;
    assert_ok(ps_frequencies_degrees(&out->frequencies, max_degree, false, error));
    assert_ok(ps_frequencies_enumerate(&out->frequencies, error));
    for (size_t i = 0; i < POINTS; i++) {
        const double z = 2 * test_uniform(&random) - 1;
        const double azimuth = 8 * atan(1) * test_uniform(&random);
        out->points[3 * i] = sqrt(1 - z * z) * cos(azimuth);
        out->points[3 * i + 1] = sqrt(1 - z * z) * sin(azimuth);
        out->points[3 * i + 2] = z;
    }
    out->pattern = (pspec_pattern){3, POINTS, out->points, NULL};
    make_powers(out);
}

static void free_checked(checked *what) {
    ps_frequencies_free(&what->frequencies);
    free(what->expected);
    free(what->powers);
    free(what->slots);
}

static pspec_status judge(const checked *what, double *deviation) {
    ps_error ignored = {0};
    return ps_self_check(&what->input, NULL, deviation, &ignored);
}

/* Each power alone is made wrong: it is noticed where it is one of those that are looked at. */
static void eight_entries_are_looked_at(void **state) {
    (void)state;
    checked what;
    double deviation = -1;
    size_t num_noticed = 0;
    bool is_of_degrees = true;
    make_on_torus(&what, 40);
    assert_int_equal(judge(&what, &deviation), PSPEC_OK);
    assert_true(deviation < 1e-14);
    for (size_t i = 0; i < what.frequencies.num; i++) {
        what.powers[i] += POINTS;
        const pspec_status status = judge(&what, &deviation);
        assert_true(status == PSPEC_OK || status == PSPEC_ERROR_CHECK);
        num_noticed += status == PSPEC_ERROR_CHECK;
        what.powers[i] -= POINTS;
    }
    assert_int_equal(num_noticed, ENTRIES);
    assert_true(ps_self_check_count(&what.frequencies, POINTS, &is_of_degrees) == ENTRIES * POINTS);
    assert_false(is_of_degrees);
    free_checked(&what);
}

/* Amplitudes on the torus may be off by 8 e (1 + |S| / sqrt(V)) sqrt(V). */
static void amplitudes(void **state) {
    (void)state;
    checked what;
    double deviation = 0;
    make_on_torus(&what, 3);
    for (int sign = -1; sign <= 1; sign += 2) {
        for (int is_outside = 0; is_outside < 2; is_outside++) {
            for (size_t i = 0; i < what.frequencies.num; i++) {
                const double size = sqrt(what.expected[i] / POINTS);
                const double allowed = ALLOWED * what.input.engine_error * (1 + size);
                const double off = sign * allowed * (is_outside ? outside : inside);
                what.powers[what.slots[i]] = POINTS * pow(fmax(size + off, 0), 2);
            }
            assert_int_equal(judge(&what, &deviation), is_outside ? PSPEC_ERROR_CHECK : PSPEC_OK);
            assert_true(is_outside || deviation > ALLOWED * what.input.engine_error * inside);
        }
    }
    free_checked(&what);
}

/* Those of a degree by 8 r / sqrt(2 l + 1) more, r the rounding of a sum of all weights. */
static void roundings_of_sums(void **state) {
    (void)state;
    checked what;
    double deviation = 0;
    make_on_sphere(&what, 9);
    what.input.sum_rounding = 3e-3;
    for (int is_outside = 0; is_outside < 2; is_outside++) {
        for (size_t i = 0; i < what.frequencies.num; i++) {
            const double size = sqrt(what.expected[i] / POINTS);
            const double allowed =
                ALLOWED * (what.input.engine_error * (1 + size) +
                           what.input.sum_rounding / sqrt(2 * ((double)i + 1) + 1));
            what.powers[what.slots[i]] =
                POINTS * pow(size + allowed * (is_outside ? outside : inside), 2);
        }
        assert_int_equal(judge(&what, &deviation), is_outside ? PSPEC_ERROR_CHECK : PSPEC_OK);
    }
    free_checked(&what);
}

/* Sums over pairs by 8 e (sum |w|)^2. */
static void pair_sums(void **state) {
    (void)state;
    checked what;
    double deviation = 0;
    make_on_sphere(&what, 9);
    what.input.size_square = POINTS * POINTS;
    for (int is_outside = 0; is_outside < 2; is_outside++) {
        const double off = ALLOWED * what.input.engine_error * (is_outside ? outside : inside);
        for (size_t i = 0; i < what.frequencies.num; i++) {
            what.powers[what.slots[i]] = what.expected[i] + off * what.input.size_square;
        }
        assert_int_equal(judge(&what, &deviation), is_outside ? PSPEC_ERROR_CHECK : PSPEC_OK);
        assert_true(is_outside || fabs(deviation / off - 1) < 1e-9);
    }
    free_checked(&what);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eight_entries_are_looked_at),
        cmocka_unit_test(amplitudes),
        cmocka_unit_test(roundings_of_sums),
        cmocka_unit_test(pair_sums),
    };
    return cmocka_run_group_tests_name("self_check", tests, NULL, NULL);
}
