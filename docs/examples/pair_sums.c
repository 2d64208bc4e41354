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

enum { NUM_POINTS = 100, REALIZATIONS = 20 };

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

int main(void) {
    static double points[REALIZATIONS][3 * NUM_POINTS], weights[REALIZATIONS][NUM_POINTS];
    pspec_context *context = pspec_context_create();
    pspec_question *question = NULL;
    pspec_answer *answer = NULL;
    for (int r = 0; r < REALIZATIONS; r++) {
        draw(points[r], weights[r]);
    }
    if (pspec_question_create(&question, context, "pairs") ||
        pspec_question_set(question, "max-degree", "12") ||
        pspec_question_set(question, "tol", "1e-9") || /* in units of (sum |w|)^2 */
        pspec_question_add(question, REALIZATIONS, NUM_POINTS, 3, points[0], weights[0]) ||
        pspec_question_answer(&answer, question)) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    printf("# degree, Q, its standard error, C^2, its standard error\n");
    const pspec_field *const degree = pspec_answer_find(answer, "degree");
    const char *const names[] = {"legendre_sum", "legendre_sum_error", "c2", "c2_error"};
    for (size_t l = 0; l < degree->num; l++) {
        printf("%d", (int)((const int64_t *)degree->data)[l]);
        for (int i = 0; i < 4; i++) {
            printf(" %.4f", ((const double *)pspec_answer_find(answer, names[i])->data)[l]);
        }
        printf("\n");
    }
    pspec_answer_destroy(answer);
    pspec_question_destroy(question);
    pspec_context_destroy(context);
    return 0;
}
