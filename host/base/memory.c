#define _DEFAULT_SOURCE /* madvise */

#include "base/memory.h"

#include "base/process/memory_limit.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

bool ps_size_multiply(size_t a, size_t b, size_t *product) {
    if (a != 0 && b > SIZE_MAX / a) {
        return false;
    }
    *product = a * b;
    return true;
}

static pspec_status fail_memory(size_t count, size_t element_bytes, const char *what,
                                ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for %s: %zu elements of %zu bytes",
                   what, count, element_bytes);
}

/* Smaller arrays are not worth the 0.1 ms that it takes to look. */
enum { LEAST_CHECKED = 16 << 20 };

/* The system gives out more than there is, and kills the program when it is used: so somebody has
 * to look before. */
static pspec_status check_room(uint64_t bytes, const char *what, ps_error *error) {
    ps_memory_room room;
    char needed[PS_SIZE_TEXT];
    char there[PS_SIZE_TEXT];
    if (bytes < LEAST_CHECKED) {
        return PSPEC_OK;
    }
    ps_memory_room_find(&room, 0);
    return bytes <= room.bytes ? PSPEC_OK
                               : ps_fail(error, PSPEC_ERROR_MEMORY,
                                         "not enough memory for %s: they take %s, but %s leaves %s",
                                         what, ps_size_show(needed, (double)bytes), room.by,
                                         ps_size_show(there, (double)room.bytes));
}

pspec_status ps_allocate(void **out, size_t count, size_t element_bytes, const char *what,
                         ps_error *error) {
    size_t bytes = 0;
    *out = NULL;
    if (ps_size_multiply(count, element_bytes, &bytes)) {
        PS_TRY(check_room(bytes, what, error));
        *out = calloc(count > 0 ? count : 1, element_bytes);
    }
    return *out != NULL ? PSPEC_OK : fail_memory(count, element_bytes, what, error);
}

/* A pointer of another type may not be written as a void *, but its bytes may be copied. */
pspec_status ps_allocate_for(void *pointer, size_t count, size_t element_bytes, const char *what,
                             ps_error *error) {
    void *memory = NULL;
    const pspec_status status = ps_allocate(&memory, count, element_bytes, what, error);
    memcpy(pointer, &memory, sizeof memory);
    return status;
}

void ps_memory_use_large_pages(void *memory, size_t bytes) {
#ifdef MADV_HUGEPAGE
    /* whole pages inside; what calloc keeps before and behind them is its own */
    const uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE);
    const uintptr_t begin = ((uintptr_t)memory + page - 1) / page * page;
    const uintptr_t end = ((uintptr_t)memory + bytes) / page * page;
    if (begin < end) {
        (void)madvise((void *)begin, end - begin, MADV_HUGEPAGE);
    }
#else
    (void)memory;
    (void)bytes;
#endif
}

pspec_status ps_grow(void **array, size_t *capacity, size_t needed, size_t element_bytes,
                     const char *what, ps_error *error) {
    if (needed <= *capacity) {
        return PSPEC_OK;
    }
    const size_t half_more = *capacity + *capacity / 2;
    const size_t count = half_more > needed ? half_more : needed;
    size_t bytes = 0;
    void *grown = NULL;
    if (ps_size_multiply(count, element_bytes, &bytes)) {
        PS_TRY(check_room(bytes - *capacity * element_bytes, what, error));
        grown = realloc(*array, bytes);
    }
    if (grown == NULL) {
        return fail_memory(needed, element_bytes, what, error);
    }
    *array = grown;
    *capacity = count;
    return PSPEC_OK;
}

struct ps_pool_block {
    struct ps_pool_block *next;
    max_align_t bytes[];
};

pspec_status ps_pool_new(ps_pool *pool, void *pointer, size_t count, size_t element_bytes,
                         const char *what, ps_error *error) {
    struct ps_pool_block *block = NULL;
    void *bytes = NULL;
    size_t num_bytes = 0;
    if (!ps_size_multiply(count, element_bytes, &num_bytes)) {
        return fail_memory(count, element_bytes, what, error);
    }
    PS_TRY(ps_allocate_for(&block, 1, sizeof *block + num_bytes, what, error));
    block->next = pool->blocks;
    pool->blocks = block;
    bytes = block->bytes;
    memcpy(pointer, &bytes, sizeof bytes);
    return PSPEC_OK;
}

void ps_pool_free(ps_pool *pool) {
    while (pool->blocks != NULL) {
        struct ps_pool_block *const next = pool->blocks->next;
        free(pool->blocks);
        pool->blocks = next;
    }
}
