#include "samplers/list.h"

#include "samplers/darts/distance.h"
#include "samplers/darts/poisson_disk.h"
#include "samplers/darts/radius.h"
#include "samplers/values.h"

enum { CUBE = 3 };

static double radius(const ps_blue_noise *asked, size_t num_points) {
    return ps_poisson_disk_radius(asked->dimension, num_points);
}

static double expected(const ps_blue_noise *asked) {
    return ps_poisson_disk_expected(asked->dimension, asked->radius);
}

static size_t most_points(const ps_blue_noise *asked) {
    return ps_torus_radius_most_points(asked->dimension, asked->radius);
}

/* bench_blue_noise, N = 1024 to 16384. */
static double nanoseconds(const ps_blue_noise *asked) {
    const double plane = 2000;
    const double cube = 19000;
    return asked->dimension < CUBE ? plane : cube;
}

static const ps_distance_kind kind = {
    .radius = radius,
    .expected = expected,
    .most_points = most_points,
    .nanoseconds = nanoseconds,
    .check = ps_poisson_disk_check,
    .make = ps_poisson_disk_points,
};
PS_DISTANCE_FUNCTIONS(kind)

const ps_sampler ps_sampler_poisson_disk = {
    .name = "poisson-disk",
    .summary = "random points that keep a distance, until no place is left",
    .aliases = {"darts", "poissondisk", "pd"},
    .minimum_dimension = 2,
    .maximum_dimension = CUBE,
    .version = 1,
    .parameters = {PS_DISTANCE_RADIUS, PS_DISTANCE_EXACT},
    PS_DISTANCE_MEMBERS,
};
