/* Philox 4x32-10: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, "Parallel random numbers: as
 * easy as 1, 2, 3", SC 2011. Constants from the paper, section 4 and table 2. For OpenCL C and C11,
 * which have the same numbers (math/random/random.h has the layout of streams).
 */
#ifndef PS_SHARED_PHILOX_H
#define PS_SHARED_PHILOX_H

#include "shared/fixed.h"

#define PHILOX_ROUNDS 10
#define PHILOX_WORDS 4 /* of a block */
#define PHILOX_MULTIPLIER_0 0xD2511F53u
#define PHILOX_MULTIPLIER_1 0xCD9E8D57u
#define PHILOX_WEYL_0 0x9E3779B9u /* golden ratio */
#define PHILOX_WEYL_1 0xBB67AE85u /* sqrt(3) - 1 */
#define PHILOX_STREAM_SHIFT 16    /* stream number above the high half of the 48-bit block index */
#define PHILOX_DROP 11            /* 64 bits of random numbers - 53 of a double */

/* Streams that points are made of. */
#define PHILOX_COORDINATES 0
#define PHILOX_SCRAMBLE 2

/* The words of a block of a stream: seed, stream number and realization. */
typedef struct philox_stream {
    ps_u64 seed, realization;
    ps_u32 number;
} philox_stream;

/* Counter and key are not changed. */
static inline void philox_4x32_10(const ps_u32 *counter, const ps_u32 *key, ps_u32 *out) {
    ps_u32 c[PHILOX_WORDS] = {counter[0], counter[1], counter[2], counter[3]};
    for (ps_u32 i = 0; i < PHILOX_ROUNDS; i++) {
        const ps_u64 product_0 = (ps_u64)PHILOX_MULTIPLIER_0 * c[0];
        const ps_u64 product_1 = (ps_u64)PHILOX_MULTIPLIER_1 * c[2];
        c[0] = (ps_u32)(product_1 >> 32) ^ c[1] ^ (key[0] + i * PHILOX_WEYL_0);
        c[1] = (ps_u32)product_1;
        c[2] = (ps_u32)(product_0 >> 32) ^ c[3] ^ (key[1] + i * PHILOX_WEYL_1);
        c[3] = (ps_u32)product_0;
    }
    for (ps_u32 i = 0; i < PHILOX_WORDS; i++) {
        out[i] = c[i];
    }
}

/* block < 2^48 */
static inline void philox_block(const philox_stream stream, const ps_u64 block, ps_u32 *out) {
    const ps_u32 key[2] = {(ps_u32)stream.seed, (ps_u32)(stream.seed >> 32)};
    const ps_u32 counter[PHILOX_WORDS] = {
        (ps_u32)block, stream.number << PHILOX_STREAM_SHIFT | (ps_u32)(block >> 32),
        (ps_u32)stream.realization, (ps_u32)(stream.realization >> 32)};
    philox_4x32_10(counter, key, out);
}

/* The 53 bits of a uniform number. */
static inline ps_u64 philox_digits(const ps_u32 low, const ps_u32 high) {
    return ((ps_u64)high << 32 | low) >> PHILOX_DROP;
}

/* The same of numbers 0, 1, .. of a stream, one after the other: words[4] has the block of the
 * number before, or `is_first` is true. */
static inline ps_u64 philox_next(const philox_stream stream, const ps_u64 number,
                                 const int is_first, ps_u32 *words) {
    if (is_first || number % 2 == 0) {
        philox_block(stream, number / 2, words);
    }
    return number % 2 == 0 ? philox_digits(words[0], words[1]) : philox_digits(words[2], words[3]);
}

#endif
