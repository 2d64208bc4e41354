/* The averaged periodogram of point sets that the caller makes: jittered points, 100 realizations,
 * each of which is there when it is asked for and no longer.
 *
 *     cc many_realizations.c $(pkg-config --cflags --libs pointspec) && ./a.out
 */
#include <pointspec/pointspec.h>

#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 16, NUM_POINTS = SIDE * SIDE, REALIZATIONS = 100 };

/* The same points whenever the same realization is asked for. */
static int jitter(uint64_t realization, pspec_pattern *out, void *payload) {
    double *const points = payload;
    srand((unsigned)realization + 1);
    for (int j = 0; j < NUM_POINTS; j++) {
        points[2 * j] = (j % SIDE + rand() / (RAND_MAX + 1.0)) / SIDE;
        points[2 * j + 1] = (j / SIDE + rand() / (RAND_MAX + 1.0)) / SIDE;
    }
    out->dimension = 2;
    out->num_points = NUM_POINTS;
    out->points = points;
    return 1;
}

int main(void) {
    double points[2 * NUM_POINTS];
    pspec_context *context = pspec_context_create();
    pspec_question *question = NULL;
    pspec_answer *answer = NULL;
    if (pspec_question_create(&question, context, "power") ||
        pspec_question_set_number(question, "max-frequency", 2 * SIDE) ||
        pspec_question_give(question, REALIZATIONS, jitter, points) ||
        pspec_question_answer(&answer, question)) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    const pspec_field *const power = pspec_answer_find(answer, "power");
    const double *const frequency = pspec_answer_find(answer, "normalized_frequency")->data;
    const double *const error = pspec_answer_find(answer, "standard_error")->data;
    printf("# %s\n", *(const char *const *)pspec_answer_find(answer, "engine")->data);
    for (size_t b = 0; b < power->num; b++) {
        printf("%g %g %g\n", frequency[b], ((const double *)power->data)[b], error[b]);
    }
    pspec_answer_destroy(answer);
    pspec_question_destroy(question);
    pspec_context_destroy(context);
    return 0;
}
