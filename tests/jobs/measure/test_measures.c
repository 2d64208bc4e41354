/* Measures of known sets: closed forms, laws of white, jittered and regular points, published sets,
 * the same bits whatever makes them. */
#include "harness.h"

#include "jobs/measure/measure_job.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device, *gpu;

/* ---- asking ---------------------------------------------------------------------------------- */

typedef struct asked {
    ps_sampler_request sampler;
    ps_measure_question question;
    ps_measure_result result;
} asked;

static void ask(asked *out, const char *sampler, size_t num_points, uint64_t num_realizations,
                const char *names, ps_device *with) {
    *out = (asked){.sampler = {.num_points = num_points, .seed = 3}};
    assert_ok(ps_sampler_parse(&out->sampler, sampler, error));
    assert_ok(ps_sampler_resolve(&out->sampler, error));
    out->question =
        (ps_measure_question){.spectrum = {.sampler = &out->sampler,
                                           .on_sphere = ps_sampler_is_on_sphere(&out->sampler),
                                           .num_realizations = num_realizations,
                                           .reach = 6.5,
                                           .bins_alone = true,
                                           .accuracy = {.tolerance = 1e-6},
                                           .limits = {.constraints = {.precision = -1}},
                                           .open_device = with},
                              .are_named = names != NULL};
    assert_ok(ps_measures_parse(&out->question.wanted, names, error));
    assert_ok(ps_measure_run(&out->result, &out->question, error));
}

static size_t find(const char *name) {
    size_t i = 0;
    while (i < PS_NUM_MEASURES && strcmp(ps_measure_rows[i].name, name) != 0) {
        i++;
    }
    assert_true(i < PS_NUM_MEASURES);
    return i;
}

static ps_mean value_of(const asked *self, const char *name) {
    return self->result.values[find(name)];
}

static void near(const char *what, double found, double expected, double allowed) {
    if (!(fabs(found - expected) <= allowed)) {
        fail_msg("%s: %.17g, not %.17g within %g", what, found, expected, allowed);
    }
}

/* ---- closed forms ---------------------------------------------------------------------------- */

/* A square grid: its distances, cells, and the peak where its frequencies are. */
static void a_square_grid_is_what_it_is(void **state) {
    asked grid;
    (void)state;
    ask(&grid, "regular", 256, 3, NULL, device);
    const double square = sqrt(sqrt(3) / 2); /* over the distance of a hexagonal packing */
    near("least", value_of(&grid, "least_distance").mean, square, 1e-14);
    near("mean", value_of(&grid, "mean_distance").mean, square, 1e-14);
    near("cells", value_of(&grid, "capacity_error").mean, 0, 1e-13);
    near("coincident", value_of(&grid, "coincident_points").mean, 0, 0);
    near("error", value_of(&grid, "mean_distance").standard_error, 0, 0);
    assert_int_equal(grid.result.num_realizations, 3);
    /* 16 places of a product of the plane: sums over one axis, to the square */
    double star = 0, boxes = 0, periodic = 0;
    for (int i = 0; i < 16; i++) {
        const double x = (i + 0.5) / 16;
        boxes += (1 - x * x) / 2;
        for (int j = 0; j < 16; j++) {
            const double y = (j + 0.5) / 16, apart = fabs(x - y);
            star += 1 - fmax(x, y);
            periodic += 0.5 - apart * (1 - apart);
        }
    }
    near("star", value_of(&grid, "star_discrepancy").mean,
         sqrt(1.0 / 9 - 2.0 / 256 * boxes * boxes + star * star / 65536), 1e-12);
    near("periodic", value_of(&grid, "periodic_discrepancy").mean,
         sqrt(periodic * periodic / 65536 - 1.0 / 9), 1e-12);
    ps_measure_result_free(&grid.result);
}

