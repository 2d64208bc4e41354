/* Memory that is wanted soon, brought near. OpenCL C's own prefetch() does nothing in PoCL 3.1.
 * Only where a work-group has one item (shared/group.h): that is a CPU, whose address spaces are
 * one. Device only.
 */
#ifndef PS_SHARED_AHEAD_H
#define PS_SHARED_AHEAD_H

#include "shared/group.h"
#include "shared/real.h"

#ifdef __OPENCL_C_VERSION__

#if ALONE && !defined(PS_NO_PREFETCH) && defined(__has_builtin)
#if __has_builtin(__builtin_prefetch)
#define PS_PREFETCH(address, is_write) __builtin_prefetch((const void *)(size_t)(address), is_write)
#endif
#endif
#ifndef PS_PREFETCH
#define PS_PREFETCH(address, is_write) ((void)(address))
#endif

/* Any address will do, also one behind a buffer. */
static inline void will_read(__global const real *from) {
    PS_PREFETCH(from, 0);
}

static inline void will_write(__global const real *to) {
    PS_PREFETCH(to, 1);
}

#endif

#endif
