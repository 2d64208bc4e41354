/* Threads that build programs: side by side, whose failures are told where kernels are waited for,
 * and a question whose kernels they make. */
#include "harness_estimator.h"
#include "harness_kernels.h"

#include "engines/engine.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- what is linked in the place of clBuildProgram (tests/CMakeLists.txt) ------------------- */

static struct gate {
    pthread_mutex_t mutex;
    pthread_cond_t has_changed;
    unsigned num_begun, num_done;
    unsigned awaited;  /* builds that all wait for until they have begun */
    unsigned refused;  /* the number of the one that fails; 0: none */
    cl_int refusal;    /* with this code */
    bool is_abandoned; /* they did not come */
} gate = {.mutex = PTHREAD_MUTEX_INITIALIZER, .has_changed = PTHREAD_COND_INITIALIZER};

static void expect(unsigned awaited, unsigned refused, cl_int refusal) {
    gate.num_begun = gate.num_done = 0;
    gate.awaited = awaited;
    gate.refused = refused;
    gate.refusal = refusal;
    gate.is_abandoned = false;
}

cl_int __real_clBuildProgram(cl_program program, cl_uint num, const cl_device_id *devices,
                             const char *options, void(CL_CALLBACK *notify)(cl_program, void *),
                             void *payload);
cl_int __wrap_clBuildProgram(cl_program program, cl_uint num, const cl_device_id *devices,
                             const char *options, void(CL_CALLBACK *notify)(cl_program, void *),
                             void *payload);
cl_int __wrap_clBuildProgram(cl_program program, cl_uint num, const cl_device_id *devices,
                             const char *options, void(CL_CALLBACK *notify)(cl_program, void *),
                             void *payload) {
    enum { PATIENCE = 60 }; /* seconds, until a test fails that would never end */
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_sec += PATIENCE;
    pthread_mutex_lock(&gate.mutex);
    const bool is_refused = ++gate.num_begun == gate.refused;
    pthread_cond_broadcast(&gate.has_changed);
    while (gate.num_begun < gate.awaited && !gate.is_abandoned) {
        gate.is_abandoned = pthread_cond_timedwait(&gate.has_changed, &gate.mutex, &until) != 0;
    }
    pthread_mutex_unlock(&gate.mutex);
    const cl_int code =
        is_refused ? gate.refusal
                   : __real_clBuildProgram(program, num, devices, options, notify, payload);
    pthread_mutex_lock(&gate.mutex);
    gate.num_done++;
    pthread_mutex_unlock(&gate.mutex);
    return code;
}

static unsigned num_done(void) {
    pthread_mutex_lock(&gate.mutex);
    const unsigned num = gate.num_done;
    pthread_mutex_unlock(&gate.mutex);
    return num;
}

/* ---- kernels -------------------------------------------------------------------------------- */

static ps_device *open_with(unsigned builders) {
    ps_device *const device = test_open_device();
    ps_device_set_builders(device, builders);
    return device;
}

/* A program for each number of lanes. */
static ps_kernel *ask(ps_device *device, unsigned lanes) {
    return test_kernel(device, "probe/copy.cl", "probe_copy", "-DPRECISION=32 -DLANES=%u", lanes);
}

static void check_copy(ps_device *device, ps_kernel *kernel, size_t lanes) {
    const double numbers[] = {3, 1, 4, 1, 5, 9, 2, 6};
    const size_t num = sizeof numbers / sizeof numbers[0];
    test_memory from = test_reals_create(device, 32, numbers, num);
    test_memory to = test_reals_create(device, 32, NULL, num);
    TEST_LAUNCH(device, kernel, 1, num / lanes, 1, 1, PS_BUFFER(from.buffer), PS_BUFFER(to.buffer));
    double *const found = test_reals_read(&to, 32);
    assert_memory_equal(found, numbers, sizeof numbers);
    free(found);
    test_memory_free_unchanged(&from);
    test_memory_free(&to);
}

