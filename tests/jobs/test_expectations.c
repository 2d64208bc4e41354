/* Whole jobs: the spectrum of a grid, which is known exactly; what is skipped; second plans. */
#include "harness.h"

#include "engines/engine.h"
#include "jobs/spectrum/power_job_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The frequency as a file, `times` lines of it, since that is how a job takes a list. */
static void write_list(const char *path, const cJSON *k, int times) {
    FILE *file = fopen(path, "w");
    const cJSON *component = NULL;
    assert_non_null(file);
    for (int i = 0; i < times; i++) {
        cJSON_ArrayForEach(component, k) {
            fprintf(file, "%d ", (int)component->valuedouble);
        }
        fprintf(file, "\n");
    }
    assert_int_equal(fclose(file), 0);
}

/* A grid has power N on its dual lattice and 0 elsewhere; one realization stands for all. */
static void regular_grid(void **state) {
    (void)state;
    enum { SIDE = 8, K = 17 };
    ps_sampler_request request = {.num_points = (size_t)SIDE * SIDE, .dimension = 2, .seed = 1};
    assert_ok(ps_sampler_parse(&request, "regular", error));
    request.homogenize = true; /* shifts leave the power unchanged, so they are skipped */
    const ps_power_question question = {.sampler = &request,
                                        .num_realizations = 50,
                                        .frequencies.max_frequency = K,
                                        .wants_full_array = true,
                                        .accuracy.tolerance = 1e-6,
                                        .limits.constraints = {.precision = -1},
                                        .limits.device = getenv("POINTSPEC_DEVICE")};
    ps_power_job *job = NULL;
    assert_ok(ps_power_job_create(&job, &question, error));
    assert_ok(ps_power_job_run(job, error));
    const ps_spectrum *spectrum = &job->spectrum;
    assert_true(job->needs.one_realization);
    assert_int_equal(spectrum->num_realizations, 50);
    for (size_t i = 0; i < spectrum->frequencies.num; i++) {
        const int32_t *k = spectrum->frequencies.vectors + 2 * i;
        const double expected = k[0] % SIDE == 0 && k[1] % SIDE == 0 ? SIDE * SIDE : 0;
        assert_true(fabs(sqrt(spectrum->powers[i].mean) - sqrt(expected)) < 1e-5);
        assert_true(spectrum->powers[i].standard_error == 0);
    }
    ps_power_job_destroy(job);
}

/* What --no-skip computes in full agrees with what was skipped, within the tolerance. */
static void skipping_changes_nothing(void **state) {
    (void)state;
    static const char *const samplers[] = {"regular", "sobol", "jittered", "hammersley"};
    for (size_t s = 0; s < sizeof samplers / sizeof samplers[0]; s++) {
        ps_spectrum_bin kept[12];
        for (int no_skip = 1; no_skip >= 0; no_skip--) {
            ps_sampler_request request = {.num_points = 64, .dimension = 2, .seed = 9};
            assert_ok(ps_sampler_parse(&request, samplers[s], error));
            request.homogenize = true;
            const ps_power_question question = {.sampler = &request,
                                                .num_realizations = 20,
                                                .frequencies.max_frequency = 12,
                                                .accuracy.tolerance = 1e-6,
                                                .accuracy.no_skip = no_skip == 1,
                                                .limits.constraints = {.precision = -1},
                                                .limits.device = getenv("POINTSPEC_DEVICE")};
            ps_power_job *job = NULL;
            assert_ok(ps_power_job_create(&job, &question, error));
            assert_ok(ps_power_job_run(job, error));
            const ps_spectrum *spectrum = &job->spectrum;
            assert_int_equal(spectrum->num_bins, 12);
            for (size_t b = 0; b < 12; b++) {
                const ps_spectrum_bin *bin = &spectrum->bins[b];
                if (no_skip == 1) {
                    kept[b] = *bin;
                    continue;
                }
                assert_true(fabs(sqrt(bin->power) - sqrt(kept[b].power)) < 1e-5);
                assert_true(fabs(bin->standard_error - kept[b].standard_error) < 1e-5);
                assert_int_equal(bin->count, kept[b].count);
            }
            ps_power_job_destroy(job);
        }
    }
}

/* Of the sets of a batch and the next one; what is announced has as many as a batch. */
static size_t count_kept_sets(const ps_power_job *job) {
    size_t num = job->sets.next.points != NULL ? 1 : 0;
    for (size_t i = 0; i < job->sets.capacity; i++) {
        num += job->sets.sets[i].points != NULL ? 1 : 0;
    }
    return num;
}

/* A set whose measured powers break single precision's promise is computed again in double; where
 * the input cannot be read twice, or double was excluded, the job fails with the tolerance. */
static void coherent_sets_are_planned_twice(void **state) {
    (void)state;
    ps_sampler_request request = {.num_points = 4096, .dimension = 2, .seed = 1};
    const cJSON *k = cJSON_Parse("[64, 0]");
    char path[] = "/tmp/pointspec-test-XXXXXX";
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    close(descriptor);
    write_list(path, k, 64); /* enough to fill the lanes: single is cheaper then */
    assert_ok(ps_sampler_parse(&request, "regular", error));
    ps_power_question question = {.sampler = &request,
                                  .num_realizations = 1,
                                  .frequencies.path = path,
                                  .accuracy.tolerance = 1e-6,
                                  .limits.constraints = {.precision = -1},
                                  .limits.device = getenv("POINTSPEC_DEVICE")};
    ps_power_job *job = NULL;
    assert_ok(ps_power_job_create(&job, &question, error));
    assert_int_equal(job->plan.chosen->precision, PS_SINGLE);
    assert_ok(ps_power_job_run(job, error));
    assert_true(job->runner.num_replans > 0);
    assert_int_equal(count_kept_sets(job), 1);
    assert_int_equal(job->plan.chosen->precision, PS_DOUBLE);
    assert_true(job->runner.accuracy.error <= 1e-6);
    assert_true(fabs(job->spectrum.powers[0].mean / 4096 - 1) < 1e-12);
    ps_power_job_destroy(job);
    question.limits.constraints.precision = PS_SINGLE;
    assert_ok(ps_power_job_create(&job, &question, error));
    ps_error error = {0};
    assert_int_equal(ps_power_job_run(job, &error), PSPEC_ERROR_TOLERANCE);
    ps_power_job_destroy(job);
    unlink(path);
    cJSON_Delete((cJSON *)k);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(regular_grid),
        cmocka_unit_test(skipping_changes_nothing),
        cmocka_unit_test(coherent_sets_are_planned_twice),
    };
    ps_device_close(test_open_device()); /* ends as skipped when there is none */
    return cmocka_run_group_tests_name("expectations", tests, NULL, NULL);
}
