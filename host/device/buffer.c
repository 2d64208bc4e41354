/* Device memory, and what goes between host and device while both go on: pinned memory, mappings,
 * reads that are waited for later. */
#include "device/device_private.h"

#include <string.h>

/* Whoever waits for what was enqueued last leaves the device without work. */
static pspec_status wait_for(ps_device *device, cl_event *event, uint64_t begun, ps_error *error) {
    if (*event == NULL) {
        return PSPEC_OK;
    }
    device->num_waits += device->num_enqueued == begun ? 1 : 0;
    const cl_int code = clWaitForEvents(1, event);
    clReleaseEvent(*event);
    *event = NULL;
    return code == CL_SUCCESS ? PSPEC_OK : ps_device_fail(code, "clWaitForEvents", error);
}

pspec_status ps_queue_create(const ps_device *device, cl_command_queue *out, ps_error *error) {
    cl_int code = CL_SUCCESS;
    const cl_command_queue_properties properties =
        device->has_profile ? CL_QUEUE_PROFILING_ENABLE : 0;
    *out = clCreateCommandQueue(device->context, device->id, properties, &code);
    return code == CL_SUCCESS ? PSPEC_OK : ps_device_fail(code, "clCreateCommandQueue", error);
}

/* The memory of a buffer; host: memory of the host that it is, by the flags. */
static pspec_status create_memory(ps_device *device, cl_mem *out, cl_mem_flags flags, void *host,
                                  size_t bytes, const char *what, ps_error *error) {
    cl_int code = CL_SUCCESS;
    *out = NULL;
    if (bytes > device->limits.max_allocation_bytes) {
        return ps_fail(error, PSPEC_ERROR_MEMORY,
                       "%s need %zu bytes, but device \"%s\" allows %llu bytes per allocation",
                       what, bytes, device->limits.name,
                       (unsigned long long)device->limits.max_allocation_bytes);
    }
    *out = flags == 0 ? ps_large_memory_create(device, bytes) : NULL;
    if (*out == NULL) {
        *out = clCreateBuffer(device->context, CL_MEM_READ_WRITE | flags, bytes > 0 ? bytes : 1,
                              host, &code);
    }
    return code == CL_SUCCESS ? PSPEC_OK : ps_device_fail(code, "clCreateBuffer", error);
}

/* ---- pinned memory ------------------------------------------------------------------------ */

pspec_status ps_pinned_create(ps_device *device, ps_pinned *out, size_t bytes, const char *what,
                              ps_error *error) {
    cl_int code = CL_SUCCESS;
    *out = (ps_pinned){0};
    PS_TRY(create_memory(device, &out->memory, CL_MEM_ALLOC_HOST_PTR, NULL, bytes, what, error));
    out->data = clEnqueueMapBuffer(device->queue, out->memory, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE,
                                   0, bytes > 0 ? bytes : 1, 0, NULL, NULL, &code);
    if (code != CL_SUCCESS) {
        clReleaseMemObject(out->memory);
        *out = (ps_pinned){0};
        return ps_device_fail(code, "clEnqueueMapBuffer", error);
    }
    return PSPEC_OK;
}

/* Once the device is done with it, which is not waited for. */
static void release_pinned(ps_device *device, ps_pinned *pinned) {
    if (pinned->memory != NULL) {
        clEnqueueUnmapMemObject(device->queue, pinned->memory, pinned->data, 0, NULL, NULL);
        clReleaseMemObject(pinned->memory);
    }
    *pinned = (ps_pinned){0};
}

/* ---- writes through pinned memory --------------------------------------------------------- */

/* A piece may be filled once what was in it has gone. */
static pspec_status begin_piece(ps_device *device, cl_event *until, ps_error *error) {
    if (device->staged.memory == NULL) {
        PS_TRY(ps_pinned_create(device, &device->staged, PS_STAGED_BYTES, "data for the device",
                                error));
    }
    return wait_for(device, until, UINT64_MAX, error);
}

