/* Rays from the pixels of a view in the directions of a set, which every pixel turns at random: how
 * many see nothing. On a device by rays/visible.cl, or on the host: the same counts, whatever
 * pixels are done at a time, and by whom. */
#ifndef PS_JOBS_OCCLUSION_RAYS_H
#define PS_JOBS_OCCLUSION_RAYS_H

#include "device/device.h"
#include "jobs/occlusion/view.h"

typedef struct ps_rays ps_rays;

typedef struct ps_ray_set {
    const double *points; /* [num][3], unit vectors */
    size_t num;           /* at least 1 */
    /* Points of the hemisphere: turned to the other side of a pixel they become their opposites.
     * Else those that are there are not tried */
    bool is_folded;
    uint64_t seed, number; /* of the turns */
} ps_ray_set;

/* For sets of at most so many points. Borrows the view and the device; NULL: on the host. */
pspec_status ps_rays_create(ps_rays **out, const ps_view *view, size_t most_points,
                            ps_device *device, ps_error *error) PS_MUST_CHECK;
/* What they take there and here. Of the view only num_pixels and num_triangles are looked at. */
uint64_t ps_rays_bytes(const ps_view *view, size_t most_points, ps_device *device);
void ps_rays_destroy(ps_rays *rays); /* NULL is allowed */
/* counts[num_pixels] of the view. */
pspec_status ps_rays_count(ps_rays *rays, const ps_ray_set *set, uint32_t *counts,
                           const ps_watch *watch, ps_error *error) PS_MUST_CHECK;
/* Pixels at a time from now on; 0: as many as are best. For tests: counts do not depend on it. */
void ps_rays_set_batch(ps_rays *rays, size_t num_pixels);

/* ---- on the host (rays_host.c) --------------------------------------------------------------- */

enum { PS_TURN_NUMBERS = 9 };

/* Pixels first .. first + num - 1; turns[num][9], points[3][capacity], of which there are
 * num_points. */
typedef struct ps_ray_batch {
    const ps_view *view;
    size_t first, num;
    const float *turns, *points;
    size_t num_points, capacity;
    bool is_folded;
    uint32_t *counts; /* [num] */
} ps_ray_batch;
void ps_rays_count_on_host(const ps_ray_batch *batch);

#endif