/* What N points can have at most is had by the best sets of few points. */
static void largest_distances_are_reached(void **state) {
    (void)state;
    near("triangle", ps_measure_largest_distance(3, 3, true), sqrt(3), 1e-15);
    near("tetrahedron", ps_measure_largest_distance(4, 3, true), sqrt(8.0 / 3), 1e-15);
    near("octahedron", ps_measure_largest_distance(6, 3, true), sqrt(2), 1e-15);
    near("icosahedron", ps_measure_largest_distance(12, 3, true), 1 / sin(2 * PS_PI / 5), 1e-15);
    near("pair", ps_measure_largest_distance(2, 3, true), 2, 0);
    near("line", ps_measure_largest_distance(7, 1, false), 1.0 / 7, 1e-16);
    near("hexagons", ps_measure_largest_distance(9, 2, false), sqrt(2 / (sqrt(3) * 9)), 1e-15);
    near("fcc", ps_measure_largest_distance(4, 3, false), sqrt(0.5), 1e-15); /* of the unit cube */
    near("D4", ps_measure_largest_distance(2, 4, false), 1, 1e-15); /* cubes and their centres */
}

/* ---- laws ------------------------------------------------------------------------------------ */

static void near_error(const asked *of, const char *name, double expected, double more) {
    const ps_mean found = value_of(of, name);
    assert_true(found.standard_error > 0);
    near(name, found.mean, expected, 4 * found.standard_error + more);
}

/* Poisson-Voronoi cells: the variance of the area is 0.280176 (Gilbert 1962, Hayen and Quine 2002).
 * The mean nearest distance of N white points of the unit torus is 1/(2 sqrt N), nearly. */
static void white_points_are_white(void **state) {
    enum { NUM = 500 };
    asked white;
    (void)state;
    ask(&white, "white", NUM, 60, NULL, device);
    const double radius = white.result.reach / (2 * sqrt(NUM));
    near_error(&white, "capacity_error", sqrt(0.280176), 0.003);
    near_error(&white, "mean_distance",
               0.5 / sqrt(NUM) / ps_measure_largest_distance(NUM, 2, false), 0.001);
    near_error(&white, "number_variance", 1 - PS_PI * radius * radius, 0);
    near_error(&white, "peak_power", 1.1, 0.3);
    near("plateau",
         value_of(&white, "hyperuniformity_index").mean * value_of(&white, "peak_power").mean, 1,
         0.15);
    assert_true(isnan(value_of(&white, "low_exponent").mean));
    for (size_t b = 0; b < NEAR_BINS; b++) {
        const ps_mean g = white.result.correlation[b];
        near("g", g.mean, 1, 5 * g.standard_error + (b < 3 ? 1 : 0));
    }
    ps_measure_result_free(&white.result);
}

/* <star^2> of N white points is (2^-d - 3^-d) / N, <periodic^2> the same; Stolarsky's sum 4/3 (1 -
 * 1/N). */
static void white_discrepancies_are_known(void **state) {
    enum { NUM = 100, SETS = 400 };
    asked white, sphere;
    (void)state;
    ask(&white, "white", NUM, SETS, "star_discrepancy,periodic_discrepancy", device);
    const ps_mean star = value_of(&white, "star_discrepancy");
    const ps_mean periodic = value_of(&white, "periodic_discrepancy");
    const double square = 5.0 / 36 / NUM;
    /* <x^2> = <x>^2 + M s.e.^2 */
    near("star", star.mean * star.mean + SETS * star.standard_error * star.standard_error, square,
         8 * star.mean * star.standard_error);
    near("periodic",
         periodic.mean * periodic.mean + SETS * periodic.standard_error * periodic.standard_error,
         square, 8 * periodic.mean * periodic.standard_error);
    ask(&sphere, "white-sphere", NUM, SETS, "stolarsky_sum,cap_discrepancy", device);
    near_error(&sphere, "stolarsky_sum", 4.0 / 3 * (1 - 1.0 / NUM), 0);
    assert_null(white.result.spectrum);
    ps_measure_result_free(&white.result);
    ps_measure_result_free(&sphere.result);
}

