/* Weights of one's own, single frequencies: importance-weighted points.
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

static pspec_status estimate(pspec_question *question, pspec_answer **answer) {
    static const int64_t frequencies[NUM_FREQUENCIES][2] = {{1, 0}, {0, 1}, {12, -5}};
    static const size_t shape[] = {NUM_FREQUENCIES, 2};
    const pspec_field list = {.struct_size = sizeof list,
                              .type = PSPEC_I64,
                              .rank = 2,
                              .shape = shape,
                              .num = 2 * NUM_FREQUENCIES,
                              .data = frequencies};
    pspec_status status = pspec_question_set(question, "normalize", "effective");
    if (status == PSPEC_OK) {
        status = pspec_question_set_array(question, "frequencies", &list);
    }
    for (int r = 0; status == PSPEC_OK && r < REALIZATIONS; r++) {
        double points[2 * NUM_POINTS], weights[NUM_POINTS];
        draw(points, weights);
        status = pspec_question_add(question, 1, NUM_POINTS, 2, points, weights); /* copies */
    }
    return status == PSPEC_OK ? pspec_question_answer(answer, question) : status;
}

int main(void) {
    pspec_context *context = pspec_context_create();
    pspec_question *question = NULL;
    pspec_answer *answer = NULL;
    if (pspec_question_create(&question, context, "power") || estimate(question, &answer)) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    const int64_t *const k1 = pspec_answer_find(answer, "k1")->data;
    const int64_t *const k2 = pspec_answer_find(answer, "k2")->data;
    const double *const power = pspec_answer_find(answer, "power")->data;
    const double *const error = pspec_answer_find(answer, "standard_error")->data;
    for (size_t i = 0; i < NUM_FREQUENCIES; i++) {
        printf("%d %d %g %g\n", (int)k1[i], (int)k2[i], power[i], error[i]);
    }
    pspec_answer_destroy(answer);
    pspec_question_destroy(question);
    pspec_context_destroy(context);
    return 0;
}
