/* A lattice of frequencies as sums and differences of two small sets: k = l + r or l - r.
 *
 * Axes are cut into a left and a right part, l from the half lattice of the left axes, r from that
 * of the right ones (in one dimension: l = multiples of m = 2A + 1, r = 1..A). Then every k of the
 * half lattice is l + r, l - r, l alone or r alone, and exp(-2 pi i k.x) is a product of one factor
 * from each set. Tables hold tiles of `lanes` frequencies; the slot of a k in a row of powers is
 *
 *     [tile pair][l in tile][l + r, l - r][r in tile]   then   [l alone]   then   [r alone].
 */
#ifndef PS_ENGINES_TORUS_TORUS_SPLIT_H
#define PS_ENGINES_TORUS_TORUS_SPLIT_H

#include "frequencies/frequencies.h"

/* One factor. vectors: [num][dimension] of the whole space, zero on the other factor's axes. */
typedef struct ps_split_side {
    size_t num, num_tiles;
    int32_t *vectors;
} ps_split_side;

typedef struct ps_split {
    unsigned dimension, left_axes, lanes;
    int32_t max_frequency;
    int32_t step; /* m, in one dimension */
    ps_split_side left, right;
    uint32_t (*pairs)[2]; /* [num_pairs]: left tile, right tile, only those that are needed */
    size_t num_pairs;
    uint32_t *pair_of_tiles; /* [left tile][right tile] -> pair, or UINT32_MAX */
} ps_split;

/* Axes of the left factor; the others are the right one's, in one dimension both have the only one.
 */
unsigned ps_split_left_axes(unsigned dimension);

/* Numbers of frequencies of the two sides, without enumerating anything. */
void ps_split_sizes(const ps_frequencies *lattice, unsigned lanes, size_t *num_left,
                    size_t *num_right);

/* The lattice is a box or ball and enumerated; tile pairs without any of its frequencies are left
 * out (the corners of a ball). */
pspec_status ps_split_create(ps_split *out, const ps_frequencies *lattice, unsigned lanes,
                             ps_error *error) PS_MUST_CHECK;
void ps_split_free(ps_split *split);

/* Slots of a row, a multiple of lanes. */
size_t ps_split_stride(const ps_split *split);
/* First slot of l alone, of r alone. */
size_t ps_split_left_slot(const ps_split *split);
size_t ps_split_right_slot(const ps_split *split);
/* Slot of a frequency of the lattice. */
size_t ps_split_slot(const ps_split *split, const int32_t *k);

#endif
