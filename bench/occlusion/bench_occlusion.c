/* Rays of ambient occlusion a second (host/jobs/occlusion) beside a plain C loop of one thread
 * (plain.c): a picture of 256 x 256 pixels, sets of 192, 1024 and 4096 points of the sphere.
 *
 *     bench_occlusion [MESH]                        default docs/scenes/p15/box.obj, 16 quadrilaterals
 *
 * Both take turns. Million rays for each second that a processor works for them, so that other
 * programs matter less: medians of the repeats, and of the ratios of neighbours. `clock` is the
 * ratio by the clock, with all processors of the device against the one of the loop, as busy as the
 * machine is. The loop has its rotations for nothing.
 */
#include "bench.h"

#include "jobs/occlusion/rays.h"
#include "math/pi.h"
#include "math/random/rotation.h"
#include "plain.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { REPEATS = 9, SIDE = 256 };

typedef struct given {
    ps_view view;
    ps_device *device;
    double *points;
    float *singles, *turns;
    uint32_t *counts, *plain;
} given;

static void *allocate(size_t num, size_t bytes) {
    void *const out = calloc(num, bytes);
    if (out == NULL) {
        bench_die("no memory");
    }
    return out;
}

static void make_given(given *self, const char *path) {
    ps_mesh mesh;
    ps_view_options options = {.width = SIDE, .height = SIDE};
    BENCH_TRY(ps_mesh_read(&mesh, path, error));
    options.camera = (ps_camera){{2.75, 2.75, -7.5}, {0, 0, 1}, {0, 1, 0}, 0.72};
    BENCH_TRY(ps_view_make(&self->view, &mesh, &options, NULL, error));
    BENCH_TRY(ps_device_open(&self->device, NULL, false, error));
    ps_mesh_free(&mesh);
    const size_t most = BENCH_PLAIN_MOST_RAYS;
    double *const uniform = bench_uniform(2 * most, 1);
    self->points = allocate(3 * most, sizeof *self->points);
    self->singles = allocate(3 * most, sizeof *self->singles);
    self->turns = allocate(self->view.num_pixels * 9, sizeof *self->turns);
    self->counts = allocate(self->view.num_pixels, sizeof *self->counts);
    self->plain = allocate(self->view.num_pixels, sizeof *self->plain);
    for (size_t j = 0; j < most; j++) {
        const double z = 2 * uniform[2 * j] - 1;
        const double phi = PS_TWO_PI * uniform[2 * j + 1];
        const double point[] = {sqrt(1 - z * z) * cos(phi), sqrt(1 - z * z) * sin(phi), z};
        for (size_t axis = 0; axis < 3; axis++) {
            self->points[3 * j + axis] = point[axis];
            self->singles[axis * most + j] = (float)point[axis];
        }
    }
    for (size_t i = 0; i < self->view.num_pixels; i++) {
        ps_random random = ps_random_init(1, PS_STREAM_TRIALS, i); /* as ps_rays_count has them */
        const ps_rotation rotation = ps_rotation_random_portable(&random);
        for (size_t k = 0; k < 9; k++) {
            self->turns[9 * i + k] = (float)rotation.matrix[k / 3][k % 3];
        }
    }
    free(uniform);
}

/* Of all threads. */
static double cpu_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Rays per second of a processor, and by the clock; rays NULL: of the plain loop. */
typedef struct measured {
    double cpu, clock;
} measured;

static measured run(given *self, ps_rays *rays, size_t num) {
    const double cpu = cpu_seconds(), clock = bench_seconds();
    const double all = (double)(num * self->view.num_pixels);
    if (rays != NULL) {
        const ps_ray_set set = {.points = self->points, .num = num, .seed = 1};
        BENCH_TRY(ps_rays_count(rays, &set, self->counts, NULL, error));
    }
    for (size_t i = 0; rays == NULL && i < self->view.num_pixels; i++) {
        self->plain[i] = (uint32_t)bench_plain_count(self->view.corners, self->view.num_triangles,
                                                     self->view.places + 6 * i, self->turns + 9 * i,
                                                     self->singles, BENCH_PLAIN_MOST_RAYS, num);
    }
    return (measured){all / (cpu_seconds() - cpu), all / (bench_seconds() - clock)};
}

/* Rays of which one of both says that they are hidden, of those on an edge, per million. */
static double difference(const given *self, size_t num) {
    double sum = 0;
    for (size_t i = 0; i < self->view.num_pixels; i++) {
        sum += fabs((double)self->counts[i] - (double)self->plain[i]);
    }
    return 1e6 * sum / (double)(num * self->view.num_pixels);
}

static void run_case(given *self, size_t num) {
    double plain[REPEATS], own[REPEATS], ratios[REPEATS], clocks[REPEATS];
    ps_rays *rays = NULL;
    BENCH_TRY(ps_rays_create(&rays, &self->view, num, self->device, error));
    run(self, rays, num);
    for (int i = 0; i < REPEATS; i++) {
        const measured loop = run(self, NULL, num), here = run(self, rays, num);
        plain[i] = loop.cpu;
        own[i] = here.cpu;
        ratios[i] = here.cpu / loop.cpu;
        clocks[i] = here.clock / loop.clock;
    }
    printf("%6zu %8.1f %9.1f %7.2f %7.2f %7.1f\n", num, 1e-6 * bench_median(plain, REPEATS),
           1e-6 * bench_median(own, REPEATS), bench_median(ratios, REPEATS),
           bench_median(clocks, REPEATS), difference(self, num));
    fflush(stdout);
    ps_rays_destroy(rays);
}

int main(int argc, char **argv) {
    static const size_t nums[] = {192, 1024, BENCH_PLAIN_MOST_RAYS};
    given self = {.device = NULL};
    make_given(&self, argc > 1 ? argv[1] : "docs/scenes/p15/box.obj");
    printf("# %zu triangles, %zu pixels; million rays, differences per million rays\n",
           self.view.num_triangles, self.view.num_pixels);
    printf("%6s %8s %9s %7s %7s %7s\n", "points", "plain", "pointspec", "ratio", "clock", "differ");
    for (size_t i = 0; i < sizeof nums / sizeof nums[0]; i++) {
        run_case(&self, nums[i]);
    }
    ps_view_free(&self.view);
    ps_device_close(self.device);
    free(self.points);
    free(self.singles);
    free(self.turns);
    free(self.counts);
    free(self.plain);
    return 0;
}
