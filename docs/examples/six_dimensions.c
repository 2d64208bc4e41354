/* Six dimensions, where rings have millions of frequencies: a random subset of each, and the error
 * of that.
 *
 *     cc six_dimensions.c $(pkg-config --cflags --libs pointspec) && ./a.out
 */
#include <pointspec/pointspec.h>

#include <stdio.h>
#include <stdlib.h>

enum { DIMENSION = 6, NUM_POINTS = 64, REALIZATIONS = 10 };

static pspec_status estimate(pspec_context *context, pspec_plan **plan, pspec_spectrum **spectrum) {
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    request.dimension = DIMENSION;
    request.num_points = NUM_POINTS;
    request.max_frequency = 20;
    request.per_ring = 100;
    pspec_status status = pspec_plan_create(plan, context, &request);
    for (int r = 0; status == PSPEC_OK && r < REALIZATIONS; r++) {
        double points[DIMENSION * NUM_POINTS];
        for (int i = 0; i < DIMENSION * NUM_POINTS; i++) {
            points[i] = rand() / (RAND_MAX + 1.0);
        }
        const pspec_pattern pattern = {DIMENSION, NUM_POINTS, points, NULL};
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
    for (size_t b = 0; b < num_bins; b++) {
        printf("%g %g %g (%llu of %llu frequencies)\n", bins[b].frequency, bins[b].power,
               bins[b].standard_error, (unsigned long long)bins[b].num_computed,
               (unsigned long long)bins[b].count);
    }
    pspec_spectrum_destroy(spectrum);
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    return 0;
}
