/* Ambient occlusion: closed boxes, open planes, a quadrilateral and a ceiling by closed forms, the
 * error of white points, and the same counts on any device, in any order and batches. */
#include "harness.h"

#include "jobs/occlusion/occlusion_job.h"
#include "jobs/occlusion/rays.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SEED = 3, MOST_QUADS = 16 };

/* ---- scenes --------------------------------------------------------------------------------- */

/* Parallelograms: a corner, and the two sides that begin there. */
typedef struct scene {
    size_t num;
    double quads[MOST_QUADS][3][3];
    ps_view_options options;
} scene;

static void set(double out[3], double x, double y, double z) {
    out[0] = x;
    out[1] = y;
    out[2] = z;
}

static void add_quad(scene *self, double x, double y, double z, const double *a, const double *b) {
    double(*const quad)[3] = self->quads[self->num++];
    set(quad[0], x, y, z);
    set(quad[1], a[0], a[1], a[2]);
    set(quad[2], b[0], b[1], b[2]);
}

/* z = 0, and a camera between 0 and 1 that looks down at its middle. */
static scene make_floor(double side, size_t pixels) {
    const double x[] = {side, 0, 0};
    const double y[] = {0, side, 0};
    scene out = {.options = {.camera = {.position = {0, 0, 0.5},
                                        .direction = {0, 0, -2},
                                        .up = {0, 3, 0},
                                        .width = 2},
                             .width = pixels,
                             .height = pixels}};
    add_quad(&out, -side / 2, -side / 2, 0, x, y);
    return out;
}

static void add_box(scene *self, double x, double y, double z, double side) {
    const double sides[3][3] = {{side, 0, 0.1 * side}, {0, side, 0}, {-0.1 * side, 0, side}};
    for (int i = 0; i < 3; i++) {
        const double *const up = sides[(i + 2) % 3];
        add_quad(self, x, y, z, sides[i], sides[(i + 1) % 3]);
        add_quad(self, x + up[0], y + up[1], z + up[2], sides[i], sides[(i + 1) % 3]);
    }
}

/* step: of the order of triangles, with no divisor of their number. */
static void make_view(ps_view *out, const scene *self, size_t step) {
    ps_mesh mesh = {.num_triangles = 2 * self->num,
                    .triangles = calloc(2 * self->num, sizeof *mesh.triangles)};
    assert_non_null(mesh.triangles);
    for (size_t t = 0; t < mesh.num_triangles; t++) {
        const double(*const quad)[3] = self->quads[t / 2];
        double(*const corners)[3] = mesh.triangles[t * step % mesh.num_triangles];
        for (size_t k = 0; k < 3; k++) {
            corners[0][k] = quad[0][k];
            corners[1][k] = quad[0][k] + quad[1 + t % 2][k];
            corners[2][k] = quad[0][k] + quad[1][k] + quad[2][k];
        }
    }
    assert_ok(ps_view_make(out, &mesh, &self->options, NULL, error));
    ps_mesh_free(&mesh);
}

/* ---- sets ----------------------------------------------------------------------------------- */

static double *make_points(size_t num) {
    double *const points = calloc(3 * num, sizeof *points);
    uint64_t random = 11;
    assert_non_null(points);
    for (size_t j = 0; j < num; j++) {
        const double z = 2 * test_uniform(&random) - 1;
        const double phi = PS_TWO_PI * test_uniform(&random);
        set(points + 3 * j, sqrt(1 - z * z) * cos(phi), sqrt(1 - z * z) * sin(phi), z);
    }
    return points;
}

static uint32_t *count(const ps_view *view, const ps_ray_set *set, ps_device *device,
                       size_t batch) {
    ps_rays *rays = NULL;
    uint32_t *const counts = calloc(view->num_pixels, sizeof *counts);
    assert_non_null(counts);
    assert_ok(ps_rays_create(&rays, view, set->num + (batch > 0 ? 100 : 0), device, error));
    ps_rays_set_batch(rays, batch);
    assert_ok(ps_rays_count(rays, set, counts, NULL, error));
    ps_rays_destroy(rays);
    return counts;
}

/* ---- what is known to the bit --------------------------------------------------------------- */

/* Inside a box nothing is seen, also from its edges, which a column of pixels shows; on a floor all
 * above it: half of points that come with their opposites, all of a hemisphere that folds. */
