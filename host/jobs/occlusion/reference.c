#include "base/memory.h"
#include "jobs/occlusion/occlusion_job.h"
#include "jobs/occlusion/rays.h"
#include "jobs/rows/set_loop.h"
#include "math/lift.h"
#include "math/neumaier.h"
#include "math/random/random.h"

#include <math.h>
#include <stdlib.h>

/* Sums over the sets, of every pixel. */
typedef struct pixel_sums {
    double sum, square;
} pixel_sums;

/* A point in each of n^2 strata of equal area. */
static void make_points(double *points, size_t n, uint64_t seed, uint64_t set) {
    ps_random random = ps_random_init(seed, PS_STREAM_COORDINATES, set);
    for (size_t j = 0; j < n * n; j++) {
        const double height = ((double)(j / n) + ps_random_uniform(&random)) / (double)n;
        const double turns = ((double)(j % n) + ps_random_uniform(&random)) / (double)n;
        ps_sphere_point(ps_height_of_area(true, height), ps_turns_of(turns), points + 3 * j);
    }
}

static void finish(ps_reference *out, const pixel_sums *sums, size_t num_pixels) {
    const double num = PS_REFERENCE_SETS;
    ps_neumaier mean = {0, 0};
    ps_neumaier variance = {0, 0};
    ps_neumaier square = {0, 0};
    for (size_t i = 0; i < num_pixels; i++) {
        out->seen[i] = sums[i].sum / num;
        const double own = (sums[i].square / num - out->seen[i] * out->seen[i]) / (num - 1);
        ps_neumaier_add(&mean, out->seen[i]);
        ps_neumaier_add(&variance, own);
        ps_neumaier_add(&square, own * own);
    }
    out->mean = ps_neumaier_value(&mean) / (double)num_pixels;
    out->variance = fmax(ps_neumaier_value(&variance) / (double)num_pixels, 0);
    /* Of means of `num` normal numbers with the variance v squares have the variance 2 v^2, and
     * what is found for v has the mean square v^2 (num + 1)/(num - 1) and the variance 2 v^2/(num -
     * 1). */
    out->variance_error =
        sqrt(2 * num / (num + 1) * ps_neumaier_value(&square)) / (double)num_pixels;
}

/* ---- sets ----------------------------------------------------------------------------------- */

typedef struct work {
    const ps_view *view;
    const ps_watch *watch;
    size_t n; /* sets have n^2 points */
    uint64_t seed;
    ps_rays *rays;
    double *points;   /* [n^2][3] */
    pixel_sums *sums; /* [num_pixels] */
} work;

/* A row has the rays of every pixel that see nothing. */
static pspec_status make(void *payload, uint64_t first, size_t most, void *rows, size_t *num,
                         ps_error *error) {
    work *const self = payload;
    const ps_ray_set set = {.points = self->points,
                            .num = self->n * self->n,
                            .is_folded = true,
                            .seed = self->seed,
                            .number = first};
    *num = most > 0 && first < PS_REFERENCE_SETS ? 1 : 0;
    if (*num == 0) {
        return PSPEC_OK;
    }
    make_points(self->points, self->n, self->seed, first);
    return ps_rays_count(self->rays, &set, rows, self->watch, error);
}

static void take(void *payload, uint64_t number, const void *row) {
    work *const self = payload;
    const uint32_t *const counts = row;
    (void)number;
    for (size_t i = 0; i < self->view->num_pixels; i++) {
        const double seen = counts[i] / (double)(self->n * self->n);
        self->sums[i].sum += seen;
        self->sums[i].square += seen * seen;
    }
}

static pspec_status walk(void *payload, ps_snapshot *snapshot, ps_error *error) {
    work *const self = payload;
    return ps_snapshot_doubles(snapshot, "pixel_sums", (double *)self->sums,
                               2 * self->view->num_pixels, error);
}

static pspec_status shoot(work *self, ps_reference *out, ps_device *device,
                          const ps_checkpoint_spec *checkpoint, ps_error *error) {
    const size_t num_pixels = self->view->num_pixels;
    const size_t num_points = self->n * self->n;
    ps_set_loop loop = {.stream = {.job = self,
                                   .make = make,
                                   .row_bytes = num_pixels * sizeof(uint32_t),
                                   .batch = 1,
                                   .total = PS_REFERENCE_SETS,
                                   .is_whole = true,
                                   .device = device},
                        .take = take,
                        .walk = walk,
                        .spec = checkpoint};
    PS_TRY(PS_NEW(&out->seen, num_pixels, "pixels", error));
    PS_TRY(PS_NEW(&self->points, 3 * num_points, "points", error));
    PS_TRY(PS_NEW(&self->sums, num_pixels, "sums of rays", error));
    PS_TRY(ps_rays_create(&self->rays, self->view, num_points, device, error));
    PS_TRY(ps_set_loop_run(&loop, error));
    finish(out, self->sums, num_pixels);
    return PSPEC_OK;
}

static size_t strata(uint64_t num_rays) {
    return (size_t)ceil(sqrt((double)num_rays / PS_REFERENCE_SETS));
}

size_t ps_reference_points(uint64_t num_rays) {
    return strata(num_rays) * strata(num_rays);
}

pspec_status ps_reference_make(ps_reference *out, const ps_view *view, uint64_t num_rays,
                               uint64_t seed, ps_device *device,
                               const ps_checkpoint_spec *checkpoint, const ps_watch *watch,
                               ps_error *error) {
    work self = {.view = view,
                 .watch = watch,
                 .n = strata(num_rays),
                 .seed = ps_random_seed_of(seed, PS_STREAM_TRIALS, "reference\n")};
    *out = (ps_reference){.num_rays = PS_REFERENCE_SETS * self.n * self.n};
    const pspec_status status = shoot(&self, out, device, checkpoint, error);
    ps_rays_destroy(self.rays);
    free(self.points);
    free(self.sums);
    return status;
}

void ps_reference_free(ps_reference *reference) {
    free(reference->seen);
    *reference = (ps_reference){0};
}
