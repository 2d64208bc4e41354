/* Empty pieces of axes: found where points are of a smaller box, never of samplers. */
#include "harness_estimator.h"

#include "jobs/spectrum/power_sets.h"
#include "samplers/sampler.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool find(const double *points, unsigned dimension, size_t num, ps_empty_axis *out) {
    ps_axis_cells cells = {0};
    const pspec_pattern halves[] = {{dimension, num / 2, points, NULL},
                                    {dimension, num - num / 2, points + num / 2 * dimension, NULL}};
    ps_axis_cells_add(&cells, &halves[0]);
    ps_axis_cells_add(&cells, &halves[1]);
    return ps_axis_cells_find_empty(&cells, out);
}

/* Uniform points of [begin, begin + length) mod 1 on the second axis. */
static bool find_within(size_t num, double begin, double length, ps_empty_axis *out) {
    test_sample what = test_make_sample(1, 2, num, 0, false);
    double *const points = malloc(2 * num * sizeof *points);
    memcpy(points, what.patterns[0].points, 2 * num * sizeof *points);
    for (size_t j = 0; j < num; j++) {
        points[2 * j + 1] = fmod(begin + length * points[2 * j + 1], 1);
    }
    const bool is_found = find(points, 2, num, out);
    free(points);
    test_free_sample(&what);
    return is_found;
}

static void smaller_boxes_are_found(void **state) {
    (void)state;
    ps_empty_axis out = {0};
    assert_true(find_within(1000, 0, 0.5, &out));
    assert_true(out.axis == 1 && out.begin == 0.5 && out.end == 1);
    assert_true(find_within(1000, 0.75, 0.5, &out)); /* through 1 */
    assert_true(out.axis == 1 && out.begin == 0.25 && out.end == 0.75);
    assert_true(find_within(1000, 0.1, 0.85, &out));
    assert_true(fabs(out.begin - 0.95) < 0.02 && fabs(out.end - 0.1) < 0.02);
    assert_false(find_within(1000, 0, 0.92, &out)); /* less than a tenth */
    assert_false(find_within(20, 0, 0.5, &out));    /* may be chance: 40 0.5^19 */
    assert_true(find_within(50, 0, 0.5, &out));     /* 100 0.5^49 */
}

static void samplers_leave_nothing_empty(void **state) {
    (void)state;
    static const struct {
        const char *name;
        size_t num;
    } cases[] = {{"white", 30},    {"white", 4096}, {"regular", 9},
                 {"regular", 64},  {"regular", 81}, {"jittered", 4},
                 {"jittered", 64}, {"sobol", 256},  {"halton", 100}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_sampler_request request = {.num_points = cases[i].num, .dimension = 2, .seed = 1};
        ps_empty_axis out = {0};
        ps_error error = {0};
        double *const points = malloc(2 * cases[i].num * sizeof *points);
        assert_int_equal(ps_sampler_parse(&request, cases[i].name, &error), PSPEC_OK);
        assert_int_equal(ps_sampler_resolve(&request, &error), PSPEC_OK);
        for (uint64_t r = 0; r < 20; r++) {
            assert_int_equal(ps_sampler_generate(&request, r, points, NULL, NULL, &error),
                             PSPEC_OK);
            if (find(points, 2, cases[i].num, &out)) {
                fail_msg("%s, N = %zu: axis %u from %g to %g", cases[i].name, cases[i].num,
                         out.axis, out.begin, out.end);
            }
        }
        free(points);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smaller_boxes_are_found),
        cmocka_unit_test(samplers_leave_nothing_empty),
    };
    return cmocka_run_group_tests_name("empty_axis", tests, NULL, NULL);
}
