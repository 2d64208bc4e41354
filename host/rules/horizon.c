#include "rules/horizon.h"

#include "base/memory.h"
#include "math/gauss_legendre.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

/* Directions are (sin b sin t, cos b, sin b cos t): b from the axis y, about which the horizon of
 * the lobe is turned into that of the normal, and t about it, 0 at the lobe's axis. What is cut
 * away is a lune between two angles t, in which the lobe is smooth: Gauss' rules in b and t. */
typedef struct span {
    double begin, end;
} span;

/* A lobe falls below this share of its top, and the rest is left out. */
static const double NOTHING = 1e-17;

/* The angle from its axis at which a lobe has ended, which falls all the way from there. */
static double find_end(const ps_brdf *brdf) {
    const double step = 0.9;
    const double least = NOTHING * ps_brdf_density(brdf, 1);
    double end = ps_brdf_is_below_horizon(brdf) ? PS_PI : PS_PI / 2;
    while (ps_brdf_density(brdf, cos(step * end)) < least) {
        end *= step;
    }
    return end;
}

/* A rule of num nodes has the waves of num periods in all of its range, and a few more. */
static size_t choose_nodes(span range, double end, size_t max_degree) {
    enum { LEAST = 12, OF_SHAPE = 24 }; /* test_horizon: rounding is left */
    const double waves = (double)max_degree / 2 + OF_SHAPE / fmin(end, 1);
    return LEAST + (size_t)ceil((range.end - range.begin) * waves);
}

static pspec_status fill(ps_horizon *out, const ps_brdf *brdf, span b, span t, const size_t *nums,
                         ps_error *error) {
    double *nodes = NULL;
    PS_TRY(PS_NEW(&out->points, 4 * nums[0] * nums[1], "directions below the horizon", error));
    PS_TRY(PS_NEW(&nodes, 2 * (nums[0] + nums[1]), "directions below the horizon", error));
    double *const of_b = nodes;
    double *const of_t = nodes + 2 * nums[0];
    out->weights = out->points + 3 * nums[0] * nums[1];
    ps_gauss_legendre(nums[0], of_b, of_b + nums[0]);
    ps_gauss_legendre(nums[1], of_t, of_t + nums[1]);
    const double area = (b.end - b.begin) * (t.end - t.begin);
    for (size_t i = 0; i < nums[0] * nums[1]; i++) {
        const size_t j = i / nums[1];
        const size_t k = i % nums[1];
        const double from_y = b.begin + (b.end - b.begin) * of_b[j];
        const double turn = t.begin + (t.end - t.begin) * of_t[k];
        double *const u = out->points + 3 * i;
        u[0] = sin(from_y) * sin(turn);
        u[1] = cos(from_y);
        u[2] = sin(from_y) * cos(turn);
        out->weights[i] = area * of_b[nums[0] + j] * of_t[nums[1] + k] * sin(from_y) *
                          ps_brdf_density(brdf, u[2]);
        out->share += out->weights[i];
    }
    out->num = nums[0] * nums[1];
    free(nodes);
    return PSPEC_OK;
}

pspec_status ps_horizon_make(ps_horizon *out, const ps_brdf *brdf, double degrees,
                             size_t max_degree, ps_error *error) {
    const double angle = degrees * PS_PI / 180;
    *out = (ps_horizon){.normal = {sin(angle), 0, cos(angle)}};
    if (ps_brdf_morph(brdf).kind == PS_MORPH_NONE) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "a lobe from a table has kinks, and the part of it below a horizon is not "
                       "found exactly; other lobes can be looked at from aside");
    }
    const double end = find_end(brdf);
    const double side = fmin(end, PS_PI / 2);
    const double least = ps_brdf_is_below_horizon(brdf) ? angle - 3 * PS_PI / 2 : -PS_PI / 2;
    const span b = {PS_PI / 2 - side, PS_PI / 2 + side};
    const span t = {fmax(least, -end), angle - PS_PI / 2};
    if (!(t.begin < t.end)) {
        return PSPEC_OK;
    }
    const size_t nums[] = {choose_nodes(b, end, max_degree), choose_nodes(t, end, max_degree)};
    return fill(out, brdf, b, t, nums, error);
}

void ps_horizon_free(ps_horizon *horizon) {
    free(horizon->points);
    *horizon = (ps_horizon){0};
}

bool ps_horizon_is_above(const ps_horizon *horizon, const double *u) {
    return u[0] * horizon->normal[0] + u[2] * horizon->normal[2] >= 0;
}
