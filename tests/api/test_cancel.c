/* The progress callback: long phases have a name, and end soon after it has asked them to. */
#include "base/clock.h"
#include "harness_quadrature.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

/* ---- points of a sampler --------------------------------------------------------------------- */

/* Stops at call number `stop`, from 0 on. */
typedef struct counter {
    uint64_t stop, num;
} counter;

static int count(const pspec_progress_report *report, void *payload) {
    counter *const self = payload;
    assert_non_null(strstr(report->phase, "sampler: "));
    assert_true(report->done > 0 && report->done <= report->total);
    return self->num++ == self->stop;
}

static pspec_status generate(const pspec_sampler *sampler, uint64_t stop, uint64_t *num_told,
                             double *points) {
    counter counted = {stop, 0};
    pspec_context *const context = pspec_context_create();
    pspec_context_set_progress(context, count, &counted);
    const pspec_status status = pspec_sampler_generate(sampler, context, 0, points, NULL);
    assert_true((status == PSPEC_ERROR_CANCELLED) ==
                (strstr(pspec_context_message(context), "interrupted after") != NULL));
    *num_told = counted.num;
    pspec_context_destroy(context);
    return status;
}

/* The callback is asked in the middle of every pass over the points, and every call may stop it;
 * the points are what they are without one. */
static void try_sampler(const char *name, const char *num_points, uint64_t expected) {
    const pspec_option options[] = {
        {"sampler", name}, {"points", num_points}, {"homogenize", NULL}};
    pspec_context *const context = pspec_context_create();
    pspec_sampler *sampler = NULL;
    uint64_t num_told = 0;
    assert_int_equal(pspec_sampler_create(&sampler, context, options, 3), PSPEC_OK);
    const pspec_sampler_shape shape = pspec_sampler_get_shape(sampler);
    const size_t bytes = shape.num_points * shape.dimension * sizeof(double);
    double *const points = malloc(bytes), *const plain = malloc(bytes);
    for (uint64_t stop = 0; stop < expected; stop++) {
        assert_int_equal(generate(sampler, stop, &num_told, points), PSPEC_ERROR_CANCELLED);
        assert_int_equal(num_told, stop + 1);
    }
    assert_int_equal(generate(sampler, expected, &num_told, points), PSPEC_OK);
    assert_int_equal(num_told, expected);
    assert_int_equal(pspec_sampler_generate(sampler, context, 0, plain, NULL), PSPEC_OK);
    assert_memory_equal(points, plain, bytes);
    free(points);
    free(plain);
    pspec_sampler_destroy(sampler);
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
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/a.npy", folder);
    const pspec_option options[] = {{"sampler", "white"}, {"points", "500000"}, {"output", path}};
    pspec_context *const context = pspec_context_create();
    pspec_context_set_progress(context, listen, &heard);
    assert_int_equal(pspec_sample(context, options, 3), PSPEC_ERROR_CANCELLED);
    assert_string_equal(pspec_context_message(context),
                        "interrupted after 262144 of 500000 points written");
    assert_int_equal(rmdir(folder), 0); /* it is empty */
    pspec_context_destroy(context);
}

static void kernel_sums(void **state) {
    enum { NUM = 20000 };
    (void)state;
    listener heard = {.phase = "slabs of pairs of points", .least = 2};
    pspec_context *const context = pspec_context_create();
    double *const points = test_rule_points("fibonacci-hemisphere", NUM, 0);
    const pspec_pattern pattern = {3, NUM, points, NULL};
    const pspec_kernel kernel = {NULL, 0, 0.5};
    double sum = 0, bound = 0;
    pspec_context_set_progress(context, listen, &heard);
    assert_int_equal(pspec_kernel_sums(context, &pattern, &kernel, 1, 1e-5, &sum, &bound),
                     PSPEC_ERROR_CANCELLED);
    check_end(&heard, context);
    free(points);
    pspec_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(worst_case_error),
                                       cmocka_unit_test(weights_by_gradients),
                                       cmocka_unit_test(weights_by_cholesky),
                                       cmocka_unit_test(interpolation),
                                       cmocka_unit_test(samplers),
                                       cmocka_unit_test(kernel_sums),
                                       cmocka_unit_test(written_points)};
    return cmocka_run_group_tests_name("cancel", tests, NULL, NULL);
}