static void boxes_and_planes(void **state) {
    enum { NUM = 700 };
    double *const points = make_points(NUM);
    ps_device *const device = test_open_device();
    (void)state;
    for (size_t j = 0; j < 3 * NUM / 2; j++) {
        points[3 * NUM / 2 + j] = -points[j];
    }
    for (int i = 0; i < 8; i++) {
        const bool is_box = i % 2 == 1;
        const bool is_folded = i / 2 % 2 == 1;
        scene asked = make_floor(4, 16);
        ps_view view;
        if (is_box) {
            asked.num = 0;
            add_box(&asked, -1.3, -1.2, -1.1, 2.7);
        }
        make_view(&view, &asked, 1);
        assert_int_equal(view.num_pixels, 16 * 16);
        const ps_ray_set set = {points, NUM, is_folded, SEED, 1};
        uint32_t *const counts = count(&view, &set, i < 4 ? device : NULL, 0);
        for (size_t k = 0; k < view.num_pixels; k++) {
            assert_int_equal(counts[k], is_box ? 0 : is_folded ? NUM : NUM / 2);
        }
        free(counts);
        ps_view_free(&view);
    }
    ps_device_close(device);
    free(points);
}

/* Also from far away all is seen above a plane that leans: places are as near to it as to a camera
 * beside it. */
static void far_cameras(void **state) {
    enum { NUM = 64 };
    static const double distances[] = {3, 1e3, 1e5};
    static const double sides[2][3] = {{0, 0.1, 2}, {2, 0.2, 0}};
    double *const points = make_points(NUM);
    (void)state;
    for (size_t i = 0; i < sizeof distances / sizeof distances[0]; i++) {
        const double far = distances[i];
        scene asked = {.options = {.camera = {.position = {0.26 * far, 0.86 * far, 0.43 * far},
                                              .direction = {-0.26, -0.86, -0.43},
                                              .up = {0, 0, 1},
                                              .width = 2.4 / far},
                                   .width = 32,
                                   .height = 32}};
        ps_view view;
        add_quad(&asked, -1, 0, -1, sides[0], sides[1]);
        make_view(&view, &asked, 1);
        assert_true(view.num_pixels > 32 * 32 / 2);
        const ps_ray_set set = {points, NUM, true, SEED, 0};
        uint32_t *const counts = count(&view, &set, NULL, 0);
        for (size_t k = 0; k < view.num_pixels; k++) {
            assert_int_equal(counts[k], NUM);
        }
        free(counts);
        ps_view_free(&view);
    }
    free(points);
}

/* Hosts, CPUs and GPUs, batches, and the order of points and triangles. */
static void same_counts(void **state) {
    enum { NUM = 333, HOST = 0, CPU = 1 };
    static const size_t batches[] = {0, 1, 37};
    ps_device *const devices[] = {NULL, test_open_device(), test_open_gpu()};
    double *const points = make_points(NUM);
    double *const turned = calloc(3 * (size_t)NUM, sizeof *turned);
    (void)state;
    assert_non_null(turned);
    for (size_t j = 0; j < NUM; j++) {
        memcpy(turned + 3 * (j * 10 % NUM), points + 3 * j, 3 * sizeof *points);
    }
    for (int kind = 0; kind < 4; kind++) {
        scene asked = make_floor(5, 11);
        ps_view view;
        ps_view other;
        add_box(&asked, -0.4, 0.1, 0.05, 0.2);
        add_box(&asked, 0.2, -0.3, 0, 0.1);
        asked.options.radius = kind % 2 == 0 ? 0 : 0.3;
        make_view(&view, &asked, 1);
        make_view(&other, &asked, 11);
        const ps_ray_set set = {points, NUM, kind / 2 == 1, SEED, 0};
        const ps_ray_set moved = {turned, NUM, kind / 2 == 1, SEED, 0};
        uint32_t *const first = count(&view, &set, NULL, 0);
        const size_t bytes = view.num_pixels * sizeof *first;
        for (size_t i = 0; i < 9; i++) {
            uint32_t *const counts = count(&view, &set, devices[i / 3], batches[i % 3]);
            uint32_t *const again = count(&other, &moved, devices[i / 3], batches[i % 3]);
            assert_memory_equal(counts, first, bytes);
            assert_memory_equal(again, first, bytes);
            free(counts);
            free(again);
        }
        free(first);
        ps_view_free(&view);
        ps_view_free(&other);
    }
    ps_device_close(devices[1]);
    ps_device_close(devices[2]);
    free(turned);
    free(points);
}

/* ---- closed forms --------------------------------------------------------------------------- */

/* Solid angle of a rectangle from a corner at the origin, a and b long, at height h, with signs. */
static double corner_angle(double a, double b, double h) {
    return atan(a * b / (h * sqrt(a * a + b * b + h * h)));
}

/* A quadrilateral above a floor: of every pixel, V = 1 - solid angle/(2 pi); what the reference is
 * off has the size that it says. */
