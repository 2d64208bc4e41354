/* Work-groups. With ALONE a group has one work-item, as engines want it on CPUs, and the kernel has
 * no barriers: at each of them PoCL 3.1 cuts a kernel, and copies what lies between.
 * sphere/nufft/orders.cl took 5 times as long to compile and four times the code. Device only.
 */
#ifndef PS_SHARED_GROUP_H
#define PS_SHARED_GROUP_H

#ifndef ALONE
#define ALONE 0
#endif

#ifdef __OPENCL_C_VERSION__

#if ALONE
#define GROUP_BARRIER(fences) ((void)0)
#else
#define GROUP_BARRIER(fences) barrier(fences)
#endif

static inline uint own_item(void) {
#if ALONE
    return 0;
#else
    return (uint)get_local_id(0);
#endif
}

static inline uint num_items(void) {
#if ALONE
    return 1;
#else
    return (uint)get_local_size(0);
#endif
}

/* What all items of the group wrote is seen by all. */
static inline void barrier_everywhere(void) {
    GROUP_BARRIER(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
}

#endif

#endif
