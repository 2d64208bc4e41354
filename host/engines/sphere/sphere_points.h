/* Points of the sphere on their way to the device, which makes directions of them: one slab of
 * every realization at a time, so that memory does not grow with the number of points.
 */
#ifndef PS_ENGINES_SPHERE_SPHERE_POINTS_H
#define PS_ENGINES_SPHERE_SPHERE_POINTS_H

#include "engines/feed.h"
#include "engines/sphere/sphere_layout.h"

typedef struct ps_sphere_points {
    const ps_sphere_layout *layout;
    ps_device *device;
    size_t batch, capacity; /* realizations; points of all of them on the device */
    double *host_weights;   /* [capacity] */
    uint64_t *host_offsets; /* [batch + 1] in vectors of lanes */
    size_t num_vectors;     /* of what was uploaded last, of all realizations */
    ps_kernel *prepare;     /* NULL: the device has no double precision, and the host does it */
    void *host_values;      /* [arrays][capacity], then */
    uint64_t *host_turns;   /* [capacity] */
    ps_feed points;         /* [capacity][3] */
    ps_buffer values, turns, weights, offsets;
} ps_sphere_points;

/* layout outlives the points. */
pspec_status ps_sphere_points_create(ps_sphere_points *out, const ps_sphere_layout *layout,
                                     size_t batch, ps_device *device,
                                     ps_error *error) PS_MUST_CHECK;
void ps_sphere_points_free(ps_sphere_points *points);

/* Uploads points first .. first + slab - 1 of every pattern of the batch (fewer or none where a
 * pattern is shorter), each pattern padded with points of weight 0 to whole vectors, and makes
 * their directions. */
pspec_status ps_sphere_points_upload(ps_sphere_points *points, const ps_batch *batch, size_t first,
                                     ps_error *error) PS_MUST_CHECK;

/* What kernels/sphere/prepare.cl does, on the host: num points to values[array * capacity + point].
 */
void ps_sphere_prepare(const double *points, size_t num, bool only_even, ps_precision precision,
                       size_t capacity, void *values, uint64_t *turns);

#endif
