/* Latin hypercube (N-rooks): x_ji = (pi_i(j) + xi)/N with independent uniform permutations pi_i, so
 * that every axis has one point in each of N strata. Spectrum:
 * docs/mathematics/samplers.md#spectra-on-the-torus. */
#include "samplers/list.h"

#include "math/random/random.h"
#include "samplers/torus/strata.h"
#include "samplers/values.h"

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
static void permute_axis(ps_random *random, size_t num_points, unsigned stride, double *column) {
    for (size_t j = 0; j < num_points; j++) {
        column[j * stride] = (double)j;
    }
    for (size_t j = num_points; j > 1; j--) {
        const size_t other = (size_t)ps_random_below(random, j) * stride;
        const size_t last = (j - 1) * stride;
        const double kept = column[other];
        column[other] = column[last];
        column[last] = kept;
    }
}

static void add_jitter(ps_random *random, double num_strata, double *points, size_t count) {
    enum { CHUNK = 256 }; /* uniforms made at a time: 2 KB, and a whole number of Philox blocks */
    double xi[CHUNK];
    for (size_t begin = 0; begin < count; begin += CHUNK) {
        const size_t length = count - begin < CHUNK ? count - begin : CHUNK;
        ps_random_fill_uniform(random, xi, length);
        for (size_t i = 0; i < length; i++) {
            points[begin + i] = ps_stratum_point(points[begin + i], xi[i], num_strata);
        }
    }
}

static void centre(double num_strata, double *points, size_t count) {
    for (size_t i = 0; i < count; i++) {
        points[i] = ps_stratum_point(points[i], CENTRE, num_strata);
    }
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    unsigned offset = 0;
    PS_TRY(ps_sampler_choice(request, OFFSET, OFFSETS, &offset, error));
    ps_random order = ps_random_init(request->seed, PS_STREAM_PERMUTATION, realization);
    ps_random jitter = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    const size_t num_points = request->num_points;
    for (unsigned i = 0; i < request->dimension; i++) {
        permute_axis(&order, num_points, request->dimension, points + i);
    }
    if (offset == OFFSET_CENTRED) {
        centre((double)num_points, points, num_points * request->dimension);
    } else {
        add_jitter(&jitter, (double)num_points, points, num_points * request->dimension);
    }
    return PSPEC_OK;
}

const ps_sampler ps_sampler_latin_hypercube = {
    .name = "latin-hypercube",
    .summary = "one point in each of N strata of every axis",
    .aliases = {"lhs", "nrooks", "n-rooks"},
    .minimum_dimension = 1,
    .maximum_dimension = PS_MAX_DIMENSION,
    .parameters = {{"offset", "jittered", "jittered|centred, place within the stratum"}},
    .is_deterministic = ps_sampler_never,
    .check = check,
    .generate = generate,
};