static void programs_are_built_side_by_side(void **state) {
    (void)state;
    enum { NUM = 4 };
    ps_device *const device = open_with(NUM);
    ps_kernel *kernels[NUM];
    expect(NUM, 0, 0); /* who asked for them does not wait, or no more would come */
    for (unsigned i = 0; i < NUM; i++) {
        kernels[i] = ask(device, 1U << i);
        assert_ptr_equal(ask(device, 1U << i), kernels[i]);
    }
    assert_ptr_not_equal(kernels[0], kernels[1]);
    assert_ok(ps_device_build(device, error));
    assert_false(gate.is_abandoned);
    for (unsigned i = 0; i < NUM; i++) {
        check_copy(device, kernels[i], (size_t)1 << i);
    }
    assert_int_equal(gate.num_begun, NUM);
    ps_device_close(device);
}

/* As CPUs do, and where there is no thread to be had. */
static void without_builders_who_asks_builds(void **state) {
    (void)state;
    ps_device *const device = open_with(0);
    for (unsigned lanes = 1; lanes <= 8; lanes *= 2) {
        expect(1, 0, 0);
        ps_kernel *const kernel = ask(device, lanes);
        assert_int_equal(num_done(), 1);
        check_copy(device, kernel, lanes);
    }
    ps_device_close(device);
}

static void check_refusal(ps_device *device, pspec_status status, const char *what) {
    ps_error said = {0};
    assert_int_equal(ps_device_build(device, &said), status);
    if (strstr(said.message, what) == NULL) {
        fail_msg("\"%s\" is missing in: %s", what, said.message);
    }
    assert_ok(ps_device_build(device, error)); /* told once */
}

/* The first that was asked for is told, whichever failed first; others are not harmed. */
static void a_failure_is_told_where_kernels_are_waited_for(void **state) {
    (void)state;
    ps_device *const device = open_with(3);
    ps_error said = {0};
    expect(3, 0, 0);
    ps_kernel *const good = ask(device, 4);
    ps_kernel *const broken = test_kernel(device, "probe/copy.cl", "probe_copy", "-DLANES=unheard");
    assert_non_null(test_kernel(device, "probe/copy.cl", "no_such_kernel", "-DPRECISION=32"));
    assert_int_equal(ps_device_build(device, &said), PSPEC_ERROR_BUILD);
    assert_non_null(strstr(said.message, "kernel probe/copy.cl does not build on"));
    assert_non_null(strstr(said.message, "-DLANES=unheard"));
    check_copy(device, good, 4);
    const ps_range range = {.rank = 1, .global = {1}, .local = {1}};
    ps_error again = {0};
    assert_int_equal(PS_LAUNCH(device, broken, &range, &again, PS_U32(1)), PSPEC_ERROR_BUILD);
    assert_string_equal(again.message, said.message);
    assert_int_equal(ps_device_build(device, &said), PSPEC_ERROR_DEVICE);
    assert_non_null(strstr(said.message, "CL_INVALID_KERNEL_NAME"));
    ps_device_close(device);
}

/* What the driver could not do may be asked for again. */
static void what_was_refused_is_built_when_asked_for_again(void **state) {
    (void)state;
    for (unsigned builders = 0; builders < 2; builders++) {
        ps_device *const device = open_with(builders);
        ps_kernel *kernel = NULL;
        ps_error said = {0};
        expect(0, 1, CL_OUT_OF_HOST_MEMORY);
        pspec_status status = ps_kernel_get(device, &kernel, "probe/copy.cl", "probe_copy",
                                            "-DPRECISION=32 -DLANES=2", &said);
        if (builders > 0) {
            assert_ok(status);
            check_refusal(device, PSPEC_ERROR_MEMORY, "CL_OUT_OF_HOST_MEMORY");
        } else {
            assert_int_equal(status, PSPEC_ERROR_MEMORY);
        }
        check_copy(device, ask(device, 2), 2);
        assert_int_equal(gate.num_begun, 2);
        ps_device_close(device);
    }
}

