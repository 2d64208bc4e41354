/* What the program computes, asked for by its own words: is a sampler the same as a saved one?
 *
 *     cc answers.c $(pkg-config --cflags --libs pointspec) && ./a.out
 */
#include <pointspec/pointspec.h>
#include <stdio.h>

/* Option, value, option, value, .. of a kind of answer; NULL where something goes wrong. */
static pspec_answer *ask(pspec_context *context, const char *kind, const char *const *words) {
    pspec_question *question = NULL;
    pspec_answer *answer = NULL;
    pspec_status status = pspec_question_create(&question, context, kind);
    for (; status == PSPEC_OK && *words != NULL; words += 2) {
        status = pspec_question_set(question, words[0], words[1]);
    }
    if (status != PSPEC_OK || pspec_question_answer(&answer, question) != PSPEC_OK) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
    }
    pspec_question_destroy(question);
    return answer;
}

int main(void) {
    const char *const saved[] = {"sampler", "jittered",      "points", "256",    "realizations",
                                 "16",      "max-frequency", "16",     "output", "answers.npz",
                                 NULL};
    const char *const check[] = {"against", "answers.npz", "sampler", "white", "seed", "2", NULL};
    pspec_context *context = pspec_context_create();
    pspec_answer *power = ask(context, "power", saved), *other = ask(context, "check", check);
    if (power != NULL && other != NULL) {
        printf("%g\n# %s\n", *(const double *)pspec_answer_find(power, "power")->data,
               pspec_answer_verdict(other));
    }
    pspec_answer_destroy(power), pspec_answer_destroy(other), pspec_context_destroy(context);
}
