/* Sobol' sequence. Axis 0 is the bit reversal of the index, axis 1 has direction numbers
 * v -> v ^ (v >> 1), so that the plane needs no table and its first 2^m points are a (0,m,2)-net.
 * Axes 2..5: S. Joe and F. Y. Kuo, "Constructing Sobol' sequences with better two-dimensional
 * projections", SIAM J. Sci. Comput. 30 (2008), set new-joe-kuo-6, dimensions 3 to 6. Points come
 * in the order of the index, not of its Gray code. */
#include "samplers/list.h"

#include "samplers/torus/digital_net.h"
#include "samplers/values.h"

enum { MAXIMUM_DEGREE = 4, NUM_POLYNOMIALS = PS_MAX_DIMENSION - 1 };

/* A primitive polynomial x^degree + a_1 x^(degree-1) + .. + 1, inner coefficients a_1 (highest bit)
 * .. a_(degree-1), and the odd numbers m_1 .. m_degree that start the recurrence. */
typedef struct polynomial {
    unsigned degree;
    uint32_t inner;
    uint32_t m[MAXIMUM_DEGREE];
} polynomial;

/* Axis 1 + row. The first row gives the recurrence v ^ (v >> 1) of the file header. */
static const polynomial POLYNOMIALS[NUM_POLYNOMIALS] = {
    {1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}, {3, 2, {1, 1, 1}}, {4, 1, {1, 1, 3, 3}},
};

static void reversal_directions(uint32_t v[PS_NET_DIGITS]) {
    for (unsigned b = 0; b < PS_NET_DIGITS; b++) {
        v[b] = (uint32_t)1 << (PS_NET_DIGITS - 1 - b);
    }
}

/* v_b = v_(b-s) ^ (v_(b-s) >> s) ^ (the v_(b-i) with a_i = 1), equation (2) of the paper, aligned
 * to the leading digit. */
static void polynomial_directions(const polynomial *p, uint32_t v[PS_NET_DIGITS]) {
    for (unsigned b = 0; b < p->degree && b < MAXIMUM_DEGREE; b++) {
        v[b] = p->m[b] << (PS_NET_DIGITS - 1 - b);
    }
    for (unsigned b = p->degree; b < PS_NET_DIGITS; b++) {
        v[b] = v[b - p->degree] ^ v[b - p->degree] >> p->degree;
        for (unsigned i = 1; i < p->degree; i++) {
            if (p->inner >> (p->degree - 1 - i) & 1) {
                v[b] ^= v[b - i];
            }
        }
    }
}

static pspec_status build_net(const ps_sampler_request *request, ps_digital_net *net,
                              ps_error *error) {
    uint32_t directions[PS_NET_DIGITS];
    (void)request;
    (void)error;
    reversal_directions(directions);
    ps_digital_net_set_axis(net, 0, directions);
    for (unsigned i = 1; i < net->dimension; i++) {
        polynomial_directions(&POLYNOMIALS[i - 1], directions);
        ps_digital_net_set_axis(net, i, directions);
    }
    return PSPEC_OK;
}

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    PS_TRY(ps_sampler_limit_points(request, (uint64_t)1 << PS_NET_DIGITS, error));
    return ps_digital_net_check(request, error);
}

/* The first two dimensions are the same in every table of direction numbers, the others are not. */
static const char *note(const ps_sampler_request *request) {
    return request->dimension > 2 ? "direction numbers new-joe-kuo-6 (Joe and Kuo 2008)" : NULL;
}

const ps_sampler ps_sampler_sobol = {
    .name = "sobol",
    .summary = "Sobol' sequence; a net when N is a power of 2",
    .minimum_dimension = 1,
    .maximum_dimension = PS_MAX_DIMENSION,
    .parameters = {PS_NET_SCRAMBLE_PARAMETER},
    .note = note,
    .check = check,
    .build_net = build_net,
    PS_NET_MEMBERS,
};