static void one_quad(void **state) {
    static const double low[] = {-0.2, -0.1};
    static const double high[] = {0.5, 0.25};
    const double height = 0.25;
    const double x[] = {high[0] - low[0], 0, 0};
    const double y[] = {0, high[1] - low[1], 0};
    ps_device *const device = test_open_device();
    scene asked = make_floor(8, 24);
    ps_view view;
    ps_reference reference;
    double squares = 0;
    (void)state;
    asked.options.camera.position[2] = 0.2; /* below it */
    asked.options.camera.width = 5;
    add_quad(&asked, low[0], low[1], height, x, y);
    make_view(&view, &asked, 1);
    assert_ok(ps_reference_make(&reference, &view, 40000, SEED, device, NULL, NULL, error));
    assert_int_equal(reference.num_rays, 40000);
    for (size_t i = 0; i < view.num_pixels; i++) {
        const double pixel = 0.2 * 5 / 24;
        const double at[] = {(view.pixels[i] % 24 - 11.5) * pixel,
                             (11.5 - view.pixels[i] / 24) * pixel};
        const double angle = corner_angle(high[0] - at[0], high[1] - at[1], height) -
                             corner_angle(low[0] - at[0], high[1] - at[1], height) -
                             corner_angle(high[0] - at[0], low[1] - at[1], height) +
                             corner_angle(low[0] - at[0], low[1] - at[1], height);
        const double off = reference.seen[i] - (1 - angle / PS_TWO_PI);
        assert_true(fabs(off) < 8 * sqrt(reference.variance));
        squares += off * off;
    }
    const double mean = squares / (double)view.num_pixels;
    assert_true(fabs(mean - reference.variance) < 4 * reference.variance_error);
    assert_true(reference.variance_error < 0.1 * reference.variance);
    assert_true(reference.variance < 1e-7);
    ps_reference_free(&reference);
    ps_view_free(&view);
    ps_device_close(device);
}

/* Under a ceiling without an end at height h that hides what is nearer than r, V = h/r. White
 * points of the sphere have the variance 2V (1 - V/2)/N, those of the hemisphere, and of the sphere
 * where they are replaced by their opposites, V (1 - V)/N. */
static void white_points(void **state) {
    static const char *const samplers[] = {"white-sphere", "white-hemisphere", "white-sphere"};
    enum { NUM_POINTS = 16, NUM_SETS = 60 };
    const double height = 0.6;
    const double radius = 1.5;
    const double x[] = {9, 0, 0};
    const double y[] = {0, 9, 0};
    const double v = height / radius;
    ps_device *const device = test_open_device();
    scene asked = make_floor(8, 24);
    ps_view view;
    ps_reference reference;
    (void)state;
    add_quad(&asked, -4.5, -4.5, height, x, y);
    asked.options.radius = radius;
    make_view(&view, &asked, 1);
    assert_ok(ps_reference_make(&reference, &view, 4096, SEED, device, NULL, NULL, error));
    assert_true(fabs(reference.mean - v) <
                6 * sqrt(reference.variance / (double)view.num_pixels) + 1e-6);
    for (int i = 0; i < 3; i++) {
        ps_sampler_request sampler = {.num_points = NUM_POINTS, .seed = SEED};
        ps_occlusion_result found;
        assert_ok(ps_sampler_parse(&sampler, samplers[i], error));
        assert_ok(ps_sampler_resolve(&sampler, error));
        const ps_occlusion_question question = {.view = &view,
                                                .reference = &reference,
                                                .sampler = &sampler,
                                                .num_realizations = NUM_SETS,
                                                .is_folded = i == 2,
                                                .device = device};
        const double expected = (i == 0 ? 2 * v * (1 - v / 2) : v * (1 - v)) / NUM_POINTS;
        assert_ok(ps_occlusion_run(&found, &question, error));
        assert_int_equal(found.num_realizations, NUM_SETS);
        assert_true(fabs(found.squared.mean - expected) < 4 * found.squared.standard_error);
        assert_true(found.squared.standard_error < 0.1 * expected);
        assert_true(fabs(found.mean - v) < 0.02);
        ps_occlusion_result_free(&found);
    }
    ps_reference_free(&reference);
    ps_view_free(&view);
    ps_device_close(device);
}

static void cameras_that_see_nothing(void **state) {
    scene asked = make_floor(1, 4);
    double corners[1][3][3] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    const ps_mesh mesh = {.num_triangles = 1, .triangles = corners};
    ps_view view;
    ps_error error = {0};
    (void)state;
    asked.options.camera.direction[2] = 1;
    assert_int_equal(ps_view_make(&view, &mesh, &asked.options, NULL, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "sees nothing of the mesh"));
    ps_view_free(&view);
    set(asked.options.camera.up, 0, 0, 5);
    assert_int_equal(ps_view_make(&view, &mesh, &asked.options, NULL, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "looks along"));
    ps_view_free(&view);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_and_planes), cmocka_unit_test(far_cameras),
        cmocka_unit_test(same_counts),      cmocka_unit_test(one_quad),
        cmocka_unit_test(white_points),     cmocka_unit_test(cameras_that_see_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
