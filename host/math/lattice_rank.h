/* Points of the integer lattice Z^d counted by their norm, and numbered: from a rank to the point
 * that has it, without listing the others.
 *
 * A shell holds the points with low <= |k|^2 <= high; its points are ranked in lexicographic order.
 * k -> -k reverses that order, so that of the T points of a shell without the origin, the ranks T/2
 * .. T-1 are exactly those whose first non-zero component is positive: the half lattice.
 */
#ifndef PS_MATH_LATTICE_RANK_H
#define PS_MATH_LATTICE_RANK_H

#include "base/status.h"

#include <stdint.h>

enum { PS_LATTICE_MAX_DIMENSION = 6 };

typedef struct ps_lattice {
    unsigned dimension;
    int64_t max_norm2;
    /* within[j][n]: points of Z^j with |k|^2 <= n, j = 0..dimension; one block */
    uint64_t *within[PS_LATTICE_MAX_DIMENSION + 1];
} ps_lattice;

/* Between which numbers the points of Z^d with |k|^2 <= max_norm2 are, without counting them: the
 * unit cubes around them cover the ball whose radius is half a diagonal less, and lie in the one
 * whose radius is half a diagonal more. */
typedef struct ps_lattice_bounds {
    double least, most;
} ps_lattice_bounds;
ps_lattice_bounds ps_lattice_estimate(unsigned dimension, int64_t max_norm2);

/* Counts all points with |k|^2 <= max_norm2, in (dimension + 1) (max_norm2 + 1) numbers and about
 * dimension max_norm2^1.5 additions. dimension 1..6. More points than 2^64 - 1 are
 * PSPEC_ERROR_INVALID_ARGUMENT, at once where the estimate says so. */
pspec_status ps_lattice_create(ps_lattice *out, unsigned dimension, int64_t max_norm2,
                               ps_error *error) PS_MUST_CHECK;
void ps_lattice_free(ps_lattice *lattice);

/* Points of the shell, 0 <= low <= high <= max_norm2. */
uint64_t ps_lattice_count(const ps_lattice *lattice, int64_t low, int64_t high);
/* Mean |k| over a shell that has points. */
double ps_lattice_mean_norm(const ps_lattice *lattice, int64_t low, int64_t high);
/* The point k[dimension] of that rank, below ps_lattice_count. */
void ps_lattice_unrank(const ps_lattice *lattice, int64_t low, int64_t high, uint64_t rank,
                       int32_t *k);

#endif
