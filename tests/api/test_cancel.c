/* The progress callback: long phases have a name, and end soon after it has asked them to. */
#include "base/clock.h"
#include "harness_public.h"
#include "harness_quadrature.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MANY = 200000, LINE = 256 }; /* points: minutes of pairs */

typedef struct listener {
    const char *phase; /* a part of the name of the phase to be cancelled */
    uint64_t least;    /* when so much of it is done */
    double asked;      /* seconds: when, 0: not yet */
    double last, gap;  /* seconds: of the last call, and the longest time between two */
    char detail[64];
} listener;

static int listen(const pspec_progress_report *report, void *payload) {
    listener *const heard = payload;
    const double now = test_own_seconds();
    heard->gap = heard->last > 0 && now - heard->last > heard->gap ? now - heard->last : heard->gap;
    heard->last = now;
    if (strstr(report->phase, heard->phase) == NULL || report->done < heard->least) {
        return 0;
    }
    assert_true(report->total == 0 || report->done <= report->total);
    strncpy(heard->detail, report->detail != NULL ? report->detail : "", sizeof heard->detail - 1);
    heard->asked = now;
    return 1;
}

/* The promise is a second, of a machine with nothing else to do. */
static void check_end(const listener *heard) {
    const double slow = 5;
    assert_true(heard->asked > 0);
    assert_true(test_own_seconds() - heard->asked < slow);
    assert_true(heard->gap < slow);
}

static void ask(pspec_context *context, const char *line, size_t num, uint64_t memory,
                listener *heard) {
    double *const points = test_rule_points("fibonacci-hemisphere:morph=diffuse", num, 0);
    pspec_question *const question = test_public_question(context, line);
    assert_int_equal(pspec_question_add(question, 1, num, 3, points, NULL), PSPEC_OK);
    pspec_context_set_memory_limit(context, memory);
    pspec_context_set_progress(context, listen, heard);
    test_public_refuse(context, question, PSPEC_ERROR_CANCELLED, "interrupted after");
    check_end(heard);
    pspec_question_destroy(question);
    free(points);
}

static void analyse(size_t num, bool optimal, uint64_t memory, listener *heard) {
    pspec_context *const context = pspec_context_create();
    ask(context,
        optimal ? "quadrature brdf=diffuse max-degree=2 engine=host_direct weights=optimal"
                : "quadrature brdf=diffuse max-degree=2 engine=host_direct",
        num, memory, heard);
    pspec_context_destroy(context);
}

static void worst_case_error(void **state) {
    (void)state;
    listener heard = {.phase = "E: blocks of pairs of points", .least = 1};
    analyse(MANY, false, 0, &heard);
    assert_string_equal(heard.detail, "");
}

static void weights_by_gradients(void **state) {
    (void)state;
    listener inverse = {.phase = "weights: rows of an approximate inverse", .least = 1};
    analyse(MANY, true, 0, &inverse);
    listener steps = {.phase = "weights: iterations of conjugate gradients", .least = 2};
    analyse(3000, true, (uint64_t)32 << 20, &steps);
    assert_int_equal(strncmp(steps.detail, "residual ", 9), 0);
}

static void weights_by_cholesky(void **state) {
    (void)state;
    listener heard = {.phase = "weights: ", .least = 1};
    analyse(6000, true, 0, &heard);
}

static void interpolation(void **state) {
    enum { NUM = 3000 };
    (void)state;
    listener heard = {.phase = "iterations of conjugate gradients", .least = 2};
    pspec_context *const context = pspec_context_create();
    pspec_answer *answer = NULL;
    double *const points = test_rule_points("fibonacci-hemisphere", NUM, 0);
    pspec_context_set_memory_limit(context, (uint64_t)8 << 20);
    pspec_context_set_progress(context, listen, &heard);
    test_public_refused(context,
                        pspec_interpolate(&answer, context, NUM, points, points, 1.5, 1, points, 0),
                        PSPEC_ERROR_CANCELLED, "interrupted after");
    check_end(&heard);
    free(points);
    pspec_context_destroy(context);
}

/* ---- points of a sampler --------------------------------------------------------------------- */

/* Stops at call number `stop`, from 0 on. */
typedef struct counter {
    uint64_t stop, num;
} counter;

static int count(const pspec_progress_report *report, void *payload) {
    counter *const self = payload;
    if (strstr(report->phase, "sampler: ") == NULL) {
        return 0; /* of realizations */
    }
    assert_true(report->done > 0 && report->done <= report->total);
    return self->num++ == self->stop;
}

