/* Variances, predicted and measured, of samplers whose variance is known: white noise, strata, and
 * sets that are always the same. */
#include "harness_variance.h"

#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;

/* Standard errors that a mean may be off; of some hundred comparisons none should be by chance. */
static const double MANY = 5;

static void near(const char *what, double found, double expected, double allowed) {
    if (!(fabs(found - expected) <= allowed)) {
        fail_msg("%s: %.17g, not %.17g within %g", what, found, expected, allowed);
    }
}

static void near_both(const char *what, const ps_variance_row *row, double exact) {
    near(what, row->prediction.variance, exact, MANY * row->prediction.standard_error);
    near(what, row->measured, exact, MANY * row->measured_error);
    assert_true(fabs(row->z_score) < MANY);
}

/* ---- white noise --------------------------------------------------------------------------- */

static const struct {
    const char *sampler, *integrand;
    double energy; /* N Var I */
} white[] = {
    {"white", "disk", PS_PI / 16 * (1 - PS_PI / 16)},
    {"white", "gaussian:sigma=0.0625", PS_PI / 256 * (1 - PS_PI / 64)},
    {"white", "box:sides=0.5x0.25", 0.125 * 0.875},
    {"white", "wave:k=3x1", 0.5},
    {"white-sphere", "cap", 3 * PS_PI *PS_PI},
    {"white-sphere", "harmonic:axis=1x2x2", PS_FOUR_PI},
    {"white-hemisphere", "square", 16 * PS_PI *PS_PI / 45},
};

static void check_white(size_t i, size_t num_points, uint64_t num_realizations, ps_device *with) {
    test_variance asked;
    test_variance_ask(&asked, white[i].sampler, num_points, num_realizations, white[i].integrand,
                      with);
    const ps_variance_row *const row = test_variance_run(&asked);
    const double exact = white[i].energy / (double)num_points;
    near(white[i].integrand, row->prediction.white, exact, 1e-14 * exact);
    near_both(white[i].integrand, row, exact);
    assert_true(row->prediction.lower <= row->prediction.variance &&
                row->prediction.variance == row->prediction.upper);
    test_variance_free(&asked);
}

static void white_noise(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof white / sizeof white[0]; i++) {
        check_white(i, 64, 400, device);
        check_white(i, 250, 400, device);
        check_white(i, 16, 60, NULL);
    }
}

/* ---- strata -------------------------------------------------------------------------------- */

/* tables.json has the sum of all frequencies, in long double. */
static void jittered_disk(void **state) {
    cJSON *const tables = test_read_reference("tables.json");
    const cJSON *item = NULL;
    (void)state;
    cJSON_ArrayForEach(item, cJSON_GetObjectItem(tables, "disk_variance")) {
        const double exact = test_field(item, "jittered_shifted");
        test_variance asked;
        test_variance_ask(&asked, "jittered", (size_t)test_field(item, "N"), 400, "disk", device);
        const ps_variance_row *const row = test_variance_run(&asked);
        const double error = row->prediction.standard_error;
        near("white", row->prediction.white, test_field(item, "white"), 1e-13);
        near("predicted", row->prediction.variance, exact,
             MANY * error + (row->prediction.upper - row->prediction.lower));
        near("measured", row->measured, exact, MANY * row->measured_error);
        assert_true(row->prediction.lower - MANY * error <= exact &&
                    exact <= row->prediction.upper + MANY * error);
        test_variance_free(&asked);
    }
    cJSON_Delete(tables);
}

/* pi/(12 N^2) of any Gaussian, whose spectrum ends long before frequency 16. */
static void jittered_gaussian(void **state) {
    static const size_t nums[] = {1024, 4096};
    (void)state;
    for (size_t i = 0; i < sizeof nums / sizeof nums[0]; i++) {
        const double num = (double)nums[i];
        const double exact = PS_PI / (12 * num * num);
        test_variance asked;
        test_variance_ask(&asked, "jittered", nums[i], 1000, "gaussian", device);
        asked.question.spectrum.frequencies.max_frequency = 16;
        const ps_variance_row *const row = test_variance_run(&asked);
        near("predicted", row->prediction.variance, exact, 0.05 * exact);
        near("measured", row->measured, exact, MANY * row->measured_error + 0.02 * exact);
        test_variance_free(&asked);
    }
}

