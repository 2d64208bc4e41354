/* Memory objects of many megabytes that a CPU works on: memory of our own in pages of 2 MiB. What a
 * driver takes from the system comes in pages of 4 KiB, each of which is cleared when it is first
 * written, at 0.5 us: 142 MB of one set on the sphere (N = 4096, L = 2000) cost as much as its
 * transforms. */
#include "base/memory.h"
#include "device/device_private.h"

#include <stdlib.h>

enum { LEAST_LARGE = 4 << 20, LARGE_PAGE = 2 << 20 };

/* Once nothing uses the object any more. */
static void CL_CALLBACK free_memory(cl_mem memory, void *own) {
    (void)memory;
    free(own);
}

/* NULL: no object, and nothing is left of it. */
static cl_mem create_in(ps_device *device, void *own, size_t bytes) {
    cl_int code = CL_SUCCESS;
    cl_mem memory =
        clCreateBuffer(device->context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes, own, &code);
    if (memory != NULL &&
        clSetMemObjectDestructorCallback(memory, free_memory, own) != CL_SUCCESS) {
        clReleaseMemObject(memory);
        memory = NULL;
    }
    return memory;
}

cl_mem ps_large_memory_create(ps_device *device, size_t bytes) {
    const bool is_large =
        device->limits.is_cpu && device->limits.has_unified_memory && bytes >= LEAST_LARGE;
    const size_t whole = (bytes + LARGE_PAGE - 1) / LARGE_PAGE * LARGE_PAGE;
    void *const own = is_large ? aligned_alloc(LARGE_PAGE, whole) : NULL;
    cl_mem memory = NULL;
    if (own != NULL) {
        ps_memory_use_large_pages(own, bytes);
        memory = create_in(device, own, bytes);
        if (memory == NULL) {
            free(own);
        }
    }
    return memory;
}
