/* The progress callback: long phases of the host have a name, and end soon after it has asked them
 * to. */
#include "base/clock.h"
#include "harness_quadrature.h"

#include <stdlib.h>
#include <string.h>

enum { MANY = 200000 }; /* points: minutes of pairs */

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
static void check_end(const listener *heard, const pspec_context *context) {
    const double slow = 5;
    assert_true(heard->asked > 0);
    assert_true(test_own_seconds() - heard->asked < slow);
    assert_true(heard->gap < slow);
    assert_non_null(strstr(pspec_context_message(context), "interrupted after"));
}

static void analyse(size_t num, bool optimal, uint64_t memory, listener *heard) {
    pspec_context *const context = pspec_context_create();
    pspec_quadrature_request request = PSPEC_QUADRATURE_REQUEST_INIT;
    double *const points = test_rule_points("fibonacci-hemisphere:morph=diffuse", num, 0);
    const pspec_pattern pattern = {3, num, points, NULL};
    pspec_quadrature *out = NULL;
    request.engine = "host_direct";
    request.optimal_weights = optimal;
    request.max_degree = 2;
    pspec_context_set_memory_limit(context, memory);
    pspec_context_set_progress(context, listen, heard);
    assert_int_equal(pspec_quadrature_create(&out, context, &request, &pattern, 1),
                     PSPEC_ERROR_CANCELLED);
    check_end(heard, context);
    free(points);
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
    pspec_interpolant *out = NULL;
    double *const points = test_rule_points("fibonacci-hemisphere", NUM, 0);
    pspec_context_set_memory_limit(context, (uint64_t)8 << 20);
    pspec_context_set_progress(context, listen, &heard);
    assert_int_equal(pspec_interpolant_create(&out, context, NUM, points, points, 1.5),
                     PSPEC_ERROR_CANCELLED);
    check_end(&heard, context);
    free(points);
    pspec_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(worst_case_error), cmocka_unit_test(weights_by_gradients),
        cmocka_unit_test(weights_by_cholesky), cmocka_unit_test(interpolation)};
    return cmocka_run_group_tests_name("cancel", tests, NULL, NULL);
}
