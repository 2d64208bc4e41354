/* Members of bins by blocks of slots: what kernels/accumulate/blocks.cl walks through. */
#ifndef PS_SPECTRA_ACCUMULATE_ACCUMULATE_BLOCKS_H
#define PS_SPECTRA_ACCUMULATE_ACCUMULATE_BLOCKS_H

#include "spectra/bins.h"

/* Slots of a block, as in the kernel. */
enum { PS_ACCUMULATE_BLOCK = 512 };
/* Members of a piece at most, so that one item of a GPU does not add up long ones while others
 * wait. Sums depend on it. */
enum { PS_ACCUMULATE_PIECE = 16 };

/* Successive members of one bin in one block; their sum is a piece of the bin. */
typedef struct ps_block_ring {
    uint32_t first, end, piece;
} ps_block_ring;

typedef struct ps_accumulate_blocks {
    size_t num_blocks, num_pieces, num_members, num_bins; /* as many rings as pieces */
    uint32_t *first_rings;                                /* [num_blocks + 1] */
    ps_block_ring *rings;                                 /* block by block */
    uint16_t *members;                                    /* ring by ring, slots within the block */
    uint32_t (*bin_pieces)[2];                            /* [num_bins]: first, one past the last */
} ps_accumulate_blocks;

/* slots: of the frequencies that are members of bins, below stride. */
pspec_status ps_accumulate_blocks_create(ps_accumulate_blocks *out, const ps_bins *bins,
                                         const uint32_t *slots, size_t stride,
                                         ps_error *error) PS_MUST_CHECK;
void ps_accumulate_blocks_free(ps_accumulate_blocks *blocks);

#endif
