/* A sampler and a file of its sets are one question: the same bits through every engine in every
 * precision, of one set as of several, with the vectors of AVX2 and of AVX-512. Sets that come but
 * once can be read again, all of them, unless they are too many.
 */
#include "harness.h"

#include "jobs/quadrature/quadrature_job.h"
#include "jobs/spectrum/power_job.h"
#include "test_folder.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { NUM_POINTS = 40, MOST_SETS = 3, LAST = 9 };

static ps_device *device;
static const test_folder *folder;
static size_t num_compared;

/* The same points both ways; *request must not be moved. */
typedef struct both_ways {
    const char *sampler;
    ps_sampler_request request;
    uint64_t num_sets;
    char path[TEST_PATH_BYTES];
    const char *paths[1];
    ps_plan_constraints constraints;
} both_ways;

static void write_file(both_ways *ways) {
    const unsigned dimension = ways->request.dimension;
    const size_t num = NUM_POINTS * dimension;
    double points[MOST_SETS * NUM_POINTS * 3];
    char shape[64];
    snprintf(shape, sizeof shape, "(%u, %d, %u)", (unsigned)ways->num_sets, NUM_POINTS, dimension);
    for (uint64_t r = 0; r < ways->num_sets; r++) {
        assert_ok(ps_sampler_generate(&ways->request, r, points + r * num, NULL, NULL, error));
    }
    ways->paths[0] = test_path(folder, "points.npy", ways->path);
    assert_true(test_write_array(ways->path, "<f8", "False", shape, points,
                                 ways->num_sets * num * sizeof *points));
}

/* ---- power, angular, pairs ----------------------------------------------------------------- */

/* Bins of the spectrum; false: the engine does not take it. */
static bool run_power(const both_ways *ways, bool from_file, bool sums_pairs,
                      ps_spectrum_bin bins[LAST], ps_mean c2[LAST + 1]) {
    const ps_power_question question = {
        .sampler = from_file ? NULL : &ways->request,
        .num_realizations = from_file ? 0 : ways->num_sets,
        .paths = from_file ? ways->paths : NULL,
        .num_paths = from_file ? 1 : 0,
        .point_options.domain = ways->request.dimension == 3 ? PS_DOMAIN_SPHERE : PS_DOMAIN_TORUS,
        .on_sphere = ways->request.dimension == 3,
        .wants_pair_sums = sums_pairs,
        .max_degree = LAST,
        .frequencies.max_frequency = LAST,
        .accuracy.tolerance = ways->constraints.precision == PS_SINGLE ? 1e-4 : 1e-9,
        .limits.constraints = ways->constraints,
        .open_device = device};
    ps_power_job *job = NULL;
    assert_ok(ps_power_job_create(&job, &question, error));
    const bool is_taken = job->plan.chosen != NULL;
    if (is_taken) {
        assert_ok(ps_power_job_run(job, error));
        const ps_spectrum *const spectrum = &job->spectrum;
        assert_true(spectrum->num_bins >= LAST);
        memcpy(bins, spectrum->bins, LAST * sizeof *bins);
        if (sums_pairs) {
            memcpy(c2, job->c2, LAST * sizeof *c2);
        }
    }
    ps_power_job_destroy(job);
    return is_taken;
}

static void compare_power(const both_ways *ways, bool sums_pairs) {
    ps_spectrum_bin expected[LAST], found[LAST];
    ps_mean expected_c2[LAST + 1] = {{0}};
    ps_mean found_c2[LAST + 1] = {{0}};
    if (run_power(ways, false, sums_pairs, expected, expected_c2)) {
        assert_true(run_power(ways, true, sums_pairs, found, found_c2));
        assert_memory_equal(found, expected, sizeof found);
        assert_memory_equal(found_c2, expected_c2, sizeof found_c2);
        num_compared++;
    }
}

/* ---- quadrature ------------------------------------------------------------------------------ */