static pspec_status write_piece(ps_device *device, const ps_buffer *buffer, size_t offset_bytes,
                                const void *data, size_t bytes, cl_event *until, ps_error *error) {
    char *const staged = (char *)device->staged.data + device->staged_at;
    cl_event written = NULL;
    memcpy(staged, data, bytes);
    PS_TRY_CL(clEnqueueWriteBuffer(device->queue, buffer->memory, CL_FALSE, offset_bytes, bytes,
                                   staged, 0, NULL, &written),
              error);
    if (*until != NULL) {
        clReleaseEvent(*until); /* the queue is in order */
    }
    *until = written;
    device->staged_at = (device->staged_at + bytes) % (PS_STAGED_BYTES);
    return PSPEC_OK;
}

/* A write through pinned memory. */
static pspec_status write_staged(ps_device *device, const ps_buffer *buffer, size_t offset_bytes,
                                 const void *data, size_t bytes, ps_error *error) {
    const size_t left = PS_STAGED_PIECE - device->staged_at % PS_STAGED_PIECE;
    size_t num = 0;
    if (bytes > left && bytes <= PS_STAGED_PIECE) { /* it is one write of the next piece */
        device->staged_at = (device->staged_at + left) % PS_STAGED_BYTES;
    }
    for (size_t done = 0; done < bytes; done += num) {
        const size_t at = device->staged_at % PS_STAGED_PIECE;
        const size_t rest = bytes - done;
        cl_event *const until = &device->staged_until[device->staged_at / PS_STAGED_PIECE];
        num = rest < PS_STAGED_PIECE - at ? rest : PS_STAGED_PIECE - at;
        PS_TRY(at == 0 ? begin_piece(device, until, error) : PSPEC_OK);
        PS_TRY(write_piece(device, buffer, offset_bytes + done, (const char *)data + done, num,
                           until, error));
    }
    return PSPEC_OK;
}

void ps_staged_release(ps_device *device) {
    for (size_t i = 0; i < PS_STAGED_PIECES; i++) {
        if (device->staged_until[i] != NULL) {
            clReleaseEvent(device->staged_until[i]);
        }
    }
    release_pinned(device, &device->staged);
}

/* ---- reads that are waited for later ------------------------------------------------------ */

pspec_status ps_readings_create(ps_device *device, ps_readings *out, size_t bytes, const char *what,
                                ps_error *error) {
    *out = (ps_readings){.device = device};
    for (size_t i = 0; i < PS_READINGS; i++) {
        PS_TRY(ps_pinned_create(device, &out->memory[i], bytes, what, error));
    }
    return PSPEC_OK;
}

pspec_status ps_readings_begin(ps_readings *readings, const ps_buffer *buffer, size_t bytes,
                               ps_error *error) {
    ps_device *const device = readings->device;
    const size_t i = readings->num_begun % PS_READINGS;
    readings->begun[i] = ++device->num_enqueued;
    if (bytes > 0) {
        PS_TRY_CL(clEnqueueReadBuffer(device->queue, buffer->memory, CL_FALSE, 0, bytes,
                                      readings->memory[i].data, 0, NULL, &readings->is_done[i]),
                  error);
    }
    readings->num_begun++;
    PS_TRY_CL(clFlush(device->queue), error);
    return PSPEC_OK;
}

pspec_status ps_readings_take(ps_readings *readings, const void **data, ps_error *error) {
    const size_t i = readings->num_taken++ % PS_READINGS;
    *data = readings->memory[i].data;
    return wait_for(readings->device, &readings->is_done[i], readings->begun[i], error);
}

void ps_readings_forget(ps_readings *readings) {
    for (; readings->num_taken < readings->num_begun; readings->num_taken++) {
        cl_event *const event = &readings->is_done[readings->num_taken % PS_READINGS];
        if (*event != NULL) {
            clWaitForEvents(1, event);
            clReleaseEvent(*event);
            *event = NULL;
        }
    }
}

