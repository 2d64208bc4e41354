#include "samplers/darts/distance.h"

#include "base/memory.h"
#include "base/text.h"
#include "samplers/values.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RADIUS, EXACT, TRIES }; /* parameters in their order */

/* Sets that are tried for an exact number, in units of sqrt(N). The number has a spread of 0.24
 * sqrt(N) and hits its mean once in 0.6 sqrt(N) sets, so that one request in 5e8 ends without. */
static const double SETS_PER_ROOT = 12;
static const double SETS_PER_HIT = 0.6;
static const double LEAST_SETS = 100;

/* Eight times the spread of N, in units of sqrt(N), and two points, which small sets go beyond it:
 * what is farther from the mean never comes. */
static const double MOST_AWAY_PER_ROOT = 2;
static const double MOST_AWAY = 2;

/* ---- while it works ------------------------------------------------------------------------ */

pspec_status ps_blue_noise_tell(const ps_blue_noise *asked, size_t num_points, double expected,
                                ps_error *error) {
    const uint64_t total = (uint64_t)expected;
    const uint64_t done = num_points < total ? num_points : total;
    return ps_watch_tell(asked->watch, "sampler: points", done, total, NULL, error);
}

pspec_status ps_blue_noise_fail_room(const ps_blue_noise *asked, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_MEMORY,
                   "radius %g: there is room for %zu points, and more are at this distance",
                   asked->radius, asked->most_points);
}

/* ---- parameters ---------------------------------------------------------------------------- */

static bool has_radius(const ps_sampler_request *request) {
    return strcmp(request->values[RADIUS], "auto") != 0;
}

static bool is_exact(const ps_sampler_request *request) {
    return strcmp(request->values[EXACT], "yes") == 0;
}

/* Everything but a radius that hangs on N. */
static pspec_status read_values(const ps_sampler_request *request, ps_blue_noise *asked,
                                ps_error *error) {
    static const char *const choices[] = {"no", "yes", NULL};
    const char *const name = request->sampler->name;
    uint64_t tries = 0;
    unsigned choice = 0;
    char what[PS_MAX_SAMPLER_VALUE];
    *asked = (ps_blue_noise){.dimension = request->dimension, .watch = request->watch};
    if (request->sampler->parameters[TRIES].key != NULL) {
        snprintf(what, sizeof what, "sampler %s: tries", name);
        PS_TRY(ps_parse_count(request->values[TRIES], what, 1, UINT32_MAX, &tries, error));
        asked->tries = (unsigned)tries;
    }
    if (has_radius(request)) {
        snprintf(what, sizeof what, "sampler %s: radius", name);
        PS_TRY(ps_parse_number(request->values[RADIUS], what, -HUGE_VAL, HUGE_VAL, &asked->radius,
                               error));
        PS_TRY(request->sampler->distance->check(asked, error));
    }
    return ps_sampler_choice(request, EXACT, choices, &choice, error);
}

static pspec_status read_request(const ps_sampler_request *request, ps_blue_noise *asked,
                                 ps_error *error) {
    PS_TRY(read_values(request, asked, error));
    if (!has_radius(request)) {
        const double any = 0.1; /* for tries that are checked before they make a radius */
        asked->radius = any;
        PS_TRY(request->sampler->distance->check(asked, error));
        asked->radius = request->sampler->distance->radius(asked, request->num_points);
        PS_TRY(request->sampler->distance->check(asked, error));
    }
    asked->most_points = request->sampler->distance->most_points(asked);
    return PSPEC_OK;
}

static size_t mean_number(const ps_sampler_request *request, const ps_blue_noise *asked) {
    const double mean = floor(request->sampler->distance->expected(asked) + 0.5);
    const double least = request->sampler->minimum_points > 1 ? 2 : 1;
    return (size_t)(mean > least ? mean : least);
}