static ps_quadrature_job *run_quadrature(const ps_quadrature_question *question) {
    ps_quadrature_job *job = NULL;
    assert_ok(ps_quadrature_job_create(&job, question, error));
    assert_ok(ps_quadrature_job_run(job, error));
    return job;
}

static void compare_quadrature(const both_ways *ways) {
    ps_brdf *brdf = NULL;
    assert_ok(ps_brdf_parse(&brdf, "diffuse", error));
    const ps_quadrature_question by_sampler = {
        .brdf = brdf,
        .smoothness = 1.5,
        .sampler = &ways->request,
        .num_realizations = ways->num_sets,
        .point_options.domain = PS_DOMAIN_SPHERE,
        .max_degree = LAST,
        .accuracy.tolerance = ways->constraints.precision == PS_SINGLE ? 1e-4 : 1e-10,
        .limits.constraints = ways->constraints,
        .open_device = device};
    ps_quadrature_question by_file = by_sampler;
    by_file.sampler = NULL;
    by_file.num_realizations = 0;
    by_file.paths = ways->paths;
    by_file.num_paths = 1;
    ps_quadrature_job *const expected = run_quadrature(&by_sampler);
    ps_quadrature_job *const found = run_quadrature(&by_file);
    const ps_quadrature_degree *const degrees = found->result.degrees;
    assert_memory_equal(degrees, expected->result.degrees, (LAST + 1) * sizeof *degrees);
    assert_memory_equal(&found->result.squared, &expected->result.squared, sizeof(ps_mean));
    ps_quadrature_job_destroy(expected);
    ps_quadrature_job_destroy(found);
    ps_brdf_destroy(brdf);
    num_compared++;
}

/* ---- every engine ---------------------------------------------------------------------------- */

static void compare_by(const ps_engine *engine, ps_precision precision, uint64_t num_sets) {
    static const struct {
        const char *sampler;
        unsigned domain;
    } samplers[] = {{"jittered", PS_ON_TORUS}, {"white-hemisphere", PS_ON_SPHERE}};
    for (size_t i = 0; i < sizeof samplers / sizeof samplers[0]; i++) {
        both_ways ways = {.request = {.num_points = NUM_POINTS, .seed = 5},
                          .num_sets = num_sets,
                          .constraints = {.engine = engine->name, .precision = (int)precision}};
        if ((engine->domains & samplers[i].domain) == 0) {
            continue;
        }
        assert_ok(ps_sampler_parse(&ways.request, samplers[i].sampler, error));
        assert_ok(ps_sampler_resolve(&ways.request, error));
        write_file(&ways);
        compare_power(&ways, false);
        if (samplers[i].domain == PS_ON_SPHERE) {
            compare_power(&ways, true);
            compare_quadrature(&ways);
        }
    }
}

static void files_have_the_bits_of_samplers(void **state) {
    static const unsigned lanes[] = {4, 8};
    folder = *state;
    for (size_t e = 0; ps_engines[e] != NULL; e++) {
        num_compared = 0;
        for (int precision = PS_SINGLE; precision <= PS_EXTENDED; precision++) {
            for (size_t i = 0; i < 2 && ps_engines[e]->has_precision[precision]; i++) {
                ps_device_set_native_lanes(device, lanes[i]);
                compare_by(ps_engines[e], (ps_precision)precision, 1);
                compare_by(ps_engines[e], (ps_precision)precision, MOST_SETS);
            }
        }
        assert_true(num_compared > 0);
    }
    ps_device_set_native_lanes(device, 0);
}

/* ---- streams --------------------------------------------------------------------------------- */

/* Sets in a pipe have so many points, more than a block, and fit into its buffer together. */
enum { STREAMED_POINTS = 1100, STREAMED_SETS = 3, STREAMED_NUMBERS = 2 * STREAMED_POINTS };

