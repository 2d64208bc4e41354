/* When a job stops at a standard error: the looks, the rule, and how often the rule is wrong. */
#include "harness.h"

#include "jobs/spectrum/power_job.h"
#include "spectra/sequential.h"

#include <math.h>
#include <stdlib.h>

static void looks_are_fixed(void **state) {
    (void)state;
    static const uint64_t first[] = {16, 24, 32, 46, 64, 92, 128};
    uint64_t look = 0;
    for (size_t i = 0; i < sizeof first / sizeof first[0]; i++) {
        look = ps_sequential_next_look(look);
        assert_int_equal(look, first[i]);
        assert_int_equal(ps_sequential_next_look(look - 1), look);
    }
    for (int i = 0; i < 40; i++) {
        const uint64_t next = ps_sequential_next_look(look);
        assert_true(next > look && next % 2 == 0 && (double)next < 1.5 * (double)look);
        look = next;
    }
    assert_true(look > 100000000);
}

/* Two bins of one and of four independent frequencies, and one that is not reported. */
static ps_bins make_bins(ps_bin *bins) {
    bins[0] = (ps_bin){.key = 1, .begin = 0, .end = 1, .num_frequencies = 1, .num_modes = 2};
    bins[1] = (ps_bin){.key = 2, .begin = 1, .end = 5, .num_frequencies = 4, .num_modes = 8};
    bins[2] =
        (ps_bin){.key = INT64_MAX, .begin = 5, .end = 9, .num_frequencies = 4, .num_modes = 8};
    return (ps_bins){.num = 3, .num_reported = 2, .bins = bins};
}

static void rule(void **state) {
    (void)state;
    ps_bin memory[3];
    const ps_bins bins = make_bins(memory);
    ps_mean means[] = {{1, 0.1}, {2, 0.1}, {1, 100}};
    ps_sequential_look look = ps_sequential_find(&bins, means, 0, 100);
    assert_int_equal(look.bin, 1);
    assert_true(fabs(look.relative_error - 0.1) < 1e-15);
    assert_true(fabs(look.corrected - 0.1 * (1 + 0.75 * sqrt(8 / 100.0))) < 1e-15);
    look = ps_sequential_find(&bins, means, 1.5, 100); /* the first is below the floor */
    assert_int_equal(look.bin, 2);
    assert_true(fabs(look.corrected - 0.05 * (1 + 0.75 * sqrt(3.5 / 100))) < 1e-15);
    look = ps_sequential_find(&bins, means, 3, 100);
    assert_true(look.bin == 0 && look.corrected == 0);
    means[0] = (ps_mean){0, 0}; /* no power at all: nothing is relative to it */
    assert_int_equal(ps_sequential_find(&bins, means, 0, 100).bin, 2);
    means[1].standard_error = NAN;
    assert_true(isnan(ps_sequential_find(&bins, means, 0, 100).corrected));
}

static double exponential(uint64_t *state) {
    return -log(1 - test_uniform(state));
}

/* Realizations until the rule, or the same without its correction, stops; powers as of white noise.
 */
static uint64_t simulate(uint64_t *state, double standard_error, bool is_corrected) {
    ps_bin memory[3];
    const ps_bins bins = make_bins(memory);
    double sums[2] = {0}, squares[2] = {0};
    uint64_t num = 0, next = ps_sequential_next_look(0);
    for (;;) {
        for (; num < next; num++) {
            const double powers[] = {exponential(state), (exponential(state) + exponential(state) +
                                                          exponential(state) + exponential(state)) /
                                                             4};
            for (int i = 0; i < 2; i++) {
                sums[i] += powers[i];
                squares[i] += powers[i] * powers[i];
            }
        }
        const double m = (double)num;
        ps_mean means[3] = {{0}};
        for (int i = 0; i < 2; i++) {
            means[i].mean = sums[i] / m;
            means[i].standard_error = sqrt((squares[i] - sums[i] * sums[i] / m) / (m - 1) / m);
        }
        const ps_sequential_look look = ps_sequential_find(&bins, means, 0, num);
        if ((is_corrected ? look.corrected : look.relative_error) <= standard_error) {
            return num;
        }
        next = ps_sequential_next_look(num);
    }
}

