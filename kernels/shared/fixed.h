/* Integers of a fixed width, for structs that host and device share: arguments of a kernel in one
 * piece, the same bytes on both sides. Members of such a struct stand by their size, widest first,
 * so that there are no gaps between them; SAME_SIZE holds its size on both sides.
 */
#ifndef PS_SHARED_FIXED_H
#define PS_SHARED_FIXED_H

#ifdef __OPENCL_C_VERSION__
typedef uint ps_u32;
typedef ulong ps_u64;
typedef long ps_i64;
#else
#include <stdint.h>
typedef uint32_t ps_u32;
typedef uint64_t ps_u64;
typedef int64_t ps_i64;
#endif

/* Compiles where the type has so many bytes. */
#define SAME_SIZE(type, bytes) typedef char type##_has_its_size[sizeof(type) == (bytes) ? 1 : -1]

#endif
