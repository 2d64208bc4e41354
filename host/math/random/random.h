/* Counter-based random numbers: Philox 4x32-10 (Salmon et al., SC 2011).
 *
 * Stream layout, fixed for ever since published numbers depend on it:
 *   key     = (low, high) 32 bits of the user's seed
 *   counter = (low 32 bits of the block index,
 *              stream number * 2^16 + high 16 bits of the block index,
 *              low 32 bits of the realization, high 32 bits of the realization)
 * A stream is (seed, stream number, realization); block b of it yields four 32-bit words.
 * Stream numbers keep independent uses apart (coordinates, permutations, scrambling, shift, ..).
 */
#ifndef PS_MATH_RANDOM_RANDOM_H
#define PS_MATH_RANDOM_RANDOM_H

#include "shared/philox.h"

#include <stddef.h>
#include <stdint.h>

/* Ten rounds of Philox 4x32; counter and key are not changed. Known answers:
 * tests/math/test_random.c.
 */
void ps_philox_4x32_10(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4]);

/* A position in one stream. Plain value; copy it freely. A stream has 2^48 blocks; running past its
 * end would enter the next stream, which no sampler comes near. */
typedef struct ps_random {
    uint32_t key[2];
    uint32_t counter[4]; /* of the block after the one in words */
    uint32_t words[4];
    unsigned num_used; /* words already taken from this block */
} ps_random;

/* Streams in use; a new use gets a new number at the end. */
typedef enum ps_random_stream {
    PS_STREAM_COORDINATES = PHILOX_COORDINATES,
    PS_STREAM_PERMUTATION = 1,
    PS_STREAM_SCRAMBLE = PHILOX_SCRAMBLE,
    PS_STREAM_SHIFT = 3,
    PS_STREAM_FREQUENCIES = 4, /* which frequencies of a ring; the realization is the ring */
    PS_STREAM_ROTATION = 5,    /* of the sphere, one per realization */
    /* Shifts or rotations of a realization that is used many times; the seed is that of
     * ps_random_seed_of, of what the realizations are of */
    PS_STREAM_TRIALS = 6
} ps_random_stream;

ps_random ps_random_init(uint64_t seed, ps_random_stream stream, uint64_t realization);

/* The seed of streams that belong to a text, so that those of other texts are independent: the
 * first 64 bits of (seed, stream, h), h the hash FNV-1a of 64 bits of the bytes of the text. */
uint64_t ps_random_seed_of(uint64_t seed, ps_random_stream stream, const char *text);

/* The next word, and the next two (the first is the low half). */
uint32_t ps_random_u32(ps_random *random);
uint64_t ps_random_u64(ps_random *random);
/* The upper 53 bits of the next 64, a uniform integer below 2^53. */
uint64_t ps_random_u53(ps_random *random);
/* Uniform on the multiples of 2^-53 in [0,1). */
double ps_random_uniform(ps_random *random);
/* Uniform integer in [0, bound), bound >= 1, without bias. Takes one word per try while
 * bound < 2^32, two above. */
uint64_t ps_random_below(ps_random *random, uint64_t bound);

/* The same numbers as count calls of ps_random_uniform, faster: several blocks at a time. */
void ps_random_fill_uniform(ps_random *random, double *out, size_t count);

/* Random access: the four words of block number block < 2^48 of the stream that random is in.
 * Depends on the stream alone, not on the position in it. */
void ps_random_block(const ps_random *random, uint64_t block, uint32_t out[4]);

#endif
