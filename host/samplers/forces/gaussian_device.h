/* Sums of Gaussians on a device: the same bits as those of the host (kernels/samplers/gaussian.cl).
 */
#ifndef PS_SAMPLERS_FORCES_GAUSSIAN_DEVICE_H
#define PS_SAMPLERS_FORCES_GAUSSIAN_DEVICE_H

#include "base/watch.h"
#include "device/device.h"

typedef struct ps_gaussian_sums ps_gaussian_sums;

typedef struct ps_gaussian_device {
    ps_device *device; /* borrowed */
    ps_kernel *kernel;
    ps_buffer points, begins, sums;
} ps_gaussian_device;

/* For sets of that shape; a device without double precision is refused. Destroy also after a
 * failure. */
pspec_status ps_gaussian_device_create(ps_gaussian_device *d, ps_device *device,
                                       const ps_gaussian_sums *shape,
                                       ps_error *error) PS_MUST_CHECK;
void ps_gaussian_device_destroy(ps_gaussian_device *d);

/* s->sums of s->points, which are sorted. */
pspec_status ps_gaussian_device_sum(ps_gaussian_device *d, const ps_gaussian_sums *s,
                                    const ps_watch *watch, ps_error *error) PS_MUST_CHECK;

#endif
