/* All pairs of points of the plane's torus on a device: how many are at what distance, and forces
 * that depend on it (kernels/samplers/step.h). Double precision, the same bits on any device. */
#ifndef PS_SAMPLERS_FORCES_STEP_PAIRS_H
#define PS_SAMPLERS_FORCES_STEP_PAIRS_H

#include "base/watch.h"
#include "device/device.h"
#include "samplers/step.h"

typedef struct ps_step_pairs {
    ps_device *device; /* borrowed */
    step_layout layout;
    ps_kernel *count, *force, *fold;
    bool has_shared_counts; /* work-items of a row have one copy of counts together */
    double launch_pairs;    /* at most, in a launch; results do not depend on it */
    ps_buffer points, counts, table, forces, sums;
    double *coordinates; /* [axis][stride] */
    uint32_t *copies;    /* [(num_blocks + 1) / 2][num_bins + 1] */
} ps_step_pairs;

/* Bytes of all arrays and buffers: forces of up to 64 blocks are 1 KB a point. */
double ps_step_pairs_bytes(size_t num, size_t num_bins);

/* The device is borrowed, and refused without double precision; destroy also after a failure. */
pspec_status ps_step_pairs_create(ps_step_pairs *p, ps_device *device, size_t num, size_t num_bins,
                                  ps_error *error) PS_MUST_CHECK;
void ps_step_pairs_destroy(ps_step_pairs *p);

/* counts [num_bins] of pairs of points x [num][2] in [0,1) by distance, bins of [0, 1/2). */
pspec_status ps_step_pairs_count(ps_step_pairs *p, const double *x, uint64_t *counts,
                                 const ps_watch *watch, ps_error *error) PS_MUST_CHECK;
/* force[i] = sum_j (x_i - x_j) table[bin], x as above. table [num_bins + 1], of which the last is
 * 0: for what is farther. */
pspec_status ps_step_pairs_force(ps_step_pairs *p, const double *x, const double *table,
                                 double *force, const ps_watch *watch,
                                 ps_error *error) PS_MUST_CHECK;

#endif
