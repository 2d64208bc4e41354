/* Threads whose first use of a device coincides, each with a context of its own. Drivers initialise
 * a process once, so every start is a new process; this one never touches a device. */
#include "harness_public.h"

#include "harness.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_THREADS = 6, NUM_COMPUTING = 2, NUM_RINGS = 4 };
#if defined __SANITIZE_THREAD__
enum { STARTS = 3 }; /* finds accesses without an order whether they collide or not */
#elif defined __SANITIZE_ADDRESS__
enum { STARTS = 6 }; /* one takes three seconds */
#else
enum { STARTS = 12 }; /* 0.6 s of a processor each */
#endif

typedef struct work {
    pthread_barrier_t *barrier;
    pspec_pattern pattern;
    bool only_looks; /* for devices, which takes no kernels and so less time */
    bool is_done;
    double powers[NUM_RINGS];
} work;

static bool ask(work *self, pspec_context *context) {
    pspec_question *question = NULL;
    pspec_answer *answer = NULL;
    bool is_done = pspec_question_create(&question, context,
                                         self->only_looks ? "devices" : "power") == PSPEC_OK;
    if (is_done && !self->only_looks) {
        is_done = pspec_question_set_number(question, "max-frequency", NUM_RINGS) == PSPEC_OK &&
                  pspec_question_set(question, "engine", "torus_direct") == PSPEC_OK &&
                  pspec_question_add(question, 1, self->pattern.num_points, 2, self->pattern.points,
                                     NULL) == PSPEC_OK;
    }
    is_done = is_done && pspec_question_answer(&answer, question) == PSPEC_OK;
    if (is_done && !self->only_looks) {
        const pspec_field *const power = pspec_answer_find(answer, "power");
        is_done = power != NULL && power->num == NUM_RINGS;
        memcpy(self->powers, is_done ? power->data : self->powers, sizeof self->powers);
    }
    pspec_answer_destroy(answer);
    pspec_question_destroy(question);
    return is_done;
}

static void *use_device(void *payload) {
    work *const self = payload;
    pthread_barrier_wait(self->barrier);
    pspec_context *const context = pspec_context_create();
    self->is_done = context != NULL && ask(self, context);
    if (!self->is_done && context != NULL) {
        fprintf(stderr, "a thread: %s\n", pspec_context_message(context));
    }
    pspec_context_destroy(context);
    return NULL;
}

/* In a process of its own: true where all threads have the same bits. */
static bool start(unsigned num_threads, const pspec_pattern *pattern) {
    pthread_barrier_t barrier;
    pthread_t threads[MOST_THREADS];
    work all[MOST_THREADS];
    bool is_good = pthread_barrier_init(&barrier, NULL, num_threads) == 0;
    for (unsigned i = 0; i < num_threads; i++) {
        all[i] = (work){.barrier = &barrier, .pattern = *pattern, .only_looks = i >= NUM_COMPUTING};
        is_good = pthread_create(&threads[i], NULL, use_device, &all[i]) == 0 && is_good;
    }
    for (unsigned i = 0; i < num_threads; i++) {
        pthread_join(threads[i], NULL);
        is_good =
            is_good && all[i].is_done &&
            (all[i].only_looks || memcmp(all[i].powers, all[0].powers, sizeof all[0].powers) == 0);
    }
    return is_good;
}

static void first_uses_coincide(void **state) {
    (void)state;
    static const unsigned numbers[] = {2, MOST_THREADS};
    test_sample what = test_make_sample(1, 2, TEST_NUM_POINTS, 0, false);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        unsigned num_good = 0;
        for (unsigned s = 0; s < STARTS; s++) {
            int status = 0;
            const pid_t child = fork();
            if (child == 0) {
                _exit(start(numbers[i], what.patterns) ? 0 : 1);
            }
            assert_true(child > 0 && waitpid(child, &status, 0) == child);
            num_good += WIFEXITED(status) && WEXITSTATUS(status) == 0;
        }
        if (num_good != STARTS) {
            fail_msg("%u of %d starts of %u threads went well", num_good, STARTS, numbers[i]);
        }
    }
    test_free_sample(&what);
}

static pspec_status answer_of(const char *words) {
    pspec_context *const context = pspec_context_create();
    pspec_question *const question = test_public_question(context, words);
    pspec_answer *answer = NULL;
    const pspec_status status = pspec_question_answer(&answer, question);
    pspec_answer_destroy(answer);
    pspec_question_destroy(question);
    pspec_context_destroy(context);
    return status;
}

/* Where no driver is, kinds that may lack a device have answers all the same. In a process of its
 * own: drivers are looked for once. */
static void some_lack_a_device(void **state) {
    int status = 0;
    (void)state;
    const pid_t child = fork();
    if (child == 0) {
        setenv("OCL_ICD_VENDORS", "/dev/null/no-drivers", 1);
        const pspec_status needed = answer_of("power sampler=white points=4 max-frequency=1");
        const pspec_status lacking =
            answer_of("interpolation integrand=diffuse sampler=fibonacci points=16");
        _exit(needed == PSPEC_ERROR_NO_DEVICE && lacking == PSPEC_OK ? 0 : 1 + (int)lacking);
    }
    assert_true(child > 0 && waitpid(child, &status, 0) == child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

/* 77: no device, nothing to test. */
static bool has_device(void) {
    int status = 0;
    const pid_t child = fork();
    if (child == 0) {
        pspec_context *const context = pspec_context_create();
        pspec_question *const question = test_public_question(
            context, "power sampler=white points=4 max-frequency=1 engine=torus_direct");
        pspec_answer *answer = NULL;
        _exit(pspec_question_answer(&answer, question) == PSPEC_ERROR_NO_DEVICE ? 1 : 0);
    }
    return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) &&
           WEXITSTATUS(status) == 0;
}

int main(void) {
    const int skipped = 77;
    const struct CMUnitTest tests[] = {cmocka_unit_test(first_uses_coincide),
                                       cmocka_unit_test(some_lack_a_device)};
    if (!has_device()) {
        puts("first_use: no OpenCL device, skipped");
        return skipped;
    }
    return cmocka_run_group_tests_name("first_use", tests, NULL, NULL);
}
