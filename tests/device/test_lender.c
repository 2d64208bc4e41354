/* Devices that are lent: opened when nobody has an idle one, kept, waited for where there are not
 * to be more. */
#include "harness.h"

#include "device/lender.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

static ps_lender *create(const char *selector) {
    ps_lender *lender = NULL;
    assert_ok(ps_lender_create(&lender, selector, error));
    return lender;
}

static ps_device *borrow(ps_lender *lender) {
    ps_device *device = NULL;
    assert_ok(ps_lender_borrow(lender, &device, error));
    assert_non_null(device);
    return device;
}

static void an_idle_device_is_lent_again(void **state) {
    (void)state;
    ps_lender *const lender = create(getenv("POINTSPEC_DEVICE"));
    assert_int_equal(ps_lender_num_open(lender), 0);
    ps_device *const first = borrow(lender);
    ps_device *const second = borrow(lender);
    assert_ptr_not_equal(first, second);
    ps_lender_give_back(lender, first);
    assert_ptr_equal(borrow(lender), first);
    ps_lender_give_back(lender, second);
    ps_lender_give_back(lender, first);
    assert_int_equal(ps_lender_num_open(lender), 2);
    ps_lender_destroy(lender);
}

/* ---- threads ---- */

enum { THREADS = 4, TIMES = 20 };

typedef struct borrowers {
    ps_lender *lender;
    pthread_mutex_t mutex;
    unsigned num_lent, most_lent, num_failed;
} borrowers;

static void note(borrowers *crowd, int lent, unsigned failed) {
    pthread_mutex_lock(&crowd->mutex);
    crowd->num_lent += (unsigned)lent;
    crowd->most_lent = crowd->num_lent > crowd->most_lent ? crowd->num_lent : crowd->most_lent;
    crowd->num_failed += failed;
    pthread_mutex_unlock(&crowd->mutex);
}

static void *work(void *argument) {
    borrowers *const crowd = argument;
    for (int k = 0; k < TIMES; k++) {
        ps_device *device = NULL;
        if (ps_lender_borrow(crowd->lender, &device, NULL) != PSPEC_OK) {
            note(crowd, 0, 1);
            continue;
        }
        note(crowd, 1, 0);
        note(crowd, -1, ps_device_finish(device, NULL) != PSPEC_OK);
        ps_lender_give_back(crowd->lender, device);
    }
    return NULL;
}

static void run(borrowers *crowd) {
    pthread_t threads[THREADS];
    pthread_mutex_init(&crowd->mutex, NULL);
    for (int t = 0; t < THREADS; t++) {
        assert_int_equal(pthread_create(&threads[t], NULL, work, crowd), 0);
    }
    for (int t = 0; t < THREADS; t++) {
        pthread_join(threads[t], NULL);
    }
    pthread_mutex_destroy(&crowd->mutex);
}

static void there_are_no_more_than_may_be(void **state) {
    (void)state;
    for (unsigned most = 1; most <= THREADS; most *= 2) {
        borrowers crowd = {.lender = create(getenv("POINTSPEC_DEVICE"))};
        ps_lender_set_most(crowd.lender, most);
        run(&crowd);
        assert_int_equal(crowd.num_failed, 0);
        assert_in_range(crowd.most_lent, 1, most);
        assert_in_range(ps_lender_num_open(crowd.lender), 1, most);
        ps_lender_destroy(crowd.lender);
    }
}

/* Nobody waits for one that could not be opened. */
static void what_is_not_there_is_told_to_everybody(void **state) {
    (void)state;
    borrowers crowd = {.lender = create("no such device")};
    ps_device *device = NULL;
    ps_error error = {0};
    assert_int_equal(ps_lender_borrow(crowd.lender, &device, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "no such device"));
    assert_null(device);
    run(&crowd);
    assert_int_equal(crowd.num_failed, THREADS * TIMES);
    assert_int_equal(ps_lender_num_open(crowd.lender), 0);
    ps_lender_destroy(crowd.lender);
    ps_lender_destroy(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_idle_device_is_lent_again),
        cmocka_unit_test(there_are_no_more_than_may_be),
        cmocka_unit_test(what_is_not_there_is_told_to_everybody),
    };
    ps_device_close(test_open_device()); /* or there is none */
    return cmocka_run_group_tests(tests, NULL, NULL);
}
