/* GSL's error handler is off inside the fence, in any thread, and what it was afterwards. */
#include "harness.h"

#include "math/gsl/fence.h"

#include <gsl/gsl_errno.h>
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

static unsigned num_errors;

static void count(const char *reason, const char *file, int line, int code) {
    (void)reason;
    (void)file;
    (void)line;
    (void)code;
    num_errors++;
}

static void raise_error(void) {
    gsl_error("a test", __FILE__, __LINE__, GSL_EDOM);
}

static void off_inside_back_outside(void **state) {
    (void)state;
    num_errors = 0;
    gsl_set_error_handler(count);
    ps_gsl_enter();
    raise_error();
    ps_gsl_enter();
    raise_error();
    ps_gsl_leave();
    raise_error();
    assert_int_equal(num_errors, 0);
    ps_gsl_leave();
    raise_error();
    assert_int_equal(num_errors, 1);
    assert_true(gsl_set_error_handler(NULL) == count);
}

/* The handler of a program that sets none aborts it. */
static void nothing_aborts(void **state) {
    (void)state;
    int status = 0;
    const pid_t child = fork();
    if (child == 0) {
        ps_gsl_enter();
        raise_error();
        ps_gsl_leave();
        _exit(0);
    }
    assert_true(child > 0 && waitpid(child, &status, 0) == child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

static void *enter_and_leave(void *payload) {
    enum { TIMES = 20000 };
    (void)payload;
    for (int i = 0; i < TIMES; i++) {
        ps_gsl_enter();
        raise_error();
        ps_gsl_leave();
    }
    return NULL;
}

static void in_threads(void **state) {
    (void)state;
    enum { THREADS = 4 };
    pthread_t threads[THREADS];
    num_errors = 0;
    gsl_set_error_handler(count);
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_create(&threads[i], NULL, enter_and_leave, NULL), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    }
    assert_int_equal(num_errors, 0);
    assert_true(gsl_set_error_handler(NULL) == count);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_aborts),
        cmocka_unit_test(off_inside_back_outside),
        cmocka_unit_test(in_threads),
    };
    return cmocka_run_group_tests_name("gsl_fence", tests, NULL, NULL);
}