/* The true standard error of the first bin is 1 / sqrt(M). */
static void rule_keeps_its_promise(void **state) {
    (void)state;
    enum { JOBS = 2000 };
    const double asked = 0.1;
    size_t broken[2] = {0};
    double sum = 0;
    uint64_t seed = 31;
    for (int is_corrected = 0; is_corrected < 2; is_corrected++) {
        for (size_t i = 0; i < JOBS; i++) {
            const double num = (double)simulate(&seed, asked, is_corrected != 0);
            broken[is_corrected] += 1 / sqrt(num) > asked;
            sum += is_corrected != 0 ? num : 0;
        }
    }
    print_message("stopped too soon: %zu of %d, %zu without the correction; %.0f realizations, "
                  "100 are needed and %.0f were expected\n",
                  broken[1], JOBS, broken[0], sum / JOBS, ps_sequential_expected(1, asked));
    assert_true((double)broken[1] < 0.02 * JOBS);
    assert_true((double)broken[0] >
                0.2 * JOBS); /* else the correction is not needed, or this test blind */
    assert_true(sum / JOBS < 2 * 100);
}

/* ---- jobs -------------------------------------------------------------------------------- */

static ps_power_job *run(double standard_error, uint64_t most, bool no_skip) {
    static ps_sampler_request request;
    static ps_power_question question;
    ps_power_job *job = NULL;
    request = (ps_sampler_request){.num_points = 64, .dimension = 2, .seed = 5};
    assert_ok(ps_sampler_parse(&request, "jittered", error));
    assert_ok(ps_sampler_resolve(&request, error));
    question = (ps_power_question){
        .sampler = &request,
        .num_realizations = most,
        .frequencies = {.max_frequency = 12},
        .accuracy = {.tolerance = 1e-6, .standard_error = standard_error, .no_skip = no_skip},
        .limits = {.constraints = {.precision = -1}}};
    assert_ok(ps_power_job_create(&job, &question, error));
    assert_ok(ps_power_job_run(job, error));
    return job;
}

/* The result is that of a job of so many realizations, to the bit. */
static void job_stops(void **state) {
    (void)state;
    ps_power_job *job = run(0.1, 100000, false);
    const ps_spectrum *spectrum = &job->spectrum;
    const uint64_t num = spectrum->num_realizations;
    const ps_sequential_look *look = &job->look;
    assert_true(num > PS_LEAST_REALIZATIONS && num < 1000);
    assert_int_equal(ps_sequential_next_look(num - 1), num);
    assert_true(look != NULL && look->corrected <= 0.1 && look->relative_error > 0.03);
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        assert_true(spectrum->bins[b].standard_error <= 0.1 * spectrum->bins[b].power);
    }
    ps_power_job *same = run(0, num, false);
    const ps_spectrum *whole = &same->spectrum;
    assert_false(same->has_look);
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        assert_true(spectrum->bins[b].power == whole->bins[b].power);
        assert_true(spectrum->bins[b].standard_error == whole->bins[b].standard_error);
    }
    ps_power_job_destroy(same);
    ps_power_job_destroy(job);
}

static void job_that_does_not_stop(void **state) {
    (void)state;
    ps_power_job *short_one = run(0.01, 100, false);
    assert_int_equal(short_one->spectrum.num_realizations, 100);
    assert_true(short_one->look.corrected > 0.01);
    ps_power_job_destroy(short_one);
    ps_power_job *whole = run(0.1, 1500, true);
    assert_int_equal(whole->spectrum.num_realizations, 1500);
    assert_true(whole->look.corrected <= 0.1);
    ps_power_job_destroy(whole);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(looks_are_fixed),        cmocka_unit_test(rule),
        cmocka_unit_test(rule_keeps_its_promise), cmocka_unit_test(job_stops),
        cmocka_unit_test(job_that_does_not_stop),
    };
    return cmocka_run_group_tests_name("sequential", tests, NULL, NULL);
}