pspec_status ps_distance_open_points(const ps_sampler_request *request, size_t *num_points,
                                     ps_error *error) {
    const ps_sampler *const sampler = request->sampler;
    ps_blue_noise asked;
    if (sampler->domain == PS_SAMPLES_TORUS && (request->dimension < sampler->minimum_dimension ||
                                                request->dimension > sampler->maximum_dimension)) {
        return PSPEC_OK; /* refused next */
    }
    PS_TRY(read_values(request, &asked, error));
    if (has_radius(request)) {
        *num_points = mean_number(request, &asked);
    }
    return PSPEC_OK;
}

pspec_status ps_distance_check(const ps_sampler_request *request, ps_error *error) {
    ps_blue_noise asked;
    PS_TRY(read_request(request, &asked, error));
    if (!has_radius(request)) {
        return PSPEC_OK;
    }
    const size_t mean = mean_number(request, &asked);
    const double away = fabs((double)mean - (double)request->num_points);
    const double most_away = MOST_AWAY + MOST_AWAY_PER_ROOT * sqrt((double)mean);
    return away <= (is_exact(request) ? most_away : 0)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "sampler %s: radius=%s makes about %zu points, but %zu were asked for; "
                         "leave one of the two away%s",
                         request->sampler->name, request->values[RADIUS], mean, request->num_points,
                         is_exact(request) ? ", for no set is so far from it"
                                           : ", or say exact=yes");
}

/* ---- what it takes ------------------------------------------------------------------------- */

bool ps_distance_varies(const ps_sampler_request *request) {
    return !is_exact(request);
}

/* Asked before the request is checked: what is refused then has no room of its own. */
size_t ps_distance_most_points(const ps_sampler_request *request) {
    ps_blue_noise asked;
    return is_exact(request) || read_request(request, &asked, NULL) != PSPEC_OK
               ? request->num_points
               : asked.most_points;
}

double ps_distance_seconds(const ps_sampler_request *request) {
    ps_blue_noise asked;
    if (read_request(request, &asked, NULL) != PSPEC_OK) {
        return 0; /* refused */
    }
    const double num = (double)request->num_points;
    const double sets = is_exact(request) ? 1 + SETS_PER_HIT * sqrt(num) : 1;
    return sets * num * request->sampler->distance->nanoseconds(&asked) * PS_NANOSECOND;
}

/* ---- points -------------------------------------------------------------------------------- */

/* Sets at one radius, each with the random numbers after those of the last, until one has N
 * points: sets of N points among all, where a point more or less would change the power. */
static pspec_status repeat(const ps_sampler_request *request, const ps_blue_noise *asked,
                           ps_random *random, double *points, ps_error *error) {
    const double most = LEAST_SETS + SETS_PER_ROOT * sqrt((double)request->num_points);
    double sum = 0;
    double sets = 0;
    for (; sets < most; sets++) {
        size_t num = 0;
        PS_TRY(request->sampler->distance->make(asked, random, points, &num, error));
        if (num == request->num_points) {
            return PSPEC_OK;
        }
        sum += (double)num;
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "sampler %s: none of %.0f sets at the radius %g has %zu points, as exact=yes "
                   "wants; they have %.1f in the mean",
                   request->sampler->name, sets, asked->radius, request->num_points, sum / sets);
}

static pspec_status generate_exactly(const ps_sampler_request *request, const ps_blue_noise *asked,
                                     ps_random *random, double *points, ps_error *error) {
    double *room = NULL;
    size_t count = 0;
    if (!ps_size_multiply(asked->most_points, request->dimension, &count)) {
        count = SIZE_MAX; /* refused in the same words as other sizes */
    }
    PS_TRY(PS_NEW(&room, count, "points", error));
    const pspec_status status = repeat(request, asked, random, room, error);
    if (status == PSPEC_OK) {
        memcpy(points, room, request->num_points * request->dimension * sizeof *points);
    }
    free(room);
    return status;
}

pspec_status ps_distance_generate(const ps_sampler_request *request, uint64_t realization,
                                  double *points, size_t *num_points, ps_error *error) {
    ps_blue_noise asked;
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    PS_TRY(read_request(request, &asked, error));
    if (is_exact(request)) {
        *num_points = request->num_points;
        return generate_exactly(request, &asked, &random, points, error);
    }
    return request->sampler->distance->make(&asked, &random, points, num_points, error);
}
