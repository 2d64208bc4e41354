/* Maximal Poisson disk points of the sphere: faces, distances, saturation, numbers, power, bits. */
#include "test_blue_noise.h"

#include "math/unit_vector.h"
#include "math/pi.h"
#include "samplers/darts/face.h"

static const double SIGMAS = 4;
enum { VECTOR = 3 };

/* The angle, with all its digits also where it is small. */
static double angle(const double *u, const double *v) {
    double square = 0;
    for (unsigned a = 0; a < VECTOR; a++) {
        square += (u[a] - v[a]) * (u[a] - v[a]);
    }
    return 2 * asin(fmin(1, sqrt(square) / 2));
}

static double nearest(const double *points, size_t num, size_t but, const double *place) {
    double least = HUGE_VAL;
    for (size_t j = 0; j < num; j++) {
        const double to = j == but ? HUGE_VAL : angle(place, points + VECTOR * j);
        least = to < least ? to : least;
    }
    return least;
}

/* One set in fresh memory, which the caller frees. */
static double *make_set(double radius, uint64_t realization, size_t *num) {
    const ps_blue_noise asked = {.dimension = VECTOR, .radius = radius};
    return test_make_set(&ps_sphere_disk_kind, asked, realization, num);
}

/* z and azimuth of HEALPix by the formulas of its paper and libm. */
static void faces_are_those_of_healpix(void **state) {
    (void)state;
    static const double jr[] = {2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4};
    static const double jp[] = {1, 3, 5, 7, 0, 2, 4, 6, 1, 3, 5, 7};
    uint64_t seed = 1;
    for (unsigned i = 0; i < 12 * 2000; i++) {
        const unsigned face = i % 12;
        double uniforms[2];
        ps_random random = ps_random_init(seed++, PS_STREAM_COORDINATES, 0);
        ps_random_fill_uniform(&random, uniforms, 2);
        const double x = uniforms[0];
        const double y = uniforms[1];
        const double j = jr[face] - x - y;
        const double nr = j < 1 ? j : j > 3 ? 4 - j : 1;
        const double z = j < 1 ? 1 - nr * nr / 3 : j > 3 ? nr * nr / 3 - 1 : (2 - j) * 2 / 3;
        const double azimuth = PS_PI / 4 * (jp[face] * nr + x - y) / nr;
        const double sine = sqrt((1 - z) * (1 + z));
        double point[VECTOR];
        ps_face_point(face, x, y, point);
        assert_true(fabs(point[0] - sine * cos(azimuth)) < 1e-14);
        assert_true(fabs(point[1] - sine * sin(azimuth)) < 1e-14);
        assert_true(fabs(point[2] - z) < 1e-15);
        assert_true(fabs(ps_square_length(point) - 1) < 1e-15);
    }
    for (double a = 0; a <= PS_PI; a += PS_PI / 64) {
        assert_true(fabs(ps_chord(a) - 2 * sin(a / 2)) < 1e-15);
    }
}

/* The edge of a square is farthest from its middle: at no size by more than PS_FACE_REACH sides,
 * and near the corners of faces by nearly so much. */
static void no_square_reaches_farther_than_is_said(void **state) {
    (void)state;
    const int sizes[] = {1, 2, 3, 4, 5, 7, 12, 30, 120};
    double farthest = 0;
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const int side = sizes[s];
        for (int i = 0; i < 3 * side * side; i++) { /* a face of each row */
            const unsigned face = (unsigned)(i / (side * side)) * 4;
            const double x = i / side % side;
            const double y = i % side;
            double middle[VECTOR];
            ps_face_point(face, (x + 0.5) / side, (y + 0.5) / side, middle);
            for (int k = 0; k < 32; k++) { /* 8 places of each edge */
                const double along = k % 8 / 8.0;
                const double ends[4][2] = {{along, 0}, {1, along}, {1 - along, 1}, {0, 1 - along}};
                double place[VECTOR];
                ps_face_point(face, (x + ends[k / 8][0]) / side, (y + ends[k / 8][1]) / side,
                              place);
                farthest = fmax(farthest, angle(middle, place) * side);
            }
        }
    }
    test_assert_between("reach", farthest, 1.06, PS_FACE_REACH);
}

static void no_two_points_are_nearer_than_the_radius(void **state) {
    (void)state;
    const size_t numbers[] = {2, 3, 4, 6, 12, 30, 200, 2000};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        const double radius = test_radius(&ps_sphere_disk_kind, 3, 0, numbers[i]);
        size_t num = 0;
        double *const points = make_set(radius, i, &num);
        double least = PS_PI;
        assert_true(num > 0);
        for (size_t j = 0; j < num; j++) {
            assert_true(fabs(ps_square_length(points + VECTOR * j) - 1) < 1e-15);
            least = fmin(least, nearest(points, num, j, points + VECTOR * j));
        }
        assert_true(least >= radius * (1 - 1e-15 * 16)); /* of the chord, and of the arc sine */
        free(points);
    }
}

