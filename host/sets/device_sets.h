/* Realizations of a sampler whose points are known by their index, made by a kernel where engines
 * read them (kernels/samplers/points.cl, sphere_points.cl), with the bits that the host makes and,
 * on the torus, converts.
 */
#ifndef PS_SETS_DEVICE_SETS_H
#define PS_SETS_DEVICE_SETS_H

#include "device/device.h"
#include "samplers/sampler.h"

typedef struct ps_device_sets ps_device_sets;

/* Are sets of the request made by such a device? GPUs alone: on CPUs the host makes them beside the
 * kernels. Not those that are shifted, and not on devices without the doubles that a sampler needs.
 * limits NULL: there is no device. */
bool ps_device_sets_serve(const ps_sampler_request *request, const ps_device_limits *limits);

/* request is one that is served, and copied. */
pspec_status ps_device_sets_create(ps_device_sets **out, const ps_sampler_request *request,
                                   ps_device *device, ps_error *error) PS_MUST_CHECK;
void ps_device_sets_destroy(ps_device_sets *sets); /* NULL is allowed */

/* Points of a realization, and numbers of a point. */
uint64_t ps_device_sets_points(const ps_device_sets *sets);
unsigned ps_device_sets_dimension(const ps_device_sets *sets);

/* Writes coordinates, on the torus as multiples of 2^-64, on the sphere as doubles,
 * [realization][range.count][dimension], to the beginning of the buffer: launched, not waited for.
 * range.step <= the number of points. */
pspec_status ps_device_sets_write(ps_device_sets *sets, const sampler_range *range,
                                  const ps_buffer *out, ps_error *error) PS_MUST_CHECK;

/* The first num points of a realization, made by the host: [num][dimension]. Of parts of a set each
 * within 2^-65 of what the sampler makes. */
pspec_status ps_device_sets_beginning(const ps_device_sets *sets, uint64_t realization, size_t num,
                                      double *points, ps_error *error) PS_MUST_CHECK;

#endif
