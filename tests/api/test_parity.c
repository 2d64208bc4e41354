/* The library answers as the program does: for the same patterns the same engine, described in the
 * same words, and the same bits of the spectrum. */
#include "harness_public.h"

#include "api/public_objects.h"
#include "store/figures_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { NUM_SETS = 3, MOST_ROWS = 512, TEXT = 4096, LAST_DEGREE = 12 };

static char folder[] = "/tmp/test_parity_XXXXXX";

typedef struct answer {
    char engine[TEXT]; /* "(torus_nufft ...)" */
    bool is_planned_twice;
    size_t num_rows;
    double bins[MOST_ROWS], powers[MOST_ROWS], errors[MOST_ROWS];
} answer;

/* Uniform in a cube of that size, on which depends how large powers are: a small cube is a single
 * point at low frequencies. */
typedef struct cloud {
    unsigned dimension;
    size_t num_points;
    double size;
    bool on_sphere;
    bool has_weights;
} cloud;

/* ---- patterns -------------------------------------------------------------------------------- */

static double any_coordinate(const cloud *shape, uint64_t *state) {
    const double corner = 0.3;
    return shape->on_sphere ? 2 * test_uniform(state) - 1
                            : corner + shape->size * test_uniform(state);
}

static pspec_pattern make_pattern(const cloud *shape, uint64_t seed) {
    uint64_t state = seed;
    double *points = calloc(shape->num_points * shape->dimension, sizeof *points);
    double *weights = shape->has_weights ? calloc(shape->num_points, sizeof *weights) : NULL;
    assert_non_null(points);
    for (size_t j = 0; j < shape->num_points; j++) {
        double *const point = points + j * shape->dimension;
        double square = 0;
        for (unsigned i = 0; i < shape->dimension; i++) {
            point[i] = any_coordinate(shape, &state);
            square += point[i] * point[i];
        }
        for (unsigned i = 0; shape->on_sphere && i < shape->dimension; i++) {
            point[i] /= sqrt(square);
        }
        if (weights != NULL) {
            uint64_t own = 1; /* the program has the same weights for every set */
            weights[j] = 0.5 + test_uniform(&own) + (double)(j % 5);
        }
    }
    return (pspec_pattern){shape->dimension, shape->num_points, points, weights};
}

static void free_patterns(pspec_pattern *patterns) {
    for (size_t r = 0; r < NUM_SETS; r++) {
        free((void *)(uintptr_t)patterns[r].points);
        free((void *)(uintptr_t)patterns[r].weights);
    }
}

static void write_rows(const char *name, const double *numbers, size_t num_rows,
                       unsigned num_columns) {
    char path[TEXT];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    for (size_t j = 0; j < num_rows; j++) {
        for (unsigned i = 0; i < num_columns; i++) {
            fprintf(file, "%.17g%s", numbers[j * num_columns + i],
                    i + 1 < num_columns ? " " : "\n");
        }
    }
    assert_int_equal(fclose(file), 0);
}

static void write_patterns(const pspec_pattern *patterns) {
    for (size_t r = 0; r < NUM_SETS; r++) {
        char name[32];
        snprintf(name, sizeof name, "%zu.txt", r);
        write_rows(name, patterns[r].points, patterns[r].num_points, patterns[r].dimension);
    }
    if (patterns[0].weights != NULL) {
        write_rows("weights.txt", patterns[0].weights, patterns[0].num_points, 1);
    }
}

/* ---- the program ----------------------------------------------------------------------------- */

/* Of a row "a,b,...", column i. */
static double read_column(const char *row, int i) {
    for (; i > 0 && row != NULL; i--) {
        row = strchr(row, ',');
        row = row != NULL ? row + 1 : NULL;
    }
    assert_non_null(row);
    return strtod(row, NULL);
}

static int find_column(const char *names, const char *wanted) {
    const char *at = names;
    for (int i = 0; at != NULL; i++) {
        const size_t length = strcspn(at, ",\n");
        if (strlen(wanted) == length && strncmp(at, wanted, length) == 0) {
            return i;
        }
        at = strchr(at, ',');
        at = at != NULL ? at + 1 : NULL;
    }
    fail_msg("no column %s in %s", wanted, names);
    return -1;
}

