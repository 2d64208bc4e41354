/* The bins of pairs_histogram, their nodes, and the proven bound of what is lost between them.
 *
 * g(r) = P_l(1 - r^2 / 2) is wanted for chords 0 <= r <= sqrt 2. Instead of g a bin of width h has
 * the polynomial of degree K - 1 that agrees with g at its K Chebyshev nodes, which is off by at
 * most max |g^(K)| (h/2)^K / (K! 2^(K-1)).
 *
 * P_l(cos gamma) = sum_j a_j cos((l - 2j) gamma) with a_j = c_j c_(l-j) > 0, c_j = binom(2j, j) /
 * 4^j, which add up to 1. With s = r / 2 = sin(gamma / 2), cos(n gamma) is the real part of f(s) =
 * exp(i m asin s), m = 2n, which solves
 *
 *     (1 - s^2) f^(k+2) = (2k + 1) s f^(k+1) + (k^2 + (i m)^2) f^(k),     f' = i m f / sqrt(1 - s^2),
 *
 * so that f^(K) = f sum_k b_k (i m)^k with b_k >= 0 that grow with s: |f^(K)| <= sum_k b_k m^k,
 * taken at s = 1 / sqrt 2, and
 *
 *     |g^(K)| <= 2^-K sum_k b_k 2^k M_k,   M_k = sum_j a_j |l - 2j|^k.
 *
 * M_k grows with l, so that the largest degree is the worst: by Laplace's integral, l - 2j is
 * distributed as a sum of l signs, independent and of the same mean c, with c = cos phi and phi
 * uniform. Given c, all odd moments of such a sum have the sign of c, so each further sign adds
 * nothing negative to an even moment. For odd k, sqrt(M_(k-1) M_(k+1)) serves. Weights multiply it
 * by sum_{i != j} |w_i w_j| <= (sum |w|)^2.
 */
#ifndef PS_ENGINES_PAIRS_PAIRS_BINS_H
#define PS_ENGINES_PAIRS_PAIRS_BINS_H

#include <stddef.h>
#include <stdint.h>

/* K, as in kernels/pairs/histogram.cl. */
enum { PS_PAIRS_MOMENTS = 8 };

/* The bound for degrees to max_degree with num_bins bins of chords to sqrt 2. */
double ps_pairs_bins_bound(int32_t max_degree, size_t num_bins);
/* The fewest bins with a bound of at most that. */
size_t ps_pairs_bins_choose(int32_t max_degree, double bound);

/* Nodes of the bins of side 1, then of side -1: t = r^2 / 2 and side, nodes[2][2 num_bins
 * PS_PAIRS_MOMENTS]. */
void ps_pairs_bins_nodes(size_t num_bins, double *nodes);
/* matrix[j][k] of kernels/pairs/nodes.cl. */
void ps_pairs_bins_matrix(double *matrix);

#endif
