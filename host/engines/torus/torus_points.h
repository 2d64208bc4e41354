/* Point sets on their way to the device: fixed-point coordinates, weights, offsets, one slab of
 * every realization at a time, so that device memory does not grow with the number of points.
 */
#ifndef PS_ENGINES_TORUS_TORUS_POINTS_H
#define PS_ENGINES_TORUS_TORUS_POINTS_H

#include "engines/engine.h"
#include "engines/feed.h"

typedef struct ps_torus_points {
    unsigned dimension;
    size_t batch, slab; /* realizations, points of each at a time */
    ps_precision precision;
    bool far_apart;         /* order of the points, see ps_torus_point_step */
    bool has_unit_weights;  /* on the device; so it stays until a pattern has weights */
    void *host_weights;     /* [batch * slab] float or double */
    uint64_t *host_offsets; /* [batch + 1] */
    ps_buffer points;       /* what was uploaded, which the feed owns */
    ps_buffer weights, offsets;
    ps_feed feed; /* [batch * slab][dimension] */
} ps_torus_points;

pspec_status ps_torus_points_create(ps_torus_points *out, unsigned dimension, size_t batch,
                                    size_t slab, ps_precision precision, bool far_apart,
                                    ps_device *device, ps_error *error) PS_MUST_CHECK;
void ps_torus_points_free(ps_torus_points *points);

/* Points go to the device in steps of about N / golden ratio, so that the points of a run of the
 * kernels lie far apart whatever the order of the pattern: in sorted patterns, neighbours would add
 * up in step at low frequencies and round the same way. A step without common factor with n visits
 * every point once. (Runs of lists are so short that they do without, and read large patterns in
 * order.) */
uint64_t ps_torus_point_step(uint64_t n);

/* Uploads points first .. first + slab - 1, in that order, of every pattern of the batch (fewer or
 * none where a pattern is shorter). *num_points is their number over all patterns. A coordinate
 * outside [0,1) is PSPEC_ERROR_INPUT (ps_engine.checks_points). */
pspec_status ps_torus_points_upload(ps_torus_points *points, ps_device *device,
                                    const ps_batch *batch, size_t first, size_t *num_points,
                                    ps_error *error) PS_MUST_CHECK;

/* round(x 2^64) for x in [0,1): exact for x >= 2^-11, otherwise off by at most 2^-65. */
uint64_t ps_fixed_point(double x);

#endif
