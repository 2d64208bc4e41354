/* The power spectrum of one pattern: 64 points of a slightly disturbed lattice.
 *
 *     cc one_pattern.c $(pkg-config --cflags --libs pointspec) && ./a.out
 */
#include <pointspec/pointspec.h>
#include <stdio.h>

int main(void) {
    double points[64][2];
    for (int j = 0; j < 64; j++) {
        points[j][0] = (j % 8 + 0.3 * (j * 7 % 5) / 5) / 8;
        points[j][1] = (j / 8 + 0.3 * (j * 3 % 7) / 7) / 8;
    }
    const pspec_pattern pattern = {2, 64, &points[0][0], NULL};
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    request.num_points = 64;
    request.max_frequency = 16;
    pspec_context *context = pspec_context_create();
    pspec_plan *plan = NULL;
    pspec_spectrum *spectrum = NULL;
    if (pspec_plan_create(&plan, context, &request) != PSPEC_OK ||
        pspec_plan_run(plan, &pattern, 1) != PSPEC_OK ||
        pspec_spectrum_create(&spectrum, plan) != PSPEC_OK) {
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
    return 0;
}
