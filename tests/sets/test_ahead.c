/* Things made ahead: in order, in the room that there is, by one thread or several, until somebody
 * has enough. */
#include "sets/ahead.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>

#include <cmocka.h>

enum { MOST_SLOTS = 8, FAILING = 5 };

typedef struct shelf {
    uint64_t slots[MOST_SLOTS];
    unsigned num_slots;
    bool fails, is_endless;
    atomic_uint num_made, num_stopped;
    _Atomic uint64_t taken; /* what the caller holds; UINT64_MAX: nothing yet */
    atomic_bool was_overwritten;
} shelf;

static void nap(long nanoseconds) {
    nanosleep(&(struct timespec){0, nanoseconds}, NULL);
}

/* Tells until it is stopped. */
static pspec_status make_for_ever(shelf *self, const ps_watch *watch, ps_error *error) {
    for (uint64_t i = 0;; i++) {
        const pspec_status status = ps_watch_tell(watch, "working", i, 0, NULL, error);
        if (status != PSPEC_OK) {
            atomic_fetch_add(&self->num_stopped, 1);
            return status;
        }
        nap(1000000);
    }
}

static pspec_status make(void *payload, uint64_t index, unsigned slot, const ps_watch *watch,
                         ps_error *error) {
    shelf *const self = payload;
    const uint64_t taken = atomic_load(&self->taken);
    if (taken != UINT64_MAX && slot == taken % self->num_slots) {
        atomic_store(&self->was_overwritten, true);
    }
    if (self->is_endless) {
        return make_for_ever(self, watch, error);
    }
    nap((long)(index * 7919 % 5) * 100000); /* the order of ends is another one */
    self->slots[slot] = index * index;
    atomic_fetch_add(&self->num_made, 1);
    return self->fails && index == FAILING
               ? ps_fail(error, PSPEC_ERROR_INPUT, "thing %llu is broken",
                         (unsigned long long)index)
               : PSPEC_OK;
}

static ps_ahead *begin(shelf *self, uint64_t num, unsigned num_slots, unsigned num_threads) {
    ps_ahead *ahead = NULL;
    const ps_ahead_plan plan = {make, self, num, num_slots, num_threads};
    self->num_slots = num_slots;
    atomic_store(&self->taken, UINT64_MAX);
    assert_int_equal(ps_ahead_create(&ahead, &plan, NULL), PSPEC_OK);
    return ahead;
}

/* The caller holds what he took until the next call, which the makers see. */
static void take(ps_ahead *ahead, shelf *self, uint64_t index) {
    unsigned slot = MOST_SLOTS;
    ps_error error = {0};
    atomic_store(&self->taken, UINT64_MAX);
    if (ps_ahead_next(ahead, NULL, &slot, &error) != PSPEC_OK) {
        fail_msg("thing %d: %s", (int)index, error.message);
    }
    atomic_store(&self->taken, index);
    assert_int_equal(slot, index % self->num_slots);
    nap((long)(index % 3) * 300000);
    assert_int_equal(self->slots[slot], index * index);
}

static void things_come_in_order_whoever_makes_them(void **state) {
    (void)state;
    enum { NUM = 60 };
    for (unsigned slots = 1; slots <= MOST_SLOTS; slots++) {
        for (unsigned threads = 0; threads <= slots && threads <= 4; threads++) {
            shelf self = {0};
            ps_ahead *const ahead = begin(&self, NUM, slots, threads);
            for (uint64_t i = 0; i < NUM; i++) {
                take(ahead, &self, i);
            }
            ps_ahead_destroy(ahead);
            assert_int_equal(self.num_made, NUM);
            assert_false(self.was_overwritten);
        }
    }
}

/* Without a caller no more is made than there is room for. */
static void there_is_room_for_so_many(void **state) {
    (void)state;
    enum { SLOTS = 3, PATIENCE = 1000 };
    shelf self = {0};
    ps_ahead *const ahead = begin(&self, 100, SLOTS, 2);
    for (int i = 0; i < PATIENCE && atomic_load(&self.num_made) < SLOTS; i++) {
        nap(10000000);
    }
    nap(50000000);
    assert_int_equal(atomic_load(&self.num_made), SLOTS);
    ps_ahead_destroy(ahead);
    assert_int_equal(self.num_made, SLOTS);
    ps_ahead_destroy(NULL);
}

static void an_error_comes_in_its_turn_and_stays(void **state) {
    (void)state;
    for (unsigned threads = 0; threads <= 3; threads++) {
        shelf self = {.fails = true};
        ps_ahead *const ahead = begin(&self, 20, 4, threads);
        for (uint64_t i = 0; i < FAILING; i++) {
            take(ahead, &self, i);
        }
        for (int again = 0; again < 2; again++) {
            unsigned slot = 0;
            ps_error error = {0};
            assert_int_equal(ps_ahead_next(ahead, NULL, &slot, &error), PSPEC_ERROR_INPUT);
            assert_string_equal(error.message, "thing 5 is broken");
        }
        ps_ahead_destroy(ahead);
    }
}

typedef struct listener {
    int num_heard;
    const char *phase;
} listener;

static int stop_at_the_third(const ps_watch_report *report, void *payload) {
    listener *const self = payload;
    self->phase = report->phase;
    return ++self->num_heard >= 3;
}

/* What its maker says is heard; who has enough is let go, and so are the threads. */
static void a_caller_hears_and_stops(void **state) {
    (void)state;
    for (unsigned threads = 0; threads <= 2; threads++) {
        shelf self = {.is_endless = true};
        listener ear = {0};
        const ps_watch watch = {stop_at_the_third, &ear};
        ps_ahead *const ahead = begin(&self, 10, 2, threads);
        unsigned slot = 0;
        ps_error error = {0};
        assert_int_equal(ps_ahead_next(ahead, &watch, &slot, &error), PSPEC_ERROR_CANCELLED);
        assert_int_equal(ear.num_heard, 3);
        assert_string_equal(ear.phase, "working");
        ps_ahead_destroy(ahead);
        assert_int_equal(atomic_load(&self.num_stopped), threads > 0 ? threads : 1);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(things_come_in_order_whoever_makes_them),
        cmocka_unit_test(there_is_room_for_so_many),
        cmocka_unit_test(an_error_comes_in_its_turn_and_stays),
        cmocka_unit_test(a_caller_hears_and_stops),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
