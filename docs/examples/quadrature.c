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

enum { NUM_POINTS = 256 };

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

static void print(const pspec_answer *answer, const char *const *names, int num_names) {
    const size_t num = pspec_answer_find(answer, "degree")->num;
    for (size_t l = 0; l < num; l++) {
        printf("%zu", l);
        for (int i = 0; i < num_names; i++) {
            printf(" %.3e", ((const double *)pspec_answer_find(answer, names[i])->data)[l]);
        }
        printf("\n");
    }
}

static pspec_status print_rule(pspec_context *context, const double *points, const char *weights) {
    static const char *const names[] = {"d2", "c2", "e2"};
    pspec_question *question = NULL;
    pspec_answer *answer = NULL;
    pspec_status status = PSPEC_OK;
    if ((status = pspec_question_create(&question, context, "quadrature")) == PSPEC_OK &&
        (status = pspec_question_set(question, "brdf", "diffuse")) == PSPEC_OK &&
        (status = pspec_question_set(question, "weights", weights)) == PSPEC_OK &&
        (status = pspec_question_set(question, "max-degree", "16")) == PSPEC_OK &&
        (status = pspec_question_add(question, 1, NUM_POINTS, 3, points, NULL)) == PSPEC_OK &&
        (status = pspec_question_answer(&answer, question)) == PSPEC_OK) {
        printf("# %s weights: E = %.6f\n", weights,
               *(const double *)pspec_answer_find(answer, "worst_case_error")->data);
        print(answer, names, 3);
    }
    pspec_answer_destroy(answer);
    pspec_question_destroy(question);
    return status;
}

static pspec_status print_truncation(pspec_context *context) {
    static const char *const names[] = {"error", "equivalent_points"};
    pspec_question *question = NULL;
    pspec_answer *answer = NULL;
    pspec_status status = PSPEC_OK;
    if ((status = pspec_question_create(&question, context, "truncation")) == PSPEC_OK &&
        (status = pspec_question_set(question, "brdf", "diffuse")) == PSPEC_OK &&
        (status = pspec_question_answer(&answer, question)) == PSPEC_OK) {
        printf("# degree, error of truncated products, Fibonacci points that have the same\n");
        print(answer, names, 2);
    }
    pspec_answer_destroy(answer);
    pspec_question_destroy(question);
    return status;
}

int main(void) {
    double points[3 * NUM_POINTS];
    pspec_context *context = pspec_context_create();
    make_directions(points);
    if (context == NULL || print_rule(context, points, "equal") != PSPEC_OK ||
        print_rule(context, points, "optimal") != PSPEC_OK ||
        print_truncation(context) != PSPEC_OK) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    pspec_context_destroy(context);
    return 0;
}