/* Of Y_40 by one point in each pixel of HEALPix, degree 4 has all of it: (4 pi/N^2) sum over pixels
 * of 1 - mean P_4(u.v), u and v in the same pixel. Squares would have (4 pi^2/3) 20/N^2, which is
 * 263.2/N^2; pixels are longer than wide, and 460800 pairs of such u and v have 275.6 +- 0.4. */
static void jittered_harmonic(void **state) {
    const double num = 768;
    const double exact = 275.6 / (num * num), its_error = 0.4 / (num * num);
    test_variance asked;
    (void)state;
    test_variance_ask(&asked, "healpix-jittered", (size_t)num, 1500, "harmonic:degree=4", device);
    asked.question.spectrum.max_degree = 4;
    const ps_variance_row *const row = test_variance_run(&asked);
    near("predicted", row->prediction.variance, exact,
         MANY * hypot(row->prediction.standard_error, its_error));
    near("measured", row->measured, exact, MANY * hypot(row->measured_error, its_error));
    assert_true(row->prediction.standard_error < 0.02 * exact);
    test_variance_free(&asked);
}

/* The square of a cosine is of degree 2 alone: (16 pi^2/45) P(2)/N. */
static void square_of_the_hemisphere(void **state) {
    static const char *const samplers[] = {"white-hemisphere", "fibonacci-hemisphere",
                                           "jittered:lift=hemisphere"};
    (void)state;
    for (size_t i = 0; i < sizeof samplers / sizeof samplers[0]; i++) {
        test_variance asked;
        test_variance_ask(&asked, samplers[i], 64, 20, "square", device);
        const ps_variance_row *const row = test_variance_run(&asked);
        const ps_spectrum_bin *const bin = test_variance_spectrum(&asked)->bins;
        const double exact = 16 * PS_PI * PS_PI / 45 * bin->power / 64;
        assert_int_equal(bin->key, 2);
        near(samplers[i], row->prediction.lower, exact, 1e-6 * exact);
        near(samplers[i], row->prediction.upper, exact, 1e-6 * exact + 1e-12);
        test_variance_free(&asked);
    }
}

/* ---- sets that are always the same --------------------------------------------------------- */

/* What an error e of S/sqrt N does to (1/N) sum P |f|^2, by Cauchy and Schwarz, with a factor of 2
 * for e is of the mean over frequencies. */
static double numerical_error(const test_variance *asked, const ps_variance_row *row) {
    const double e = 2 * asked->question.spectrum.accuracy.tolerance;
    return 2 * e * sqrt(row->prediction.white * row->prediction.upper) +
           e * e * row->prediction.white;
}

/* The bracket has the sum over all pairs of the very points. */
static void check_bracket(const char *sampler, size_t num_points, const char *integrand,
                          ps_device *with) {
    test_variance asked;
    size_t num = 0;
    double exact = 0;
    test_variance_ask(&asked, sampler, num_points, 200, integrand, with);
    const ps_variance_row *const row = test_variance_run(&asked);
    double *const points = test_variance_points(&asked, 0, &num);
    assert_ok(ps_integrand_pairwise(test_variance_integrand(&asked, 0), points, NULL, num, &exact,
                                    error));
    const double off = with == NULL ? 1e-10 * row->prediction.white : numerical_error(&asked, row);
    if (!(row->prediction.lower - off <= exact && exact <= row->prediction.upper + off)) {
        fail_msg("%s, %s: %.17g is not in %.17g .. %.17g within %g", sampler, integrand, exact,
                 row->prediction.lower, row->prediction.upper, off);
    }
    assert_true(row->prediction.standard_error == 0);
    near(integrand, row->measured, exact, MANY * row->measured_error);
    free(points);
    test_variance_free(&asked);
}

