/* Directions on their way to the device, where they become places on a torus
 * (kernels/sphere/nufft/orders_turns.cl). */
#ifndef PS_ENGINES_SPHERE_NUFFT_PLACES_H
#define PS_ENGINES_SPHERE_NUFFT_PLACES_H

#include "engines/feed.h"
#include "engines/sphere/nufft/shape.h"

typedef struct ps_sphere_places {
    ps_device *device;
    ps_precision precision;
    const ps_sphere_shape *shape;
    size_t most_points; /* of all realizations together */
    size_t num_points;  /* that are on the device */
    unsigned lanes;
    uint64_t shift;         /* of the angle from the pole, in units of 2^-64 turns */
    bool has_unit_weights;  /* on the device */
    ps_kernel *turn;        /* or sort, or keys where there is an order */
    ps_nufft_order order;   /* of parts, on GPUs */
    void *host_weights;     /* [most_points] float or double */
    uint64_t *host_offsets; /* [together + 1], where there is an order of the parts */
    ps_feed vectors;        /* [most_points][3] */
    ps_buffer turns, weights, offsets;
    ps_buffer keys, sorted, heights, starts; /* of kernels/sphere/nufft/orders_sort.cl */
} ps_sphere_places;

/* shape is borrowed. */
pspec_status ps_sphere_places_create(ps_sphere_places *out, const ps_sphere_shape *shape,
                                     ps_precision precision, ps_device *device,
                                     ps_error *error) PS_MUST_CHECK;
void ps_sphere_places_free(ps_sphere_places *points);

/* Makes the places of at most shape->together patterns, of shape->most_points points together. */
pspec_status ps_sphere_places_make(ps_sphere_places *points, const ps_batch *batch,
                                   ps_error *error) PS_MUST_CHECK;

#endif
