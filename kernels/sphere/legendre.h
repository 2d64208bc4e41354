/* The recurrence over degrees at a fixed order m, in the form of differences
 * (docs/mathematics/numerics.md#high-order), DEGREES at a time. With t = 1 - |cos theta| and p_mm =
 * 1, D_mm = 0,
 *
 *     D_l = alpha_l D_{l-1} - kappa_l t p_{l-1},   p_l = p_{l-1} + D_l,
 *     alpha_l = (l - m - 1) / (l + m),   kappa_l = (2l - 1) / (l + m),
 *     Y_lm = C_m sin^m(theta) e^{i m phi} G_l p_l,
 *     G_l = G_{l-1} sqrt((2l + 1)(l + m) / ((2l - 1)(l - m))),   G_m = 1.
 *
 * Within a block that begins at degree l_0, D_l = epsilon_l E_l with epsilon the product of alphas
 * from l_0 on: three operations for a degree,
 *
 *     E_l = E_{l-1} - (kappa_l / epsilon_l) t p_{l-1},   p_l = p_{l-1} + epsilon_l E_l.
 *
 * From block to block p takes G up, so that it keeps the size of Y_lm, and E becomes D. The table
 * of a block (sphere/layout.h) is made by host/engines/sphere/sphere_table.c.
 */
#ifndef PS_SPHERE_LEGENDRE_H
#define PS_SPHERE_LEGENDRE_H

#include "shared/real.h"
#include "sphere/layout.h"

#ifdef __OPENCL_C_VERSION__
#define TABLE __global const real
#define INLINE static inline __attribute__((always_inline))
#else
#define TABLE const real
#define INLINE static inline
#endif

/* Degree i of a block, 1 .. DEGREES, from degree i - 1. */
INLINE void legendre_step(realv *p, realv *e, const realv t, TABLE *block, const int i) {
    *e = fma((realv)block[BLOCK_KAPPA + i - 1] * t, *p, *e);
    *p = fma((realv)block[BLOCK_EPSILON + i - 1], *e, *p);
}

/* From degree DEGREES of a block to degree 0 of the next. */
INLINE void legendre_enter(realv *p, realv *e, TABLE *block) {
    *p *= (realv)block[BLOCK_FACTORS];
    *e *= (realv)block[BLOCK_FACTORS + 1];
}

#endif
