/* The power spectrum of one pattern: twenty lines of main, errors looked at.
 *
 *     cc one_pattern.c $(pkg-config --cflags --libs pointspec) && ./a.out
 */
#include <pointspec/pointspec.h>
#include <stdio.h>

int main(void) {
    const double points[4][2] = {{0.05, 0.1}, {0.6, 0.15}, {0.2, 0.7}, {0.75, 0.6}};
    const pspec_pattern pattern = {2, 4, &points[0][0], NULL};
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    request.max_frequency = 16;
    pspec_context *context = pspec_context_create();
    pspec_plan *plan = NULL;
    pspec_spectrum *spectrum = NULL;
    if (pspec_plan_create(&plan, context, &request) || pspec_plan_run(plan, &pattern, 1) ||
        pspec_spectrum_create(&spectrum, plan)) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    size_t num_bins = 0;
    const pspec_bin *bins = pspec_spectrum_bins(spectrum, &num_bins);
    for (size_t b = 0; b < num_bins; b++) {
        printf("%g %g\n", bins[b].frequency, bins[b].power);
    }
    pspec_spectrum_destroy(spectrum);
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
}
