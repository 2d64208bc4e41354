#include "spectra/accumulate_blocks.h"

#include "base/memory.h"
#include "base/round.h"

#include <stdlib.h>
#include <string.h>

/* Where the next ring and the next member of a block go while bins are walked through. */
typedef struct cursor {
    size_t bin; /* of the last ring, plus 1 */
    uint32_t ring, member;
} cursor;

/* A ring more in the block of this slot, unless the last one is of the same bin already. */
static bool is_new_ring(cursor *block, size_t bin) {
    const bool is_new = block->bin != bin + 1;
    block->bin = bin + 1;
    return is_new;
}

static void count(ps_accumulate_blocks *self, const ps_bins *bins, const uint32_t *slots,
                  cursor *cursors) {
    for (size_t b = 0; b < bins->num; b++) {
        for (size_t i = bins->bins[b].begin; i < bins->bins[b].end; i++) {
            cursor *block = &cursors[slots[bins->members[i]] / PS_ACCUMULATE_BLOCK];
            const uint32_t new_rings = is_new_ring(block, b);
            block->ring += new_rings;
            block->member++;
            self->num_pieces += new_rings;
            self->num_members++;
        }
    }
}

/* Numbers become beginnings. */
static void begin_blocks(ps_accumulate_blocks *self, cursor *cursors) {
    uint32_t ring = 0;
    uint32_t member = 0;
    for (size_t i = 0; i < self->num_blocks; i++) {
        const cursor counted = cursors[i];
        self->first_rings[i] = ring;
        cursors[i] = (cursor){.ring = ring, .member = member};
        ring += counted.ring;
        member += counted.member;
    }
    self->first_rings[self->num_blocks] = ring;
}

static void fill(ps_accumulate_blocks *self, const ps_bins *bins, const uint32_t *slots,
                 cursor *cursors) {
    uint32_t piece = 0;
    for (size_t b = 0; b < bins->num; b++) {
        self->bin_pieces[b][0] = piece;
        for (size_t i = bins->bins[b].begin; i < bins->bins[b].end; i++) {
            const uint32_t slot = slots[bins->members[i]];
            cursor *block = &cursors[slot / PS_ACCUMULATE_BLOCK];
            if (is_new_ring(block, b)) {
                self->rings[block->ring++] = (ps_block_ring){block->member, block->member, piece++};
            }
            self->rings[block->ring - 1].end++;
            self->members[block->member++] = (uint16_t)(slot % PS_ACCUMULATE_BLOCK);
        }
        self->bin_pieces[b][1] = piece;
    }
}

/* Rings of equal length one after the other: the loop over members becomes predictable. */
static int compare_rings(const void *left, const void *right) {
    const ps_block_ring *a = left;
    const ps_block_ring *b = right;
    const uint32_t a_length = a->end - a->first;
    const uint32_t b_length = b->end - b->first;
    return a_length != b_length ? (a_length > b_length) - (a_length < b_length)
                                : (a->piece > b->piece) - (a->piece < b->piece);
}

static pspec_status allocate(ps_accumulate_blocks *self, ps_error *error) {
    PS_TRY(PS_NEW(&self->rings, self->num_pieces, "bins", error));
    PS_TRY(PS_NEW(&self->members, self->num_members, "bins", error));
    PS_TRY(PS_NEW(&self->bin_pieces, self->num_bins, "bins", error));
    PS_TRY(PS_NEW(&self->first_rings, self->num_blocks + 1, "bins", error));
    return PSPEC_OK;
}

pspec_status ps_accumulate_blocks_create(ps_accumulate_blocks *out, const ps_bins *bins,
                                         const uint32_t *slots, size_t stride, ps_error *error) {
    *out = (ps_accumulate_blocks){.num_bins = bins->num,
                                  .num_blocks = ps_divide_up(stride, PS_ACCUMULATE_BLOCK)};
    cursor *cursors = NULL;
    PS_TRY(PS_NEW(&cursors, out->num_blocks, "bins", error));
    count(out, bins, slots, cursors);
    const pspec_status status = allocate(out, error);
    if (status == PSPEC_OK) {
        begin_blocks(out, cursors);
        fill(out, bins, slots, cursors);
        for (size_t i = 0; i < out->num_blocks; i++) {
            qsort(out->rings + out->first_rings[i], out->first_rings[i + 1] - out->first_rings[i],
                  sizeof *out->rings, compare_rings);
        }
    } else {
        ps_accumulate_blocks_free(out);
    }
    free(cursors);
    return status;
}

void ps_accumulate_blocks_free(ps_accumulate_blocks *blocks) {
    free(blocks->first_rings);
    free(blocks->rings);
    free(blocks->members);
    free(blocks->bin_pieces);
    *blocks = (ps_accumulate_blocks){0};
}
