#include "engines/torus/torus_split.h"

#include "base/memory.h"
#include "base/round.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

unsigned ps_split_left_axes(unsigned dimension) {
    return (dimension + 1) / 2;
}

/* ((2K+1)^axes - 1) / 2 */
static size_t half_lattice_size(unsigned axes, int32_t max_frequency) {
    size_t size = 1;
    for (unsigned i = 0; i < axes; i++) {
        size *= 2 * (size_t)max_frequency + 1;
    }
    return (size - 1) / 2;
}

/* A, the number of right frequencies in one dimension: A left times A right products cover K = 2
 * A^2 frequencies, so A = sqrt(K / 2), rounded up to whole tiles. */
static size_t right_size_1d(int32_t max_frequency, unsigned lanes) {
    const size_t wanted = (size_t)ceil(sqrt(max_frequency / 2.0));
    const size_t tiled = ps_round_up(wanted, lanes);
    return tiled < (size_t)max_frequency ? tiled : (size_t)max_frequency;
}

void ps_split_sizes(const ps_frequencies *lattice, unsigned lanes, size_t *num_left,
                    size_t *num_right) {
    const unsigned left_axes = ps_split_left_axes(lattice->dimension);
    if (lattice->dimension == 1) {
        *num_right = right_size_1d(lattice->max_frequency, lanes);
        *num_left = ((size_t)lattice->max_frequency + *num_right) / (2 * *num_right + 1);
    } else {
        *num_left = half_lattice_size(left_axes, lattice->max_frequency);
        *num_right = half_lattice_size(lattice->dimension - left_axes, lattice->max_frequency);
    }
}

/* ---- building ---------------------------------------------------------------------------- */

/* Index of a vector in the half lattice of its axes: its place in the box, counted from DC. */
static size_t half_lattice_index(const int32_t *k, unsigned axes, int32_t max_frequency) {
    size_t place = 0;
    size_t centre = 0;
    const size_t width = 2 * (size_t)max_frequency + 1;
    for (unsigned i = 0; i < axes; i++) {
        place = place * width + (size_t)(k[i] + max_frequency);
        centre = centre * width + (size_t)max_frequency;
    }
    return place - centre - 1;
}

/* All of a side's vectors: the half lattice of `axes` axes, written from column `first_axis` on. */
static pspec_status fill_half_lattice(ps_split_side *side, const ps_split *split, unsigned axes,
                                      unsigned first_axis, ps_error *error) {
    ps_frequencies part = {0};
    PS_TRY(ps_frequencies_lattice(&part, axes, split->max_frequency, false, error));
    PS_TRY(ps_frequencies_enumerate(&part, error));
    for (size_t i = 0; i < side->num; i++) {
        memcpy(side->vectors + i * split->dimension + first_axis, part.vectors + i * axes,
               axes * sizeof *part.vectors);
    }
    ps_frequencies_free(&part);
    return PSPEC_OK;
}

static pspec_status fill_side(ps_split_side *side, const ps_split *split, bool is_left,
                              ps_error *error) {
    side->num_tiles = ps_divide_up(side->num, split->lanes);
    PS_TRY(PS_NEW(&side->vectors, side->num * split->dimension, "the factors of a grid", error));
    if (split->dimension > 1) {
        const unsigned axes = is_left ? split->left_axes : split->dimension - split->left_axes;
        return fill_half_lattice(side, split, axes, is_left ? 0 : split->left_axes, error);
    }
    for (size_t i = 0; i < side->num; i++) {
        side->vectors[i] = (int32_t)(i + 1) * (is_left ? split->step : 1);
    }
    return PSPEC_OK;
}

/* Where k stands: l index and r index, counted from 1, 0 meaning absent; is_minus for l - r. */
typedef struct place {
    size_t left, right;
    bool is_minus;
} place;

static place find_place_1d(const ps_split *split, int32_t k) {
    const int32_t reach = (int32_t)split->right.num;
    const int32_t multiple = (k + reach) / split->step;
    const int32_t rest = k - multiple * split->step;
    return (place){(size_t)multiple, (size_t)abs(rest), rest < 0};
}

