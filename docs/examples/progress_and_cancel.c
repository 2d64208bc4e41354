/* Callbacks: a log, progress, and a user who has seen enough; then the same question with fewer
 * realizations.
 *
 *     cc progress_and_cancel.c $(pkg-config --cflags --libs pointspec) && ./a.out
 */
#include <pointspec/pointspec.h>

#include <stdio.h>

static void tell(const char *sentence, void *payload) {
    fprintf(payload, "# %s\n", sentence);
}

/* payload: after how many realizations to stop, 0: never */
static int report(const pspec_progress_report *report, void *payload) {
    const uint64_t enough = *(const uint64_t *)payload;
    fprintf(stderr, "# %llu of %llu %s\n", (unsigned long long)report->done,
            (unsigned long long)report->total, report->phase);
    return enough > 0 && report->done >= enough;
}

int main(void) {
    uint64_t enough = 1000;
    pspec_context *context = pspec_context_create();
    pspec_question *question = NULL;
    pspec_answer *answer = NULL;
    pspec_context_set_log(context, tell, stderr);
    pspec_context_set_progress(context, report, &enough);
    pspec_context_set_memory_limit(context, 1 << 28);
    pspec_status status = pspec_question_create(&question, context, "power");
    if (status == PSPEC_OK) {
        status = pspec_question_set(question, "sampler", "white");
    }
    if (status == PSPEC_OK) {
        status = pspec_question_set_number(question, "realizations", 6000);
    }
    if (status == PSPEC_OK) {
        status = pspec_question_answer(&answer, question);
    }
    if (status == PSPEC_ERROR_CANCELLED) {
        printf("# %s\n", pspec_context_message(context));
        enough = 0;
        status = pspec_question_set_number(question, "realizations", 50);
        if (status == PSPEC_OK) {
            status = pspec_question_answer(&answer, question);
        }
    }
    if (status != PSPEC_OK) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    const pspec_field *const power = pspec_answer_find(answer, "power");
    for (size_t b = 0; b < power->num; b++) {
        printf("%zu %g\n", b + 1, ((const double *)power->data)[b]);
    }
    pspec_answer_destroy(answer);
    pspec_question_destroy(question);
    pspec_context_destroy(context);
    return 0;
}