static pspec_answer *generate(const char *name, const char *num_points, uint64_t stop,
                              uint64_t *num_told) {
    counter counted = {stop, 0};
    char line[LINE];
    pspec_answer *answer = NULL;
    pspec_context *const context = pspec_context_create();
    snprintf(line, sizeof line, "sample sampler=%s points=%s homogenize", name, num_points);
    pspec_question *const question = test_public_question(context, line);
    pspec_context_set_progress(context, count, &counted);
    const pspec_status status = pspec_question_answer(&answer, question);
    assert_true((status == PSPEC_ERROR_CANCELLED) ==
                (strstr(pspec_context_message(context), "interrupted after") != NULL));
    *num_told = counted.num;
    pspec_question_destroy(question);
    pspec_context_destroy(context);
    return answer;
}

/* The callback is asked in the middle of every pass over the points, and every call may stop it;
 * the points are what they are without one. */
static void try_sampler(const char *name, const char *num_points, uint64_t expected) {
    char line[LINE];
    uint64_t num_told = 0;
    for (uint64_t stop = 0; stop < expected; stop++) {
        assert_null(generate(name, num_points, stop, &num_told));
        assert_int_equal(num_told, stop + 1);
    }
    pspec_context *const context = pspec_context_create();
    snprintf(line, sizeof line, "sample sampler=%s points=%s homogenize", name, num_points);
    pspec_answer *const told = generate(name, num_points, UINT64_MAX, &num_told);
    pspec_answer *const plain = test_public_ask(context, line, NULL, 0);
    assert_int_equal(num_told, expected);
    assert_true(test_public_same(told, plain));
    pspec_answer_destroy(told);
    pspec_answer_destroy(plain);
    pspec_context_destroy(context);
}

/* Two pieces of points: one call a pass. Shifts and rotations are one pass, the hemisphere's two,
 * lifts and morphs one each. */
static void samplers(void **state) {
    static const char two_pieces[] = "32768";
    static const struct {
        const char *name, *num_points;
        uint64_t passes;
    } all[] = {
        {"white", two_pieces, 2},
        {"regular", two_pieces, 3},
        {"jittered", two_pieces, 3},
        {"latin-hypercube", two_pieces, 6},
        {"latin-hypercube:offset=centred", two_pieces, 6},
        {"sobol:scramble=owen", two_pieces, 2},
        {"halton", two_pieces, 2},
        {"hammersley", two_pieces, 2},
        {"larcher-pillichshammer", two_pieces, 2},
        {"white-sphere", two_pieces, 3},
        {"zphi", two_pieces, 4},
        {"healpix", "27648", 3}, /* 12 48^2, less than two pieces */
        {"healpix-jittered", "27648", 3},
        {"fibonacci", two_pieces, 2},
        {"spiral", two_pieces, 2},
        {"white-hemisphere", two_pieces, 4},
        {"fibonacci-hemisphere:morph=diffuse", two_pieces, 4},
        {"white:lift=sphere", two_pieces, 3},
    };
    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        try_sampler(all[i].name, all[i].num_points, all[i].passes);
    }
}

/* Blocks of a set are written one by one; nothing is left of a file that was begun. */
static void written_points(void **state) {
    (void)state;
    listener heard = {.phase = "points written", .least = 200000};
    char folder[] = "/tmp/pointspec-cancel-XXXXXX";
    char path[sizeof folder + 8];
    char line[LINE];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/a.npy", folder);
    snprintf(line, sizeof line, "sample sampler=white points=500000 output=%s", path);
    pspec_context *const context = pspec_context_create();
    pspec_question *const question = test_public_question(context, line);
    pspec_context_set_progress(context, listen, &heard);
    test_public_refuse(context, question, PSPEC_ERROR_CANCELLED,
                       "interrupted after 262144 of 500000 points written");
    pspec_question_destroy(question);
    assert_int_equal(rmdir(folder), 0); /* it is empty */
    pspec_context_destroy(context);
}

/* ---- checkpoints ----------------------------------------------------------------------------- */

static int stop_late(const pspec_progress_report *report, void *payload) {
    int *const left = payload; /* calls before it stops */
    (void)report;
    return (*left)-- == 0;
}

static int give_none(uint64_t realization, pspec_pattern *out, void *payload) {
    (void)realization;
    (void)out;
    (void)payload;
    return 0;
}

/* Sets in memory are known again by their numbers; others are those of another job, and what a
 * function gives is not known. */