static place find_place(const ps_split *split, const int32_t *k) {
    if (split->dimension == 1) {
        return find_place_1d(split, k[0]);
    }
    const unsigned right_axes = split->dimension - split->left_axes;
    const int32_t *right = k + split->left_axes;
    int32_t mirrored[PS_MAX_DIMENSION] = {0};
    place found = {0};
    if (ps_frequency_is_in_half_lattice(k, split->left_axes)) {
        found.left = half_lattice_index(k, split->left_axes, split->max_frequency) + 1;
    }
    if (ps_frequency_is_in_half_lattice(right, right_axes)) {
        found.right = half_lattice_index(right, right_axes, split->max_frequency) + 1;
    } else if (ps_frequency_norm2(right, right_axes) > 0) {
        for (unsigned i = 0; i < right_axes; i++) {
            mirrored[i] = -right[i];
        }
        found.right = half_lattice_index(mirrored, right_axes, split->max_frequency) + 1;
        found.is_minus = true;
    }
    return found;
}

/* Marks the tile pairs that the lattice needs, then numbers them; pairs that share a right tile are
 * neighbours, so that its table stays in the cache. */
static pspec_status fill_pairs(ps_split *split, const ps_frequencies *lattice, ps_error *error) {
    const size_t num_tiles = split->left.num_tiles * split->right.num_tiles;
    PS_TRY(PS_NEW(&split->pair_of_tiles, num_tiles, "the tiles of a grid", error));
    PS_TRY(PS_NEW(&split->pairs, num_tiles, "the tiles of a grid", error));
    for (size_t i = 0; i < lattice->num; i++) {
        const place at = find_place(split, lattice->vectors + i * split->dimension);
        if (at.left > 0 && at.right > 0) {
            const size_t tile = (at.left - 1) / split->lanes * split->right.num_tiles +
                                (at.right - 1) / split->lanes;
            split->pair_of_tiles[tile] = 1;
        }
    }
    for (size_t right = 0; right < split->right.num_tiles; right++) {
        for (size_t left = 0; left < split->left.num_tiles; left++) {
            uint32_t *pair = &split->pair_of_tiles[left * split->right.num_tiles + right];
            if (*pair != 0) {
                split->pairs[split->num_pairs][0] = (uint32_t)left;
                split->pairs[split->num_pairs][1] = (uint32_t)right;
                *pair = (uint32_t)split->num_pairs++;
            } else {
                *pair = UINT32_MAX;
            }
        }
    }
    return PSPEC_OK;
}

pspec_status ps_split_create(ps_split *out, const ps_frequencies *lattice, unsigned lanes,
                             ps_error *error) {
    *out = (ps_split){.dimension = lattice->dimension,
                      .left_axes = ps_split_left_axes(lattice->dimension),
                      .lanes = lanes,
                      .max_frequency = lattice->max_frequency};
    ps_split_sizes(lattice, lanes, &out->left.num, &out->right.num);
    out->step = 2 * (int32_t)out->right.num + 1;
    pspec_status status = fill_side(&out->left, out, true, error);
    if (status == PSPEC_OK) {
        status = fill_side(&out->right, out, false, error);
    }
    if (status == PSPEC_OK) {
        status = fill_pairs(out, lattice, error);
    }
    if (status != PSPEC_OK) {
        ps_split_free(out);
    }
    return status;
}

void ps_split_free(ps_split *split) {
    free(split->left.vectors);
    free(split->right.vectors);
    free(split->pairs);
    free(split->pair_of_tiles);
    *split = (ps_split){0};
}

/* ---- slots ------------------------------------------------------------------------------- */

size_t ps_split_left_slot(const ps_split *split) {
    return split->num_pairs * 2 * split->lanes * split->lanes;
}

size_t ps_split_right_slot(const ps_split *split) {
    return ps_split_left_slot(split) + split->left.num_tiles * split->lanes;
}

size_t ps_split_stride(const ps_split *split) {
    return ps_split_right_slot(split) + split->right.num_tiles * split->lanes;
}

size_t ps_split_slot(const ps_split *split, const int32_t *k) {
    const place at = find_place(split, k);
    const size_t lanes = split->lanes;
    if (at.right == 0) {
        return ps_split_left_slot(split) + at.left - 1;
    }
    if (at.left == 0) {
        return ps_split_right_slot(split) + at.right - 1;
    }
    const size_t left = at.left - 1;
    const size_t right = at.right - 1;
    const size_t pair = split->pair_of_tiles[left / lanes * split->right.num_tiles + right / lanes];
    const size_t row = (pair * lanes + left % lanes) * 2 + (at.is_minus ? 1 : 0);
    return row * lanes + right % lanes;
}
