/* Digital nets in base 2, scrambled (samplers/torus/digital_net.h of the host).
 */
#ifndef PS_SAMPLERS_DIGITAL_NET_H
#define PS_SAMPLERS_DIGITAL_NET_H

#include "samplers/numbers.h"

#define NET_PLAIN 0
#define NET_XOR 1
#define NET_OWEN 2
#define NET_HASH 3

#define NET_MANTISSA_DIGITS 53
/* Owen's tree of flips is cut into chunks of 7 levels: the 127 flips of a chunk are bits 1..127 of
 * one Philox block, so 5 blocks hold a coordinate's whole path and no hash weaker than the
 * generator is needed. */
#define NET_CHUNK_LEVELS 7
#define NET_CHUNKS 5
#define NET_TREE_LEVELS (NET_CHUNKS * NET_CHUNK_LEVELS) /* 35, 3 more than the net has digits */
/* Below the tree: 18 bits for each of its leaves. */
#define NET_TAIL_DIGITS (NET_MANTISSA_DIGITS - NET_TREE_LEVELS)
/* Owen's block index: prefix or word in the low 32 bits, chunk in 3 above, axis above that. */
#define NET_CHUNK_SHIFT 32
#define NET_AXIS_SHIFT 35

/* Flips of the 7 digits of one chunk. A node of its binary tree is a 1 followed by the digits above
 * it, a number in 1..127. */
static inline ps_u32 net_chunk_flips(const ps_u32 *bits, const ps_u32 digits) {
    ps_u32 flips = 0;
    for (ps_u32 level = 0; level < NET_CHUNK_LEVELS; level++) {
        const ps_u32 node = (1u << level) | digits >> (NET_CHUNK_LEVELS - level);
        flips = flips << 1 | (bits[node / 32] >> node % 32 & 1u);
    }
    return flips;
}

/* word -> 53 digits. The digits above a chunk name its block, those within it the bits thereof. */
static inline ps_u64 net_owen(const philox_stream stream, const ps_u32 axis, const ps_u32 word) {
    const ps_u64 digits = (ps_u64)word << (NET_TREE_LEVELS - SAMPLER_DIGITS);
    const ps_u64 axis_blocks = (ps_u64)axis << NET_AXIS_SHIFT;
    ps_u64 flips = 0;
    ps_u32 bits[PHILOX_WORDS];
    for (ps_u32 chunk = 0; chunk < NET_CHUNKS; chunk++) {
        const ps_u32 below = NET_TREE_LEVELS - NET_CHUNK_LEVELS * (chunk + 1);
        const ps_u64 prefix = digits >> (below + NET_CHUNK_LEVELS);
        const ps_u32 own = (ps_u32)(digits >> below) & ((1u << NET_CHUNK_LEVELS) - 1);
        philox_block(stream, axis_blocks | (ps_u64)chunk << NET_CHUNK_SHIFT | prefix, bits);
        flips = flips << NET_CHUNK_LEVELS | net_chunk_flips(bits, own);
    }
    philox_block(stream, axis_blocks | (ps_u64)NET_CHUNKS << NET_CHUNK_SHIFT | word, bits);
    return (digits ^ flips) << NET_TAIL_DIGITS | bits[0] >> (32 - NET_TAIL_DIGITS);
}

static inline ps_u32 net_reverse(ps_u32 x) {
    x = (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
    x = (x >> 8 & 0x00ff00ffu) | (x & 0x00ff00ffu) << 8;
    return x >> 16 | x << 16;
}

/* Nested uniform scrambling by a hash (S. Laine and T. Karras 2011, multipliers of N. Vegdahl
 * 2021): of the reversed digits each is flipped by those below it alone, since x times an even
 * number has none of x's own digit. Cheap, and not as random as net_owen. The 21 digits below are
 * those of a last mixing of the scrambled word and the shift. */
static inline ps_u64 net_hash(const ps_u32 word, const ps_u64 shift) {
    const ps_u32 seed = (ps_u32)(shift >> (NET_MANTISSA_DIGITS - SAMPLER_DIGITS));
    ps_u32 x = net_reverse(word);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= seed >> 16 | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    x = net_reverse(x);
    ps_u32 rest = (x ^ (ps_u32)shift) * 0x85ebca6bu;
    rest = (rest ^ rest >> 13) * 0xc2b2ae35u;
    rest ^= rest >> 16;
    return (ps_u64)x << (NET_MANTISSA_DIGITS - SAMPLER_DIGITS) |
           rest >> (2 * SAMPLER_DIGITS - NET_MANTISSA_DIGITS);
}

/* A coordinate's 53 digits; shift is that of its axis and realization. */
static inline ps_u64 net_digits(const ps_u32 scramble, const philox_stream stream,
                                const ps_u32 axis, const ps_u32 word, const ps_u64 shift) {
    return scramble == NET_OWEN ? net_owen(stream, axis, word)
           : scramble == NET_HASH
               ? net_hash(word, shift)
               : ((ps_u64)word << (NET_MANTISSA_DIGITS - SAMPLER_DIGITS) ^ shift);
}

/* Has an axis of such nets one random word, the same for all points? */
static inline ps_u32 net_is_shifted(const ps_u32 scramble) {
    return scramble == NET_XOR || scramble == NET_HASH;
}

/* Point j of one axis. steps[b] is the XOR of its direction numbers 0..b: those of the set bits of
 * j are the steps of the set bits of the Gray code of j. */
static inline ps_u32 net_word(const ps_u32 origin, SAMPLER_TABLE steps, const ps_u64 j) {
    ps_u32 word = origin;
    ps_u64 gray = j ^ j >> 1;
    for (ps_u32 b = 0; gray != 0; b++) {
        word ^= (gray & 1) != 0 ? steps[b] : 0;
        gray >>= 1;
    }
    return word;
}

/* table [axis][SAMPLER_DIGITS]: steps */
SAMPLER_INLINE void net_places(const sampler_numbers *of, SAMPLER_TABLE table,
                               const ps_u32 dimension, const ps_u64 realization, const ps_u64 j,
                               ps_u64 *places) {
    const philox_stream stream = {of->seed, realization, PHILOX_SCRAMBLE};
    ps_u32 words[PHILOX_WORDS];
    SAMPLER_FOR(ps_u32 i = 0; i < dimension; i++) {
        const ps_u64 shift =
            net_is_shifted(of->scramble) ? philox_next(stream, i, i == 0, words) : 0;
        const ps_u32 word = net_word(of->origin[i], table + i * SAMPLER_DIGITS, j);
        places[i] = net_digits(of->scramble, stream, i, word, shift) << SAMPLER_DROP;
    }
}

#endif
