/* Weights of one's own, single frequencies, saving, loading and merging: importance-weighted
 * points, in two halves as two machines would compute them.
 *
 *     cc own_weights.c $(pkg-config --cflags --libs pointspec) -lm && ./a.out
 */
#include <pointspec/pointspec.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NUM_POINTS = 200, REALIZATIONS = 50, NUM_FREQUENCIES = 3 };

/* x has the density 2 x; the weight 1 / (2 x) makes up for it. */
static void draw(double *points, double *weights) {
    for (int j = 0; j < NUM_POINTS; j++) {
        const double x = sqrt((rand() + 0.5) / (RAND_MAX + 1.0));
        points[2 * j] = x;
        points[2 * j + 1] = rand() / (RAND_MAX + 1.0);
        weights[j] = 1 / (2 * x);
    }
}

static pspec_status estimate_half(pspec_context *context, const char *path) {
    static const int32_t frequencies[NUM_FREQUENCIES][2] = {{1, 0}, {0, 1}, {12, -5}};
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    request.num_points = NUM_POINTS;
    request.frequencies = &frequencies[0][0];
    request.num_frequencies = NUM_FREQUENCIES;
    request.normalization = PSPEC_NORMALIZATION_EFFECTIVE;
    pspec_plan *plan = NULL;
    pspec_spectrum *spectrum = NULL;
    pspec_status status = pspec_plan_create(&plan, context, &request);
    for (int r = 0; status == PSPEC_OK && r < REALIZATIONS / 2; r++) {
        double points[2 * NUM_POINTS];
        double weights[NUM_POINTS];
        draw(points, weights);
        const pspec_pattern pattern = {2, NUM_POINTS, points, weights};
        status = pspec_plan_run(plan, &pattern, 1); /* takes copies */
    }
    if (status == PSPEC_OK) {
        status = pspec_spectrum_create(&spectrum, plan);
    }
    if (status == PSPEC_OK) {
        status = pspec_spectrum_save(spectrum, context, path);
    }
    pspec_spectrum_destroy(spectrum);
    pspec_plan_destroy(plan);
    return status;
}

static void print(const pspec_spectrum *spectrum) {
    size_t num = 0;
    const int32_t *k = pspec_spectrum_frequencies(spectrum, &num);
    for (size_t i = 0; i < num; i++) {
        printf("%d %d %g %g\n", (int)k[2 * i], (int)k[2 * i + 1],
               pspec_spectrum_powers(spectrum)[i], pspec_spectrum_standard_errors(spectrum)[i]);
    }
}

int main(void) {
    static const char *const paths[] = {"half1.spectrum", "half2.spectrum"};
    pspec_context *context = pspec_context_create();
    pspec_spectrum *halves[2] = {NULL, NULL};
    pspec_spectrum *whole = NULL;
    pspec_status status = PSPEC_OK;
    for (int i = 0; i < 2 && status == PSPEC_OK; i++) {
        status = estimate_half(context, paths[i]);
    }
    for (int i = 0; i < 2 && status == PSPEC_OK; i++) {
        status = pspec_spectrum_load(&halves[i], context, paths[i]);
    }
    if (status == PSPEC_OK) {
        const pspec_spectrum *const both[] = {halves[0], halves[1]};
        status = pspec_spectrum_merge(&whole, context, both, 2);
    }
    if (status == PSPEC_OK) {
        print(whole);
    } else {
        fprintf(stderr, "%s\n", pspec_context_message(context));
    }
    pspec_spectrum_destroy(whole);
    pspec_spectrum_destroy(halves[0]);
    pspec_spectrum_destroy(halves[1]);
    pspec_context_destroy(context);
    return status == PSPEC_OK ? 0 : 1;
}