typedef struct stream {
    double points[STREAMED_SETS * STREAMED_NUMBERS];
    int reading;
    char path[32];
    const char *paths[1];
    ps_source *source;
    ps_point_set set;
} stream;

static void open_stream(stream *s, const ps_source_options *options) {
    int ends[2];
    char writing[sizeof s->path];
    uint64_t random = 3;
    *s = (stream){.paths = {s->path}};
    for (size_t i = 0; i < sizeof s->points / sizeof s->points[0]; i++) {
        s->points[i] = test_uniform(&random);
    }
    assert_int_equal(pipe(ends), 0);
    s->reading = ends[0];
    snprintf(s->path, sizeof s->path, "/dev/fd/%d", ends[0]);
    snprintf(writing, sizeof writing, "/dev/fd/%d", ends[1]);
    assert_true(
        test_write_array(writing, "<f8", "False", "(3, 1100, 2)", s->points, sizeof s->points));
    assert_int_equal(close(ends[1]), 0);
    assert_ok(ps_source_files(&s->source, s->paths, 1, options, error));
}

static void close_stream(stream *s) {
    ps_source_destroy(s->source);
    ps_point_set_free(&s->set);
    assert_int_equal(close(s->reading), 0);
}

/* The next sets are those of these numbers; end STREAMED_SETS: there are no more. */
static void must_come(stream *s, size_t first, size_t end) {
    ps_source_part part;
    bool has_set = true;
    for (size_t r = first; r < end; r++) {
        assert_ok(ps_source_next(s->source, &s->set, &part, &has_set, error));
        assert_true(has_set);
        assert_ok(ps_source_more(s->source, &s->set, SIZE_MAX, &part.is_whole, error));
        assert_int_equal(s->set.num_points, STREAMED_POINTS);
        assert_memory_equal(s->set.points, s->points + r * STREAMED_NUMBERS,
                            STREAMED_NUMBERS * sizeof(double));
    }
    if (end == STREAMED_SETS) {
        assert_ok(ps_source_next(s->source, &s->set, &part, &has_set, error));
        assert_false(has_set);
    }
}

/* Wherever it is rewound, and whether sets are so large that those of files come in blocks. */
static void streams_are_read_again(void **state) {
    (void)state;
    const ps_source_options options[] = {{.points = {0}},
                                         {.whole_bytes = 1, .kept_bytes = UINT64_MAX}};
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) {
        stream s;
        open_stream(&s, &options[i]);
        static const size_t ends[] = {0, 1, 1, 2, 1, STREAMED_SETS, 2, STREAMED_SETS};
        for (size_t j = 0; j < sizeof ends / sizeof ends[0]; j++) {
            must_come(&s, 0, ends[j]);
            assert_ok(ps_source_rewind(s.source, error));
        }
        close_stream(&s);
    }
}

/* As many bytes as are kept, and one less. */
static void streams_are_kept_up_to_a_limit(void **state) {
    (void)state;
    for (uint64_t lacking = 0; lacking < 2; lacking++) {
        const ps_source_options options = {.kept_bytes =
                                               2 * STREAMED_NUMBERS * sizeof(double) - lacking};
        ps_error reason;
        stream s;
        open_stream(&s, &options);
        must_come(&s, 0, 2);
        assert_int_equal(ps_source_can_rewind(s.source), lacking == 0);
        must_come(&s, 2, STREAMED_SETS);
        assert_int_equal(ps_source_check_rewind(s.source, "why", &reason), PSPEC_ERROR_TOLERANCE);
        assert_non_null(strstr(reason.message, "why; they are to be read again, but"));
        assert_int_equal(ps_source_rewind(s.source, &reason), PSPEC_ERROR_IO);
        close_stream(&s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(files_have_the_bits_of_samplers, test_folder_create,
                                        test_folder_remove),
        cmocka_unit_test(streams_are_read_again),
        cmocka_unit_test(streams_are_kept_up_to_a_limit),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("sources", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
