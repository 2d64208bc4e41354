/* The power spectrum of one pattern: twenty lines of main, errors looked at.
 *
 *     cc one_pattern.c $(pkg-config --cflags --libs pointspec) && ./a.out
 */
#include <pointspec/pointspec.h>
#include <stdio.h>

int main(void) {
    const double points[4][2] = {{0.05, 0.1}, {0.6, 0.15}, {0.2, 0.7}, {0.75, 0.6}};
    pspec_context *context = pspec_context_create();
    pspec_question *question = NULL;
    pspec_answer *answer = NULL;
    if (pspec_question_create(&question, context, "power") ||
        pspec_question_set(question, "max-frequency", "16") ||
        pspec_question_add(question, 1, 4, 2, &points[0][0], NULL) ||
        pspec_question_answer(&answer, question)) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    const pspec_field *frequency = pspec_answer_find(answer, "frequency");
    const pspec_field *power = pspec_answer_find(answer, "power");
    for (size_t b = 0; b < power->num; b++) {
        printf("%g %g\n", ((const double *)frequency->data)[b], ((const double *)power->data)[b]);
    }
    pspec_answer_destroy(answer);
    pspec_question_destroy(question);
    pspec_context_destroy(context);
}
