/* sphere_direct in both precisions, and the referee, against the exact values of tests/reference.
 * Tolerances are those of the reference (measured there, times four). */
#include "harness_sphere.h"

#include "engines/host/host_direct.h"
#include "engines/engine.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;

typedef struct judge {
    const ps_engine *engine;
    ps_precision precision;
} judge;

/* Errors over sum |w| of c_lm to degree 64, over (sum |w|)^2 of Q(l). */
static double coefficient_limit(const judge *by) {
    return by->precision == PS_SINGLE ? 2.5e-5 : 1e-13;
}

static double power_limit(const judge *by, double l) {
    return by->precision == PS_SINGLE ? 2e-6 * (1 + l / 50) : 1e-15 * (20 + l / 2);
}

static void check_coefficients(const judge *by, const test_set *set) {
    const cJSON *rows = cJSON_GetObjectItem(set->json, "clm");
    const cJSON *row = NULL;
    const pspec_pattern pattern = test_pattern(set);
    const int32_t last = 64;
    ps_frequencies degrees = test_degrees(last, false);
    double *c = test_coefficients(by->engine, by->precision, device, &degrees, &pattern);
    double worst = 0;
    cJSON_ArrayForEach(row, rows) {
        const int32_t l = (int32_t)test_number(cJSON_GetArrayItem(row, 0));
        const int32_t m = (int32_t)test_number(cJSON_GetArrayItem(row, 1));
        const double *one = c + 2 * test_coefficient(last, l, m);
        const double off = hypot(one[0] - test_number(cJSON_GetArrayItem(row, 2)),
                                 one[1] - test_number(cJSON_GetArrayItem(row, 3)));
        worst = fmax(worst, off / set->weight_size_sum);
    }
    print_message("%-13s %-8s %-20s c_lm %8.2g of %8.2g\n", by->engine->name,
                  ps_precision_name(by->precision), set->name, worst, coefficient_limit(by));
    assert_true(worst <= coefficient_limit(by));
    free(c);
    ps_frequencies_free(&degrees);
}

/* rows: [l, value, ..], value Q times factor. */
static void check_powers(const judge *by, const test_set *set, const cJSON *rows, double factor,
                         int32_t last, bool only_even) {
    const cJSON *row = NULL;
    const pspec_pattern pattern = test_pattern(set);
    const double sizes = set->weight_size_sum * set->weight_size_sum;
    ps_frequencies degrees = test_degrees(last, only_even);
    double *q = test_run_engine(by->engine, by->precision, device, &degrees, &pattern, 1, 1);
    double worst = 0;
    cJSON_ArrayForEach(row, rows) {
        const int32_t l = (int32_t)test_number(cJSON_GetArrayItem(row, 0));
        if (l == 0 || l > last) {
            continue;
        }
        const size_t i = only_even ? (size_t)l / 2 - 1 : (size_t)l - 1;
        assert_int_equal(degrees.vectors[i], l);
        const double off = fabs(q[i] - test_number(cJSON_GetArrayItem(row, 1)) / factor) / sizes;
        worst = fmax(worst, off / power_limit(by, l));
    }
    print_message("%-13s %-8s %-20s Q    %8.2g of the limit\n", by->engine->name,
                  ps_precision_name(by->precision), set->name, worst);
    assert_true(worst <= 1);
    free(q);
    ps_frequencies_free(&degrees);
}

/* The referee goes from order to order and takes as long for all degrees as for the last: it stops
 * earlier. */
static int32_t last_degree(const judge *by, int32_t last) {
    const int32_t patience = 512;
    return by->engine == &ps_host_direct && last > patience ? patience : last;
}

static void check_sphere(const judge *by) {
    cJSON *json = test_read_reference("sphere.json");
    const cJSON *one = NULL;
    cJSON_ArrayForEach(one, cJSON_GetObjectItem(json, "sets")) {
        test_set set = test_read_sphere_set(one);
        check_coefficients(by, &set);
        check_powers(by, &set, cJSON_GetObjectItem(one, "pl"), 1, last_degree(by, 2000), false);
        test_free_set(&set);
    }
    cJSON_Delete(json);
}

static void check_hemisphere(const judge *by) {
    cJSON *json = test_read_reference("hemisphere_m18.json");
    const cJSON *one = NULL;
    cJSON_ArrayForEach(one, cJSON_GetObjectItem(json, "sets")) {
        test_set set = test_read_sphere_set(one);
        const cJSON *rows = cJSON_GetObjectItem(one, "projective_P_even_l");
        const double num = (double)set.num_points;
        const double sum = set.weights != NULL ? set.weight_sum : num; /* "equal" is any weight */
        const double factor = num / (sum * sum);
        check_powers(by, &set, rows, factor, last_degree(by, 32), true);
        test_free_set(&set);
    }
    cJSON_Delete(json);
}

static void check(const ps_engine *engine, ps_precision precision) {
    const judge by = {engine, precision};
    if (precision == PS_DOUBLE && !ps_device_get_limits(device)->has_fp64) {
        skip();
    }
    check_sphere(&by);
    check_hemisphere(&by);
}

static void single(void **state) {
    (void)state;
    check(&ps_sphere_direct, PS_SINGLE);
}

static void double_precision(void **state) {
    (void)state;
    check(&ps_sphere_direct, PS_DOUBLE);
}

static void referee(void **state) {
    (void)state;
    check(&ps_host_direct, PS_EXTENDED);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(single), cmocka_unit_test(double_precision),
                                       cmocka_unit_test(referee)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("sphere_reference", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
