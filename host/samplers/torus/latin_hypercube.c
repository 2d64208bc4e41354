/* Latin hypercube (N-rooks): x_ji = (pi_i(j) + xi)/N with independent uniform permutations pi_i, so
 * that every axis has one point in each of N strata. Spectrum:
 * docs/mathematics/samplers.md#spectra-on-the-torus. */
#include "samplers/list.h"

#include "samplers/pace.h"
#include "samplers/torus/strata.h"
#include "samplers/values.h"

#include <string.h>

enum { OFFSET };
static const char *const OFFSETS[] = {"jittered", "centred", NULL};
enum { OFFSET_JITTERED, OFFSET_CENTRED };
static const double CENTRE = 0.5;

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    unsigned offset = 0;
    return ps_sampler_choice(request, OFFSET, OFFSETS, &offset, error);
}

/* Fisher-Yates on one column, in place: a whole number below 2^53 is exact as a double, so that no
 * second array is needed. */
static pspec_status permute_axis(const ps_sampler_request *request, ps_random *random,
                                 double *column, ps_error *error) {
    const size_t num_points = request->num_points;
    const size_t stride = request->dimension;
    for (size_t j = 0; j < num_points; j++) {
        PS_TRY(ps_sampler_go_on(request, "sampler: strata of an axis", j, error));
        column[j * stride] = (double)j;
    }
    for (size_t j = num_points; j > 1; j--) {
        PS_TRY(ps_sampler_go_on(request, "sampler: strata in random order", num_points - j, error));
        const size_t other = (size_t)ps_random_below(random, j) * stride;
        const size_t last = (j - 1) * stride;
        const double kept = column[other];
        column[other] = column[last];
        column[last] = kept;
    }
    return PSPEC_OK;
}

/* At random within the strata, or in their centres where random is NULL. */
static pspec_status place(const ps_sampler_request *request, ps_random *random, double *points,
                          ps_error *error) {
    enum { CHUNK = 256 }; /* points at a time: a whole number of Philox blocks, and of pieces */
    const double num_strata = (double)request->num_points;
    double xi[CHUNK * PS_MAX_DIMENSION];
    for (size_t i = 0; i < sizeof xi / sizeof xi[0]; i++) {
        xi[i] = CENTRE;
    }
    for (size_t first = 0; first < request->num_points; first += CHUNK) {
        const size_t left = request->num_points - first;
        const size_t num = (left < CHUNK ? left : CHUNK) * request->dimension;
        double *const some = points + first * request->dimension;
        PS_TRY(ps_sampler_go_on(request, "sampler: points in strata", first, error));
        if (random != NULL) {
            ps_random_fill_uniform(random, xi, num);
        }
        for (size_t i = 0; i < num; i++) {
            some[i] = ps_stratum_point(some[i], xi[i], num_strata);
        }
    }
    return PSPEC_OK;
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    unsigned offset = 0;
    PS_TRY(ps_sampler_choice(request, OFFSET, OFFSETS, &offset, error));
    ps_random order = ps_random_init(request->seed, PS_STREAM_PERMUTATION, realization);
    ps_random jitter = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    for (unsigned i = 0; i < request->dimension; i++) {
        PS_TRY(permute_axis(request, &order, points + i, error));
    }
    return place(request, offset == OFFSET_CENTRED ? NULL : &jitter, points, error);
}

/* 1 + 1/(N - 1) where cells are jittered; centred points have N where N divides every k. */
static double most_power(const ps_sampler_request *request) {
    const double num = (double)request->num_points;
    const bool is_jittered = strcmp(request->values[0], "jittered") == 0;
    if (request->lift != PS_SAMPLES_TORUS || num < 2) {
        return 0;
    }
    return is_jittered ? num / (num - 1) : num;
}

const ps_sampler ps_sampler_latin_hypercube = {
    .name = "latin-hypercube",
    .summary = "one point in each of N strata of every axis",
    .aliases = {"lhs", "nrooks", "n-rooks"},
    .minimum_dimension = 1,
    .maximum_dimension = PS_MAX_DIMENSION,
    .parameters = {{"offset", "jittered", "jittered|centred, place within the stratum"}},
    .nanoseconds = 11.5,
    .is_deterministic = ps_sampler_never,
    .most_power = most_power,
    .check = check,
    .generate = generate,
};