static void brackets(void **state) {
    static const char *const plane[] = {"halton", "sobol", "hammersley"};
    static const char *const integrands[] = {"disk", "gaussian", "box:sides=0.5x0.3", "half-plane"};
    static const char *const sphere[] = {"cap", "cap:angle=0.5", "harmonic", "lobe:n=5"};
    (void)state;
    for (size_t i = 0; i < sizeof integrands / sizeof integrands[0]; i++) {
        for (size_t k = 0; k < sizeof plane / sizeof plane[0]; k++) {
            check_bracket(plane[k], 64, integrands[i], NULL);
            check_bracket(plane[k], 64, integrands[i], device);
        }
    }
    for (size_t i = 0; i < sizeof sphere / sizeof sphere[0]; i++) {
        check_bracket("fibonacci", 100, sphere[i], NULL);
        check_bracket("fibonacci", 100, sphere[i], device);
    }
    check_bracket("fibonacci-hemisphere", 64, "cap", device);
}

/* ---- numbers of points, constants, one set ------------------------------------------------- */

static void points_vary(void **state) {
    test_variance asked;
    (void)state;
    test_variance_ask(&asked, "poisson-disk", 64, 20, "disk", device);
    const ps_variance_row *const row = test_variance_run(&asked);
    const ps_spectrum *const spectrum = test_variance_spectrum(&asked);
    const double exact = PS_PI / 16 * (1 - PS_PI / 16) / spectrum->mean_points;
    assert_true(spectrum->smallest_points < spectrum->largest_points);
    near("white", row->prediction.white, exact, 1e-14 * exact);
    assert_true(row->prediction.variance > 0.05 * exact && row->prediction.variance < 0.4 * exact);
    assert_true(isfinite(row->z_score));
    test_variance_free(&asked);
}

/* Of any value, though the sum of its copies is rounded. */
static void constants(void **state) {
    static const char *const values[] = {"constant", "constant:value=0.1", "constant:value=-7e-30"};
    (void)state;
    for (size_t i = 0; i < 2 * (sizeof values / sizeof values[0]); i++) {
        test_variance asked;
        test_variance_ask(&asked, "white", 100, 12, values[i / 2], i % 2 == 0 ? device : NULL);
        const ps_variance_row *const row = test_variance_run(&asked);
        assert_true(row->prediction.variance == 0 && row->prediction.standard_error == 0 &&
                    row->prediction.white == 0);
        assert_true(row->prediction.lower == 0 && row->prediction.upper == 0);
        assert_true(row->measured == 0 && row->measured_error == 0);
        assert_true(isnan(row->z_score));
        test_variance_free(&asked);
    }
}

static void one_realization(void **state) {
    (void)state;
    for (int on_host = 0; on_host < 2; on_host++) {
        test_variance asked;
        test_variance_ask(&asked, "white", 16, 1, "disk", on_host ? NULL : device);
        const ps_variance_row *const row = test_variance_run(&asked);
        assert_true(row->prediction.variance > 0 && row->measured >= 0);
        assert_true(isnan(row->prediction.standard_error) && isnan(row->measured_error));
        assert_true(isnan(row->z_score));
        test_variance_free(&asked);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(white_noise),
        cmocka_unit_test(jittered_disk),
        cmocka_unit_test(jittered_gaussian),
        cmocka_unit_test(jittered_harmonic),
        cmocka_unit_test(square_of_the_hemisphere),
        cmocka_unit_test(brackets),
        cmocka_unit_test(points_vary),
        cmocka_unit_test(constants),
        cmocka_unit_test(one_realization),
    };
    device = test_open_device();
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    ps_device_close(device);
    return failed;
}
