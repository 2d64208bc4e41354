#include "harness_public.h"

#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <string.h>

pspec_power_request test_host_request(void) {
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    request.num_points = TEST_NUM_POINTS;
    request.max_frequency = 4;
    request.engine = "host_direct";
    return request;
}

pspec_context *test_public_context(void) {
    pspec_context *const context = pspec_context_create();
    assert_int_equal(pspec_context_set_device(context, getenv("POINTSPEC_DEVICE")), PSPEC_OK);
    return context;
}

pspec_spectrum *test_public_spectrum(pspec_context *context, const pspec_power_request *request,
                                     const pspec_pattern *patterns, size_t num) {
    pspec_plan *plan = NULL;
    pspec_spectrum *spectrum = NULL;
    if (pspec_plan_create(&plan, context, request) != PSPEC_OK ||
        pspec_plan_run(plan, patterns, num) != PSPEC_OK ||
        pspec_spectrum_create(&spectrum, plan) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    pspec_plan_destroy(plan);
    return spectrum;
}

bool test_is_same_spectrum(const pspec_spectrum *a, const pspec_spectrum *b, bool with_powers) {
    size_t num = 0;
    size_t num_b = 0;
    const pspec_bin *bins = pspec_spectrum_bins(a, &num);
    const pspec_bin *bins_b = pspec_spectrum_bins(b, &num_b);
    for (size_t i = 0; i < num && num == num_b; i++) {
        if (bins[i].bin != bins_b[i].bin || bins[i].count != bins_b[i].count ||
            memcmp(&bins[i].power, &bins_b[i].power, sizeof(double)) != 0 ||
            memcmp(&bins[i].standard_error, &bins_b[i].standard_error, sizeof(double)) != 0 ||
            memcmp(&bins[i].normalized_frequency, &bins_b[i].normalized_frequency,
                   sizeof(double)) != 0) {
            return false;
        }
    }
    const int32_t *vectors = pspec_spectrum_frequencies(a, &num);
    const int32_t *vectors_b = pspec_spectrum_frequencies(b, &num_b);
    const unsigned num_components = pspec_spectrum_components(a);
    return num == num_b &&
           memcmp(vectors, vectors_b, num * num_components * sizeof *vectors) == 0 &&
           pspec_spectrum_num_realizations(a) == pspec_spectrum_num_realizations(b) &&
           pspec_spectrum_mean_points(a) == pspec_spectrum_mean_points(b) &&
           pspec_spectrum_error(a) == pspec_spectrum_error(b) &&
           (!with_powers || (memcmp(pspec_spectrum_powers(a), pspec_spectrum_powers(b),
                                    num * sizeof(double)) == 0 &&
                             memcmp(pspec_spectrum_standard_errors(a),
                                    pspec_spectrum_standard_errors(b), num * sizeof(double)) == 0));
}

/* ---- GSL --------------------------------------------------------------------------------- */

static int num_gsl_errors; /* the handler has no payload */

static void count_gsl_errors(const char *reason, const char *file, int line, int number) {
    (void)reason;
    (void)file;
    (void)line;
    (void)number;
    num_gsl_errors++;
}

void test_watch_gsl(void) {
    gsl_set_error_handler(count_gsl_errors);
}

void test_gsl_is_left_alone(void **state) {
    (void)state;
    assert_true(gsl_set_error_handler(count_gsl_errors) == count_gsl_errors);
    assert_int_equal(num_gsl_errors, 0);
}
