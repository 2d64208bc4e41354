/* Sets that come in blocks: the same bits as sets in memory, whatever the blocks, in any file; one
 * clear error for what is wrong in the middle of them.
 */
#include "harness_estimator.h"

#include "engines/engine.h"
#include "files/npy_array.h"
#include "jobs/spectrum/power_job.h"
#include "points/points.h"

#include "test_folder.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A grid is chosen, and its chunks have 307200 points: two and a part. */
enum { NUM_POINTS = 700000, K = 250, BYTES = 16 * 50000 };

static char path[TEST_PATH_BYTES];
static const test_folder *folder;
static uint64_t calls;
static const char *weights_path; /* of a file besides, or NULL */
static bool is_checked;          /* by the referee, who takes longer than the rest */

static void write_sets(const char *name, size_t num_sets, size_t num_points, bool has_weights) {
    uint64_t state = 5;
    ps_point_writer *writer = NULL;
    ps_point_set set = {.dimension = 2, .num_points = num_points, .has_weights = has_weights};
    const ps_point_shape shape = {
        .num_sets = num_sets, .num_points = num_points, .dimension = 2, .has_weights = has_weights};
    test_path(folder, name, path);
    assert_ok(ps_points_reserve(&set, num_points, error));
    assert_ok(ps_points_create(&writer, path, NULL, &shape, error));
    for (size_t r = 0; r < num_sets; r++) {
        for (size_t i = 0; i < 2 * num_points; i++) {
            set.points[i] = test_uniform(&state);
        }
        for (size_t j = 0; has_weights && j < num_points; j++) { /* the largest comes last */
            set.weights[j] = (test_uniform(&state) - 0.25) * (double)(j + 1);
        }
        assert_ok(ps_points_write(writer, &set, true, error));
    }
    assert_ok(ps_points_commit(writer, error));
    ps_points_discard(writer);
    ps_point_set_free(&set);
}

static int count_calls(const ps_watch_report *report, void *payload) {
    const uint64_t *limit = payload;
    (void)report;
    return ++calls > *limit;
}

typedef struct result {
    ps_spectrum_bin *bins;
    size_t num;
} result;

/* whole_bytes 0: in memory. */
static pspec_status run(uint64_t whole_bytes, bool weight_column, uint64_t most_calls, result *out,
                        ps_error *error) {
    static const char *paths[1];
    paths[0] = path;
    const ps_power_question question = {
        .paths = paths,
        .num_paths = 1,
        .point_options = {.weight_column = weight_column},
        .whole_bytes = whole_bytes,
        .weights = {.path = weights_path},
        .frequencies.max_frequency = K,
        .accuracy = {.tolerance = 1e-4, .no_self_check = !is_checked},
        .limits.constraints = {.engine = "torus_nufft", .precision = PS_SINGLE},
        .limits.device = getenv("POINTSPEC_DEVICE"),
        .watch = {count_calls, &most_calls},
    };
    ps_power_job *job = NULL;
    calls = 0;
    pspec_status status = ps_power_job_create(&job, &question, error);
    if (status == PSPEC_OK) {
        assert_true((job->problem.block_points > 0) == (whole_bytes > 0));
        status = ps_power_job_run(job, error);
    }
    if (status == PSPEC_OK && out != NULL) {
        const ps_spectrum *spectrum = &job->spectrum;
        assert_non_null(strstr(ps_text_string(&job->description), "gridded"));
        out->num = spectrum->num_bins;
        out->bins = calloc(out->num, sizeof *out->bins);
        memcpy(out->bins, spectrum->bins, out->num * sizeof *out->bins);
    }
    ps_power_job_destroy(job);
    return status;
}

static void compare(bool weight_column) {
    static const uint64_t blocks[] = {BYTES, 1, 8 * BYTES + 8};
    result expected = {0};
    assert_ok(run(0, weight_column, UINT64_MAX, &expected, error));
    for (size_t i = 0; i < sizeof blocks / sizeof blocks[0]; i++) {
        result found = {0};
        assert_ok(run(blocks[i], weight_column, UINT64_MAX, &found, error));
        assert_int_equal(found.num, expected.num);
        assert_memory_equal(found.bins, expected.bins, found.num * sizeof *found.bins);
        free(found.bins);
    }
    free(expected.bins);
}

/* One reading where the file tells the size, two where it does not or where there are weights. */
static void blocks_change_nothing(void **state) {
    folder = *state;
    write_sets("points.npy", 2, NUM_POINTS, false);
    compare(false);
    write_sets("points.bin", 1, NUM_POINTS, false);
    compare(false);
    write_sets("points.csv", 2, NUM_POINTS, false);
    compare(false);
    write_sets("weights.npy", 2, NUM_POINTS, true);
    is_checked = true;
    compare(true);
    is_checked = false;
}

