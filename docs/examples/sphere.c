/* The averaged angular power spectrum of points on the sphere that the caller makes: one random
 * point in each cell of equal area, 100 realizations. At low degrees it is near (pi / 3) l (l + 1)
 * / N.
 *
 *     cc sphere.c $(pkg-config --cflags --libs pointspec) -lm && ./a.out
 */
#include <pointspec/pointspec.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { BANDS = 12, CELLS = 36, NUM_POINTS = BANDS * CELLS, REALIZATIONS = 100 };

static double random_number(void) {
    return rand() / (RAND_MAX + 1.0);
}

/* Bands of equal height have equal area. */
static void jitter(double *points) {
    const double two_pi = 6.283185307179586;
    for (int j = 0; j < NUM_POINTS; j++) {
        const double z = 1 - 2 * (j / CELLS + random_number()) / BANDS;
        const double phi = two_pi * (j % CELLS + random_number()) / CELLS;
        points[3 * j] = sqrt(1 - z * z) * cos(phi);
        points[3 * j + 1] = sqrt(1 - z * z) * sin(phi);
        points[3 * j + 2] = z;
    }
}

static pspec_status estimate(pspec_context *context, pspec_plan **plan, pspec_spectrum **spectrum) {
    pspec_angular_request request = PSPEC_ANGULAR_REQUEST_INIT;
    request.num_points = NUM_POINTS;
    request.num_realizations = REALIZATIONS;
    request.max_degree = 48;
    pspec_status status = pspec_plan_create_angular(plan, context, &request);
    for (int r = 0; status == PSPEC_OK && r < REALIZATIONS; r++) {
        double points[3 * NUM_POINTS];
        jitter(points);
        const pspec_pattern pattern = {3, NUM_POINTS, points, NULL};
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
        printf("%d %g %g\n", (int)bins[b].bin, bins[b].power, bins[b].standard_error);
    }
    pspec_spectrum_destroy(spectrum);
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    return 0;
}
