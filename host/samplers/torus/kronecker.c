/* Kronecker sequences: x_j = 1/2 + j alpha mod 1, in whole multiples of 2^-64. By default alpha_i =
 * g^-i, g the root above 1 of g^(d+1) = g + 1: the golden ratio in one dimension, the plastic
 * number in the plane, where this is R2 (M. Roberts 2018). */
#include "samplers/list.h"

#include "base/text.h"
#include "samplers/pace.h"
#include "samplers/values.h"

#include <string.h>

enum { ALPHA };
#define GOLDEN "golden"

/* g^-1, g^-2, .. times 2^64 of 1 to 6 dimensions, from 60 decimal digits of g. */
static const uint64_t golden[PS_MAX_DIMENSION][PS_MAX_DIMENSION] = {
    {UINT64_C(0x9e3779b97f4a7c16)},
    {UINT64_C(0xc13fa9a902a6328f), UINT64_C(0x91e10da5c79e7b1d)},
    {UINT64_C(0xd1b54a32d192ed04), UINT64_C(0xabc98388fb8fac03), UINT64_C(0x8cb92ba72f3d8dd7)},
    {UINT64_C(0xdb4f0b9175ae2165), UINT64_C(0xbbe0563303a4615f), UINT64_C(0xa0f2ec75a1fe1576),
     UINT64_C(0x89e182857d9ed689)},
    {UINT64_C(0xe19b01aa9d42c633), UINT64_C(0xc6d1d6c8ed0c9632), UINT64_C(0xaf36d01ef7518dbc),
     UINT64_C(0x9a69443f36f710e7), UINT64_C(0x881403b9339bd42e)},
    {UINT64_C(0xe60e2b722b53aeec), UINT64_C(0xcebd76d9edb6a8ef), UINT64_C(0xb9c9aa3a51d00b65),
     UINT64_C(0xa6f5777f6f889840), UINT64_C(0x9609c71eb7d03f7a), UINT64_C(0x86d516e50b04ab1b)},
};

static pspec_status fail_alpha(const ps_sampler_request *request, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "sampler kronecker: alpha=%s is not %u numbers between 0 and 1 joined by x, as "
                   "in 0.414x0.732",
                   request->values[ALPHA], request->dimension);
}

static pspec_status find_alpha(const ps_sampler_request *request, uint64_t alpha[PS_MAX_DIMENSION],
                               ps_error *error) {
    enum { ROOM = 32 }; /* a double has 24 characters */
    const double two_to_64 = 0x1p64;
    const char *text = request->values[ALPHA];
    memcpy(alpha, golden[request->dimension - 1], sizeof golden[0]);
    if (strcmp(text, GOLDEN) == 0) {
        return PSPEC_OK;
    }
    for (unsigned i = 0; i < request->dimension; i++) {
        char number[ROOM] = "";
        const size_t length = strcspn(text, "x");
        const char follows = i + 1 < request->dimension ? 'x' : '\0';
        double value = 0;
        memcpy(number, text, length < ROOM ? length : 0);
        if (ps_parse_number(number, "", 0, 1, &value, NULL) != PSPEC_OK || value == 0 ||
            value == 1 || text[length] != follows) {
            return fail_alpha(request, error);
        }
        alpha[i] = (uint64_t)(value * two_to_64);
        text += length + 1;
    }
    return PSPEC_OK;
}

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    uint64_t alpha[PS_MAX_DIMENSION];
    return find_alpha(request, alpha, error);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    enum { DROPPED = 64 - 53 }; /* digits that a double has not */
    uint64_t alpha[PS_MAX_DIMENSION];
    (void)realization;
    PS_TRY(find_alpha(request, alpha, error));
    for (uint64_t j = 0; j < request->num_points; j++) {
        PS_TRY(ps_sampler_go_on(request, PS_PACE_POINTS_MADE, j, error));
        for (unsigned i = 0; i < request->dimension; i++) {
            const uint64_t place = (UINT64_C(1) << 63) + j * alpha[i];
            points[j * request->dimension + i] = (double)(place >> DROPPED) * 0x1p-53;
        }
    }
    return PSPEC_OK;
}

const ps_sampler ps_sampler_kronecker = {
    .name = "kronecker",
    .summary = "1/2 + j alpha mod 1; R2 in the plane",
    .aliases = {"r2", "rd"},
    .minimum_dimension = 1,
    .maximum_dimension = PS_MAX_DIMENSION,
    .parameters = {{"alpha", GOLDEN,
                    "AxB.., steps between 0 and 1; golden: powers of the root of g^(d+1) = g + 1"}},
    .nanoseconds = 2,
    .is_deterministic = ps_sampler_always,
    .check = check,
    .generate = generate,
};
