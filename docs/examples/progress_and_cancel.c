/* Callbacks: a log, progress, and a user who has seen enough; then the same plan for another
 * average.
 *
 *     cc progress_and_cancel.c $(pkg-config --cflags --libs pointspec) && ./a.out
 */
#include <pointspec/pointspec.h>

#include <stdio.h>
#include <stdlib.h>

enum { NUM_POINTS = 100, REALIZATIONS = 6000 };

static void tell(const char *sentence, void *payload) {
    fprintf(payload, "# %s\n", sentence);
}

/* payload: after how many realizations to stop, 0: never */
static int report(const pspec_progress_report *report, void *payload) {
    const uint64_t enough = *(const uint64_t *)payload;
    fprintf(stderr, "# %llu of %llu %s\n", (unsigned long long)report->done,
            (unsigned long long)report->total, report->phase);
    return enough > 0 && report->done >= enough;
}

/* White noise, 10 patterns in each call. */
static pspec_status run(pspec_plan *plan, int num_realizations) {
    enum { AT_A_TIME = 10 };
    static double points[AT_A_TIME][2 * NUM_POINTS];
    pspec_pattern patterns[AT_A_TIME];
    pspec_status status = PSPEC_OK;
    for (int r = 0; status == PSPEC_OK && r < num_realizations; r += AT_A_TIME) {
        for (int i = 0; i < AT_A_TIME; i++) {
            for (int j = 0; j < 2 * NUM_POINTS; j++) {
                points[i][j] = rand() / (RAND_MAX + 1.0);
            }
            patterns[i] = (pspec_pattern){2, NUM_POINTS, points[i], NULL};
        }
        status = pspec_plan_run(plan, patterns, AT_A_TIME);
    }
    return status;
}

int main(void) {
    uint64_t enough = 1000;
    pspec_context *context = pspec_context_create();
    pspec_plan *plan = NULL;
    pspec_spectrum *spectrum = NULL;
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    request.num_points = NUM_POINTS;
    request.num_realizations = REALIZATIONS;
    request.max_frequency = 10;
    pspec_context_set_log(context, tell, stderr);
    pspec_context_set_progress(context, report, &enough);
    pspec_context_set_memory_limit(context, 1 << 28);
    pspec_status status = pspec_plan_create(&plan, context, &request);
    if (status == PSPEC_OK) {
        status = run(plan, REALIZATIONS);
    }
    if (status == PSPEC_ERROR_CANCELLED) { /* a part of a batch is no average: begin again */
        printf("# %s\n", pspec_context_message(context));
        enough = 0;
        status = pspec_plan_reset(plan);
        if (status == PSPEC_OK) {
            status = run(plan, 500);
        }
    }
    if (status == PSPEC_OK) {
        status = pspec_spectrum_create(&spectrum, plan);
    }
    if (status != PSPEC_OK) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    size_t num_bins = 0;
    const pspec_bin *bins = pspec_spectrum_bins(spectrum, &num_bins);
    for (size_t b = 0; b < num_bins; b++) {
        printf("%lld %g %g\n", (long long)bins[b].bin, bins[b].power, bins[b].standard_error);
    }
    pspec_spectrum_destroy(spectrum);
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    return 0;
}
