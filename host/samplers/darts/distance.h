/* Requests of samplers that keep a least distance: what their parameters radius=, exact= and tries=
 * say, how many points there will be, and sets of an exact number.
 */
#ifndef PS_SAMPLERS_DARTS_DISTANCE_H
#define PS_SAMPLERS_DARTS_DISTANCE_H

#include "samplers/darts/blue_noise.h"
#include "samplers/sampler.h"

/* What such a sampler is besides its row. asked has the dimension and the tries. */
typedef struct ps_distance_kind {
    /* The radius at which num_points are made in the mean, and the mean at asked's radius. */
    double (*radius)(const ps_blue_noise *asked, size_t num_points);
    double (*expected)(const ps_blue_noise *asked);
    size_t (*most_points)(const ps_blue_noise *asked);
    double (*nanoseconds)(const ps_blue_noise *asked); /* of a point, plan/host_cost.c's machine */
    pspec_status (*check)(const ps_blue_noise *asked, ps_error *error);
    pspec_status (*make)(const ps_blue_noise *asked, ps_random *random, double *points,
                         size_t *num_points, ps_error *error);
} ps_distance_kind;

/* The parameters in their order; tries= is Bridson's alone. */
#define PS_DISTANCE_RADIUS                                                                         \
    { "radius", "auto", "least distance, on the sphere an angle; auto: from N" }
#define PS_DISTANCE_EXACT                                                                          \
    { "exact", "no", "no|yes, sets are made anew until one has N points" }
#define PS_DISTANCE_TRIES                                                                          \
    { "tries", "30", "2 to 1000 around a point before it is left" }

/* What members of the rows (samplers/sampler.h) do for a kind. */
bool ps_distance_varies(const ps_sampler_request *request);
size_t ps_distance_most_points(const ps_distance_kind *kind, const ps_sampler_request *request);
double ps_distance_seconds(const ps_distance_kind *kind, const ps_sampler_request *request);
pspec_status ps_distance_open_points(const ps_distance_kind *kind,
                                     const ps_sampler_request *request, size_t *num_points,
                                     ps_error *error) PS_MUST_CHECK;
pspec_status ps_distance_check(const ps_distance_kind *kind, const ps_sampler_request *request,
                               ps_error *error) PS_MUST_CHECK;
pspec_status ps_distance_generate(const ps_distance_kind *kind, const ps_sampler_request *request,
                                  uint64_t realization, double *points, size_t *num_points,
                                  ps_error *error) PS_MUST_CHECK;

/* These members for the file's kind, and their place in its row. */
#define PS_DISTANCE_FUNCTIONS(kind)                                                                \
    static size_t row_most_points(const ps_sampler_request *request) {                             \
        return ps_distance_most_points(&(kind), request);                                          \
    }                                                                                              \
    static double row_seconds(const ps_sampler_request *request) {                                 \
        return ps_distance_seconds(&(kind), request);                                              \
    }                                                                                              \
    static pspec_status row_open_points(const ps_sampler_request *request, size_t *num_points,     \
                                        ps_error *error) {                                         \
        return ps_distance_open_points(&(kind), request, num_points, error);                       \
    }                                                                                              \
    static pspec_status row_check(const ps_sampler_request *request, ps_error *error) {            \
        return ps_distance_check(&(kind), request, error);                                         \
    }                                                                                              \
    static pspec_status row_generate(const ps_sampler_request *request, uint64_t realization,      \
                                     double *points, size_t *num_points, ps_error *error) {        \
        return ps_distance_generate(&(kind), request, realization, points, num_points, error);     \
    }

#define PS_DISTANCE_MEMBERS                                                                        \
    .varies = ps_distance_varies, .most_points = row_most_points, .seconds = row_seconds,          \
    .is_deterministic = ps_sampler_never, .open_points = row_open_points, .check = row_check,      \
    .generate_some = row_generate

#endif
