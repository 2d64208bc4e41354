/* The table of all OpenCL functions that the device layer calls: how each fails. */
#include "faults.h"

#include <CL/cl.h>
#include <string.h>

/* A call that only returns a code. */
#define STATUS(name, failure, parameters, arguments)                                               \
    WRAPPER(name, cl_int, parameters) {                                                            \
        return fault_is_due(FAULT_OPENCL, #name) ? failure : __real_##name arguments;              \
    }

/* A call that makes an object; its last parameter is called code. */
#define CREATE(name, type, failure, parameters, arguments)                                         \
    WRAPPER(name, type, parameters) {                                                              \
        if (fault_is_due(FAULT_OPENCL, #name)) {                                                   \
            *code = failure;                                                                       \
            return NULL;                                                                           \
        }                                                                                          \
        type object = __real_##name arguments;                                                     \
        fault_gain(object, #name);                                                                 \
        return object;                                                                             \
    }

/* A call that gives one up: it does so, and may say that it failed. */
#define RELEASE(name, type)                                                                        \
    WRAPPER(name, cl_int, (type object)) {                                                         \
        const bool is_due = fault_is_due(FAULT_OPENCL, #name);                                     \
        fault_lose(object);                                                                        \
        const cl_int code = __real_##name(object);                                                 \
        return is_due ? CL_OUT_OF_RESOURCES : code;                                                \
    }

/* A call that queues work; its last parameter is called event. */
#define ENQUEUE(name, failure, parameters, arguments)                                              \
    WRAPPER(name, cl_int, parameters) {                                                            \
        if (fault_is_due(FAULT_OPENCL, #name)) {                                                   \
            return failure;                                                                        \
        }                                                                                          \
        const cl_int code = __real_##name arguments;                                               \
        if (code == CL_SUCCESS && event != NULL) {                                                 \
            fault_gain(*event, #name);                                                             \
        }                                                                                          \
        return code;                                                                               \
    }

/* ---- platforms and devices ----------------------------------------------------------------- */

STATUS(clGetPlatformIDs, CL_OUT_OF_HOST_MEMORY,
       (cl_uint room, cl_platform_id *platforms, cl_uint *num), (room, platforms, num))
STATUS(clGetPlatformInfo, CL_OUT_OF_HOST_MEMORY,
       (cl_platform_id id, cl_platform_info what, size_t bytes, void *value, size_t *size),
       (id, what, bytes, value, size))
STATUS(clGetDeviceIDs, CL_OUT_OF_RESOURCES,
       (cl_platform_id id, cl_device_type type, cl_uint room, cl_device_id *devices, cl_uint *num),
       (id, type, room, devices, num))
/* With the largest buffer as small as a test wants it. */
WRAPPER(clGetDeviceInfo, cl_int,
        (cl_device_id id, cl_device_info what, size_t bytes, void *value, size_t *size)) {
    if (fault_is_due(FAULT_OPENCL, "clGetDeviceInfo")) {
        return CL_OUT_OF_RESOURCES;
    }
    const cl_ulong most = fault_size("POINTSPEC_FAULT_ALLOCATION_BYTES");
    const cl_int code = __real_clGetDeviceInfo(id, what, bytes, value, size);
    if (what == CL_DEVICE_MAX_MEM_ALLOC_SIZE && most > 0 && code == CL_SUCCESS &&
        bytes == sizeof most) {
        memcpy(value, &most, sizeof most);
    }
    return code;
}

/* Shares of a device. */
WRAPPER(clCreateSubDevices, cl_int,
        (cl_device_id id, const cl_device_partition_property *properties, cl_uint room,
         cl_device_id *shares, cl_uint *num)) {
    if (fault_is_due(FAULT_OPENCL, "clCreateSubDevices")) {
        return CL_DEVICE_PARTITION_FAILED;
    }
    const cl_int code = __real_clCreateSubDevices(id, properties, room, shares, num);
    for (cl_uint i = 0; code == CL_SUCCESS && i < *num; i++) {
        fault_gain(shares[i], "clCreateSubDevices");
    }
    return code;
}
RELEASE(clReleaseDevice, cl_device_id)

/* ---- contexts, queues, memory -------------------------------------------------------------- */

CREATE(clCreateContext, cl_context, CL_DEVICE_NOT_AVAILABLE,
       (const cl_context_properties *properties, cl_uint num, const cl_device_id *devices,
        void(CL_CALLBACK *notify)(const char *, const void *, size_t, void *), void *payload,
        cl_int *code),
       (properties, num, devices, notify, payload, code))
CREATE(clCreateCommandQueue, cl_command_queue, CL_OUT_OF_RESOURCES,
       (cl_context context, cl_device_id id, cl_command_queue_properties properties, cl_int *code),
       (context, id, properties, code))
CREATE(clCreateBuffer, cl_mem, CL_MEM_OBJECT_ALLOCATION_FAILURE,
       (cl_context context, cl_mem_flags flags, size_t bytes, void *host, cl_int *code),
       (context, flags, bytes, host, code))
RELEASE(clReleaseContext, cl_context)
RELEASE(clReleaseCommandQueue, cl_command_queue)
RELEASE(clReleaseMemObject, cl_mem)
STATUS(clSetMemObjectDestructorCallback, CL_OUT_OF_HOST_MEMORY,
       (cl_mem memory, void(CL_CALLBACK *hear)(cl_mem, void *), void *payload),
       (memory, hear, payload))

/* ---- programs and kernels ------------------------------------------------------------------ */

CREATE(clCreateProgramWithSource, cl_program, CL_OUT_OF_HOST_MEMORY,
       (cl_context context, cl_uint num, const char **texts, const size_t *lengths, cl_int *code),
       (context, num, texts, lengths, code))
STATUS(clBuildProgram, CL_OUT_OF_HOST_MEMORY,
       (cl_program program, cl_uint num, const cl_device_id *devices, const char *options,
        void(CL_CALLBACK *notify)(cl_program, void *), void *payload),
       (program, num, devices, options, notify, payload))
STATUS(clGetProgramBuildInfo, CL_OUT_OF_HOST_MEMORY,
       (cl_program program, cl_device_id id, cl_program_build_info what, size_t bytes, void *value,
        size_t *size),
       (program, id, what, bytes, value, size))
CREATE(clCreateKernel, cl_kernel, CL_OUT_OF_HOST_MEMORY,
       (cl_program program, const char *kernel, cl_int *code), (program, kernel, code))
STATUS(clGetKernelInfo, CL_OUT_OF_HOST_MEMORY,
       (cl_kernel kernel, cl_kernel_info what, size_t bytes, void *value, size_t *size),
       (kernel, what, bytes, value, size))
STATUS(clGetKernelWorkGroupInfo, CL_OUT_OF_HOST_MEMORY,
       (cl_kernel kernel, cl_device_id id, cl_kernel_work_group_info what, size_t bytes,
        void *value, size_t *size),
       (kernel, id, what, bytes, value, size))
STATUS(clSetKernelArg, CL_OUT_OF_HOST_MEMORY,
       (cl_kernel kernel, cl_uint index, size_t bytes, const void *value),
       (kernel, index, bytes, value))
RELEASE(clReleaseProgram, cl_program)
RELEASE(clReleaseKernel, cl_kernel)

/* ---- work ---------------------------------------------------------------------------------- */

ENQUEUE(clEnqueueNDRangeKernel, CL_OUT_OF_RESOURCES,
        (cl_command_queue queue, cl_kernel kernel, cl_uint rank, const size_t *offset,
         const size_t *global, const size_t *local, cl_uint num_waits, const cl_event *waits,
         cl_event *event),
        (queue, kernel, rank, offset, global, local, num_waits, waits, event))
ENQUEUE(clEnqueueReadBuffer, CL_OUT_OF_RESOURCES,
        (cl_command_queue queue, cl_mem memory, cl_bool waits_here, size_t offset, size_t bytes,
         void *data, cl_uint num_waits, const cl_event *waits, cl_event *event),
        (queue, memory, waits_here, offset, bytes, data, num_waits, waits, event))
ENQUEUE(clEnqueueWriteBuffer, CL_OUT_OF_RESOURCES,
        (cl_command_queue queue, cl_mem memory, cl_bool waits_here, size_t offset, size_t bytes,
         const void *data, cl_uint num_waits, const cl_event *waits, cl_event *event),
        (queue, memory, waits_here, offset, bytes, data, num_waits, waits, event))
ENQUEUE(clEnqueueUnmapMemObject, CL_OUT_OF_RESOURCES,
        (cl_command_queue queue, cl_mem memory, void *data, cl_uint num_waits,
         const cl_event *waits, cl_event *event),
        (queue, memory, data, num_waits, waits, event))
WRAPPER(clEnqueueMapBuffer, void *,
        (cl_command_queue queue, cl_mem memory, cl_bool waits_here, cl_map_flags flags,
         size_t offset, size_t bytes, cl_uint num_waits, const cl_event *waits, cl_event *event,
         cl_int *code)) {
    if (fault_is_due(FAULT_OPENCL, "clEnqueueMapBuffer")) {
        *code = CL_MAP_FAILURE;
        return NULL;
    }
    void *data = __real_clEnqueueMapBuffer(queue, memory, waits_here, flags, offset, bytes,
                                           num_waits, waits, event, code);
    if (*code == CL_SUCCESS && event != NULL) {
        fault_gain(*event, "clEnqueueMapBuffer");
    }
    return data;
}
ENQUEUE(clEnqueueFillBuffer, CL_MEM_OBJECT_ALLOCATION_FAILURE,
        (cl_command_queue queue, cl_mem memory, const void *pattern, size_t pattern_bytes,
         size_t offset, size_t bytes, cl_uint num_waits, const cl_event *waits, cl_event *event),
        (queue, memory, pattern, pattern_bytes, offset, bytes, num_waits, waits, event))
ENQUEUE(clEnqueueCopyBufferRect, CL_OUT_OF_RESOURCES,
        (cl_command_queue queue, cl_mem from, cl_mem to, const size_t *from_origin,
         const size_t *to_origin, const size_t *region, size_t from_row, size_t from_slice,
         size_t to_row, size_t to_slice, cl_uint num_waits, const cl_event *waits, cl_event *event),
        (queue, from, to, from_origin, to_origin, region, from_row, from_slice, to_row, to_slice,
         num_waits, waits, event))
ENQUEUE(clEnqueueMarkerWithWaitList, CL_OUT_OF_RESOURCES,
        (cl_command_queue queue, cl_uint num_waits, const cl_event *waits, cl_event *event),
        (queue, num_waits, waits, event))
ENQUEUE(clEnqueueBarrierWithWaitList, CL_OUT_OF_RESOURCES,
        (cl_command_queue queue, cl_uint num_waits, const cl_event *waits, cl_event *event),
        (queue, num_waits, waits, event))
STATUS(clFlush, CL_OUT_OF_RESOURCES, (cl_command_queue queue), (queue))
/* What was begun ends, whatever is said of it: nobody lets go of a device that works. */
WRAPPER(clFinish, cl_int, (cl_command_queue queue)) {
    const bool is_due = fault_is_due(FAULT_OPENCL, "clFinish");
    const cl_int code = __real_clFinish(queue);
    return is_due ? CL_DEVICE_NOT_AVAILABLE : code;
}
STATUS(clWaitForEvents, CL_OUT_OF_RESOURCES, (cl_uint num, const cl_event *events), (num, events))
STATUS(clGetEventProfilingInfo, CL_PROFILING_INFO_NOT_AVAILABLE,
       (cl_event event, cl_profiling_info what, size_t bytes, void *value, size_t *size),
       (event, what, bytes, value, size))
RELEASE(clReleaseEvent, cl_event)
