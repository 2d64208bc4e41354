/* Device memory. */
#include "device/device_private.h"

pspec_status ps_buffer_create(ps_device *device, ps_buffer *out, size_t bytes, const char *what,
                              ps_error *error) {
    *out = (ps_buffer){0};
    if (bytes > device->limits.max_allocation_bytes) {
        return ps_fail(error, PSPEC_ERROR_MEMORY,
                       "%s need %zu bytes, but device \"%s\" allows %llu bytes per allocation",
                       what, bytes, device->limits.name,
                       (unsigned long long)device->limits.max_allocation_bytes);
    }
    cl_int code = CL_SUCCESS;
    out->memory =
        clCreateBuffer(device->context, CL_MEM_READ_WRITE, bytes > 0 ? bytes : 1, NULL, &code);
    if (code != CL_SUCCESS) {
        out->memory = NULL;
        return ps_device_fail(code, "clCreateBuffer", error);
    }
    out->bytes = bytes;
    return PSPEC_OK;
}

void ps_buffer_release(ps_buffer *buffer) {
    if (buffer->memory != NULL) {
        clReleaseMemObject(buffer->memory);
    }
    *buffer = (ps_buffer){0};
}

pspec_status ps_buffer_write(ps_device *device, const ps_buffer *buffer, size_t offset_bytes,
                             const void *data, size_t bytes, ps_error *error) {
    if (bytes == 0) {
        return PSPEC_OK;
    }
    PS_TRY_CL(clEnqueueWriteBuffer(device->queue, buffer->memory, CL_TRUE, offset_bytes, bytes,
                                   data, 0, NULL, NULL),
              error);
    return PSPEC_OK;
}

pspec_status ps_buffer_read(ps_device *device, const ps_buffer *buffer, size_t offset_bytes,
                            void *data, size_t bytes, ps_error *error) {
    if (bytes == 0) {
        return PSPEC_OK;
    }
    PS_TRY_CL(clEnqueueReadBuffer(device->queue, buffer->memory, CL_TRUE, offset_bytes, bytes, data,
                                  0, NULL, NULL),
              error);
    return PSPEC_OK;
}

pspec_status ps_buffer_clear(ps_device *device, const ps_buffer *buffer, ps_error *error) {
    const cl_uint zero = 0;
    if (buffer->bytes == 0) {
        return PSPEC_OK;
    }
    PS_TRY_CL(clEnqueueFillBuffer(device->queue, buffer->memory, &zero, sizeof zero, 0,
                                  buffer->bytes, 0, NULL, NULL),
              error);
    return PSPEC_OK;
}
