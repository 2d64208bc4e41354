/* Power cells of the torus: exact lattices, laws of tilings, and all images of all sites. */
#include "brute_cells.h"

#include <string.h>

#include "math/random/random.h"
#include "samplers/optimized/cells.h"

enum { MOST_SITES = 200 };
static const double EXACT = 1e-12;

static ps_power_cells make_cells(size_t num, const double *points) {
    ps_power_cells cells;
    ps_error error = {0};
    if (ps_power_cells_create(&cells, num, points, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
    return cells;
}

/* Points within a square of that side, weights within +-weight/N. */
static ps_power_cells random_cells(size_t num, double side, double weight, uint64_t seed) {
    double points[2 * MOST_SITES];
    ps_random random = ps_random_init(seed, PS_STREAM_COORDINATES, num);
    ps_random_fill_uniform(&random, points, 2 * num);
    for (size_t i = 0; i < 2 * num; i++) {
        points[i] *= side;
    }
    ps_power_cells cells = make_cells(num, points);
    for (size_t i = 0; i < num; i++) {
        cells.w[i] = weight * (2 * ps_random_uniform(&random) - 1) / (double)num;
    }
    ps_power_cells_weigh(&cells);
    return cells;
}

static const ps_polygon *clip(const ps_power_cells *cells, size_t i, ps_cell *cell) {
    ps_power_cells_clip(cells, i, NULL, 0, cell);
    assert_false(cell->has_no_room);
    return ps_cell_polygon(cell);
}

static double sum_of_areas(const ps_power_cells *cells) {
    static ps_cell cell;
    double sum = 0;
    for (size_t i = 0; i < cells->num; i++) {
        sum += ps_polygon_moments(clip(cells, i, &cell)).area;
    }
    return sum;
}

static void cells_agree_with_all_images(const ps_power_cells *cells) {
    static ps_cell cell;
    for (size_t i = 0; i < cells->num; i++) {
        const ps_cell_moments ours = ps_polygon_moments(clip(cells, i, &cell));
        const brute_cell theirs = brute_clip(cells->num, cells->x, cells->y, cells->w, i);
        assert_close(ours.area, theirs.area, EXACT);
        if (theirs.area > 1e-6) {
            assert_close(ours.x, theirs.x, 1e-9);
            assert_close(ours.y, theirs.y, 1e-9);
        }
    }
    assert_close(sum_of_areas(cells), 1, EXACT);
}

static void random_sets_agree_with_all_images(void **state) {
    (void)state;
    static const size_t nums[] = {16, 17, 31, 64, 65, MOST_SITES};
    for (unsigned n = 0; n < sizeof nums / sizeof nums[0]; n++) {
        for (int kind = 0; kind < 3; kind++) { /* weights: none, some, so that cells are empty */
            ps_power_cells cells = random_cells(nums[n], 1, 0.3 * kind * kind, 7);
            cells_agree_with_all_images(&cells);
            ps_power_cells_destroy(&cells);
        }
    }
}

static void clumps_agree_with_all_images(void **state) {
    (void)state;
    for (double side = 0.3; side > 1e-4; side /= 10) {
        ps_power_cells cells = random_cells(40, side, 0, 8);
        cells_agree_with_all_images(&cells);
        ps_power_cells_destroy(&cells);
        cells = random_cells(40, side, 0.1 * side, 9);
        cells_agree_with_all_images(&cells);
        ps_power_cells_destroy(&cells);
    }
}

/* The length of the edge of site i with an image, 0 where there is none. */
static double edge_length(const ps_polygon *polygon, ps_image image) {
    double length = 0;
    for (unsigned k = 0; k < polygon->num; k++) {
        const unsigned next = (k + 1) % polygon->num;
        if (polygon->neighbour[k] == image) {
            length += hypot(polygon->x[next] - polygon->x[k], polygon->y[next] - polygon->y[k]);
        }
    }
    return length;
}

static void edges_have_the_same_length_from_both_sides(void **state) {
    (void)state;
    static ps_cell here;
    static ps_cell there;
    ps_power_cells cells = random_cells(MOST_SITES, 1, 0.3, 10);
    for (size_t i = 0; i < cells.num; i++) {
        const ps_polygon *const polygon = clip(&cells, i, &here);
        for (unsigned k = 0; k < polygon->num; k++) {
            const ps_image image = polygon->neighbour[k];
            const ps_image back = ps_image_of((uint32_t)i, -ps_image_a(image), -ps_image_b(image));
            const double length = edge_length(clip(&cells, ps_image_site(image), &there), back);
            assert_close(length, edge_length(polygon, image), EXACT);
        }
    }
    ps_power_cells_destroy(&cells);
}

/* Those that have a length: where four squares meet, there is one without. */
static unsigned num_edges(const ps_polygon *polygon) {
    unsigned num = 0;
    for (unsigned k = 0; k < polygon->num; k++) {
        num += edge_length(polygon, polygon->neighbour[k]) > 0;
    }
    return num;
}

static void squares_and_hexagons_are_exact(void **state) {
    (void)state;
    static ps_cell cell;
    double points[128];
    for (int sheared = 0; sheared < 2; sheared++) {
        for (int i = 0; i < 64; i++) {
            points[2 * i] = (i % 8 + 0.5 * sheared * (i / 8 % 2)) / 8;
            points[2 * i + 1] = i / 8 / 8.0;
        }
        ps_power_cells cells = make_cells(64, points);
        for (size_t i = 0; i < 64; i++) {
            const ps_polygon *const polygon = clip(&cells, i, &cell);
            const ps_cell_moments moments = ps_polygon_moments(polygon);
            assert_int_equal(num_edges(polygon), sheared ? 6 : 4);
            assert_true(fabs(moments.area - 1.0 / 64) < 1e-17);
            assert_true(fabs(moments.x) < 1e-16 && fabs(moments.y) < 1e-16);
            /* the farthest vertex: of a square; of triangles with base 1/8 and height 1/8 */
            assert_close(sqrt(cell.reach2), sheared ? 0.625 / 8 : sqrt(0.5) / 8, 1e-16);
        }
        ps_power_cells_destroy(&cells);
    }
}

static int by_size(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static void sorted_areas(size_t num, const double *points, double *areas) {
    static ps_cell cell;
    ps_power_cells cells = make_cells(num, points);
    for (size_t i = 0; i < num; i++) {
        areas[i] = ps_polygon_moments(clip(&cells, i, &cell)).area;
    }
    qsort(areas, num, sizeof *areas, by_size);
    ps_power_cells_destroy(&cells);
}

static void a_shift_of_the_torus_changes_no_area(void **state) {
    (void)state;
    double points[2 * MOST_SITES];
    double before[MOST_SITES];
    double after[MOST_SITES];
    ps_random random = ps_random_init(11, PS_STREAM_COORDINATES, 0);
    ps_random_fill_uniform(&random, points, 2 * MOST_SITES);
    sorted_areas(MOST_SITES, points, before);
    for (size_t i = 0; i < 2 * MOST_SITES; i++) {
        points[i] += i % 2 == 0 ? 0.377 : 0.891;
        points[i] -= floor(points[i]);
    }
    sorted_areas(MOST_SITES, points, after);
    for (size_t i = 0; i < MOST_SITES; i++) {
        assert_close(before[i], after[i], EXACT);
    }
}

static void neighbours_known_before_change_nothing(void **state) {
    (void)state;
    static ps_cell fresh;
    static ps_cell again;
    ps_power_cells cells = random_cells(MOST_SITES, 1, 0.3, 12);
    for (size_t i = 0; i < cells.num; i++) {
        const ps_polygon *const polygon = clip(&cells, i, &fresh);
        const ps_cell_moments moments = ps_polygon_moments(polygon);
        ps_image known[PS_CELL_MOST_EDGES];
        for (unsigned k = 0; k < polygon->num; k++) {
            known[k] = polygon->neighbour[k] ^ (k % 5 == 4 ? PS_IMAGES_OF_SITE : 0); /* and wrong */
        }
        ps_power_cells_clip(&cells, i, known, polygon->num, &again);
        assert_int_equal(ps_cell_polygon(&again)->num, polygon->num);
        assert_close(ps_polygon_moments(ps_cell_polygon(&again)).area, moments.area, EXACT);
    }
    ps_power_cells_destroy(&cells);
}

static void of_points_at_one_place_the_first_has_the_cell(void **state) {
    (void)state;
    static ps_cell cell;
    double points[2 * 32];
    for (int i = 0; i < 64; i++) {
        points[i] = i < 32 ? 0.25 : 0.75;
    }
    ps_power_cells cells = make_cells(32, points);
    for (size_t i = 0; i < 32; i++) {
        const double area = ps_polygon_moments(clip(&cells, i, &cell)).area;
        assert_close(area, i % 16 == 0 ? 0.5 : 0, EXACT);
    }
    ps_power_cells_destroy(&cells);
}

static void too_many_edges_and_too_few_points_are_said(void **state) {
    (void)state;
    static ps_cell cell;
    static double points[2 * 600];
    ps_power_cells cells;
    ps_error error = {0};
    for (int i = 1; i < 600; i++) {
        points[2 * i] = 0.5 + 0.3 * cos(i * 2 * acos(-1) / 599);
        points[2 * i + 1] = 0.5 + 0.3 * sin(i * 2 * acos(-1) / 599);
    }
    points[0] = points[1] = 0.5;
    cells = make_cells(600, points);
    bool has_no_room = false;
    for (size_t i = 0; i < 600; i++) {
        ps_power_cells_clip(&cells, i, NULL, 0, &cell);
        has_no_room = has_no_room || cell.has_no_room;
        assert_true(ps_cell_polygon(&cell)->num <= PS_CELL_MOST_EDGES);
    }
    assert_true(has_no_room);
    ps_power_cells_destroy(&cells);
    assert_int_equal(ps_power_cells_create(&cells, 15, points, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "15 points"));
    assert_non_null(strstr(error.message, "from 16"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_sets_agree_with_all_images),
        cmocka_unit_test(clumps_agree_with_all_images),
        cmocka_unit_test(edges_have_the_same_length_from_both_sides),
        cmocka_unit_test(squares_and_hexagons_are_exact),
        cmocka_unit_test(a_shift_of_the_torus_changes_no_area),
        cmocka_unit_test(neighbours_known_before_change_nothing),
        cmocka_unit_test(of_points_at_one_place_the_first_has_the_cell),
        cmocka_unit_test(too_many_edges_and_too_few_points_are_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
