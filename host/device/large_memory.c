/* Memory objects of many megabytes that a CPU works on: memory of our own in pages of 2 MiB, which
 * is kept for the next object of that size. What a driver takes from the system comes in pages of
 * 4 KiB, each of which is cleared when it is first written: 142 MB of one set on the sphere (N =
 * 4096, L = 2000) cost as much as its transforms. What an object finds in its memory is undefined
 * anyway.
 */
#include "base/memory.h"
#include "device/device_private.h"

#include <stdlib.h>

enum { LEAST_LARGE = 4 << 20, LARGE_PAGE = 2 << 20 };

/* Of memory that waits for another object. It never adds to what is in use: none of it is left
 * where there was none that fits. */
enum { MOST_IDLE = 256 << 20 };

typedef struct large_block {
    struct large_block *next; /* of those that wait */
    ps_large_pool *pool;
    void *memory;
    size_t bytes;
} large_block;

/* Drivers let go of objects when they like, perhaps after the device was closed. */
struct ps_large_pool {
    pthread_mutex_t mutex;
    large_block *idle;
    size_t idle_bytes, num_used;
    bool is_left; /* by the device */
};

static void free_block(large_block *block) {
    free(block->memory);
    free(block);
}

/* With the mutex. */
static void free_idle(ps_large_pool *pool) {
    while (pool->idle != NULL) {
        large_block *const block = pool->idle;
        pool->idle = block->next;
        free_block(block);
    }
    pool->idle_bytes = 0;
}

/* With the mutex, which it unlocks. */
static void leave_pool(ps_large_pool *pool) {
    const bool is_over = pool->is_left && pool->num_used == 0;
    if (pool->is_left) {
        free_idle(pool);
    }
    pthread_mutex_unlock(&pool->mutex);
    if (is_over) {
        pthread_mutex_destroy(&pool->mutex);
        free(pool);
    }
}

void ps_large_pool_leave(ps_large_pool *pool) {
    if (pool != NULL) {
        pthread_mutex_lock(&pool->mutex);
        pool->is_left = true;
        leave_pool(pool);
    }
}

/* Once nothing uses the object any more. */
static void give_back(large_block *block) {
    ps_large_pool *const pool = block->pool;
    pthread_mutex_lock(&pool->mutex);
    pool->num_used--;
    if (pool->is_left || block->bytes > MOST_IDLE - pool->idle_bytes) {
        free_block(block);
    } else {
        block->next = pool->idle;
        pool->idle = block;
        pool->idle_bytes += block->bytes;
    }
    leave_pool(pool);
}

static void CL_CALLBACK on_release(cl_mem memory, void *block) {
    (void)memory;
    give_back(block);
}

static large_block *make_block(size_t bytes) {
    large_block *const block = calloc(1, sizeof *block);
    void *const memory = block != NULL ? aligned_alloc(LARGE_PAGE, bytes) : NULL;
    if (memory == NULL) {
        free(block);
        return NULL;
    }
    ps_memory_use_large_pages(memory, bytes);
    *block = (large_block){.memory = memory, .bytes = bytes};
    return block;
}

/* One that waits, no more than a quarter too large, or a new one; NULL: there is no memory. */
static large_block *take_block(ps_large_pool *pool, size_t bytes) {
    pthread_mutex_lock(&pool->mutex);
    large_block **at = &pool->idle;
    while (*at != NULL && ((*at)->bytes < bytes || (*at)->bytes - bytes > bytes / 4)) {
        at = &(*at)->next;
    }
    large_block *block = *at;
    if (block != NULL) {
        *at = block->next;
        pool->idle_bytes -= block->bytes;
    } else {
        free_idle(pool);
        block = make_block(bytes);
    }
    pool->num_used += block != NULL ? 1 : 0;
    pthread_mutex_unlock(&pool->mutex);
    return block;
}

static ps_large_pool *make_pool(void) {
    ps_large_pool *const pool = calloc(1, sizeof *pool);
    if (pool != NULL) {
        pthread_mutex_init(&pool->mutex, NULL);
    }
    return pool;
}

/* NULL: no object, and the block is given back. */
static cl_mem create_in(ps_device *device, large_block *block, size_t bytes) {
    cl_int code = CL_SUCCESS;
    cl_mem memory = clCreateBuffer(device->context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes,
                                   block->memory, &code);
    if (memory != NULL &&
        clSetMemObjectDestructorCallback(memory, on_release, block) != CL_SUCCESS) {
        clReleaseMemObject(memory);
        memory = NULL;
    }
    if (memory == NULL) {
        give_back(block);
    }
    return memory;
}

cl_mem ps_large_memory_create(ps_device *device, size_t bytes) {
    const bool is_large =
        device->limits.is_cpu && device->limits.has_unified_memory && bytes >= LEAST_LARGE;
    const size_t whole = (bytes + LARGE_PAGE - 1) / LARGE_PAGE * LARGE_PAGE;
    if (is_large && device->large == NULL) {
        device->large = make_pool();
    }
    large_block *const block =
        is_large && device->large != NULL ? take_block(device->large, whole) : NULL;
    if (block == NULL) {
        return NULL;
    }
    block->pool = device->large;
    return create_in(device, block, bytes);
}