void ps_readings_release(ps_readings *readings) {
    ps_readings_forget(readings);
    for (size_t i = 0; i < PS_READINGS; i++) {
        release_pinned(readings->device, &readings->memory[i]);
    }
    *readings = (ps_readings){0};
}

/* ---- mappings ----------------------------------------------------------------------------- */

pspec_status ps_mapping_begin(ps_device *device, ps_mapping *out, const ps_buffer *buffer,
                              ps_error *error) {
    cl_int code = CL_SUCCESS;
    *out = (ps_mapping){.data = buffer->twin.data, .begun = device->num_enqueued};
    if (out->data != NULL) {
        PS_TRY_CL(clEnqueueMarkerWithWaitList(device->queue, 0, NULL, &out->is_ready), error);
    } else {
        out->data = clEnqueueMapBuffer(device->queue, buffer->memory, CL_FALSE,
                                       CL_MAP_WRITE_INVALIDATE_REGION, 0, buffer->bytes, 0, NULL,
                                       &out->is_ready, &code);
    }
    if (code != CL_SUCCESS) {
        *out = (ps_mapping){0};
        return ps_device_fail(code, "clEnqueueMapBuffer", error);
    }
    out->buffer = *buffer;
    return PSPEC_OK;
}

pspec_status ps_mapping_wait(ps_mapping *mapping, ps_error *error) {
    return wait_for(mapping->buffer.device, &mapping->is_ready, mapping->begun, error);
}

/* Nothing is launched any more before the copy is there; what was launched before goes on. */
static pspec_status copy_twin(ps_device *device, const ps_buffer *buffer, size_t bytes,
                              ps_error *error) {
    const cl_command_queue queue = device->uploads != NULL ? device->uploads : device->queue;
    cl_event copied = NULL;
    PS_TRY_CL(clEnqueueWriteBuffer(queue, buffer->memory, CL_FALSE, 0, bytes, buffer->twin.data, 0,
                                   NULL, &copied),
              error);
    cl_int code = clFlush(queue);
    if (code == CL_SUCCESS && queue != device->queue) {
        code = clEnqueueBarrierWithWaitList(device->queue, 1, &copied, NULL);
    }
    clReleaseEvent(copied);
    return code == CL_SUCCESS ? PSPEC_OK : ps_device_fail(code, "clEnqueueBarrier", error);
}

pspec_status ps_mapping_end(ps_device *device, ps_mapping *mapping, size_t bytes, ps_error *error) {
    const ps_mapping ended = *mapping;
    *mapping = (ps_mapping){0};
    if (ended.buffer.twin.data != NULL) {
        return bytes > 0 ? copy_twin(device, &ended.buffer, bytes, error) : PSPEC_OK;
    }
    PS_TRY_CL(
        clEnqueueUnmapMemObject(device->queue, ended.buffer.memory, ended.data, 0, NULL, NULL),
        error);
    return PSPEC_OK;
}

void ps_mapping_abandon(ps_device *device, ps_mapping *mapping) {
    if (mapping->is_ready != NULL) {
        clWaitForEvents(1, &mapping->is_ready);
        clReleaseEvent(mapping->is_ready);
    }
    if (mapping->buffer.twin.data == NULL) {
        clEnqueueUnmapMemObject(device->queue, mapping->buffer.memory, mapping->data, 0, NULL,
                                NULL);
    }
    *mapping = (ps_mapping){0};
}

/* ---- buffers ------------------------------------------------------------------------------ */

static pspec_status create_buffer(ps_device *device, ps_buffer *out, cl_mem_flags flags, void *host,
                                  size_t bytes, const char *what, ps_error *error) {
    *out = (ps_buffer){0};
    PS_TRY(create_memory(device, &out->memory, flags, host, bytes, what, error));
    out->bytes = host == NULL ? bytes : 0; /* the host's own are not the device's */
    out->device = device;
    device->buffer_bytes += out->bytes;
    if (device->buffer_bytes > device->most_buffer_bytes) {
        device->most_buffer_bytes = device->buffer_bytes;
    }
    return PSPEC_OK;
}

