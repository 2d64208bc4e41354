/* Directions on their way to the device, where they become places on a torus (kernels/sphere/orders_turns.cl). */
#ifndef PS_ENGINES_SPHERE_NUFFT_POINTS_H
#define PS_ENGINES_SPHERE_NUFFT_POINTS_H

#include "engines/sphere_nufft_shape.h"

typedef struct ps_sphere_places {
    ps_device *device;
    ps_precision precision;
    size_t most_points; /* of all realizations together */
    unsigned lanes;
    uint64_t shift;        /* of the angle from the pole, in units of 2^-64 turns */
    bool has_unit_weights; /* on the device */
    cl_kernel turn;
    void *host_weights;     /* [most_points] float or double */
    uint64_t *host_offsets; /* [at_once + 1] */
    ps_buffer vectors, turns, weights, offsets;
} ps_sphere_places;

pspec_status ps_sphere_places_create(ps_sphere_places *out, const ps_sphere_shape *shape,
                                     uint64_t num_points, ps_precision precision, ps_device *device,
                                     ps_error *error) PS_MUST_CHECK;
void ps_sphere_places_free(ps_sphere_places *points);

/* At most shape->at_once patterns. */
pspec_status ps_sphere_places_make(ps_sphere_places *points, const ps_batch *batch,
                                   ps_error *error) PS_MUST_CHECK;

#endif