/* The same weights for every set, as many as it has points. */
static void weights_of_a_file(void **state) {
    folder = *state;
    char name[TEST_PATH_BYTES];
    double *weights = calloc(NUM_POINTS, sizeof *weights);
    uint64_t random = 9;
    for (size_t j = 0; j < NUM_POINTS; j++) {
        weights[j] = (test_uniform(&random) - 0.25) * (double)(NUM_POINTS - j);
    }
    const ps_npy_array alone = {1, {NUM_POINTS}, NUM_POINTS, false, weights};
    assert_ok(ps_npy_write_array(test_path(folder, "alone.npy", name), &alone, error));
    weights_path = name;
    write_sets("points.npy", 2, NUM_POINTS, false);
    compare(false);
    write_sets("points.npy", 1, NUM_POINTS - 1, false);
    ps_error error = {0};
    assert_int_equal(run(BYTES, false, UINT64_MAX, NULL, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "holds 700000 weights, but a set has 699999 points"));
    weights_path = NULL;
    free(weights);
}

typedef struct blocks {
    pspec_pattern pattern;
    size_t position;
} blocks;

static pspec_status next_block(void *payload, size_t unit, pspec_pattern *block, ps_error *error) {
    blocks *source = payload;
    (void)error;
    const size_t left = source->pattern.num_points - source->position;
    *block = source->pattern;
    block->num_points = left < unit ? left : unit;
    block->points += source->position * block->dimension;
    source->position += block->num_points;
    return PSPEC_OK;
}

/* What was announced and what comes are not the same: nothing is added. */
static void sets_that_change(void **state) {
    (void)state;
    enum { MANY = 5000000, SOME = 300000 };
    ps_device *device = test_open_device();
    ps_frequencies grid = test_make_lattice(2, 9, true);
    test_sample what = test_make_sample(1, 2, SOME, 0, false);
    ps_estimator_options options = test_make_options(&grid, &ps_torus_nufft, PS_SINGLE, MANY, 1);
    options.problem.tolerance = 1e-6;
    ps_estimator *estimator = NULL;
    assert_ok(ps_estimator_create(&estimator, &options, device, error));
    assert_true(ps_estimator_can_stream(estimator));
    for (uint64_t announced = SOME - 1; announced <= SOME + 1; announced++) {
        ps_error error = {0};
        blocks source = {.pattern = what.patterns[0]};
        const double sum = (double)announced;
        const ps_pattern_stream stream = {
            2, announced, {0, true, sum, sum, sum, 0}, next_block, &source};
        const bool is_right = announced == SOME;
        assert_int_equal(ps_estimator_add_stream(estimator, &stream, &error),
                         is_right ? PSPEC_OK : PSPEC_ERROR_INPUT);
        assert_true(is_right || strstr(error.message, "changed while it was read") != NULL);
    }
    assert_int_equal(ps_estimator_num_realizations(estimator), 1);
    ps_estimator_destroy(estimator);
    test_free_sample(&what);
    ps_frequencies_free(&grid);
    ps_device_close(device);
}

/* Line `line` of the file becomes another one. */
static void spoil_line(size_t line, const char *text) {
    char command[2 * TEST_PATH_BYTES];
    snprintf(command, sizeof command, "sed -i '%zus/.*/%s/' %s", line, text, path);
    assert_int_equal(system(command), 0);
}

static void errors_have_a_place(void **state) {
    folder = *state;
    ps_error error = {0};
    write_sets("spoiled.csv", 1, NUM_POINTS, false);
    spoil_line(650001, "0.5,1.5");
    assert_int_equal(run(BYTES, false, UINT64_MAX, NULL, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "line 650001"));
    assert_non_null(strstr(error.message, "1.5"));
    spoil_line(650001, "0.5,word");
    assert_int_equal(run(BYTES, false, UINT64_MAX, NULL, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "line 650001"));
    assert_null(strchr(error.message, '\n'));
}

/* Where the size is known, the bad point comes when others are on the device already. */
static void errors_in_mid_stream(void **state) {
    folder = *state;
    enum { HEADER_BYTES = 128, ROW = 680000 };
    ps_error error = {0};
    const double bad = -0.25;
    write_sets("spoiled.npy", 1, NUM_POINTS, false);
    FILE *file = fopen(path, "r+b");
    assert_non_null(file);
    assert_int_equal(fseek(file, HEADER_BYTES + 16L * ROW, SEEK_SET), 0);
    assert_int_equal(fwrite(&bad, sizeof bad, 1, file), 1);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(run(BYTES, false, UINT64_MAX, NULL, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "row 680001"));
    assert_non_null(strstr(error.message, "-0.25"));
}

/* Wherever a job is cancelled, it says so and nothing else. */
static void cancelled_anywhere(void **state) {
    folder = *state;
    write_sets("points.csv", 1, NUM_POINTS, false);
    result whole = {0};
    assert_ok(run(BYTES, false, UINT64_MAX, &whole, error));
    const uint64_t num_calls = calls;
    assert_true(num_calls > 8);
    for (uint64_t most = 0; most < num_calls; most += num_calls / 8) {
        ps_error error = {0};
        assert_int_equal(run(BYTES, false, most, NULL, &error), PSPEC_ERROR_CANCELLED);
    }
    free(whole.bins);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_change_nothing), cmocka_unit_test(weights_of_a_file),
        cmocka_unit_test(sets_that_change),      cmocka_unit_test(errors_have_a_place),
        cmocka_unit_test(errors_in_mid_stream),  cmocka_unit_test(cancelled_anywhere),
    };
    ps_device_close(test_open_device());
    return cmocka_run_group_tests_name("streams", tests, test_folder_create, test_folder_remove);
}
