/* Allocation with checked size arithmetic: a product that overflows is an error, not a small block.
 * So is an array that the limits of this machine leave no room for
 * (base/process/memory_limit.h), since using it would end the program. */
#ifndef PS_BASE_MEMORY_H
#define PS_BASE_MEMORY_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* True when a * b fits; the product is stored in *product. */
bool ps_size_multiply(size_t a, size_t b, size_t *product);

/* Zeroed array of count elements, never of zero bytes. The caller frees it with free().
 * what names the array in the message, for example "points". */
pspec_status ps_allocate(void **out, size_t count, size_t element_bytes, const char *what,
                         ps_error *error) PS_MUST_CHECK;

/* Allocates for the pointer to which pointer points, of whatever type: zeroed, count of what it
 * points to, with the sentence of ps_allocate. The size of an element is thus said nowhere else
 * than in the type. */
#define PS_NEW(pointer, count, what, error)                                                        \
    ps_allocate_for((pointer), (count), sizeof **(pointer), (what), (error))
pspec_status ps_allocate_for(void *pointer, size_t count, size_t element_bytes, const char *what,
                             ps_error *error) PS_MUST_CHECK;

/* Says that memory of many megabytes will all be used, whatever it costs: Linux then gives it out
 * in pages of 2 MiB, which saves a fifth of the time of a Cholesky factor of 4096 rows
 * (bench_weights cholesky). A hint that may have no effect. */
void ps_memory_use_large_pages(void *memory, size_t bytes);

/* Grows *array to hold at least needed elements; *capacity counts elements. Contents are kept;
 * new elements are not initialised. Growth is geometric, so that appending is linear. */
pspec_status ps_grow(void **array, size_t *capacity, size_t needed, size_t element_bytes,
                     const char *what, ps_error *error) PS_MUST_CHECK;

/* Memory of many things that end together; {0}: none yet. */
typedef struct ps_pool {
    struct ps_pool_block *blocks;
} ps_pool;

/* The same as PS_NEW of what ps_pool_free frees, all at once. */
#define PS_POOL_NEW(pool, pointer, count, what, error)                                             \
    ps_pool_new((pool), (pointer), (count), sizeof **(pointer), (what), (error))
pspec_status ps_pool_new(ps_pool *pool, void *pointer, size_t count, size_t element_bytes,
                         const char *what, ps_error *error) PS_MUST_CHECK;
void ps_pool_free(ps_pool *pool);

#endif
