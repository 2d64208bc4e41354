/* What pictures of points show: which points in which panel, of which part. */
#include "answers/points/points.h"
#include "plots/plot_script.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_DIMENSION = 6 };

/* Points of a sampler, as a set. */
static ps_drawn_set make_set(const char *text, size_t num_points, unsigned dimension) {
    ps_sampler_request request = {.seed = 1};
    ps_error error = {0};
    size_t num = 0;
    assert_int_equal(ps_sampler_parse(&request, text, &error), PSPEC_OK);
    request.num_points = num_points;
    request.dimension = dimension;
    assert_int_equal(ps_sampler_resolve(&request, &error), PSPEC_OK);
    double *const points =
        calloc(ps_sampler_most_points(&request) * request.dimension, sizeof *points);
    assert_non_null(points);
    assert_int_equal(ps_sampler_generate(&request, 0, points, &num, NULL, &error), PSPEC_OK);
    return (ps_drawn_set){text, ps_sampler_where(&request), request.dimension, num, points};
}

static void free_set(const ps_drawn_set *set) {
    free((void *)(uintptr_t)set->points);
}

static void add(ps_points_picture *picture, const ps_drawn_set *set) {
    ps_error error = {0};
    const ps_watch watch = {0};
    assert_int_equal(ps_points_picture_add(picture, set, &watch, &error), PSPEC_OK);
}

static ps_figure make_figure(ps_points_picture *picture) {
    return ps_points_picture_figure(picture, "title");
}

static void the_plane_is_one_square_of_all_points(void **state) {
    (void)state;
    const ps_drawn_set set = make_set("jittered", 64, 2);
    ps_pool memory = {0};
    ps_points_picture picture = {.num_sets = 1, .memory = &memory};
    add(&picture, &set);
    const ps_figure figure = make_figure(&picture);
    const ps_series *const series = figure.panels[0].series;
    assert_int_equal(figure.form, PS_FIGURE_POINTS);
    assert_int_equal(figure.num_panels, 1);
    assert_int_equal(figure.num_columns, 1);
    assert_string_equal(figure.panels[0].title, "");
    assert_int_equal(figure.panels[0].frame.form, PS_FRAME_SQUARE);
    assert_true(figure.panels[0].frame.first == 0 && figure.panels[0].frame.last == 1);
    assert_int_equal(series->num, 64);
    for (size_t i = 0; i < series->num; i++) {
        assert_true(series->x[i] == set.points[2 * i] && series->y[i] == set.points[2 * i + 1]);
    }
    ps_pool_free(&memory);
    free_set(&set);
}

/* Every point is on one side, inside of the circle; z is what is left of its length. */
static void the_sphere_has_two_sides(void **state) {
    (void)state;
    const ps_drawn_set set = make_set("white-sphere", 1000, 3);
    ps_pool memory = {0};
    ps_points_picture picture = {.num_sets = 1, .memory = &memory};
    add(&picture, &set);
    const ps_figure figure = make_figure(&picture);
    size_t places[2] = {0, 0};
    assert_int_equal(figure.num_panels, 2);
    assert_int_equal(figure.num_columns, 2);
    assert_string_equal(figure.panels[0].title, "z ≥ 0, from above");
    assert_string_equal(figure.panels[1].title, "z < 0, from below");
    for (size_t i = 0; i < set.num_points; i++) {
        const double *const point = set.points + 3 * i;
        const size_t side = point[2] < 0;
        const ps_series *const series = figure.panels[side].series;
        const size_t place = places[side]++;
        assert_true(series->x[place] == point[0] && series->y[place] == point[1]);
        assert_true(hypot(series->x[place], series->y[place]) <= 1);
    }
    for (size_t side = 0; side < 2; side++) {
        assert_int_equal(figure.panels[side].series->num, places[side]);
        assert_int_equal(figure.panels[side].frame.form, PS_FRAME_DISC);
        assert_int_equal(figure.panels[side].frame.is_mirrored, side == 1);
    }
    ps_pool_free(&memory);
    free_set(&set);
}

/* z = 0 belongs to the upper side, also as -0. */
static void the_equator_is_above(void **state) {
    (void)state;
    const double points[] = {1, 0, 0, 0, 1, -0.0, 0, 0, 1, 0, 0, -1};
    const ps_drawn_set set = {"own", PS_SAMPLES_SPHERE, 3, 4, points};
    ps_pool memory = {0};
    ps_points_picture picture = {.num_sets = 1, .memory = &memory};
    add(&picture, &set);
    assert_int_equal(picture.panels[0].series->num, 3);
    assert_int_equal(picture.panels[1].series->num, 1);
    ps_pool_free(&memory);
}

static void the_hemisphere_has_one_side(void **state) {
    (void)state;
    const ps_drawn_set set = make_set("jittered:lift=hemisphere", 100, 0);
    ps_pool memory = {0};
    ps_points_picture picture = {.num_sets = 1, .memory = &memory};
    add(&picture, &set);
    const ps_figure figure = make_figure(&picture);
    assert_int_equal(figure.num_panels, 1);
    assert_int_equal(figure.panels[0].frame.form, PS_FRAME_DISC);
    assert_int_equal(figure.panels[0].series->num, 100);
    ps_pool_free(&memory);
    free_set(&set);
}

