/* Strata of height and azimuth: one uniform point in each of n_z x n_phi cells of equal area,
 * slices of equal height cut into equal sectors. The same points as
 * jittered:strata=AxB,lift=sphere, but for the automatic counts. In expectation P(l) is
 * docs/mathematics/samplers.md#spectra-on-the-sphere. */
#include "samplers/list.h"

#include "math/pi.h"
#include "samplers/pace.h"
#include "samplers/lifted.h"
#include "samplers/torus/strata.h"
#include "samplers/values.h"

#include <math.h>
#include <string.h>

enum { STRATA };
enum { HEIGHTS, AZIMUTHS, NUM_AXES };

/* At the equator a cell is 2/n_z high and 2 pi/n_phi wide: square when n_phi/n_z = pi. */
static const double SQUARE_RATIO = PS_PI;
static const double MAXIMUM_ASPECT = 2; /* as for jittered */

/* Side over side of a cell at the equator, at least 1. */
static double aspect(uint64_t num_heights, uint64_t num_azimuths) {
    const double ratio = (double)num_azimuths / ((double)num_heights * SQUARE_RATIO);
    return ratio < 1 ? 1 / ratio : ratio;
}

/* Counts n_z from *first to *last include all that make cells square enough: n_z^2 lies within a
 * factor MAXIMUM_ASPECT of N/pi. */
static void range_of_heights(uint64_t num_points, uint64_t *first, uint64_t *last) {
    const double square = sqrt((double)num_points / SQUARE_RATIO);
    *first = (uint64_t)(square / sqrt(MAXIMUM_ASPECT));
    *first = *first > 0 ? *first : 1;
    *last = (uint64_t)(square * sqrt(MAXIMUM_ASPECT)) + 1;
}

/* A single cell is the whole sphere and has no sides, so that 1 point is always admissible. */
static bool factorise(uint64_t num_points, uint64_t counts[PS_MAX_DIMENSION]) {
    uint64_t first = 0;
    uint64_t last = 0;
    double best = MAXIMUM_ASPECT;
    range_of_heights(num_points, &first, &last);
    counts[HEIGHTS] = num_points == 1;
    counts[AZIMUTHS] = num_points == 1;
    for (uint64_t n_z = first; n_z <= last; n_z++) {
        if (num_points % n_z == 0 && aspect(n_z, num_points / n_z) <= best) {
            best = aspect(n_z, num_points / n_z);
            counts[HEIGHTS] = n_z;
            counts[AZIMUTHS] = num_points / n_z;
        }
    }
    return counts[HEIGHTS] != 0;
}

/* The nearest admissible numbers are few steps away: each step tries the counts of one number. */
static pspec_status fail_aspect(const ps_sampler_request *request, ps_error *error) {
    uint64_t counts[PS_MAX_DIMENSION];
    uint64_t below = request->num_points - 1;
    uint64_t above = request->num_points + 1;
    while (!factorise(below, counts)) { /* ends at 1 */
        below--;
    }
    while (!factorise(above, counts)) {
        above++;
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "sampler %s: %zu points cannot be laid out in cells with sides in a ratio of at "
                   "most 2 at the equator; use %llu or %llu points, or give strata=",
                   request->sampler->name, request->num_points, (unsigned long long)below,
                   (unsigned long long)above);
}

static pspec_status resolve_strata(const ps_sampler_request *request,
                                   uint64_t counts[PS_MAX_DIMENSION], ps_error *error) {
    if (strcmp(request->values[STRATA], PS_STRATA_AUTO) != 0) {
        return ps_strata_read(request, STRATA, NUM_AXES, counts, error);
    }
    return factorise(request->num_points, counts) ? PSPEC_OK : fail_aspect(request, error);
}

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    uint64_t counts[PS_MAX_DIMENSION];
    return resolve_strata(request, counts, error);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    uint64_t counts[PS_MAX_DIMENSION];
    PS_TRY(resolve_strata(request, counts, error));
    ps_sampler_request plane = *request;
    plane.dimension = NUM_AXES;
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    PS_TRY(ps_sampler_fill_uniform(request, &random, NUM_AXES, points, error));
    PS_TRY(ps_strata_place(&plane, counts, points, error));
    return ps_sampler_lift(request, false, points, error);
}

static pspec_status fill(const ps_sampler_request *request, ps_sampler_places *out,
                         ps_error *error) {
    return resolve_strata(request, out->numbers.counts, error);
}

const ps_sampler ps_sampler_zphi = {
    .name = "zphi",
    .stands_beside = true,
    .summary = "one uniform point in each cell of equal height by equal azimuth",
    .aliases = {"z-phi"},
    .domain = PS_SAMPLES_SPHERE,
    .parameters = {{"strata", PS_STRATA_AUTO,
                    "AxB, slices of height x sectors; auto: square at the equator, B/A near pi"}},
    .nanoseconds = 16,
    .is_deterministic = ps_sampler_never,
    .most_power = ps_sampler_white_power,
    .check = check,
    .generate = generate,
    .by_index = {.name = "jittered", .fill = fill, .point = jittered_point},
};
