#include "base/memory.h"
#include "jobs/occlusion/occlusion_job.h"
#include "jobs/occlusion/rays.h"
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
        ps_sphere_point_portable(ps_height_of_area(true, height), ps_turns_of(turns),
                                 points + 3 * j);
    }
}

static void add(pixel_sums *sums, const uint32_t *counts, size_t num_pixels, size_t num_points) {
    for (size_t i = 0; i < num_pixels; i++) {
        const double seen = counts[i] / (double)num_points;
        sums[i].sum += seen;
        sums[i].square += seen * seen;
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

static pspec_status shoot(ps_reference *out, const ps_view *view, size_t n, uint64_t seed,
                          ps_rays *rays, const ps_watch *watch, ps_error *error) {
    double *points = NULL;
    uint32_t *counts = NULL;
    pixel_sums *sums = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, PS_NEW(&points, 3 * n * n, "points", error));
    PS_TRY_OUT(status, PS_NEW(&counts, view->num_pixels, "counts of rays", error));
    PS_TRY_OUT(status, PS_NEW(&sums, view->num_pixels, "sums of rays", error));
    for (uint64_t r = 0; r < PS_REFERENCE_SETS; r++) {
        const ps_ray_set set = {
            .points = points, .num = n * n, .is_folded = true, .seed = seed, .number = r};
        make_points(points, n, seed, r);
        PS_TRY_OUT(status, ps_rays_count(rays, &set, counts, watch, error));
        add(sums, counts, view->num_pixels, set.num);
    }
    finish(out, sums, view->num_pixels);
out:
    free(points);
    free(counts);
    free(sums);
    return status;
}

static size_t strata(uint64_t num_rays) {
    return (size_t)ceil(sqrt((double)num_rays / PS_REFERENCE_SETS));
}

size_t ps_reference_points(uint64_t num_rays) {
    return strata(num_rays) * strata(num_rays);
}

pspec_status ps_reference_make(ps_reference *out, const ps_view *view, uint64_t num_rays,
                               uint64_t seed, ps_device *device, const ps_watch *watch,
                               ps_error *error) {
    const size_t n = strata(num_rays);
    const uint64_t own_seed = ps_random_seed_of(seed, PS_STREAM_TRIALS, "reference\n");
    ps_rays *rays = NULL;
    *out = (ps_reference){.num_rays = PS_REFERENCE_SETS * n * n};
    PS_TRY(PS_NEW(&out->seen, view->num_pixels, "pixels", error));
    PS_TRY(ps_rays_create(&rays, view, n * n, device, error));
    const pspec_status status = shoot(out, view, n, own_seed, rays, watch, error);
    ps_rays_destroy(rays);
    return status;
}

void ps_reference_free(ps_reference *reference) {
    free(reference->seen);
    *reference = (ps_reference){0};
}
