/* Numbers in [0,1) as multiples of 2^-64, for devices that have doubles and for C11: phases are
 * whole numbers then (docs/mathematics/numerics.md#phases).
 */
#ifndef PS_SHARED_FIXED_POINT_H
#define PS_SHARED_FIXED_POINT_H

#include "shared/fixed.h"

#ifdef __OPENCL_C_VERSION__
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#pragma OPENCL FP_CONTRACT OFF
#define FIXED_POINT_BITS(x) as_ulong(x)
#else
#include <string.h>
static inline ps_u64 FIXED_POINT_BITS(double x) {
    ps_u64 bits = 0;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
#endif

/* round(x 2^64): exact for x >= 2^-11 and for multiples of 2^-64, otherwise off by at most 2^-65.
 *
 * There are neither branches nor conversions, since every point passes here: adding 1 leaves the
 * upper 52 bits of x in the mantissa; what that rounds off is below 2^-52, exact, and goes through
 * the mantissa of another sum, which rounds it to whole units of 2^-64. 1 + x may round up to 2:
 * the upper part then is 0, the rest negative, and the sum wraps as it should. */
static inline ps_u64 fixed_point(const double x) {
    const double two_to_64 = 18446744073709551616.0;
    const double rounder = 6755399441055744.0; /* 1.5 * 2^52: its last bit is a unit */
    const double upper = 1 + x;
    const double rest = (x - (upper - 1)) * two_to_64;
    return (FIXED_POINT_BITS(upper) << 12) + /* bits of sign and exponent */
           (FIXED_POINT_BITS(rest + rounder) - FIXED_POINT_BITS(rounder));
}

#endif
