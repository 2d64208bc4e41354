/* Does a ray from an origin o meet a triangle? Rays of many directions d from the same o: what
 * depends on o and the triangle alone is made once.
 *
 * With corners a, b, c seen from o, d lies between the three planes through o and a side where
 * d.(a x b), d.(b x c) and d.(c x a) have the sign of a.(b x c), and then the ray meets the
 * triangle ahead, from either side, at the distance |a.(b x c)| over the sum of the three. a x b is
 * rounded as -(b x a), without fused operations, so that two triangles see the same plane of a side
 * that they share, one from either side: no ray gets through between them.
 */
#ifndef PS_RAYS_TRIANGLE_H
#define PS_RAYS_TRIANGLE_H

#include "shared/real.h"

#ifdef __OPENCL_C_VERSION__
#define RAYS_GLOBAL __global
#else
#define RAYS_GLOBAL
#endif

/* A triangle as it is seen from o. */
typedef struct rays_cone {
    real normals[9]; /* of the three planes, to the inside */
    real volume;     /* |a.(b x c)| */
} rays_cone;

static inline real rays_dot(const real *a, const real *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void rays_cross(real *out, const real *a, const real *b) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* corners[9]. Returns 0 where no ray can meet it that goes to the side of o where `normal` points:
 * every corner is on the other one, or o is in the plane of the triangle. */
static inline int rays_see(rays_cone *out, RAYS_GLOBAL const real *corners, const real *origin,
                           const real *normal) {
    real at[9];
    int is_ahead = 0;
    for (int i = 0; i < 9; i++) {
        at[i] = corners[i] - origin[i % 3];
    }
    for (int i = 0; i < 9; i += 3) {
        is_ahead |= rays_dot(at + i, normal) > 0;
    }
    if (!is_ahead) {
        return 0;
    }
    rays_cross(out->normals, at, at + 3);
    rays_cross(out->normals + 3, at + 3, at + 6);
    rays_cross(out->normals + 6, at + 6, at);
    const real volume = rays_dot(at, out->normals + 3);
    const real sign = volume < 0 ? -1 : 1;
    for (int i = 0; i < 9; i++) {
        out->normals[i] *= sign;
    }
    out->volume = volume * sign;
    return volume != 0;
}

/* d.n of plane i */
static inline realv rays_height(const rays_cone *cone, const int i, const realv x, const realv y,
                                const realv z) {
    const real *const n = cone->normals + 3 * i;
    return fma(z, (realv)n[2], fma(y, (realv)n[1], x * (realv)n[0]));
}

/* Not 0 where a ray in direction (x, y, z), a unit vector, meets the triangle; is_bounded: within
 * the radius. */
static inline swordv rays_meet(const rays_cone *cone, const realv x, const realv y, const realv z,
                               const int is_bounded, const real radius) {
    const realv first = rays_height(cone, 0, x, y, z);
    const realv second = rays_height(cone, 1, x, y, z);
    const realv third = rays_height(cone, 2, x, y, z);
    swordv out = (first >= (realv)0) & (second >= (realv)0) & (third >= (realv)0);
    if (is_bounded) {
        out &= (first + second + third) * (realv)radius >= (realv)cone->volume;
    }
    return out;
}

#endif
