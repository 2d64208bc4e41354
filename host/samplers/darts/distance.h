/* Samplers that keep a least distance: what they are asked for, what their parameters radius=,
 * exact= and tries= say, how many points there will be, and sets of an exact number.
 */
#ifndef PS_SAMPLERS_DARTS_DISTANCE_H
#define PS_SAMPLERS_DARTS_DISTANCE_H

#include "math/random/random.h"
#include "samplers/sampler.h"

typedef struct ps_blue_noise {
    unsigned dimension;    /* of the torus; on the sphere points have three numbers */
    double radius;         /* points nearer than this are refused; on the sphere an angle */
    unsigned tries;        /* of Bridson's, around a point */
    size_t most_points;    /* room of the array of points */
    const ps_watch *watch; /* may be NULL */
} ps_blue_noise;

/* Tells the watch; more points than were expected are told as all of them. */
pspec_status ps_blue_noise_tell(const ps_blue_noise *asked, size_t num_points, double expected,
                                ps_error *error) PS_MUST_CHECK;
/* The room is full, which the bounds on numbers of points exclude. */
pspec_status ps_blue_noise_fail_room(const ps_blue_noise *asked, ps_error *error) PS_MUST_CHECK;

/* What such a sampler is besides its row. asked has the dimension and the tries. */
struct ps_distance_kind {
    /* The radius at which num_points are made in the mean, and the mean at asked's radius. */
    double (*radius)(const ps_blue_noise *asked, size_t num_points);
    double (*expected)(const ps_blue_noise *asked);
    /* More points than this are never at the radius from each other; SIZE_MAX for radii that are
     * refused. */
    size_t (*most_points)(const ps_blue_noise *asked);
    double (*nanoseconds)(const ps_blue_noise *asked); /* of a point, plan/phases.c's machine */
    /* Are radius and tries possible? */
    pspec_status (*check)(const ps_blue_noise *asked, ps_error *error);
    /* Points [*num_points][dimension] in the order of their acceptance. */
    pspec_status (*make)(const ps_blue_noise *asked, ps_random *random, double *points,
                         size_t *num_points, ps_error *error);
};
extern const ps_distance_kind ps_poisson_disk_kind, ps_bridson_kind, ps_sphere_disk_kind;

/* The parameters in their order; tries= is Bridson's alone. */
#define PS_DISTANCE_RADIUS                                                                         \
    { "radius", "auto", "least distance, on the sphere an angle; auto: from N" }
#define PS_DISTANCE_EXACT                                                                          \
    { "exact", "no", "no|yes, sets are made anew until one has N points" }
#define PS_DISTANCE_TRIES                                                                          \
    { "tries", "30", "2 to 1000 around a point before it is left" }

/* Members of the rows (samplers/sampler.h) with a .distance. */
bool ps_distance_varies(const ps_sampler_request *request);
size_t ps_distance_most_points(const ps_sampler_request *request);
double ps_distance_seconds(const ps_sampler_request *request);
pspec_status ps_distance_open_points(const ps_sampler_request *request, size_t *num_points,
                                     ps_error *error) PS_MUST_CHECK;
pspec_status ps_distance_check(const ps_sampler_request *request, ps_error *error) PS_MUST_CHECK;
pspec_status ps_distance_generate(const ps_sampler_request *request, uint64_t realization,
                                  double *points, size_t *num_points,
                                  ps_error *error) PS_MUST_CHECK;
#define PS_DISTANCE_MEMBERS                                                                        \
    .varies = ps_distance_varies, .most_points = ps_distance_most_points,                          \
    .seconds = ps_distance_seconds, .is_deterministic = ps_sampler_never,                          \
    .open_points = ps_distance_open_points, .check = ps_distance_check,                            \
    .generate_some = ps_distance_generate

#endif
