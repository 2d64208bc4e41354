#include "harness_kernels.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Any device's alignment of sub-buffers (CL_DEVICE_MEM_BASE_ADDR_ALIGN) divides it. */
enum { GUARD_BYTES = 4096 };

test_memory test_memory_create(ps_device *device, const void *data, size_t bytes) {
    const bool is_simulated = strcmp(ps_device_get_limits(device)->platform, "Oclgrind") == 0;
    test_memory memory = {
        .device = device, .bytes = bytes, .guard_bytes = is_simulated ? 0 : GUARD_BYTES};
    const size_t some = bytes > 0 ? bytes : 1; /* there are no empty sub-buffers */
    const size_t all = some + 2 * memory.guard_bytes;
    unsigned char *original = malloc(all);
    assert_non_null(original);
    memset(original, 0xFF, all);
    if (data != NULL) {
        memcpy(original + memory.guard_bytes, data, bytes);
    }
    memory.original = original;
    assert_ok(ps_buffer_create(device, &memory.whole, all, "a test", error));
    assert_ok(ps_buffer_write(device, &memory.whole, 0, original, all, error));
    memory.buffer = memory.whole;
    if (memory.guard_bytes > 0) {
        cl_int code = CL_SUCCESS;
        const cl_buffer_region region = {memory.guard_bytes, some};
        memory.buffer.bytes = bytes;
        memory.buffer.memory = clCreateSubBuffer(memory.whole.memory, CL_MEM_READ_WRITE,
                                                 CL_BUFFER_CREATE_TYPE_REGION, &region, &code);
        assert_int_equal(code, CL_SUCCESS);
    }
    return memory;
}

static unsigned char *read_all(const test_memory *memory) {
    unsigned char *bytes = malloc(memory->whole.bytes);
    assert_non_null(bytes);
    assert_ok(ps_buffer_read(memory->device, &memory->whole, 0, bytes, memory->whole.bytes, error));
    return bytes;
}

void *test_memory_read(const test_memory *memory) {
    unsigned char *bytes = read_all(memory);
    for (size_t i = 0; i < memory->whole.bytes; i++) {
        const bool is_guard = i < memory->guard_bytes || i >= memory->guard_bytes + memory->bytes;
        if (is_guard && bytes[i] != 0xFF) {
            fail_msg("a kernel wrote at byte %ld of a buffer of %zu bytes",
                     (long)i - (long)memory->guard_bytes, memory->bytes);
        }
    }
    memmove(bytes, bytes + memory->guard_bytes, memory->bytes);
    return bytes;
}

void test_memory_free(test_memory *memory) {
    if (memory->guard_bytes > 0) {
        clReleaseMemObject(memory->buffer.memory);
    }
    ps_buffer_release(&memory->whole);
    free(memory->original);
    *memory = (test_memory){0};
}

void test_memory_free_unchanged(test_memory *memory) {
    unsigned char *bytes = read_all(memory);
    assert_memory_equal(bytes, memory->original, memory->whole.bytes);
    free(bytes);
    test_memory_free(memory);
}

test_memory test_reals_create(ps_device *device, unsigned precision, const double *values,
                              size_t num) {
    if (values == NULL || precision == 64) {
        return test_memory_create(device, values, num * precision / 8);
    }
    float *floats = malloc((num + 1) * sizeof(float));
    assert_non_null(floats);
    for (size_t i = 0; i < num; i++) {
        floats[i] = (float)values[i];
    }
    const test_memory memory = test_memory_create(device, floats, num * sizeof(float));
    free(floats);
    return memory;
}

double *test_reals_read(const test_memory *memory, unsigned precision) {
    void *data = test_memory_read(memory);
    if (precision == 64) {
        return data;
    }
    const size_t num = memory->bytes / sizeof(float);
    double *values = malloc((num + 1) * sizeof(double));
    assert_non_null(values);
    for (size_t i = 0; i < num; i++) {
        values[i] = (double)((const float *)data)[i];
    }
    free(data);
    return values;
}

ps_kernel *test_kernel(ps_device *device, const char *source, const char *name, const char *options,
                       ...) {
    char text[256];
    ps_kernel *kernel = NULL;
    va_list arguments;
    va_start(arguments, options);
    vsnprintf(text, sizeof text, options, arguments);
    va_end(arguments);
    assert_ok(ps_kernel_get(device, &kernel, source, name, text, error));
    return kernel;
}

double *test_whole_numbers(uint64_t *seed, size_t num, double largest) {
    double *values = malloc((num + 1) * sizeof(double));
    assert_non_null(values);
    for (size_t i = 0; i < num; i++) {
        values[i] = rint((2 * test_uniform(seed) - 1) * largest);
    }
    return values;
}

bool test_has_precision(const ps_device *device, unsigned precision) {
    return precision == 32 || ps_device_get_limits(device)->has_fp64;
}
