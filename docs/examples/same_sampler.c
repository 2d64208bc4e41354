/* Is it the same sampler? Jittered points with two random generators, and white ones.
 *
 *     cc same_sampler.c $(pkg-config --cflags --libs pointspec) && ./a.out
 */
#include <pointspec/pointspec.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 8, NUM_POINTS = SIDE * SIDE };

static double by_library(void) {
    return rand() / (RAND_MAX + 1.0);
}

/* A generator of one's own, which is to be as good. */
static double by_multiplication(void) {
    static uint64_t state = 1;
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(state >> 11) / 9007199254740992.0; /* 53 bits over 2^53 */
}

static void draw(double *points, double (*uniform)(void), int is_jittered) {
    for (int j = 0; j < NUM_POINTS; j++) {
        points[2 * j] = is_jittered ? (j % SIDE + uniform()) / SIDE : uniform();
        points[2 * j + 1] = is_jittered ? (j / SIDE + uniform()) / SIDE : uniform();
    }
}

/* option and value are of the kind. */
static pspec_answer *ask(pspec_context *context, const char *kind, const char *option,
                         const char *value, int num_sets, double (*uniform)(void),
                         int is_jittered) {
    pspec_question *question = NULL;
    pspec_answer *answer = NULL;
    double points[2 * NUM_POINTS];
    pspec_status status = pspec_question_create(&question, context, kind);
    if (status == PSPEC_OK) {
        status = pspec_question_set(question, option, value);
    }
    for (int r = 0; status == PSPEC_OK && r < num_sets; r++) {
        draw(points, uniform, is_jittered);
        status = pspec_question_add(question, 1, NUM_POINTS, 2, points, NULL);
    }
    if (status != PSPEC_OK || pspec_question_answer(&answer, question) != PSPEC_OK) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        exit(1);
    }
    pspec_question_destroy(question);
    return answer;
}

/* Is it the same? */
static int check(pspec_context *context, const char *name, int num_sets, double (*uniform)(void),
                 int is_jittered) {
    pspec_answer *answer =
        ask(context, "check", "against", "saved.npz", num_sets, uniform, is_jittered);
    const char *const verdict = pspec_answer_verdict(answer);
    const int is_same = verdict[0] == '\0';
    printf("%d sets of %s: %s\n", num_sets, name, is_same ? "the same sampler" : verdict);
    pspec_answer_destroy(answer);
    return is_same;
}

int main(void) {
    pspec_context *context = pspec_context_create();
    pspec_answer *power = ask(context, "power", "max-frequency", "16", 200, by_library, 1);
    if (pspec_answer_write(power, context, "saved.npz", NULL) != PSPEC_OK) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    const int same = check(context, "another generator", 50, by_multiplication, 1);
    const int white = check(context, "white points", 5, by_library, 0);
    pspec_answer_destroy(power);
    pspec_context_destroy(context);
    return same && !white ? 0 : 1;
}
