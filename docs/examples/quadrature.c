/* How well do directions integrate light times reflection? Spherical Fibonacci points with the
 * density of a diffuse surface: their worst-case error, what each degree has to do with it, what
 * other weights would do, and up to which degree a truncated product of spherical harmonics is
 * worse.
 *
 *     cc quadrature.c $(pkg-config --cflags --libs pointspec) -lm && ./a.out
 */
#include <pointspec/pointspec.h>

#include <math.h>
#include <stdio.h>

enum { NUM_POINTS = 256, MAX_DEGREE = 16 };

/* Points of equal areas at heights z', moved to z = sqrt(z'): their density is z / pi. */
static void make_directions(double *points) {
    const double pi = 3.141592653589793;
    const double golden = (sqrt(5) - 1) / 2;
    for (int j = 0; j < NUM_POINTS; j++) {
        const double z = sqrt(1 - (j + 0.5) / NUM_POINTS);
        const double phi = 2 * pi * fmod(j * golden, 1);
        points[3 * j] = sqrt(1 - z * z) * cos(phi);
        points[3 * j + 1] = sqrt(1 - z * z) * sin(phi);
        points[3 * j + 2] = z;
    }
}

static pspec_status print_rule(pspec_context *context, const double *points, int optimal) {
    const pspec_pattern pattern = {3, NUM_POINTS, points, NULL}; /* weights: 1/N */
    pspec_quadrature_request request = PSPEC_QUADRATURE_REQUEST_INIT;
    request.brdf = "diffuse";
    request.max_degree = MAX_DEGREE;
    request.optimal_weights = optimal;
    pspec_quadrature *rule = NULL;
    const pspec_status status = pspec_quadrature_create(&rule, context, &request, &pattern, 1);
    if (status != PSPEC_OK) {
        return status;
    }
    const pspec_worst_case_error *e = pspec_quadrature_error(rule);
    printf("# %s weights: E = %.6f, weights sum to %.6f, %s\n", optimal ? "optimal" : "equal",
           sqrt(e->squared.mean), e->weight_sum.mean, pspec_quadrature_text(rule));
    size_t num = 0;
    const pspec_quadrature_degree *degrees = pspec_quadrature_degrees(rule, &num);
    for (size_t l = 0; l < num; l++) {
        printf("%d %.3e %.3e %.3e\n", (int)degrees[l].degree, degrees[l].d2.mean,
               degrees[l].c2.mean, degrees[l].e2.mean);
    }
    pspec_quadrature_destroy(rule);
    return PSPEC_OK;
}

static pspec_status print_truncation(pspec_context *context) {
    double errors[MAX_DEGREE + 1], bounds[MAX_DEGREE + 1], points[MAX_DEGREE + 1];
    const pspec_status status =
        pspec_truncation(context, "diffuse", 1.5, 0, MAX_DEGREE, errors, bounds, points);
    printf("# degree, error of truncated products, Fibonacci points that have the same\n");
    for (int l = 0; status == PSPEC_OK && l <= MAX_DEGREE; l++) {
        printf("%d %.6f %.0f\n", l, errors[l], points[l]);
    }
    return status;
}

int main(void) {
    double points[3 * NUM_POINTS];
    pspec_context *context = pspec_context_create();
    make_directions(points);
    if (context == NULL || print_rule(context, points, 0) != PSPEC_OK ||
        print_rule(context, points, 1) != PSPEC_OK || print_truncation(context) != PSPEC_OK) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    pspec_context_destroy(context);
    return 0;
}