/* Where two circles of the radius around points cross, on one side. */
static bool crossing(const double *a, const double *b, double radius, int side, double *place) {
    const double apart = angle(a, b);
    if (apart >= 2 * radius) {
        return false;
    }
    const double cross[VECTOR] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                  a[0] * b[1] - a[1] * b[0]};
    const double cosine = cos(apart);
    const double along = cos(radius) / (1 + cosine); /* of a + b */
    const double rest = 1 - 2 * along * along * (1 + cosine);
    const double across = side * sqrt(rest / (1 - cosine * cosine));
    for (unsigned i = 0; i < VECTOR; i++) {
        place[i] = along * (a[i] + b[i]) + across * cross[i];
    }
    return true;
}

static bool is_covered(const double *points, size_t num, size_t i, size_t j, double radius,
                       const double *place) {
    const double rounding = 1e-8;
    for (size_t k = 0; k < num; k++) {
        if (k != i && k != j && angle(place, points + VECTOR * k) < radius * (1 + rounding)) {
            return true;
        }
    }
    return false;
}

/* A hole would have corners, where two circles cross outside of all other disks. */
static void no_place_is_left(void **state) {
    (void)state;
    const size_t numbers[] = {20, 100, 600};
    for (size_t s = 0; s < sizeof numbers / sizeof *numbers; s++) {
        const double radius = test_radius(&ps_sphere_disk_kind, 3, 0, numbers[s]);
        size_t num = 0;
        size_t num_crossings = 0;
        double *const points = make_set(radius, 0, &num);
        for (size_t i = 0; i < num; i++) {
            for (size_t j = 0; j < i; j++) {
                double place[VECTOR];
                for (int side = -1; side <= 1; side += 2) {
                    if (crossing(points + VECTOR * i, points + VECTOR * j, radius, side, place)) {
                        assert_true(fabs(angle(place, points + VECTOR * i) - radius) < 1e-9);
                        assert_true(is_covered(points, num, i, j, radius, place));
                        num_crossings++;
                    }
                }
            }
        }
        assert_true(num_crossings > 2 * num);
        free(points);
    }
}

static void numbers_of_points_are_those_asked_for(void **state) {
    (void)state;
    const struct {
        size_t num_points;
        unsigned sets;
        double tolerance; /* what the header says */
    } cases[] = {{2, 100, 0},      {4, 400, 0.02},    {16, 400, 0.002},
                 {64, 300, 0.002}, {256, 200, 0.002}, {1024, 100, 0.002}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double n = (double)cases[i].num_points;
        const double radius = test_radius(&ps_sphere_disk_kind, 3, 0, cases[i].num_points);
        double sum = 0;
        double squares = 0;
        for (unsigned r = 0; r < cases[i].sets; r++) {
            size_t num = 0;
            free(make_set(radius, r, &num));
            sum += (double)num;
            squares += (double)num * (double)num;
        }
        const double mean = sum / cases[i].sets;
        const double error = sqrt((squares / cases[i].sets - mean * mean) / cases[i].sets);
        test_assert_between("mean number", mean, n * (1 - cases[i].tolerance) - SIGMAS * error,
                            n * (1 + cases[i].tolerance) + SIGMAS * error);
        if (cases[i].num_points >=
            64) { /* the variance over the mean is the plateau of the power */
            test_assert_between("variance", error * error * cases[i].sets / mean, 0.035, 0.08);
        }
    }
}

static void bits_are_those_of_every_machine(void **state) {
    (void)state;
    size_t num = 0;
    double *const points = make_set(test_radius(&ps_sphere_disk_kind, 3, 0, 500), 3, &num);
    test_assert_digest("sphere", points, VECTOR * num, "96a5ca8ad5cbc58d8b8405aaccdbcf18");
    free(points);
}

static void impossible_radii_are_refused(void **state) {
    (void)state;
    const double wrong[] = {0, -1, 3.01, HUGE_VAL, (double)NAN};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const ps_blue_noise asked = {.dimension = 3, .radius = wrong[i], .most_points = 1};
        test_assert_refused(&ps_sphere_disk_kind, asked, PSPEC_ERROR_INVALID_ARGUMENT, "at most 3");
    }
    const ps_blue_noise tiny = {.dimension = 3, .radius = 1e-5, .most_points = 1};
    test_assert_refused(&ps_sphere_disk_kind, tiny, PSPEC_ERROR_INVALID_ARGUMENT,
                        "cells of the sphere, more than 2^32");
    const ps_blue_noise crowded = {.dimension = 3, .radius = 0.3, .most_points = 1};
    test_assert_refused(&ps_sphere_disk_kind, crowded, PSPEC_ERROR_MEMORY, "room for 1 points");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_are_those_of_healpix),
        cmocka_unit_test(no_square_reaches_farther_than_is_said),
        cmocka_unit_test(no_two_points_are_nearer_than_the_radius),
        cmocka_unit_test(no_place_is_left),
        cmocka_unit_test(numbers_of_points_are_those_asked_for),
        cmocka_unit_test(bits_are_those_of_every_machine),
        cmocka_unit_test(impossible_radii_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
