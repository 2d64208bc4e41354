/* Sizes that the kernels of the sphere and their host agree on (host/engines/sphere/ passes them).
 *
 *   LANES    points side by side
 *   CHUNK    points whose state stays in local memory; their sums are added to a pair
 *   JOBS     work-items of a group, who have a chunk together: one on CPUs
 *   ORDERS   orders of one work-group: azimuth and sin^m begin exactly at the first, then go by multiplication
 *   DEGREES  degrees of a block, whose sums stay in registers. 8: 16 sums of 32 registers
 *
 * A block of the table is BLOCK_REALS numbers: -kappa[8], epsilon[8], ratio[8], the two factors of
 * the state, and nothing. See sphere/sums.cl.
 */
#ifndef PS_SPHERE_LAYOUT_H
#define PS_SPHERE_LAYOUT_H

#ifndef CHUNK
#define CHUNK 512
#endif
#ifndef JOBS
#define JOBS 1
#endif
#ifndef ORDERS
#define ORDERS 16
#endif
#ifndef ONLY_EVEN
#define ONLY_EVEN 0
#endif

/* What sphere/prepare.cl writes for every point, array after array. */
#define ARRAY_T 0
#define ARRAY_SIDE 1
#define ARRAY_RHO 2
#define ARRAY_RHO_REST 3
#define ARRAY_COSINE 4
#define ARRAY_SINE 5
#define NUM_ARRAYS 6

#define DEGREES 8
#define BLOCK_KAPPA 0
#define BLOCK_EPSILON 8
#define BLOCK_RATIO 16
#define BLOCK_FACTORS 24
#define BLOCK_REALS 32

#endif