static void read_header(answer *out, const char *line) {
    if (strncmp(line, "# engine: ", 10) == 0) {
        snprintf(out->engine, sizeof out->engine, "%.*s", (int)strcspn(line + 10, "\n"), line + 10);
    }
    out->is_planned_twice = out->is_planned_twice || strncmp(line, "# planned_twice:", 16) == 0;
}

static answer *ask_program(const char *words, const char *power, const char *error) {
    answer *const out = calloc(1, sizeof *out);
    char line[TEXT];
    char names[TEXT] = "";
    assert_non_null(out);
    snprintf(line, sizeof line, "cd %s && '%s' %s", folder, TEST_PROGRAM, words);
    FILE *const table = popen(line, "r");
    assert_non_null(table);
    while (fgets(line, sizeof line, table) != NULL) {
        if (line[0] == '#') {
            read_header(out, line);
        } else if (names[0] == '\0') {
            memcpy(names, line, sizeof names);
        } else {
            assert_true(out->num_rows < MOST_ROWS);
            out->bins[out->num_rows] = read_column(line, 0);
            out->powers[out->num_rows] = read_column(line, find_column(names, power));
            out->errors[out->num_rows++] = read_column(line, find_column(names, error));
        }
    }
    assert_int_equal(pclose(table), 0);
    assert_true(out->num_rows > 0);
    return out;
}

/* ---- the same -------------------------------------------------------------------------------- */

static void check_number(const char *what, size_t row, double found, double expected) {
    if (!(found == expected) && !(isnan(found) && isnan(expected))) {
        fail_msg("%s of row %zu is %.17g, of the program %.17g", what, row, found, expected);
    }
}

