/* Typed launches: arguments travel with the launch and are counted; sizes are checked first. */
#include "device/device_private.h"

#include <math.h>

/* Enough to fill a GPU's scheduling unit (32 or 64 items) without binding small launches. */
enum { DEFAULT_GROUP_SIZE = 64 };

void ps_device_set_group_size(ps_device *device, size_t group_size) {
    device->group_size = group_size;
}

static ps_range make_range(size_t group, size_t first, size_t second, size_t third, double flops,
                           double bytes) {
    return (ps_range){.rank = 3,
                      .global = {(first + group - 1) / group * group, second, third},
                      .local = {group, 1, 1},
                      .flops = flops,
                      .bytes = bytes};
}

static size_t light_group_size(const ps_device *device) {
    const size_t group = device->group_size > 0 ? device->group_size : DEFAULT_GROUP_SIZE;
    return group < device->limits.max_work_group_size ? group : device->limits.max_work_group_size;
}

ps_range ps_range_light(const ps_device *device, size_t first, size_t second, size_t third,
                        double flops, double bytes) {
    return make_range(light_group_size(device), first, second, third, flops, bytes);
}

/* On a CPU a work-group runs on one thread and costs PoCL about a quarter of a microsecond: as many
 * items as make it worth that, but enough groups to keep every thread busy to the end, and no more
 * than there are along the first axis. Powers of four alone: PoCL compiles a kernel anew for every
 * size, which takes most of a second. */
static size_t cpu_group_size(const ps_device *device, size_t first, double items, double flops) {
    const double worthwhile_flops = 4e6; /* 16 microseconds of one AVX-512 core; 4 at least */
    const double groups_per_unit = 16;
    const double wanted = worthwhile_flops * items / flops;
    const double allowed = items / (groups_per_unit * device->limits.compute_units);
    const double most = fmin(fmin(wanted, allowed), (double)first);
    size_t size = 1;
    while (size < DEFAULT_GROUP_SIZE && 4 * (double)size <= most) {
        size *= 4;
    }
    return size;
}

bool ps_range_is_alone(const ps_device *device) {
    return !device->limits.has_dedicated_local_memory && device->group_size == 0;
}

ps_range ps_range_alone(size_t second, double flops) {
    return make_range(1, 1, second, 1, flops, 0);
}

ps_range ps_range_heavy(const ps_device *device, size_t first, size_t second, size_t third,
                        double flops, double bytes) {
    const bool is_cpu = ps_range_is_alone(device);
    const double items = (double)first * (double)second * (double)third;
    const size_t group =
        is_cpu ? cpu_group_size(device, first, items, flops) : light_group_size(device);
    return make_range(group, first, second, third, flops, bytes);
}

ps_range ps_range_shared(const ps_device *device, size_t wanted, size_t second, size_t third,
                         double flops, double bytes) {
    const size_t most = device->limits.max_work_group_size;
    const size_t fitting = wanted < most ? wanted : most;
    return make_range(device->group_size > 0 ? light_group_size(device) : fitting, 1, second, third,
                      flops, bytes);
}

static pspec_status set_arguments(cl_kernel kernel, const ps_argument *arguments,
                                  size_t num_arguments, size_t *local_bytes, ps_error *error) {
    cl_uint expected = 0;
    PS_TRY_CL(clGetKernelInfo(kernel, CL_KERNEL_NUM_ARGS, sizeof expected, &expected, NULL), error);
    if (expected != num_arguments) {
        return ps_fail(error, PSPEC_ERROR_DEVICE, "a kernel takes %u arguments but %zu were given",
                       expected, num_arguments);
    }
    *local_bytes = 0;
    for (size_t i = 0; i < num_arguments; i++) {
        *local_bytes += arguments[i].value == NULL ? arguments[i].bytes : 0;
        PS_TRY_CL(clSetKernelArg(kernel, (cl_uint)i, arguments[i].bytes, arguments[i].value),
                  error);
    }
    return PSPEC_OK;
}

/* PoCL ends the process when a launch asks for too much local memory, so this must come first. */
static pspec_status check_limits(const ps_device *device, cl_kernel kernel, const ps_range *range,
                                 size_t local_bytes, ps_error *error) {
    size_t kernel_limit = 0;
    cl_ulong kernel_local_bytes = 0;
    PS_TRY_CL(clGetKernelWorkGroupInfo(kernel, device->id, CL_KERNEL_WORK_GROUP_SIZE,
                                       sizeof kernel_limit, &kernel_limit, NULL),
              error);
    PS_TRY_CL(clGetKernelWorkGroupInfo(kernel, device->id, CL_KERNEL_LOCAL_MEM_SIZE,
                                       sizeof kernel_local_bytes, &kernel_local_bytes, NULL),
              error);
    size_t group = 1;
    for (unsigned i = 0; i < range->rank; i++) {
        group *= range->local[i] > 0 ? range->local[i] : 1;
    }
    if (group > kernel_limit) {
        return ps_fail(error, PSPEC_ERROR_DEVICE,
                       "a work-group of %zu items is more than the %zu that device \"%s\" allows",
                       group, kernel_limit, device->limits.name);
    }
    /* Drivers may or may not count the pointer arguments already; the larger reading is safe. */
    const uint64_t own = device->limits.has_dedicated_local_memory ? PS_DRIVERS_LOCAL_BYTES : 0;
    const uint64_t counted = kernel_local_bytes > own ? kernel_local_bytes - own : 0;
    const uint64_t needed = local_bytes > counted ? local_bytes : counted;
    if (needed > device->limits.local_bytes) {
        return ps_fail(error, PSPEC_ERROR_DEVICE,
                       "a launch needs %llu bytes of local memory, device \"%s\" has %llu",
                       (unsigned long long)needed, device->limits.name,
                       (unsigned long long)device->limits.local_bytes);
    }
    return PSPEC_OK;
}

pspec_status ps_launch_arguments(ps_device *device, ps_kernel *kernel, const ps_range *range,
                                 const ps_argument *arguments, size_t num_arguments,
                                 ps_error *error) {
    size_t local_bytes = 0;
    cl_event event = NULL;
    cl_kernel object = NULL;
    for (unsigned i = 0; i < range->rank; i++) {
        if (range->global[i] == 0) {
            return PSPEC_OK;
        }
    }
    PS_TRY(ps_kernel_object(device, kernel, &object, error));
    PS_TRY(set_arguments(object, arguments, num_arguments, &local_bytes, error));
    PS_TRY(check_limits(device, object, range, local_bytes, error));
    PS_TRY_CL(clEnqueueNDRangeKernel(device->queue, object, range->rank, range->offset,
                                     range->global, range->local[0] > 0 ? range->local : NULL, 0,
                                     NULL, device->has_profile ? &event : NULL),
              error);
    device->launched_flops += range->flops;
    device->num_enqueued++;
    const cl_int code = clFlush(device->queue); /* it works while the host prepares more */
    if (code != CL_SUCCESS) {
        if (event != NULL) {
            clReleaseEvent(event);
        }
        return ps_device_fail(code, "clFlush", error);
    }
    return device->has_profile ? ps_profile_add(device, kernel->name, range, event, error)
                               : PSPEC_OK;
}

double ps_device_launched_flops(const ps_device *device) {
    return device->launched_flops;
}
