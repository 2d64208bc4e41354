#include "spectra/accumulate/accumulate_device.h"

#include "base/memory.h"
#include "base/round.h"

#include <stdlib.h>
#include <string.h>

/* Where the next ring and the next member of a block go while bins are walked through. */
typedef struct cursor {
    size_t bin; /* of the last ring, plus 1 */
    uint32_t length, ring, member;
} cursor;

/* A ring more in the block of this slot, unless the last one is of the same bin and not full. */
static bool is_new_ring(cursor *block, size_t bin) {
    const bool is_new = block->bin != bin + 1 || block->length == PS_ACCUMULATE_PIECE;
    block->bin = bin + 1;
    block->length = is_new ? 1 : block->length + 1;
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

/* Rings of equal length one after the other: the loop over members becomes predictable. Those of
 * one length stay in the order of bins. */
static void sort_rings(ps_block_ring *rings, size_t num, ps_block_ring *sorted) {
    uint32_t begins[PS_ACCUMULATE_PIECE + 1] = {0}; /* of a length, from 1 on */
    uint32_t begin = 0;
    for (size_t i = 0; i < num; i++) {
        begins[rings[i].end - rings[i].first]++;
    }
    for (size_t length = 0; length <= PS_ACCUMULATE_PIECE; length++) {
        const uint32_t count = begins[length];
        begins[length] = begin;
        begin += count;
    }
    for (size_t i = 0; i < num; i++) {
        sorted[begins[rings[i].end - rings[i].first]++] = rings[i];
    }
    memcpy(rings, sorted, num * sizeof *rings);
}

/* A block has no more rings than slots. */
static void sort_blocks(ps_accumulate_blocks *self) {
    ps_block_ring sorted[PS_ACCUMULATE_BLOCK];
    for (size_t i = 0; i < self->num_blocks; i++) {
        sort_rings(self->rings + self->first_rings[i],
                   self->first_rings[i + 1] - self->first_rings[i], sorted);
    }
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
        sort_blocks(out);
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
