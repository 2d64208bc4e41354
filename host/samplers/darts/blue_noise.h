/* What samplers that keep a least distance are asked for, and what they tell while they work.
 */
#ifndef PS_SAMPLERS_DARTS_BLUE_NOISE_H
#define PS_SAMPLERS_DARTS_BLUE_NOISE_H

#include "base/status.h"
#include "base/watch.h"
#include "math/random/random.h"

#include <stddef.h>

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

#endif
