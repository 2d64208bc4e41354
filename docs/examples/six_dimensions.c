/* Six dimensions, where rings have millions of frequencies: a random subset of each, and the error
 * of that.
 *
 *     cc six_dimensions.c $(pkg-config --cflags --libs pointspec) && ./a.out
 */
#include <pointspec/pointspec.h>

#include <stdio.h>
#include <stdlib.h>

enum { DIMENSION = 6, NUM_POINTS = 64, REALIZATIONS = 10 };

int main(void) {
    static double points[REALIZATIONS][DIMENSION * NUM_POINTS];
    pspec_context *context = pspec_context_create();
    pspec_question *question = NULL;
    pspec_answer *answer = NULL;
    for (int i = 0; i < REALIZATIONS * DIMENSION * NUM_POINTS; i++) {
        (&points[0][0])[i] = rand() / (RAND_MAX + 1.0);
    }
    if (pspec_question_create(&question, context, "power") ||
        pspec_question_set(question, "max-frequency", "20") ||
        pspec_question_set(question, "per-ring", "100") ||
        pspec_question_add(question, REALIZATIONS, NUM_POINTS, DIMENSION, points[0], NULL) ||
        pspec_question_answer(&answer, question)) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    const pspec_field *const power = pspec_answer_find(answer, "power");
    const double *const frequency = pspec_answer_find(answer, "frequency")->data;
    const double *const error = pspec_answer_find(answer, "standard_error")->data;
    const int64_t *const count = pspec_answer_find(answer, "count")->data;
    for (size_t b = 0; b < power->num; b++) {
        printf("%g %g %g (of %lld frequencies)\n", frequency[b], ((const double *)power->data)[b],
               error[b], (long long)count[b]);
    }
    pspec_answer_destroy(answer);
    pspec_question_destroy(question);
    pspec_context_destroy(context);
    return 0;
}