static void check_spectrum(pspec_context *context, pspec_plan *plan, const answer *expected) {
    pspec_spectrum *spectrum = NULL;
    size_t num = 0;
    if (pspec_spectrum_create(&spectrum, plan) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    const pspec_bin *const bins = pspec_spectrum_bins(spectrum, &num);
    assert_string_equal(pspec_plan_text(plan), expected->engine);
    assert_int_equal(num, expected->num_rows);
    for (size_t b = 0; b < num; b++) {
        check_number("the bin", b, (double)bins[b].bin, expected->bins[b]);
        check_number("the power", b, bins[b].power, expected->powers[b]);
        check_number("the standard error", b, bins[b].standard_error, expected->errors[b]);
    }
    pspec_spectrum_destroy(spectrum);
}

/* In one call and in several, after a reset, too. */
static void check_plan(pspec_context *context, pspec_plan *plan, const pspec_pattern *patterns,
                       const answer *expected) {
    assert_int_equal(pspec_plan_run(plan, patterns, NUM_SETS), PSPEC_OK);
    check_spectrum(context, plan, expected);
    assert_int_equal(pspec_plan_reset(plan), PSPEC_OK);
    for (size_t r = 0; r < NUM_SETS; r++) {
        assert_int_equal(pspec_plan_run(plan, &patterns[r], 1), PSPEC_OK);
    }
    check_spectrum(context, plan, expected);
}

static void compare_power(const cloud *shape, const pspec_power_request *request, const char *words,
                          bool is_planned_twice) {
    pspec_context *const context = test_public_context();
    pspec_plan *plan = NULL;
    pspec_pattern patterns[NUM_SETS];
    for (size_t r = 0; r < NUM_SETS; r++) {
        patterns[r] = make_pattern(shape, r + 1);
    }
    write_patterns(patterns);
    answer *const expected = ask_program(words, "power", "standard_error");
    assert_int_equal(expected->is_planned_twice, is_planned_twice);
    if (pspec_plan_create(&plan, context, request) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    check_plan(context, plan, patterns, expected);
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    free_patterns(patterns);
    free(expected);
}

static void compare_angular(const cloud *shape, const pspec_angular_request *request,
                            const char *words, const char *power, const char *error) {
    pspec_context *const context = test_public_context();
    pspec_plan *plan = NULL;
    pspec_pattern patterns[NUM_SETS];
    for (size_t r = 0; r < NUM_SETS; r++) {
        patterns[r] = make_pattern(shape, r + 1);
    }
    write_patterns(patterns);
    answer *const expected = ask_program(words, power, error);
    if (pspec_plan_create_angular(&plan, context, request) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    check_plan(context, plan, patterns, expected);
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    free_patterns(patterns);
    free(expected);
}

/* ---- questions ------------------------------------------------------------------------------- */

static void on_the_torus(void **state) {
    (void)state;
    const cloud shape = {.dimension = 2, .num_points = 300, .size = 0.6};
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    request.num_points = shape.num_points;
    request.max_frequency = 24;
    request.rings_only = 1;
    compare_power(&shape, &request, "power 0.txt 1.txt 2.txt -k 24", false);
    request.rings_only = 0;
    compare_power(&shape, &request, "power 0.txt 1.txt 2.txt -k 24 --full full.npy", false);
}

static void with_weights(void **state) {
    (void)state;
    const cloud shape = {.dimension = 2, .num_points = 200, .size = 0.6, .has_weights = true};
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    request.num_points = shape.num_points;
    request.max_frequency = 16;
    request.rings_only = 1;
    compare_power(&shape, &request, "power 0.txt 1.txt 2.txt -k 16 --weights weights.txt", false);
}

/* Points that are close together have powers near N. */
static void powers_that_are_large(void **state) {
    (void)state;
    const cloud shape = {.dimension = 2, .num_points = 1024, .size = 1e-4};
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    request.num_points = shape.num_points;
    request.max_frequency = 8;
    request.rings_only = 1;
    compare_power(&shape, &request, "power 0.txt 1.txt 2.txt -k 8 --tol 1e-6", true);
    request.floor = 1e-6;
    compare_power(&shape, &request, "power 0.txt 1.txt 2.txt -k 8 --tol 1e-6 --floor 1e-6", true);
}

static void on_the_sphere(void **state) {
    (void)state;
    const cloud shape = {.dimension = 3, .num_points = 200, .on_sphere = true};
    pspec_angular_request request = PSPEC_ANGULAR_REQUEST_INIT;
    request.num_points = shape.num_points;
    request.max_degree = LAST_DEGREE;
    compare_angular(&shape, &request, "angular 0.txt 1.txt 2.txt -l 12", "power", "standard_error");
    request.normalization = PSPEC_NORMALIZATION_PAIRS;
    compare_angular(&shape, &request, "pairs 0.txt 1.txt 2.txt -l 12", "legendre_sum",
                    "legendre_sum_error");
}

/* What was measured of a device lies where the program keeps it, and the library reads it there. */
static void with_calibrated_figures(void **state) {
    pspec_context *const context = test_public_context();
    ps_device *const device = test_open_device();
    ps_figures figures = {.is_measured = true};
    ps_figures_row(&figures, "torus_nufft")->scales[PS_SINGLE] = 1.0 / 3;
    assert_ok(ps_figures_write(folder, &figures, ps_device_get_limits(device), error));
    ps_device_close(device);
    assert_int_equal(ps_context_open_device(context), PSPEC_OK);
    const ps_figures *const found = ps_device_get_limits(context->device)->figures;
    assert_non_null(found);
    assert_true(found->is_measured);
    pspec_context_destroy(context);
    on_the_torus(state);
    powers_that_are_large(state);
}

static int make_folder(void **state) {
    (void)state;
    assert_non_null(mkdtemp(folder));
    return setenv("POINTSPEC_CACHE_DIR", folder, 1);
}

static int remove_folder(void **state) {
    (void)state;
    char command[TEXT];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(on_the_torus),
        cmocka_unit_test(with_weights),
        cmocka_unit_test(powers_that_are_large),
        cmocka_unit_test(on_the_sphere),
        cmocka_unit_test(with_calibrated_figures),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