static void every_pair_of_coordinates_has_a_panel(void **state) {
    (void)state;
    for (unsigned d = 1; d <= MOST_DIMENSION; d++) {
        const ps_drawn_set set = make_set("halton", 20, d);
        ps_pool memory = {0};
        ps_points_picture picture = {.num_sets = 1, .memory = &memory};
        size_t panel = 0;
        add(&picture, &set);
        const ps_figure figure = make_figure(&picture);
        assert_int_equal(figure.num_panels, d == 1 ? 1 : d * (d - 1) / 2);
        for (unsigned i = 0; i + 1 < d; i++) {
            for (unsigned j = i + 1; j < d; j++, panel++) {
                const ps_series *const series = figure.panels[panel].series;
                assert_int_equal(series->num, 20);
                assert_true(series->x[7] == set.points[7 * d + i]);
                assert_true(series->y[7] == set.points[7 * d + j]);
            }
        }
        assert_int_equal(figure.panels[0].frame.form, d == 1 ? PS_FRAME_LINE : PS_FRAME_SQUARE);
        assert_string_equal(figure.panels[0].frame.x_label, d > 2 ? "x_1" : "x");
        assert_true(figure.num_columns <= PS_MOST_POINT_COLUMNS);
        ps_pool_free(&memory);
        free_set(&set);
    }
}

/* Of several sets the first two coordinates, and each is named with its own N. */
static void several_sets_are_panels_with_names(void **state) {
    (void)state;
    const char *const samplers[] = {"white", "sobol", "poisson-disk", "white-sphere"};
    const unsigned dimensions[] = {2, 4, 2, 3};
    ps_pool memory = {0};
    ps_points_picture picture = {.num_sets = 4, .memory = &memory};
    for (size_t i = 0; i < 4; i++) {
        const ps_drawn_set set = make_set(samplers[i], 100, dimensions[i]);
        add(&picture, &set);
        assert_int_equal(picture.num_points, set.num_points);
        free_set(&set);
    }
    const ps_figure figure = make_figure(&picture);
    assert_int_equal(figure.num_panels, 5);
    assert_string_equal(figure.panels[1].title, "sobol, N = 100");
    assert_string_equal(figure.panels[1].frame.y_label, "x_2");
    assert_string_equal(figure.panels[4].title, "white-sphere, N = 100, z < 0, from below");
    ps_pool_free(&memory);
}

/* More points than can be told apart: a part of them, as large as its name says. */
static void of_too_many_points_a_part_is_shown(void **state) {
    static const struct {
        const char *sampler, *title;
        unsigned dimension;
        size_t num_points;
        double reach;
    } cases[] = {{"regular", "the corner [0, 0.5)²", 2, 1 << 18, 0.5},
                 {"regular", "", 2, 1 << 16, 1},
                 {"regular", "the part [0, 0.25)", 1, 1 << 10, 0.25},
                 {"white-sphere", "z ≥ 0, from above, |x| and |y| up to 0.5", 3, 1 << 19, 0.5}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const ps_drawn_set set =
            make_set(cases[i].sampler, cases[i].num_points, cases[i].dimension);
        ps_pool memory = {0};
        ps_points_picture picture = {.num_sets = 1, .memory = &memory};
        add(&picture, &set);
        const ps_panel *const panel = &picture.panels[0];
        const ps_frame *const frame = &picture.panels[0].frame;
        assert_string_equal(panel->title, cases[i].title);
        assert_true(frame->last == cases[i].reach);
        assert_true(frame->form != PS_FRAME_DISC);
        for (size_t k = 0; k < panel->series->num; k++) {
            assert_true(fabs(panel->series->x[k]) <= cases[i].reach);
            assert_true(fabs(panel->series->y[k]) <= cases[i].reach);
        }
        if (strcmp(cases[i].sampler, "regular") == 0) {
            assert_int_equal(panel->series->num,
                             cases[i].dimension == 1 ? PS_MOST_DRAWN_OF_LINE : PS_MOST_DRAWN);
        }
        ps_pool_free(&memory);
        free_set(&set);
    }
}

/* All in a place that is in no smaller part. */
static void a_clump_is_not_lost(void **state) {
    enum { NUM = PS_MOST_DRAWN + 1 };
    (void)state;
    double *const points = calloc((size_t)2 * NUM, sizeof *points);
    assert_non_null(points);
    for (size_t i = 0; i < (size_t)2 * NUM; i++) {
        points[i] = 0.375;
    }
    const ps_drawn_set set = {"own", PS_SAMPLES_TORUS, 2, NUM, points};
    ps_pool memory = {0};
    ps_points_picture picture = {.num_sets = 1, .memory = &memory};
    add(&picture, &set);
    assert_int_equal(picture.panels[0].series->num, NUM);
    assert_true(picture.panels[0].frame.last == 0.5);
    ps_pool_free(&memory);
    free(points);
}

/* A third of the distance on a grid, within what is seen. */
static void marks_follow_the_number_of_points(void **state) {
    static const struct {
        size_t num_points;
        double size;
    } cases[] = {{64, 8.6}, {1024, 860.0 / 32 / 3}, {16384, 860.0 / 128 / 3}, {65536, 1.12}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const ps_drawn_set set = make_set("white", cases[i].num_points, 2);
        ps_pool memory = {0};
        ps_points_picture picture = {.num_sets = 1, .memory = &memory};
        add(&picture, &set);
        const ps_figure figure = make_figure(&picture);
        const double expected = fmin(cases[i].size, 8.6);
        assert_true(fabs(ps_script_mark_size(&figure.panels[0], 860) - expected) < 1e-2 * expected);
        ps_pool_free(&memory);
        free_set(&set);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_plane_is_one_square_of_all_points),
        cmocka_unit_test(the_sphere_has_two_sides),
        cmocka_unit_test(the_equator_is_above),
        cmocka_unit_test(the_hemisphere_has_one_side),
        cmocka_unit_test(every_pair_of_coordinates_has_a_panel),
        cmocka_unit_test(several_sets_are_panels_with_names),
        cmocka_unit_test(of_too_many_points_a_part_is_shown),
        cmocka_unit_test(a_clump_is_not_lost),
        cmocka_unit_test(marks_follow_the_number_of_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
