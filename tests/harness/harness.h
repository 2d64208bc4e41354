/* What several tests need: reference files, a device, one-shot spectra. */
#ifndef TESTS_HARNESS_H
#define TESTS_HARNESS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "device/device.h"
#include "engines/engine.h"

#include <cjson/cJSON.h>

/* Exit status that CTest counts as skipped. */
enum { TEST_SKIPPED = 77 };

/* Runs a call whose last argument is written `error`, and shows its sentence when it fails.
 * (Callers may have an `error` of their own for calls that must fail: hence the pragma.) */
#define assert_ok(call)                                                                            \
    do {                                                                                           \
        _Pragma("GCC diagnostic push") _Pragma("GCC diagnostic ignored \"-Wshadow\"");             \
        ps_error test_error = {0};                                                                 \
        ps_error *const error = &test_error;                                                       \
        if ((call) != PSPEC_OK) {                                                                  \
            fail_msg("%s: %s", #call, error->message);                                             \
        }                                                                                          \
        _Pragma("GCC diagnostic pop");                                                             \
    } while (0)

/* Parses tests/reference/NAME; the caller deletes it. */
cJSON *test_read_reference(const char *name);
/* A number, or a decimal string. */
double test_number(const cJSON *item);
long double test_long_number(const cJSON *item);
double test_field(const cJSON *object, const char *key);

/* One pattern of torus.json; the arrays are freed by test_free_set. */
typedef struct test_set {
    const char *name;
    unsigned dimension;
    size_t num_points;
    double *points, *weights; /* weights NULL: unit */
    double weight_sum, weight_square_sum, weight_size_sum;
    const cJSON *json;
} test_set;

test_set test_read_set(const cJSON *json);
void test_free_set(test_set *set);
pspec_pattern test_pattern(const test_set *set);

/* Opens the default device, or ends the test program as skipped when there is none. */
ps_device *test_open_device(void);
/* The same, which works as GPUs do, in groups of test_group, and counts launches. */
ps_device *test_open_gpu(void);
/* Launches so far of such a device, of kernels whose names begin with the words. */
uint64_t test_count_launches(const ps_device *device, const char *words);

/* Items of a work-group as GPUs have them: POINTSPEC_TEST_GROUP, which .ci/run draws from 32 to
 * 512, else `usual`. */
size_t test_group(size_t usual);

/* Runs an engine on patterns with scale 1 and returns |S|^2 as [pattern][frequency], freed by the
 * caller. batch: capacity of the engine. */
double *test_run_engine(const ps_engine *engine, ps_precision precision, ps_device *device,
                        const ps_frequencies *frequencies, const pspec_pattern *patterns,
                        size_t num_patterns, size_t batch);

/* The same for engines that work as exactly as asked. */
double *test_run_engine_to(const ps_engine *engine, ps_precision precision, double tolerance,
                           ps_device *device, const ps_frequencies *frequencies,
                           const pspec_pattern *patterns, size_t num_patterns, size_t batch);

/* The same for any problem; batch: patterns in one run. */
double *test_run_problem(const ps_engine *engine, const ps_problem *problem, ps_precision precision,
                         ps_device *device, const pspec_pattern *patterns, size_t num_patterns,
                         size_t batch);

/* One run of an engine that is there, into [pattern][frequency]; and rows that it gave. */
void test_run_batch(const ps_engine *engine, void *state, const ps_frequencies *frequencies,
                    ps_device *device, const ps_batch *batch, double *powers);
void test_read_rows(const ps_engine *engine, const void *state, const ps_frequencies *frequencies,
                    ps_device *device, const ps_rows *rows, double *powers);

/* The expected error of an engine that is made for the problem, for a set of some mean power. */
double test_engine_error(const ps_engine *engine, const ps_problem *problem, ps_precision precision,
                         ps_device *device, double mean_power);

/* The largest is made a number in [1/2, 1), as jobs do by the exponents of a batch. */
void test_normalize_weights(double *weights, size_t num);

/* Reproducible numbers in [0,1) for tests that must not depend on math/random. */
double test_uniform(uint64_t *state);

/* Seconds that all processors together have worked for this process: unlike those of the clock they
 * do not pass faster where other processes are in the way. */
double test_own_seconds(void);

#endif
