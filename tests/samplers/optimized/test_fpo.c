/* FPO: cells that are kept up to date are those of the points, each move is to the farthest place,
 * the same bits for ever. */
#include "brute_cells.h"
#include "set_distances.h"
#include "stop_at_the_third.h"

#include <string.h>

#include "files/digest.h"
#include "samplers/optimized/fpo.h"
#include "samplers/optimized/fpo_mesh.h"

enum { NUM = 1024, SETS = 8, MOST = 200 };

/* ---- cells ---- */

static double area_of(const ps_fpo_cell *cell) {
    double twice = 0;
    for (uint32_t k = 0; k < cell->num; k++) {
        const uint32_t next = (k + 1) % cell->num;
        twice += cell->x[k] * cell->y[next] - cell->x[next] * cell->y[k];
    }
    return twice / 2;
}

/* All of them, by cells of the test's own; and the farthest vertex of all is no nearer to any. */
static void cells_are_those_of_the_points(const ps_fpo_mesh *mesh) {
    static const double no_weights[MOST];
    double x;
    double y;
    ps_image beside;
    const double farthest2 = ps_fpo_mesh_farthest(mesh, &x, &y, &beside);
    double nearest2 = 1;
    for (size_t i = 0; i < mesh->num; i++) {
        const brute_cell brute = brute_clip(mesh->num, mesh->x, mesh->y, no_weights, i);
        const double dx = mesh->x[i] - x - rint(mesh->x[i] - x);
        const double dy = mesh->y[i] - y - rint(mesh->y[i] - y);
        assert_close(area_of(&mesh->cells[i]), brute.area, 1e-12);
        nearest2 = fmin(nearest2, dx * dx + dy * dy);
    }
    assert_close(farthest2, nearest2, 1e-14);
}

/* Takes points out and puts them to the farthest place, or where they were. */
static void move_some(ps_fpo_mesh *mesh, ps_random *random, size_t num) {
    for (size_t k = 0; k < num; k++) {
        const uint32_t p = (uint32_t)ps_random_below(random, mesh->num);
        double x = mesh->x[p];
        double y = mesh->y[p];
        ps_image beside = 0;
        assert_true(ps_fpo_mesh_nearest(mesh, p, &beside) > 0);
        ps_fpo_mesh_remove(mesh, p);
        if (k % 4 != 0) {
            ps_fpo_mesh_farthest(mesh, &x, &y, &beside);
        }
        ps_fpo_mesh_insert(mesh, p, x, y, beside);
        assert_false(mesh->has_no_room);
    }
}

static void cells_stay_those_of_the_points(void **state) {
    (void)state;
    static const size_t nums[] = {16, 17, 30, 64, 80};
    static ps_fpo_mesh mesh;
    for (unsigned n = 0; n < sizeof nums / sizeof nums[0]; n++) {
        for (double side = 1; side > 1e-3; side /= 30) {
            double points[2 * MOST];
            ps_error error = {0};
            ps_random random = ps_random_init(3, PS_STREAM_COORDINATES, n);
            ps_random_fill_uniform(&random, points, 2 * nums[n]);
            for (size_t i = 0; i < 2 * nums[n]; i++) {
                points[i] *= side;
            }
            assert_int_equal(ps_fpo_mesh_create(&mesh, nums[n], points, &error), PSPEC_OK);
            for (size_t moved = 1; moved <= 16 * nums[n]; moved *= 8) {
                move_some(&mesh, &random, moved);
                cells_are_those_of_the_points(&mesh);
            }
            ps_fpo_mesh_destroy(&mesh);
        }
    }
}