static void sets_in_memory_go_on(void **state) {
    enum { SETS = 200, POINTS = 6, NUMBERS = SETS * POINTS * 2 };
    static const char job[] = "power max-frequency=3 engine=host_direct";
    static double numbers[NUMBERS];
    pspec_pattern sets[SETS];
    char folder[] = "/tmp/pointspec-cancel-XXXXXX";
    char path[sizeof folder + 16];
    char line[LINE];
    uint64_t random = 1;
    int num = 0;
    pspec_answer *pieces = NULL;
    (void)state;
    for (size_t i = 0; i < NUMBERS; i++) {
        numbers[i] = test_uniform(&random);
    }
    for (size_t i = 0; i < SETS; i++) {
        sets[i] = (pspec_pattern){2, POINTS, numbers + i * POINTS * 2, NULL};
    }
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/job.npz", folder);
    snprintf(line, sizeof line, "%s checkpoint=%s checkpoint-interval=0", job, path);
    pspec_context *const context = pspec_context_create();
    pspec_answer *const whole = test_public_ask(context, job, sets, SETS);
    for (; pieces == NULL; num++) {
        int left = 1 + num;
        pspec_question *const question = test_public_question(context, line);
        pspec_context_set_progress(context, stop_late, &left);
        test_public_add(question, sets, SETS);
        if (num == 1) {
            numbers[NUMBERS - 1] += 0x1p-20;
            pspec_question *const other = test_public_question(context, line);
            test_public_add(other, sets, SETS);
            test_public_refuse(context, other, PSPEC_ERROR_INPUT, "set memory, digest");
            pspec_question_destroy(other);
            numbers[NUMBERS - 1] -= 0x1p-20;
        }
        const pspec_status status = pspec_question_answer(&pieces, question);
        assert_true(status == PSPEC_OK || status == PSPEC_ERROR_CANCELLED);
        pspec_question_destroy(question);
    }
    assert_true(num > 2 && test_public_same(whole, pieces));
    pspec_context_set_progress(context, NULL, NULL);
    pspec_question *const given = test_public_question(context, line);
    assert_int_equal(pspec_question_give(given, 1, give_none, NULL), PSPEC_OK);
    test_public_refuse(context, given, PSPEC_ERROR_INVALID_ARGUMENT, "a function gives");
    pspec_question_destroy(given);
    pspec_answer_destroy(whole);
    pspec_answer_destroy(pieces);
    pspec_context_destroy(context);
    assert_int_equal(rmdir(folder), 0); /* it is empty */
}

/* Two halves of a CPU, whose threads tell nobody but the one that asked, and end with it. */
typedef struct own_thread {
    pthread_t thread;
    unsigned num_calls, num_others;
    uint64_t most; /* realizations, after which it is cancelled */
} own_thread;

static int listen_in_thread(const pspec_progress_report *report, void *payload) {
    own_thread *const self = payload;
    self->num_calls++;
    self->num_others += pthread_equal(self->thread, pthread_self()) == 0;
    return report->done >= self->most;
}

static void ask_several_devices(const char *words) {
    pspec_context *const context = pspec_context_create();
    own_thread heard = {.thread = pthread_self(), .most = UINT64_MAX};
    pspec_answer *answer = NULL;
    assert_int_equal(pspec_context_set_device(context, "cpu:split=2"), PSPEC_OK);
    pspec_context_set_progress(context, listen_in_thread, &heard);
    pspec_question *const question = test_public_question(context, words);
    if (pspec_question_answer(&answer, question) == PSPEC_OK) {
        assert_true(heard.num_calls > 0 && heard.num_others == 0);
        heard.most = 0;
        test_public_refuse(context, question, PSPEC_ERROR_CANCELLED, "interrupted");
        assert_int_equal(heard.num_others, 0);
    } else { /* no device is split here */
        assert_true(pspec_context_message(context)[0] != '\0');
    }
    pspec_answer_destroy(answer);
    pspec_question_destroy(question);
    pspec_context_destroy(context);
}

/* Parts of a job, and rows of its realizations. */
static void several_devices(void **state) {
    (void)state;
    ask_several_devices("power sampler=white points=64 realizations=3000 max-frequency=8");
    ask_several_devices(
        "quadrature sampler=white-hemisphere points=64 realizations=300 brdf=diffuse max-degree=8");
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(worst_case_error),
                                       cmocka_unit_test(weights_by_gradients),
                                       cmocka_unit_test(weights_by_cholesky),
                                       cmocka_unit_test(interpolation),
                                       cmocka_unit_test(samplers),
                                       cmocka_unit_test(written_points),
                                       cmocka_unit_test(sets_in_memory_go_on),
                                       cmocka_unit_test(several_devices)};
    return cmocka_run_group_tests_name("cancel", tests, NULL, NULL);
}
