/* Zonal sums, the part of a pair sum that a turn about the z axis does not change:
 *
 *     Z(l) = sum_j w_j P_l(z_j),   c_l0 = sqrt((2l + 1) / (4 pi)) Z(l),
 *     C_l^2 = 2 sum_{m > 0} |c_lm|^2 = (2l + 1) / (4 pi) (Q(l) - Z(l)^2)
 *
 * See docs/mathematics/sphere.md#pair-sums. In double precision on the host, in the difference form
 * of kernels/pairs/sums.cl: N L small steps beside the N^2 L / 2 or N L^2 / 2 of an engine.
 */
#ifndef PS_ENGINES_PAIRS_PAIRS_ZONAL_H
#define PS_ENGINES_PAIRS_PAIRS_ZONAL_H

#include "base/status.h"

#include <pointspec/pointspec.h>

#include <stdint.h>

/* Doubles of working memory for degrees to max_degree. */
size_t ps_zonal_scratch(int32_t max_degree);
/* out[l], l = 0 .. max_degree, with weights w 2^-exponent (1 where there are none). Points need not
 * have exactly length 1. */
void ps_zonal_sums(const pspec_pattern *pattern, int exponent, int32_t max_degree, double *scratch,
                   double *out);

#endif
