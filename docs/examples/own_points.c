/* Points and an integrand of one's own: how much does the estimate of an integral scatter, and are
 * the points still those of a saved spectrum?
 *
 *     cc own_points.c $(pkg-config --cflags --libs pointspec) -lm && ./a.out
 */
#include <pointspec/pointspec.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 8, NUM_POINTS = SIDE * SIDE, REALIZATIONS = 64 };

/* F(x, y) = exp(x) y, whose integral is (e - 1) / 2. */
static int values(size_t num, unsigned dimension, const double *points, double *out,
                  void *payload) {
    (void)payload;
    for (size_t i = 0; i < num; i++) {
        out[i] = exp(points[i * dimension]) * points[i * dimension + 1];
    }
    return 0;
}

/* The answer of a kind, with an option and its value, for these points. */
static pspec_answer *ask(pspec_context *context, const char *kind, const char *option,
                         const char *value, const double *points) {
    pspec_question *question = NULL;
    pspec_answer *answer = NULL;
    pspec_status status = pspec_question_create(&question, context, kind);
    if (status == PSPEC_OK) {
        status = pspec_question_set(question, option, value);
    }
    if (status == PSPEC_OK && strcmp(kind, "variance") == 0) {
        status = pspec_question_integrand(question, "own", (exp(1) - 1) / 2, values, NULL);
    }
    if (status == PSPEC_OK) {
        status = pspec_question_add(question, REALIZATIONS, NUM_POINTS, 2, points, NULL);
    }
    if (status != PSPEC_OK || pspec_question_answer(&answer, question) != PSPEC_OK) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        exit(1);
    }
    pspec_question_destroy(question);
    return answer;
}

int main(void) {
    static double points[REALIZATIONS][2 * NUM_POINTS];
    pspec_context *context = pspec_context_create();
    for (int r = 0; r < REALIZATIONS; r++) {
        for (int j = 0; j < NUM_POINTS; j++) { /* one in each cell of a grid */
            points[r][2 * j] = (j % SIDE + rand() / (RAND_MAX + 1.0)) / SIDE;
            points[r][2 * j + 1] = (j / SIDE + rand() / (RAND_MAX + 1.0)) / SIDE;
        }
    }
    pspec_answer *variance = ask(context, "variance", "shifts", "4", points[0]);
    pspec_answer *power = ask(context, "power", "output", "own_points.npz", points[0]);
    pspec_answer *check = ask(context, "check", "against", "own_points.npz", points[0]);
    printf("%g +- %g\n", *(const double *)pspec_answer_find(variance, "measured")->data,
           *(const double *)pspec_answer_find(variance, "measured_error")->data);
    printf("# %s\n", pspec_answer_verdict(check)[0] == '\0' ? "the same sampler" : "another one");
    pspec_answer_destroy(variance);
    pspec_answer_destroy(power);
    pspec_answer_destroy(check);
    pspec_context_destroy(context);
    return 0;
}