/* Squares, four of whose cells meet in every vertex: rounding decides who are neighbours. */
static void lattices_can_be_taken_apart(void **state) {
    (void)state;
    static ps_fpo_mesh mesh;
    double points[2 * 100];
    ps_error error = {0};
    ps_random random = ps_random_init(4, PS_STREAM_COORDINATES, 0);
    for (int i = 0; i < 100; i++) {
        points[2 * i] = i % 10 / 10.0;
        points[2 * i + 1] = i / 10 / 10.0;
    }
    assert_int_equal(ps_fpo_mesh_create(&mesh, 100, points, &error), PSPEC_OK);
    for (int k = 0; k < 3; k++) {
        move_some(&mesh, &random, 60);
        cells_are_those_of_the_points(&mesh);
    }
    ps_fpo_mesh_destroy(&mesh);
}

/* ---- sets ---- */

static ps_fpo_outcome optimise(size_t num, double distance, uint64_t realization, double *points) {
    ps_fpo_outcome outcome = {0};
    ps_error error = {0};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, realization);
    ps_random_fill_uniform(&random, points, 2 * num);
    if (ps_fpo_optimise(num, distance, &random, NULL, points, &outcome, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
    return outcome;
}

static void outcomes_are_those_of_the_points(void **state) {
    (void)state;
    static double points[2 * NUM];
    const ps_fpo_outcome outcome = optimise(NUM, 0.925, 0, points);
    const set_distances distances = measure_distances(NUM, points);
    assert_close(outcome.distance, distances.least, 1e-12);
    assert_close(outcome.mean_nearest, distances.mean, 1e-12);
    assert_in_range(outcome.passes, 30, 130);
}

static void few_points_end_where_none_has_a_better_place(void **state) {
    (void)state;
    double points[2 * 40];
    for (size_t num = 16; num <= 40; num += 3) {
        for (uint64_t r = 0; r < 5; r++) {
            const ps_fpo_outcome outcome = optimise(num, 0.925, r, points);
            assert_true(outcome.distance >= 0.88);
            for (size_t i = 0; i < 2 * num; i++) {
                assert_true(points[i] >= 0 && points[i] < 1);
            }
            assert_close(outcome.distance, measure_distances(num, points).least, 1e-12);
        }
    }
}

static void what_cannot_be_made_is_refused(void **state) {
    (void)state;
    double points[32];
    ps_error error = {0};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    assert_int_equal(ps_fpo_make(15, 0.9, &random, NULL, points, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "from 16"));
    static const double wrong[] = {0, 0.499, 0.931, 1, NAN};
    for (unsigned k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
        assert_int_equal(ps_fpo_check(16, wrong[k], &error), PSPEC_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(error.message, "distance"));
    }
    for (int i = 0; i < 32; i++) {
        points[i] = 0.25;
    }
    assert_int_equal(ps_fpo_optimise(16, 0.9, &random, NULL, points, NULL, &error),
                     PSPEC_ERROR_INPUT);
}

static void whoever_watches_may_stop_it(void **state) {
    (void)state;
    static double points[2 * NUM];
    unsigned calls = 0;
    const ps_watch watch = {stop_at_the_third, &calls};
    ps_error error = {0};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    assert_int_equal(ps_fpo_make(NUM, 0.925, &random, &watch, points, &error),
                     PSPEC_ERROR_CANCELLED);
    assert_int_equal(calls, 3);
}

/* Recorded: the bits of a set stay the same, with any compiler and on any machine. */
static void the_bits_of_a_set_are_these(void **state) {
    (void)state;
    static double points[2 * NUM];
    char digest[PS_DIGEST_BYTES];
    optimise(NUM, 0.925, 0, points);
    ps_digest_bytes(points, sizeof points, digest);
    assert_string_equal(digest, "7dcdc9efcbc5b899e49aa7f3ab4dd8af");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_stay_those_of_the_points),
        cmocka_unit_test(lattices_can_be_taken_apart),
        cmocka_unit_test(outcomes_are_those_of_the_points),
        cmocka_unit_test(few_points_end_where_none_has_a_better_place),
        cmocka_unit_test(what_cannot_be_made_is_refused),
        cmocka_unit_test(whoever_watches_may_stop_it),
        cmocka_unit_test(the_bits_of_a_set_are_these),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