static void closing_waits_for_what_was_begun(void **state) {
    (void)state;
    ps_device *const device = open_with(1);
    expect(0, 0, 0);
    for (unsigned lanes = 1; lanes <= 8; lanes *= 2) {
        ask(device, lanes);
    }
    ps_device_close(device);
    assert_int_equal(gate.num_done, gate.num_begun);
}

/* ---- a question ----------------------------------------------------------------------------- */

typedef struct question {
    ps_frequencies set;
    test_sample sample;
    ps_estimator_options options;
} question;

/* By the kernels that GPUs have. */
static void make_question(question *q) {
    enum { POINTS = 600, NUM = 6 };
    q->set = test_make_lattice(2, 20, false);
    q->sample = test_make_sample(NUM, 2, POINTS, 0, false);
    q->options = test_make_options(&q->set, &ps_torus_nufft, PS_SINGLE, POINTS, NUM);
    q->options.problem.tolerance = 1e-5;
}

static ps_device *open_as_gpu(unsigned builders) {
    ps_device *const device = open_with(builders);
    ps_device_set_dedicated_local_memory(device, true);
    return device;
}

static void kernels_of_a_question_are_built_side_by_side(void **state) {
    (void)state;
    enum { BUILDERS = 4 };
    question *const q = *state;
    ps_device *const alone = open_as_gpu(0);
    expect(0, 0, 0);
    ps_spectrum expected = test_estimate(&q->options, &q->sample, q->sample.num, alone);
    const unsigned num = gate.num_begun;
    ps_device *const device = open_as_gpu(BUILDERS);
    expect(BUILDERS, 0, 0);
    ps_spectrum found = test_estimate(&q->options, &q->sample, q->sample.num, device);
    assert_false(gate.is_abandoned);
    assert_int_equal(gate.num_begun, num);
    assert_true(test_is_same_bits(&expected, &found));
    ps_spectrum_free(&expected);
    ps_spectrum_free(&found);
    ps_device_close(alone);
    ps_device_close(device);
}

/* Before anything is launched; memory as if another had refused it. */
static void a_question_whose_kernels_fail_is_not_begun(void **state) {
    question *const q = *state;
    ps_device *device = open_as_gpu(2);
    ps_estimator *estimator = NULL;
    ps_error said = {0};
    expect(0, 3, CL_BUILD_PROGRAM_FAILURE);
    assert_int_equal(ps_estimator_create(&estimator, &q->options, device, &said),
                     PSPEC_ERROR_BUILD);
    assert_non_null(strstr(said.message, "does not build on"));
    ps_device_close(device);
    device = open_as_gpu(2);
    expect(0, 3, CL_OUT_OF_HOST_MEMORY);
    assert_ok(ps_estimator_create(&estimator, &q->options, device, error));
    assert_int_equal(ps_estimator_batch(estimator), q->sample.num / 2);
    ps_estimator_destroy(estimator);
    ps_device_close(device);
}

int main(void) {
    question q;
    make_question(&q);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(programs_are_built_side_by_side),
        cmocka_unit_test(without_builders_who_asks_builds),
        cmocka_unit_test(a_failure_is_told_where_kernels_are_waited_for),
        cmocka_unit_test(what_was_refused_is_built_when_asked_for_again),
        cmocka_unit_test(closing_waits_for_what_was_begun),
        cmocka_unit_test_prestate(kernels_of_a_question_are_built_side_by_side, &q),
        cmocka_unit_test_prestate(a_question_whose_kernels_fail_is_not_begun, &q),
    };
    const int failures = cmocka_run_group_tests_name("builders", tests, NULL, NULL);
    test_free_sample(&q.sample);
    ps_frequencies_free(&q.set);
    return failures;
}
