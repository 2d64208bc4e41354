/* kernels/rays/visible.cl: counts of every kind of set as the host has them, in pieces that the set
 * does not fill. */
#include "harness.h"

#include "jobs/occlusion/rays.h"

#include <math.h>
#include <string.h>

enum { NUM_POINTS = 21, NUM_PIXELS = 3, NUM_TRIANGLES = 3 };

static void make_points(double *points) {
    uint64_t random = 4;
    for (size_t j = 0; j < NUM_POINTS; j++) {
        const double z = 2 * test_uniform(&random) - 1;
        const double phi = 7 * test_uniform(&random);
        points[3 * j] = sqrt(1 - z * z) * cos(phi);
        points[3 * j + 1] = sqrt(1 - z * z) * sin(phi);
        points[3 * j + 2] = z;
    }
}

/* Two triangles above, one of them beyond the radius of 1/2, and one that is in the plane of the
 * first pixel. */
static void visible(void **state) {
    float corners[NUM_TRIANGLES * PS_CORNER_NUMBERS] = {-1, -1, 0.25F, 1, -1, 0.25F, 0, 1, 0.25F,
                                                        0,  -2, 0.75F, 2, -2, 1,     1, 2, 1,
                                                        -1, -1, 0,     1, -1, 0,     0, 1, 0};
    float places[NUM_PIXELS * PS_PLACE_NUMBERS] = {0, 0,     0, 0, 0,    1,    0.25F, 0, 0.5F,
                                                   0, -0.6F, 0, 0, 0.8F, 0.1F, 0.2F,  0, 0};
    places[17] = -1;
    uint32_t pixels[NUM_PIXELS] = {0, 1, 2};
    double points[3 * NUM_POINTS];
    ps_device *const device = test_open_device();
    uint32_t before[NUM_PIXELS] = {0};
    (void)state;
    make_points(points);
    for (int kind = 0; kind < 4; kind++) {
        const ps_view view = {.is_bounded = kind % 2 == 1,
                              .radius = 0.5F,
                              .num_triangles = NUM_TRIANGLES,
                              .corners = corners,
                              .num_pixels = NUM_PIXELS,
                              .pixels = pixels,
                              .places = places};
        const ps_ray_set set = {points, NUM_POINTS, kind / 2 == 1, 5, 2};
        uint32_t counts[2][NUM_PIXELS];
        for (int i = 0; i < 2; i++) {
            ps_rays *rays = NULL;
            assert_ok(ps_rays_create(&rays, &view, NUM_POINTS, i == 0 ? NULL : device, error));
            assert_ok(ps_rays_count(rays, &set, counts[i], NULL, error));
            ps_rays_destroy(rays);
        }
        assert_memory_equal(counts[0], counts[1], sizeof before);
        assert_true(counts[0][0] > 0 && counts[0][0] < NUM_POINTS);
        assert_memory_not_equal(counts[0], before, sizeof before);
        memcpy(before, counts[0], sizeof before);
    }
    ps_device_close(device);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(visible)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
