/* The points of a realization are made by pieces: between two of them whoever waits for the points
 * is told how many are done, and may stop the rest.
 */
#ifndef PS_SAMPLERS_PACE_H
#define PS_SAMPLERS_PACE_H

#include "math/random/random.h"
#include "samplers/sampler.h"

/* Points of a piece: 40 ms of the slowest, a Sobol' net of six dimensions scrambled by Owen's tree
 * (2.5 us a point, 2 shared cores of an EPYC with AVX2, 2026-11). A power of two, which keeps
 * pieces of random numbers whole blocks of the generator. */
enum { PS_PACE_POINTS = 1 << 14 };

/* What is counted while coordinates are made. */
#define PS_PACE_POINTS_MADE "sampler: points"

/* Told after every piece but the last: done of the request's points. PSPEC_ERROR_CANCELLED when the
 * watch asks to stop. */
static inline pspec_status ps_sampler_go_on(const ps_sampler_request *request, const char *phase,
                                            size_t done, ps_error *error) {
    return request->watch == NULL || done == 0 || done % PS_PACE_POINTS != 0
               ? PSPEC_OK
               : ps_watch_tell(request->watch, phase, done, request->num_points, NULL, error);
}

/* Work on points first .. end - 1, each by itself. */
typedef void ps_piece_task(const void *payload, size_t first, size_t end, double *points);

/* Does it for all points, piece by piece from the first. */
pspec_status ps_sampler_pieces(const ps_sampler_request *request, const char *phase,
                               ps_piece_task *task, const void *payload, double *points,
                               ps_error *error) PS_MUST_CHECK;

/* numbers[num_points][per_point], uniform: those of one call of ps_random_fill_uniform. */
pspec_status ps_sampler_fill_uniform(const ps_sampler_request *request, ps_random *random,
                                     unsigned per_point, double *numbers,
                                     ps_error *error) PS_MUST_CHECK;
/* numbers[num_points][per_point], each of them 1/2: the centre of a cell. */
pspec_status ps_sampler_fill_centres(const ps_sampler_request *request, unsigned per_point,
                                     double *numbers, ps_error *error) PS_MUST_CHECK;

/* ps_sphere_lift of all points. */
pspec_status ps_sampler_lift(const ps_sampler_request *request, bool on_hemisphere, double *points,
                             ps_error *error) PS_MUST_CHECK;

#endif
