/* Sums of products of amplitudes on the torus against their definition. */
#include "harness.h"

#include "math/pi.h"
#include "math/random/random.h"
#include "spectra/phases/shift_products.h"

#include <math.h>
#include <stdlib.h>

/* S'(k) of a family: 0 at 0, off its axes and beyond its reach. */
static void amplitude(const ps_frequencies *box, const ps_shift_family *family,
                      const double *values, const int32_t *k, double out[2]) {
    double weight = 1;
    out[0] = out[1] = 0;
    for (unsigned axis = 0; axis < box->dimension; axis++) {
        if (abs(k[axis]) > ((family->axes >> axis & 1) != 0 ? family->reach : 0)) {
            return;
        }
        weight *= cos(PS_PI / 2 * k[axis] / (family->reach + 1));
    }
    for (size_t i = 0; i < box->num; i++) {
        int equal = 1;
        int opposite = 1;
        for (unsigned axis = 0; axis < box->dimension; axis++) {
            equal = equal && box->vectors[i * box->dimension + axis] == k[axis];
            opposite = opposite && box->vectors[i * box->dimension + axis] == -k[axis];
        }
        if (equal || opposite) {
            out[0] = weight * values[2 * i];
            out[1] = weight * (equal ? values[2 * i + 1] : -values[2 * i + 1]);
            return;
        }
    }
}

/* Z(h) over the whole box; returns the sum of |S'(k)|^2. */
static double sum_products(const ps_frequencies *box, const ps_shift_family *family,
                           const double *values, const int32_t *h, double out[2]) {
    int32_t k[PS_MAX_DIMENSION];
    const int32_t side = 2 * box->max_frequency + 1;
    const int64_t cells = (int64_t)pow(side, box->dimension);
    double norm2 = 0;
    out[0] = out[1] = 0;
    for (int64_t cell = 0; cell < cells; cell++) {
        double a[2];
        double b[2];
        int32_t shifted[PS_MAX_DIMENSION];
        int64_t rest = cell;
        for (unsigned axis = 0; axis < box->dimension; axis++) {
            k[axis] = (int32_t)(rest % side) - box->max_frequency;
            shifted[axis] = k[axis] + h[axis];
            rest /= side;
        }
        amplitude(box, family, values, k, b);
        amplitude(box, family, values, shifted, a);
        out[0] += a[0] * b[0] + a[1] * b[1];
        out[1] += a[1] * b[0] - a[0] * b[1];
        norm2 += b[0] * b[0] + b[1] * b[1];
    }
    return norm2;
}

static void assert_near(double found, double expected, double tolerance) {
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%.17g instead of %.17g", found, expected);
    }
}

/* Of some shifts of a family, for each of the sets; the norms are of all sets together. */
static void check_family(const ps_frequencies *box, const ps_shift_family *family,
                         const double *values, size_t num_sets, size_t num_sums,
                         const double *found, double norm) {
    const size_t stride = 2 * box->num;
    for (size_t i = 0; i < family->num; i += 1 + family->num / 10) {
        int32_t h[PS_MAX_DIMENSION];
        double norm2 = 0;
        ps_shift_family_shift(family, i, h);
        for (size_t r = 0; r < num_sets; r++) {
            double expected[2];
            norm2 += sum_products(box, family, values + r * stride, h, expected);
            const double *const one = found + 2 * (r * num_sums + family->first + i);
            assert_near(one[0], expected[0], 1e-12 * (double)box->num);
            assert_near(one[1], expected[1], 1e-12 * (double)box->num);
        }
        assert_near(norm, sqrt(norm2), 1e-12 * norm);
    }
}

static void check_box(unsigned dimension, int32_t max_frequency) {
    ps_frequencies box;
    ps_shift_products *products = NULL;
    ps_random random = ps_random_init(7, 0, dimension);
    assert_ok(ps_frequencies_lattice(&box, dimension, max_frequency, false, error));
    const size_t num_sums = ps_shift_families_sums(&box);
    assert_ok(ps_frequencies_enumerate(&box, error));
    assert_ok(ps_shift_products_create(&products, &box, error));
    size_t num = 0;
    size_t total = 0;
    const ps_shift_family *const families = ps_shift_products_families(products, &num);
    double *const values = calloc(4 * box.num, sizeof *values);
    double *const found = calloc(4 * num_sums + 1, sizeof *found);
    double *const norms = calloc(num + 1, sizeof *norms);
    for (size_t i = 0; i < 4 * box.num; i++) {
        values[i] = ps_random_uniform(&random) - 0.5;
    }
    for (size_t num_sets = 1; num_sets <= PS_SHIFT_SETS; num_sets++) {
        ps_shift_products_run(products, num_sets, values, 2 * box.num, found, norms);
        for (size_t f = 0; f < num; f++) {
            check_family(&box, &families[f], values, num_sets, num_sums, found, norms[f]);
        }
    }
    for (size_t f = 0; f < num; f++) {
        assert_int_equal(families[f].first, total);
        total += families[f].num;
    }
    assert_int_equal(total, num_sums);
    ps_shift_products_destroy(products);
    ps_frequencies_free(&box);
    free(values);
    free(found);
    free(norms);
}

static void products_of_boxes(void **state) {
    (void)state;
    check_box(1, 1);
    check_box(1, 9);
    check_box(2, 4);
    check_box(2, 7);
    check_box(3, 3);
    check_box(4, 2);
}

/* Every set of axes with K/2, K/4, .., 1. */
static void families_of_a_box(void **state) {
    (void)state;
    ps_frequencies box;
    ps_shift_family *families = NULL;
    size_t num = 0;
    assert_ok(ps_frequencies_lattice(&box, 3, 9, false, error));
    assert_ok(ps_shift_families_list(&families, &num, &box, error));
    assert_int_equal(num, 3 * 7);
    unsigned seen = 0;
    for (size_t f = 0; f < num; f++) {
        assert_int_equal(families[f].reach, 4 >> f / 7);
        seen |= 1U << families[f].axes;
        assert_true(f % 7 < 6 || seen == 0xfe);
        seen = f % 7 < 6 ? seen : 0;
    }
    assert_int_equal(families[0].num, (17 * 17 * 17 - 1) / 2);
    ps_shift_families_free(families, num);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(products_of_boxes),
        cmocka_unit_test(families_of_a_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
