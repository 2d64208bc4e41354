/* Who watches a sampler, and asks it to end at the third time it is told something. */
#ifndef TEST_STOP_AT_THE_THIRD_H
#define TEST_STOP_AT_THE_THIRD_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/watch.h"

/* payload: unsigned, how many times it was told. */
static inline int stop_at_the_third(const pspec_progress_report *report, void *payload) {
    unsigned *const calls = payload;
    assert_non_null(report->phase);
    return ++*calls == 3;
}

#endif
