/* The averaged periodogram of point sets that the caller makes: jittered points, 100 realizations.
 *
 *     cc many_realizations.c $(pkg-config --cflags --libs pointspec) && ./a.out
 */
#include <pointspec/pointspec.h>

#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 16, NUM_POINTS = SIDE * SIDE, REALIZATIONS = 100 };

static void jitter(double *points) {
    for (int j = 0; j < NUM_POINTS; j++) {
        points[2 * j] = (j % SIDE + rand() / (RAND_MAX + 1.0)) / SIDE;
        points[2 * j + 1] = (j / SIDE + rand() / (RAND_MAX + 1.0)) / SIDE;
    }
}

static pspec_status estimate(pspec_context *context, pspec_plan **plan, pspec_spectrum **spectrum) {
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    request.num_points = NUM_POINTS;
    request.num_realizations = REALIZATIONS;
    request.max_frequency = 2 * SIDE;
    request.rings_only = 1;
    pspec_status status = pspec_plan_create(plan, context, &request);
    for (int r = 0; status == PSPEC_OK && r < REALIZATIONS; r++) {
        double points[2 * NUM_POINTS];
        jitter(points);
        const pspec_pattern pattern = {2, NUM_POINTS, points, NULL};
        status = pspec_plan_run(*plan, &pattern, 1);
    }
    return status == PSPEC_OK ? pspec_spectrum_create(spectrum, *plan) : status;
}

int main(void) {
    pspec_context *context = pspec_context_create();
    pspec_plan *plan = NULL;
    pspec_spectrum *spectrum = NULL;
    if (context == NULL || estimate(context, &plan, &spectrum) != PSPEC_OK) {
        fprintf(stderr, "%s\n", context != NULL ? pspec_context_message(context) : "no memory");
        return 1;
    }
    size_t num_bins = 0;
    const pspec_bin *bins = pspec_spectrum_bins(spectrum, &num_bins);
    printf("# %s, %llu realizations, numerical error %.1e\n", pspec_plan_text(plan),
           (unsigned long long)pspec_spectrum_num_realizations(spectrum),
           pspec_spectrum_error(spectrum));
    for (size_t b = 0; b < num_bins; b++) {
        printf("%g %g %g\n", bins[b].normalized_frequency, bins[b].power, bins[b].standard_error);
    }
    pspec_spectrum_destroy(spectrum);
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    return 0;
}
