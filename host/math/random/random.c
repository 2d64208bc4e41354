/* The generator itself is kernels/shared/philox.h, which devices have, too. */
#include "math/random/random.h"

enum {
    UNIFORMS_PER_BLOCK = 2,
    /* Blocks made together, so that their rounds overlap and vectorise: 2.7 ns a uniform (gcc 12,
     * 3.2 by clang 15; -O3, SSE2, Zen 4), where fewer, whose loops gcc unrolls before that, take
     * 6.2 to 7.6, and more the same. */
    NUM_LANES = 24,
    /* As many uniforms one at a time take as long as a chunk of these. */
    LEAST_OF_CHUNK = 24
};

static const double UNIFORM_STEP = 0x1p-53;

void ps_philox_4x32_10(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4]) {
    philox_4x32_10(counter, key, out);
}

ps_random ps_random_init(uint64_t seed, ps_random_stream stream, uint64_t realization) {
    return (ps_random){
        .key = {(uint32_t)seed, (uint32_t)(seed >> 32)},
        .counter = {0, (uint32_t)stream << PHILOX_STREAM_SHIFT, (uint32_t)realization,
                    (uint32_t)(realization >> 32)},
        .num_used = PHILOX_WORDS,
    };
}

/* Adds to the 48-bit block index, whose high 16 bits are the low bits of counter[1]. */
static void advance(ps_random *random, uint32_t num_blocks) {
    random->counter[0] += num_blocks;
    random->counter[1] += random->counter[0] < num_blocks;
}

static void refill(ps_random *random) {
    ps_philox_4x32_10(random->counter, random->key, random->words);
    advance(random, 1);
    random->num_used = 0;
}

uint32_t ps_random_u32(ps_random *random) {
    if (random->num_used == PHILOX_WORDS) {
        refill(random);
    }
    return random->words[random->num_used++];
}

uint64_t ps_random_u64(ps_random *random) {
    const uint64_t low = ps_random_u32(random);
    return low | (uint64_t)ps_random_u32(random) << 32;
}

uint64_t ps_random_seed_of(uint64_t seed, ps_random_stream stream, const char *text) {
    const uint64_t prime = UINT64_C(0x100000001b3);
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (const char *letter = text; *letter != '\0'; letter++) {
        hash = (hash ^ (unsigned char)*letter) * prime;
    }
    ps_random random = ps_random_init(seed, stream, hash);
    return ps_random_u64(&random);
}

uint64_t ps_random_u53(ps_random *random) {
    return ps_random_u64(random) >> PHILOX_DROP;
}

double ps_random_uniform(ps_random *random) {
    return (double)ps_random_u53(random) * UNIFORM_STEP;
}

/* D. Lemire, "Fast random integer generation in an interval", 2019: the high half of a product is
 * uniform once the low halves below 2^32 mod bound are refused. */
static uint32_t below_32(ps_random *random, uint32_t bound) {
    uint64_t product = (uint64_t)ps_random_u32(random) * bound;
    if ((uint32_t)product < bound) {
        const uint32_t num_refused = (0u - bound) % bound;
        while ((uint32_t)product < num_refused) {
            product = (uint64_t)ps_random_u32(random) * bound;
        }
    }
    return (uint32_t)(product >> 32);
}

uint64_t ps_random_below(ps_random *random, uint64_t bound) {
    if (bound <= UINT32_MAX) {
        return below_32(random, (uint32_t)bound);
    }
    const uint64_t num_refused = (0u - bound) % bound; /* 2^64 mod bound */
    uint64_t value = ps_random_u64(random);
    while (value < num_refused) {
        value = ps_random_u64(random);
    }
    return value % bound;
}

/* NUM_LANES successive blocks; lane l of word w is lanes[w][l]. */
static void make_blocks(const ps_random *random, uint32_t lanes[PHILOX_WORDS][NUM_LANES]) {
    for (uint32_t l = 0; l < NUM_LANES; l++) {
        lanes[0][l] = random->counter[0] + l;
        lanes[1][l] = random->counter[1] + (lanes[0][l] < l);
        lanes[2][l] = random->counter[2];
        lanes[3][l] = random->counter[3];
    }
    for (uint32_t i = 0; i < PHILOX_ROUNDS; i++) {
        const uint32_t key_0 = random->key[0] + i * PHILOX_WEYL_0;
        const uint32_t key_1 = random->key[1] + i * PHILOX_WEYL_1;
        for (unsigned l = 0; l < NUM_LANES; l++) {
            const uint64_t product_0 = (uint64_t)PHILOX_MULTIPLIER_0 * lanes[0][l];
            const uint64_t product_1 = (uint64_t)PHILOX_MULTIPLIER_1 * lanes[2][l];
            lanes[0][l] = (uint32_t)(product_1 >> 32) ^ lanes[1][l] ^ key_0;
            lanes[1][l] = (uint32_t)product_1;
            lanes[2][l] = (uint32_t)(product_0 >> 32) ^ lanes[3][l] ^ key_1;
            lanes[3][l] = (uint32_t)product_0;
        }
    }
}

/* Through a signed integer, since that conversion is one instruction on every machine. */
static double uniform_of_words(uint32_t low, uint32_t high) {
    return (double)(int64_t)philox_digits(low, high) * UNIFORM_STEP;
}

/* The first num_blocks of them are kept. */
static void fill_lanes(ps_random *random, double *out, uint32_t num_blocks) {
    uint32_t lanes[PHILOX_WORDS][NUM_LANES];
    make_blocks(random, lanes);
    advance(random, num_blocks);
    for (uint32_t l = 0; l < num_blocks; l++) {
        out[2 * l] = uniform_of_words(lanes[0][l], lanes[1][l]);
        out[2 * l + 1] = uniform_of_words(lanes[2][l], lanes[3][l]);
    }
}

void ps_random_fill_uniform(ps_random *random, double *out, size_t count) {
    enum { CHUNK = UNIFORMS_PER_BLOCK * NUM_LANES };
    size_t i = 0;
    /* A block begun is finished first. Begun by an odd number of words it never is: all scalar. */
    for (; i < count && random->num_used != PHILOX_WORDS; i++) {
        out[i] = ps_random_uniform(random);
    }
    for (; count - i >= CHUNK; i += CHUNK) {
        fill_lanes(random, out + i, NUM_LANES);
    }
    if (count - i >= LEAST_OF_CHUNK) {
        const uint32_t num_blocks = (uint32_t)(count - i) / UNIFORMS_PER_BLOCK;
        fill_lanes(random, out + i, num_blocks);
        i += (size_t)num_blocks * UNIFORMS_PER_BLOCK;
    }
    for (; i < count; i++) {
        out[i] = ps_random_uniform(random);
    }
}

void ps_random_block(const ps_random *random, uint64_t block, uint32_t out[4]) {
    const uint32_t stream = random->counter[1] >> PHILOX_STREAM_SHIFT;
    const uint32_t counter[4] = {(uint32_t)block,
                                 stream << PHILOX_STREAM_SHIFT | (uint32_t)(block >> 32),
                                 random->counter[2], random->counter[3]};
    ps_philox_4x32_10(counter, random->key, out);
}