pspec_status ps_buffer_create(ps_device *device, ps_buffer *out, size_t bytes, const char *what,
                              ps_error *error) {
    return create_buffer(device, out, 0, NULL, bytes, what, error);
}

void ps_buffer_release(ps_buffer *buffer) {
    if (buffer->twin.memory != NULL) {
        if (buffer->device->uploads != NULL) {
            clFinish(buffer->device->uploads); /* it may still be copied */
        }
        release_pinned(buffer->device, &buffer->twin);
    }
    if (buffer->memory != NULL) {
        clReleaseMemObject(buffer->memory);
        buffer->device->buffer_bytes -= buffer->bytes;
    }
    *buffer = (ps_buffer){0};
}

pspec_status ps_buffers_create(ps_device *device, const ps_wanted_buffer *wanted, size_t num,
                               ps_error *error) {
    for (size_t i = 0; i < num; i++) {
        PS_TRY(ps_buffer_create(device, wanted[i].buffer, wanted[i].bytes, wanted[i].what, error));
    }
    return PSPEC_OK;
}

void ps_buffers_release(ps_buffer *const *buffers, size_t num) {
    for (size_t i = 0; i < num; i++) {
        ps_buffer_release(buffers[i]);
    }
}

pspec_status ps_buffer_upload(ps_device *device, ps_buffer *out, const void *data, size_t bytes,
                              const char *what, ps_error *error) {
    PS_TRY(ps_buffer_create(device, out, bytes, what, error));
    return ps_buffer_write(device, out, 0, data, bytes, error);
}

/* OpenCL takes what is not const, and no kernel writes into it. */
pspec_status ps_buffer_share(ps_device *device, ps_buffer *out, const void *data, size_t bytes,
                             const char *what, ps_error *error) {
    return device->limits.has_unified_memory
               ? create_buffer(device, out, CL_MEM_USE_HOST_PTR, (void *)(uintptr_t)data, bytes,
                               what, error)
               : ps_buffer_upload(device, out, data, bytes, what, error);
}

pspec_status ps_buffer_write(ps_device *device, const ps_buffer *buffer, size_t offset_bytes,
                             const void *data, size_t bytes, ps_error *error) {
    if (bytes == 0) {
        return PSPEC_OK;
    }
    if (!device->limits.has_unified_memory) {
        return write_staged(device, buffer, offset_bytes, data, bytes, error);
    }
    device->num_waits++;
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
    device->num_waits++;
    PS_TRY_CL(clEnqueueReadBuffer(device->queue, buffer->memory, CL_TRUE, offset_bytes, bytes, data,
                                  0, NULL, NULL),
              error);
    return PSPEC_OK;
}

/* PoCL 3.1 stores a pattern at a time: one of 16 bytes clears 64 MB in half of the time of one of
 * four (1.8 instead of 4.2 ms, EPYC of Zen 5, 2026-11), and a longer one is no faster. */
pspec_status ps_buffer_clear(ps_device *device, const ps_buffer *buffer, ps_error *error) {
    const cl_uint4 zeros = {{0}};
    const size_t rest = buffer->bytes % sizeof zeros;
    const size_t whole = buffer->bytes - rest;
    if (whole > 0) {
        PS_TRY_CL(clEnqueueFillBuffer(device->queue, buffer->memory, &zeros, sizeof zeros, 0, whole,
                                      0, NULL, NULL),
                  error);
    }
    if (rest > 0) {
        PS_TRY_CL(clEnqueueFillBuffer(device->queue, buffer->memory, &zeros, sizeof(cl_uint), whole,
                                      rest, 0, NULL, NULL),
                  error);
    }
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

uint64_t ps_device_num_waits(const ps_device *device) {
    return device->num_waits;
}

uint64_t ps_device_most_buffer_bytes(const ps_device *device) {
    return device->most_buffer_bytes;
}
