/* Pair sums by every route against the exact values of tests/reference: Q(l), and C_l^2 from them.
 * Tolerances are those of the reference (measured there, times four).
 */
#include "harness_pairs.h"

#include "engines/engine.h"
#include "engines/pairs/pairs_zonal.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;

typedef struct judge {
    const ps_engine *engine;
    ps_precision precision;
    double asked; /* tolerance that the engine is given */
} judge;

/* Of Q(l) over (sum |w|)^2. */
static double limit(const judge *by, double l) {
    if (by->engine == &ps_pairs_histogram) {
        return by->asked;
    }
    if (by->engine->sums_pairs) {
        return by->precision == PS_SINGLE ? 7e-6 : 1.5e-14;
    }
    const double direct = by->precision == PS_SINGLE ? 2e-6 * (1 + l / 50) : 1e-15 * (20 + l / 2);
    return by->engine == &ps_sphere_nufft ? fmax(by->asked, direct) : direct;
}

/* All sets of a file; their sums Q(l), l = 1 .. LAST, come from one run. */
enum { MOST_SETS = 8, LAST = 2000 };

typedef struct reference {
    size_t num;
    test_set sets[MOST_SETS];
    const cJSON *json[MOST_SETS];
    cJSON *file;
    double *q; /* [set][LAST] */
} reference;

/* "equal" is 1/N there. */
static void give_weights(test_set *set) {
    if (set->weights == NULL) {
        set->weights = calloc(set->num_points, sizeof(double));
        for (size_t j = 0; j < set->num_points; j++) {
            set->weights[j] = 1 / (double)set->num_points;
        }
        set->weight_size_sum = 1;
    }
}

static reference run_reference(const judge *by, const char *name, void (*prepare)(test_set *set)) {
    reference exact = {.file = test_read_reference(name)};
    pspec_pattern patterns[MOST_SETS];
    const cJSON *one = NULL;
    cJSON_ArrayForEach(one, cJSON_GetObjectItem(exact.file, "sets")) {
        assert_true(exact.num < MOST_SETS);
        exact.json[exact.num] = one;
        exact.sets[exact.num] = test_read_sphere_set(one);
        if (prepare != NULL) {
            prepare(&exact.sets[exact.num]);
        }
        patterns[exact.num] = test_pattern(&exact.sets[exact.num]);
        exact.num++;
    }
    exact.q = test_run_pairs(by->engine, by->precision, by->asked, device, LAST, patterns,
                             exact.num, exact.num);
    return exact;
}

static void free_reference(reference *exact) {
    for (size_t r = 0; r < exact->num; r++) {
        test_free_set(&exact->sets[r]);
    }
    cJSON_Delete(exact->file);
    free(exact->q);
}

/* rows: [l, Q, ..]. */
static void check_sums(const judge *by, const test_set *set, const cJSON *rows, const double *q) {
    const cJSON *row = NULL;
    const double sizes = set->weight_size_sum * set->weight_size_sum;
    double worst = 0;
    size_t checked = 0;
    cJSON_ArrayForEach(row, rows) {
        const int32_t l = (int32_t)test_number(cJSON_GetArrayItem(row, 0));
        if (l == 0 || l > LAST) {
            continue;
        }
        const double off = fabs(q[l - 1] - test_number(cJSON_GetArrayItem(row, 1))) / sizes;
        worst = fmax(worst, off / limit(by, l));
        checked++;
    }
    print_message("%-15s %-8s %-24s Q %3zu of them, %8.2g of the limit\n", by->engine->name,
                  ps_precision_name(by->precision), set->name, checked, worst);
    assert_true(checked > 0 && worst <= 1);
}

/* rows: [l, c_l0, C_l^2, ..]. */
static void check_c2(const judge *by, const test_set *set, const cJSON *rows, const double *q) {
    enum { LAST_ROW = 32 };
    const double double_limit = 2e-15;
    const cJSON *row = NULL;
    const pspec_pattern pattern = test_pattern(set);
    const double size = set->weight_size_sum;
    double *scratch = calloc(ps_zonal_scratch(LAST_ROW), sizeof(double));
    double zonal[LAST_ROW + 1] = {0};
    double worst = 0;
    ps_zonal_sums(&pattern, 0, LAST_ROW, scratch, zonal);
    cJSON_ArrayForEach(row, rows) {
        const int32_t l = (int32_t)test_number(cJSON_GetArrayItem(row, 0));
        if (l == 0) {
            continue;
        }
        assert_true(l <= LAST_ROW);
        const double unit = (2 * l + 1) / PS_FOUR_PI;
        const double c_l0 = sqrt(unit) * zonal[l];
        const double c2 = unit * (q[l - 1] - zonal[l] * zonal[l]);
        assert_true(fabs(c_l0 - test_number(cJSON_GetArrayItem(row, 1))) <=
                    double_limit * sqrt(unit) * size);
        const double off = fabs(c2 - test_number(cJSON_GetArrayItem(row, 2))) / unit;
        worst = fmax(worst, off / (size * size) / (limit(by, l) + double_limit));
    }
    print_message("%-15s %-8s %-24s C2, %8.2g of the limit\n", by->engine->name,
                  ps_precision_name(by->precision), set->name, worst);
    assert_true(worst <= 1);
    free(scratch);
}

static void check_sphere(const judge *by) {
    reference exact = run_reference(by, "sphere.json", NULL);
    for (size_t r = 0; r < exact.num; r++) {
        check_sums(by, &exact.sets[r], cJSON_GetObjectItem(exact.json[r], "pl"),
                   exact.q + r * LAST);
    }
    free_reference(&exact);
}

static void check_hemisphere(const judge *by) {
    reference exact = run_reference(by, "hemisphere_m18.json", give_weights);
    for (size_t r = 0; r < exact.num; r++) {
        const double *q = exact.q + r * LAST;
        check_c2(by, &exact.sets[r], cJSON_GetObjectItem(exact.json[r], "l"), q);
        check_sums(by, &exact.sets[r], cJSON_GetObjectItem(exact.json[r], "Q_high"), q);
    }
    free_reference(&exact);
}

static void check_all(ps_precision precision) {
    const double asked = precision == PS_SINGLE ? 1e-4 : 1e-12;
    const judge all[] = {{&ps_pairs_direct, precision, asked},
                         {&ps_pairs_histogram, precision, precision == PS_SINGLE ? 1e-5 : 1e-13},
                         {&ps_sphere_direct, precision, asked},
                         {&ps_sphere_nufft, precision, asked}};
    test_need_precision(device, precision);
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        check_sphere(&all[i]);
        check_hemisphere(&all[i]);
    }
}

static void single(void **state) {
    (void)state;
    check_all(PS_SINGLE);
}

static void double_precision(void **state) {
    (void)state;
    check_all(PS_DOUBLE);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(single),
                                       cmocka_unit_test(double_precision)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("pairs_reference", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
