/* Time, arithmetic and traffic per kernel, from device events. */
#include "device/device_private.h"

#include <stdio.h>
#include <string.h>

static ps_profile_row *find_row(ps_device *device, const char *name) {
    for (size_t i = 0; i < device->num_profile_rows; i++) {
        if (strcmp(device->profile[i].kernel, name) == 0) {
            return &device->profile[i];
        }
    }
    if (device->num_profile_rows == PS_PROFILE_ROWS) {
        return NULL;
    }
    ps_profile_row *row = &device->profile[device->num_profile_rows++];
    memset(row, 0, sizeof *row);
    snprintf(row->kernel, sizeof row->kernel, "%s", name);
    return row;
}

static pspec_status measure(cl_event event, double *seconds, ps_error *error) {
    const double nanoseconds = 1e-9;
    cl_ulong begin = 0;
    cl_ulong end = 0;
    PS_TRY_CL(clWaitForEvents(1, &event), error);
    PS_TRY_CL(
        clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof begin, &begin, NULL),
        error);
    PS_TRY_CL(clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, NULL),
              error);
    *seconds = (double)(end - begin) * nanoseconds;
    return PSPEC_OK;
}

pspec_status ps_profile_add(ps_device *device, const char *kernel, const ps_range *range,
                            cl_event event, ps_error *error) {
    double seconds = 0;
    const pspec_status status = measure(event, &seconds, error);
    clReleaseEvent(event);
    PS_TRY(status);
    ps_profile_row *row = find_row(device, kernel);
    if (row != NULL) {
        row->launches++;
        row->seconds += seconds;
        row->flops += range->flops;
        row->bytes += range->bytes;
    }
    return PSPEC_OK;
}

const ps_profile_row *ps_device_profile(const ps_device *device, size_t *num_rows) {
    *num_rows = device->num_profile_rows;
    return device->profile;
}
