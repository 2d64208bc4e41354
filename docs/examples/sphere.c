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

int main(void) {
    pspec_context *context = pspec_context_create();
    pspec_question *question = NULL;
    pspec_answer *answer = NULL;
    pspec_status status = pspec_question_create(&question, context, "angular");
    if (status == PSPEC_OK) {
        status = pspec_question_set(question, "max-degree", "48");
    }
    for (int r = 0; status == PSPEC_OK && r < REALIZATIONS; r++) {
        double points[3 * NUM_POINTS];
        jitter(points);
        status = pspec_question_add(question, 1, NUM_POINTS, 3, points, NULL);
    }
    if (status != PSPEC_OK || pspec_question_answer(&answer, question) != PSPEC_OK) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    const pspec_field *const power = pspec_answer_find(answer, "power");
    const double *const error = pspec_answer_find(answer, "standard_error")->data;
    printf("# %s\n", *(const char *const *)pspec_answer_find(answer, "engine")->data);
    for (size_t b = 0; b < power->num; b++) {
        printf("%zu %g %g\n", b + 1, ((const double *)power->data)[b], error[b]);
    }
    pspec_answer_destroy(answer);
    pspec_question_destroy(question);
    pspec_context_destroy(context);
    return 0;
}
