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
    out->device = device;
    device->buffer_bytes += bytes;
    if (device->buffer_bytes > device->most_buffer_bytes) {
        device->most_buffer_bytes = device->buffer_bytes;
    }
    return PSPEC_OK;
}

void ps_buffer_release(ps_buffer *buffer) {
    if (buffer->memory != NULL) {
        clReleaseMemObject(buffer->memory);
        buffer->device->buffer_bytes -= buffer->bytes;
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

pspec_status ps_mapping_begin(ps_device *device, ps_mapping *out, const ps_buffer *buffer,
                              ps_error *error) {
    cl_int code = CL_SUCCESS;
    *out = (ps_mapping){0};
    out->data =
        clEnqueueMapBuffer(device->queue, buffer->memory, CL_FALSE, CL_MAP_WRITE_INVALIDATE_REGION,
                           0, buffer->bytes, 0, NULL, &out->is_ready, &code);
    if (code != CL_SUCCESS) {
        *out = (ps_mapping){0};
        return ps_device_fail(code, "clEnqueueMapBuffer", error);
    }
    out->memory = buffer->memory;
    return PSPEC_OK;
}

pspec_status ps_mapping_wait(ps_mapping *mapping, ps_error *error) {
    if (mapping->is_ready == NULL) {
        return PSPEC_OK;
    }
    const cl_int code = clWaitForEvents(1, &mapping->is_ready);
    clReleaseEvent(mapping->is_ready);
    mapping->is_ready = NULL;
    return code == CL_SUCCESS ? PSPEC_OK : ps_device_fail(code, "clWaitForEvents", error);
}

pspec_status ps_mapping_end(ps_device *device, ps_mapping *mapping, ps_error *error) {
    const ps_mapping ended = *mapping;
    *mapping = (ps_mapping){0};
    PS_TRY_CL(clEnqueueUnmapMemObject(device->queue, ended.memory, ended.data, 0, NULL, NULL),
              error);
    return PSPEC_OK;
}

void ps_mapping_abandon(ps_device *device, ps_mapping *mapping) {
    if (mapping->is_ready != NULL) {
        clWaitForEvents(1, &mapping->is_ready);
        clReleaseEvent(mapping->is_ready);
    }
    clEnqueueUnmapMemObject(device->queue, mapping->memory, mapping->data, 0, NULL, NULL);
    *mapping = (ps_mapping){0};
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

pspec_status ps_buffer_copy_rectangle(ps_device *device, const ps_buffer *source,
                                      const ps_buffer *target, const ps_rectangle *rectangle,
                                      ps_error *error) {
    const size_t from_origin[] = {rectangle->from_offset % rectangle->from_pitch,
                                  rectangle->from_offset / rectangle->from_pitch, 0};
    const size_t to_origin[] = {rectangle->to_offset % rectangle->to_pitch,
                                rectangle->to_offset / rectangle->to_pitch, 0};
    const size_t region[] = {rectangle->row_bytes, rectangle->num_rows, 1};
    PS_TRY_CL(clEnqueueCopyBufferRect(device->queue, source->memory, target->memory, from_origin,
                                      to_origin, region, rectangle->from_pitch, 0,
                                      rectangle->to_pitch, 0, 0, NULL, NULL),
              error);
    return PSPEC_OK;
}

void ps_device_set_unified_memory(ps_device *device, bool is_wanted) {
    device->limits.has_unified_memory = is_wanted && device->own_unified_memory;
}

void ps_device_set_dedicated_local_memory(ps_device *device, bool is_wanted) {
    device->limits.has_dedicated_local_memory = is_wanted || device->own_dedicated_local_memory;
}

void ps_device_set_max_allocation(ps_device *device, uint64_t bytes) {
    const bool is_smaller = bytes > 0 && bytes < device->own_max_allocation;
    device->limits.max_allocation_bytes = is_smaller ? bytes : device->own_max_allocation;
}

void ps_device_set_local_bytes(ps_device *device, uint64_t bytes) {
    const bool is_smaller = bytes > 0 && bytes < device->own_local_bytes;
    device->limits.local_bytes = is_smaller ? bytes : device->own_local_bytes;
}

void ps_device_set_native_lanes(ps_device *device, unsigned lanes) {
    device->limits.native_float_lanes = lanes > 0 ? lanes : device->own_float_lanes;
    device->limits.native_double_lanes = lanes > 0 ? lanes : device->own_double_lanes;
}

uint64_t ps_device_most_buffer_bytes(const ps_device *device) {
    return device->most_buffer_bytes;
}
