/* Legendre sums over all pairs of weighted points on the sphere, Q(l) = sum_ij w_i w_j
 * P_l(u_i.u_j), and their part C_l^2 that depends on the azimuth: random points with random
 * weights, 20 realizations. Q is about the sum of the squared weights, which is 1 here.
 *
 *     cc pair_sums.c $(pkg-config --cflags --libs pointspec) -lm && ./a.out
 */
#include <pointspec/pointspec.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NUM_POINTS = 100, REALIZATIONS = 20, MAX_DEGREE = 12 };

static double random_number(void) {
    return rand() / (RAND_MAX + 1.0);
}

static void draw(double *points, double *weights) {
    double square = 0;
    for (int j = 0; j < NUM_POINTS; j++) {
        const double z = 1 - 2 * random_number();
        const double phi = 6.283185307179586 * random_number();
        points[3 * j] = sqrt(1 - z * z) * cos(phi);
        points[3 * j + 1] = sqrt(1 - z * z) * sin(phi);
        points[3 * j + 2] = z;
        weights[j] = random_number() - 0.5; /* they may be negative */
        square += weights[j] * weights[j];
    }
    for (int j = 0; j < NUM_POINTS; j++) {
        weights[j] /= sqrt(square);
    }
}

static pspec_status estimate(pspec_context *context, pspec_plan **plan, pspec_spectrum **sums,
                             pspec_mean *c2) {
    pspec_angular_request request = PSPEC_ANGULAR_REQUEST_INIT;
    request.num_points = NUM_POINTS;
    request.num_realizations = REALIZATIONS;
    request.max_degree = MAX_DEGREE;
    request.normalization = PSPEC_NORMALIZATION_PAIRS;
    request.want_c2 = 1;
    request.tolerance = 1e-9; /* in units of (sum |w|)^2 */
    pspec_status status = pspec_plan_create_angular(plan, context, &request);
    for (int r = 0; status == PSPEC_OK && r < REALIZATIONS; r++) {
        double points[3 * NUM_POINTS], weights[NUM_POINTS];
        draw(points, weights);
        const pspec_pattern pattern = {3, NUM_POINTS, points, weights};
        status = pspec_plan_run(*plan, &pattern, 1);
    }
    if (status == PSPEC_OK) {
        status = pspec_spectrum_create(sums, *plan);
    }
    return status == PSPEC_OK ? pspec_plan_c2(*plan, c2) : status;
}

int main(void) {
    pspec_context *context = pspec_context_create();
    pspec_plan *plan = NULL;
    pspec_spectrum *sums = NULL;
    pspec_mean c2[MAX_DEGREE];
    if (context == NULL || estimate(context, &plan, &sums, c2) != PSPEC_OK) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    size_t num = 0;
    const pspec_bin *bins = pspec_spectrum_bins(sums, &num);
    printf("# %s\n# degree, Q, its standard error, C^2, its standard error\n",
           pspec_plan_text(plan));
    for (size_t b = 0; b < num; b++) {
        printf("%d %.4f %.4f %.4f %.4f\n", (int)bins[b].bin, bins[b].power, bins[b].standard_error,
               c2[b].mean, c2[b].standard_error);
    }
    pspec_spectrum_destroy(sums);
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    return 0;
}
