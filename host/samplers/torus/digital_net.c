#include "samplers/torus/digital_net.h"

#include "samplers/pace.h"
#include "samplers/values.h"

enum {
    MANTISSA_DIGITS = 53,
    /* Owen's tree of flips is cut into chunks of 7 levels: the 127 flips of a chunk are bits
     * 1..127 of one Philox block, so 5 blocks hold a coordinate's whole path and no hash weaker
     * than the generator is needed. */
    CHUNK_LEVELS = 7,
    NUM_CHUNKS = 5,
    TREE_LEVELS = NUM_CHUNKS * CHUNK_LEVELS, /* 35, 3 more than the net has digits */
    PADDING = TREE_LEVELS - PS_NET_DIGITS,
    TAIL_DIGITS =
        MANTISSA_DIGITS - TREE_LEVELS, /* below the tree: 18 bits for each of its leaves */
    WORD_BITS = 32,
    /* Owen's block index: prefix or word in the low 32 bits, chunk in 3 above, axis above that. */
    CHUNK_SHIFT = 32,
    AXIS_SHIFT = 35
};

static const double COORDINATE_STEP = 0x1p-53;
static const char *const SCRAMBLES[] = {"none", "xor", "owen", NULL};

pspec_status ps_digital_net_scramble(const ps_sampler_request *request, unsigned i_parameter,
                                     ps_net_scramble *scramble, ps_error *error) {
    unsigned choice = 0;
    PS_TRY(ps_sampler_choice(request, i_parameter, SCRAMBLES, &choice, error));
    *scramble = (ps_net_scramble)choice; /* SCRAMBLES is in the order of the enumeration */
    return PSPEC_OK;
}

bool ps_digital_net_is_plain(const ps_sampler_request *request, unsigned i_parameter) {
    ps_net_scramble scramble = PS_NET_PLAIN;
    return ps_digital_net_scramble(request, i_parameter, &scramble, NULL) == PSPEC_OK &&
           scramble == PS_NET_PLAIN;
}

double ps_digital_net_seconds(const ps_sampler_request *request, unsigned i_parameter) {
    static const double nanoseconds[] = {
        [PS_NET_PLAIN] = 1.7, [PS_NET_XOR] = 1.7, [PS_NET_OWEN] = 160}; /* of a coordinate */
    ps_net_scramble scramble = PS_NET_PLAIN;
    return ps_digital_net_scramble(request, i_parameter, &scramble, NULL) == PSPEC_OK
               ? ps_sampler_numbers(request) * nanoseconds[scramble] * PS_NANOSECOND
               : 0;
}

void ps_digital_net_set_axis(ps_digital_net *net, unsigned axis,
                             const uint32_t directions[PS_NET_DIGITS]) {
    uint32_t sum = 0;
    for (unsigned b = 0; b < PS_NET_DIGITS; b++) {
        sum ^= directions[b];
        net->steps[axis][b] = sum;
    }
}

/* Flips of the 7 digits of one chunk. A node of its binary tree is a 1 followed by the digits above
 * it, a number in 1..127. */
static uint32_t chunk_flips(const uint32_t bits[4], uint32_t digits) {
    uint32_t flips = 0;
    for (unsigned level = 0; level < CHUNK_LEVELS; level++) {
        const uint32_t node = (1u << level) | digits >> (CHUNK_LEVELS - level);
        flips = flips << 1 | (bits[node / WORD_BITS] >> node % WORD_BITS & 1u);
    }
    return flips;
}

/* word -> 53 digits. The digits above a chunk name its block, those within it the bits thereof. */
static uint64_t scramble_owen(const ps_random *random, unsigned axis, uint32_t word) {
    const uint64_t digits = (uint64_t)word << PADDING;
    const uint64_t axis_blocks = (uint64_t)axis << AXIS_SHIFT;
    uint64_t flips = 0;
    uint32_t bits[4];
    for (unsigned chunk = 0; chunk < NUM_CHUNKS; chunk++) {
        const unsigned below = TREE_LEVELS - CHUNK_LEVELS * (chunk + 1);
        const uint64_t prefix = digits >> (below + CHUNK_LEVELS);
        const uint32_t own = (uint32_t)(digits >> below) & ((1u << CHUNK_LEVELS) - 1);
        ps_random_block(random, axis_blocks | (uint64_t)chunk << CHUNK_SHIFT | prefix, bits);
        flips = flips << CHUNK_LEVELS | chunk_flips(bits, own);
    }
    ps_random_block(random, axis_blocks | (uint64_t)NUM_CHUNKS << CHUNK_SHIFT | word, bits);
    return (digits ^ flips) << TAIL_DIGITS | bits[0] >> (WORD_BITS - TAIL_DIGITS);
}

/* One word per axis; zero without scrambling. */
static void draw_shifts(ps_net_scramble scramble, const ps_random *stream,
                        uint64_t shifts[PS_MAX_DIMENSION]) {
    ps_random random = *stream;
    for (unsigned i = 0; i < PS_MAX_DIMENSION; i++) {
        shifts[i] = scramble == PS_NET_XOR ? ps_random_u53(&random) : 0;
    }
}

/* words: point j - 1 becomes point j. */
static void step(const ps_digital_net *net, uint64_t j, uint32_t words[PS_MAX_DIMENSION]) {
    unsigned num_zeros = 0;
    while ((j >> num_zeros & 1) == 0) {
        num_zeros++;
    }
    for (unsigned i = 0; i < net->dimension; i++) {
        words[i] ^= net->steps[i][num_zeros];
    }
}

pspec_status ps_digital_net_generate(const ps_digital_net *net, ps_net_scramble scramble,
                                     const ps_sampler_request *request, uint64_t realization,
                                     double *points, ps_error *error) {
    const ps_random stream = ps_random_init(request->seed, PS_STREAM_SCRAMBLE, realization);
    uint64_t shifts[PS_MAX_DIMENSION];
    uint32_t words[PS_MAX_DIMENSION];
    draw_shifts(scramble, &stream, shifts);
    for (unsigned i = 0; i < net->dimension; i++) {
        words[i] = net->origin[i];
    }
    for (size_t j = 0; j < request->num_points; j++) {
        PS_TRY(ps_sampler_go_on(request, PS_PACE_POINTS_MADE, j, error));
        if (j > 0) {
            step(net, j, words);
        }
        for (unsigned i = 0; i < net->dimension; i++) {
            const uint64_t digits =
                scramble == PS_NET_OWEN
                    ? scramble_owen(&stream, i, words[i])
                    : ((uint64_t)words[i] << (MANTISSA_DIGITS - PS_NET_DIGITS) ^ shifts[i]);
            *points++ = (double)(int64_t)digits * COORDINATE_STEP;
        }
    }
    return PSPEC_OK;
}
