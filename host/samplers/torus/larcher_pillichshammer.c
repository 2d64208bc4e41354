/* Larcher-Pillichshammer: (j/N, y) with N = 2^m and direction numbers v -> v | (v >> 1), that is,
 * the upper triangular matrix of ones (G. Larcher, F. Pillichshammer 2001/2003). A (0,m,2)-net with
 * a lower star discrepancy than Hammersley's. */
#include "samplers/list.h"

#include "samplers/torus/digital_net.h"
#include "samplers/values.h"

enum { CENTRED = 1 };
enum {
    MAXIMUM_LOG_POINTS = PS_NET_DIGITS - 1 /* one digit stays free, for the centre of the cell */
};
static const char *const ANSWERS[] = {"no", "yes", NULL};

static bool is_power_of_2(size_t number) {
    return (number & (number - 1)) == 0;
}

static unsigned log2_points(const ps_sampler_request *request) {
    unsigned m = 0;
    while ((request->num_points >> m) > 1) {
        m++;
    }
    return m;
}

static pspec_status build_net(const ps_sampler_request *request, ps_digital_net *net,
                              ps_error *error) {
    const unsigned m = log2_points(request);
    unsigned is_centred = 0;
    uint32_t reversed[PS_NET_DIGITS] = {0};
    uint32_t ones[PS_NET_DIGITS] = {0};
    PS_TRY(ps_sampler_choice(request, CENTRED, ANSWERS, &is_centred, error));
    for (unsigned b = 0; b < m; b++) {
        reversed[b] = (uint32_t)1 << (PS_NET_DIGITS - m + b); /* j/N: digits in their own order */
        ones[b] = UINT32_MAX << (PS_NET_DIGITS - 1 - b);
    }
    ps_digital_net_set_axis(net, 0, reversed);
    ps_digital_net_set_axis(net, 1, ones);
    for (unsigned i = 0; i < net->dimension; i++) {
        /* No direction number has the digit of 1/(2N), so this adds it to every point. */
        net->origin[i] = is_centred == 1 ? (uint32_t)1 << (PS_NET_DIGITS - 1 - m) : 0;
    }
    return PSPEC_OK;
}

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    unsigned answer = 0;
    PS_TRY(ps_digital_net_check(request, error));
    PS_TRY(ps_sampler_choice(request, CENTRED, ANSWERS, &answer, error));
    PS_TRY(ps_sampler_limit_points(request, (uint64_t)1 << MAXIMUM_LOG_POINTS, error));
    if (!is_power_of_2(request->num_points)) {
        const size_t below = (size_t)1 << log2_points(request);
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "sampler %s: %zu points are not a power of 2; use %zu or %zu",
                       request->sampler->name, request->num_points, below, 2 * below);
    }
    return PSPEC_OK;
}

const ps_sampler ps_sampler_larcher_pillichshammer = {
    .name = "larcher-pillichshammer",
    .summary = "plane net of low discrepancy, N a power of 2",
    .aliases = {"lp", "larcher"},
    .minimum_dimension = 2,
    .maximum_dimension = 2,
    .parameters = {PS_NET_SCRAMBLE_PARAMETER,
                   {"centred", "no", "no|yes, add 1/(2N) to both coordinates before scrambling"}},
    .check = check,
    .build_net = build_net,
    PS_NET_MEMBERS,
};
