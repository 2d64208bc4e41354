#include "samplers/list.h"

#include "samplers/darts/distance.h"
#include "samplers/darts/sphere_disk.h"
#include "samplers/values.h"

static double radius(const ps_blue_noise *asked, size_t num_points) {
    (void)asked;
    return ps_sphere_disk_radius(num_points);
}

static double expected(const ps_blue_noise *asked) {
    return ps_sphere_disk_expected(asked->radius);
}

static size_t most_points(const ps_blue_noise *asked) {
    return ps_sphere_disk_most_points(asked->radius);
}

/* bench_blue_noise, N = 1024 to 16384. */
static double nanoseconds(const ps_blue_noise *asked) {
    const double any = 12500;
    (void)asked;
    return any;
}

static const ps_distance_kind kind = {
    .radius = radius,
    .expected = expected,
    .most_points = most_points,
    .nanoseconds = nanoseconds,
    .check = ps_sphere_disk_check,
    .make = ps_sphere_disk_points,
};
PS_DISTANCE_FUNCTIONS(kind)

const ps_sampler ps_sampler_poisson_disk_sphere = {
    .name = "poisson-disk-sphere",
    .summary = "random points that keep an angle, until no place is left",
    .aliases = {"darts-sphere"},
    .domain = PS_SAMPLES_SPHERE,
    .minimum_points = 2,
    .version = 1,
    .parameters = {PS_DISTANCE_RADIUS, PS_DISTANCE_EXACT},
    PS_DISTANCE_MEMBERS,
};
