#include "samplers/list.h"

#include "samplers/darts/bridson.h"
#include "samplers/darts/distance.h"
#include "samplers/darts/radius.h"
#include "samplers/darts/torus_grid.h"
#include "samplers/values.h"

static double radius(const ps_blue_noise *asked, size_t num_points) {
    return ps_bridson_radius(asked->dimension, asked->tries, num_points);
}

static double expected(const ps_blue_noise *asked) {
    return ps_bridson_expected(asked->dimension, asked->radius, asked->tries);
}

static size_t most_points(const ps_blue_noise *asked) {
    return ps_torus_radius_most_points(asked->dimension, asked->radius);
}

/* By dimension, N = 4096 and 10 to 1000 tries. */
static double nanoseconds(const ps_blue_noise *asked) {
    static const double first[PS_GRID_MOST_DIMENSION + 1] = {0, 0, 600, 500, 5000};
    static const double per_try[PS_GRID_MOST_DIMENSION + 1] = {0, 0, 50, 130, 270};
    return first[asked->dimension] + asked->tries * per_try[asked->dimension];
}

static const ps_distance_kind kind = {
    .radius = radius,
    .expected = expected,
    .most_points = most_points,
    .nanoseconds = nanoseconds,
    .check = ps_bridson_check,
    .make = ps_bridson_points,
};
PS_DISTANCE_FUNCTIONS(kind)

const ps_sampler ps_sampler_bridson = {
    .name = "bridson",
    .summary = "random points that keep a distance, each within two of it from another",
    .minimum_dimension = 2,
    .maximum_dimension = PS_GRID_MOST_DIMENSION,
    .version = 2,
    .parameters = {PS_DISTANCE_RADIUS, PS_DISTANCE_EXACT, PS_DISTANCE_TRIES},
    PS_DISTANCE_MEMBERS,
};