/* N star of jittered points at N = 64, 256: 1.17 and 1.64, means of ten; P ~ nu^2 to 0. */
static void jittered_points_are_known(void **state) {
    asked jittered;
    (void)state;
    ask(&jittered, "jittered", 256, 40, NULL, device);
    near("N star", 256 * value_of(&jittered, "star_discrepancy").mean, 1.64, 0.06);
    near_error(&jittered, "low_exponent", 2, 0.1);
    near_error(&jittered, "hyperuniformity_index", 0, 0.002);
    assert_true(value_of(&jittered, "oscillation").mean < 0.3);
    ps_measure_result_free(&jittered.result);
    ask(&jittered, "jittered", 64, 40, "star_discrepancy", device);
    near("N star", 64 * value_of(&jittered, "star_discrepancy").mean, 1.17, 0.05);
    ps_measure_result_free(&jittered.result);
}

/* Regular in one sense or other: what measures are for. */
static void better_sets_measure_better(void **state) {
    static const char *const better[] = {"bnot", "poisson-disk", "jittered", "white"};
    double oscillation = INFINITY, distance = INFINITY, nyquist = INFINITY;
    (void)state;
    for (size_t i = 0; i < sizeof better / sizeof better[0]; i++) {
        asked of;
        ask(&of, better[i], 256, 8, NULL, device);
        assert_true(value_of(&of, "mean_distance").mean < distance);
        assert_true(value_of(&of, "effective_nyquist").mean < nyquist);
        assert_true(value_of(&of, "oscillation").mean <= oscillation);
        distance = value_of(&of, "mean_distance").mean;
        nyquist = value_of(&of, "effective_nyquist").mean;
        oscillation = value_of(&of, "oscillation").mean;
        ps_measure_result_free(&of.result);
    }
}

/* ---- bits, names ----------------------------------------------------------------------------- */

/* A GPU's layout has its own engine for the spectrum, and the same sums over pairs. */
static void layouts_agree(void **state) {
    static const char *const samplers[] = {"jittered", "zphi"};
    (void)state;
    for (size_t s = 0; s < 2; s++) {
        asked first, second;
        ask(&first, samplers[s], 192, 8, NULL, device);
        ask(&second, samplers[s], 192, 8, NULL, gpu);
        for (size_t i = 0; i < PS_NUM_MEASURES; i++) {
            const ps_mean a = first.result.values[i], b = second.result.values[i];
            assert_true(isnan(a.mean) == isnan(b.mean));
            near(ps_measure_rows[i].name, isnan(a.mean) ? 0 : a.mean - b.mean, 0,
                 ps_measure_rows[i].of_spectrum != NULL ? 1e-4 : 1e-12);
        }
        for (size_t b = 0; b < NEAR_BINS; b++) {
            assert_true(first.result.correlation[b].mean == second.result.correlation[b].mean);
        }
        ps_measure_result_free(&first.result);
        ps_measure_result_free(&second.result);
    }
}

static void names_are_looked_up(void **state) {
    ps_measure_set set = 0;
    ps_error failure = {0};
    (void)state;
    assert_ok(ps_measures_parse(&set, "separation,least_distance", error));
    assert_int_equal(set, 1U << find("separation") | 1U << find("least_distance"));
    assert_int_equal(ps_measures_parse(&set, "least", &failure), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(failure.message, "\"least\" is no measure; known are least_distance"));
    assert_int_equal(ps_measures_parse(&set, "", &failure), PSPEC_ERROR_INVALID_ARGUMENT);
    for (size_t i = 0; i < PS_NUM_MEASURES; i++) {
        const ps_measure_row *const row = &ps_measure_rows[i];
        assert_true((row->of_set == NULL) != (row->of_spectrum == NULL));
        assert_true(row->on_torus || row->on_sphere);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_square_grid_is_what_it_is),
        cmocka_unit_test(largest_distances_are_reached),
        cmocka_unit_test(white_points_are_white),
        cmocka_unit_test(white_discrepancies_are_known),
        cmocka_unit_test(jittered_points_are_known),
        cmocka_unit_test(better_sets_measure_better),
        cmocka_unit_test(layouts_agree),
        cmocka_unit_test(names_are_looked_up),
    };
    device = test_open_device();
    if (!ps_device_get_limits(device)->has_fp64) {
        print_message("skipped: measures need doubles\n");
        return TEST_SKIPPED;
    }
    gpu = test_open_gpu();
    const int failures = cmocka_run_group_tests_name("measures", tests, NULL, NULL);
    ps_device_close(device);
    ps_device_close(gpu);
    return failures;
}
