#include "samplers/torus/digital_net.h"

#include "samplers/digital_net.h"
#include "samplers/pace.h"
#include "samplers/values.h"

#include <string.h>

static const double COORDINATE_STEP = 0x1p-53;
static const char *const SCRAMBLES[] = {"none", "xor", "owen", "hash", NULL};

static pspec_status scramble_of(const ps_sampler_request *request, ps_net_scramble *scramble,
                                ps_error *error) {
    unsigned choice = 0;
    PS_TRY(ps_sampler_choice(request, 0, SCRAMBLES, &choice, error));
    *scramble = (ps_net_scramble)choice; /* SCRAMBLES is in the order of the enumeration */
    return PSPEC_OK;
}

pspec_status ps_digital_net_check(const ps_sampler_request *request, ps_error *error) {
    ps_net_scramble scramble = PS_NET_PLAIN;
    return scramble_of(request, &scramble, error);
}

bool ps_digital_net_is_plain(const ps_sampler_request *request) {
    ps_net_scramble scramble = PS_NET_PLAIN;
    return scramble_of(request, &scramble, NULL) == PSPEC_OK && scramble == PS_NET_PLAIN;
}

double ps_digital_net_seconds(const ps_sampler_request *request) {
    static const double nanoseconds[] = {
        [PS_NET_PLAIN] = 1.7, [PS_NET_XOR] = 1.7, [PS_NET_OWEN] = 160, [PS_NET_HASH] = 5};
    /* of a coordinate */
    ps_net_scramble scramble = PS_NET_PLAIN;
    return scramble_of(request, &scramble, NULL) == PSPEC_OK
               ? ps_sampler_numbers(request) * nanoseconds[scramble] * PS_NANOSECOND
               : 0;
}

static pspec_status make(const ps_sampler_request *request, ps_digital_net *net,
                         ps_net_scramble *scramble, ps_error *error) {
    *net = (ps_digital_net){.dimension = request->dimension};
    PS_TRY(scramble_of(request, scramble, error));
    return request->sampler->build_net(request, net, error);
}

void ps_digital_net_set_axis(ps_digital_net *net, unsigned axis,
                             const uint32_t directions[PS_NET_DIGITS]) {
    uint32_t sum = 0;
    for (unsigned b = 0; b < PS_NET_DIGITS; b++) {
        sum ^= directions[b];
        net->steps[axis][b] = sum;
    }
}

/* One word per axis; zero without scrambling. */
static void draw_shifts(ps_net_scramble scramble, const ps_random *stream,
                        uint64_t shifts[PS_MAX_DIMENSION]) {
    ps_random random = *stream;
    for (unsigned i = 0; i < PS_MAX_DIMENSION; i++) {
        shifts[i] = net_is_shifted((uint32_t)scramble) ? ps_random_u53(&random) : 0;
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

pspec_status ps_digital_net_generate(const ps_sampler_request *request, uint64_t realization,
                                     double *points, ps_error *error) {
    ps_net_scramble scramble = PS_NET_PLAIN;
    ps_digital_net net;
    PS_TRY(make(request, &net, &scramble, error));
    const ps_random stream = ps_random_init(request->seed, PS_STREAM_SCRAMBLE, realization);
    const philox_stream blocks = {request->seed, realization, PS_STREAM_SCRAMBLE};
    uint64_t shifts[PS_MAX_DIMENSION];
    uint32_t words[PS_MAX_DIMENSION];
    draw_shifts(scramble, &stream, shifts);
    for (unsigned i = 0; i < net.dimension; i++) {
        words[i] = net.origin[i];
    }
    for (size_t j = 0; j < request->num_points; j++) {
        PS_TRY(ps_sampler_go_on(request, PS_PACE_POINTS_MADE, j, error));
        if (j > 0) {
            step(&net, j, words);
        }
        for (unsigned i = 0; i < net.dimension; i++) {
            const uint64_t digits = net_digits(scramble, blocks, i, words[i], shifts[i]);
            *points++ = (double)(int64_t)digits * COORDINATE_STEP;
        }
    }
    return PSPEC_OK;
}

pspec_status ps_digital_net_fill(const ps_sampler_request *request, ps_sampler_places *out,
                                 ps_error *error) {
    ps_net_scramble scramble = PS_NET_PLAIN;
    ps_digital_net net;
    PS_TRY(make(request, &net, &scramble, error));
    out->numbers.scramble = scramble;
    for (unsigned i = 0; i < net.dimension; i++) {
        out->numbers.origin[i] = net.origin[i];
        memcpy(out->table[i], net.steps[i], sizeof out->table[i]);
    }
    return PSPEC_OK;
}
