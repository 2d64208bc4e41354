#include "verify/stress_shapes.h"

#include "base/memory.h"
#include "frequencies/frequencies.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double ps_stress_uniform(uint64_t *state) {
    /* splitmix64: its published constants */
    *state += 0x9E3779B97F4A7C15u;
    uint64_t z = *state;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* ---- coordinates --------------------------------------------------------------------------- */

static double white(const ps_stress_spot *at) {
    return ps_stress_uniform(at->state);
}

static double jittered(const ps_stress_spot *at) {
    const size_t cells = (size_t)ceil(sqrt((double)at->num_points));
    const size_t cell = at->axis % 2 == 0 ? at->point / cells : at->point % cells;
    return ((double)cell + ps_stress_uniform(at->state)) / (double)cells;
}

/* In one dimension, sorted: every run of points adds up in step at low frequencies, S does not. */
static double sorted(const ps_stress_spot *at) {
    return ((double)at->point + ps_stress_uniform(at->state)) / (double)at->num_points;
}

static double lattice(const ps_stress_spot *at) {
    const double step = at->axis == 0 ? 1 : at->axis == 1 ? 17 : 113;
    return fmod((double)at->point * step / (double)at->num_points, 1.0);
}

static double one_place(const ps_stress_spot *at) {
    return at->axis % 2 == 0 ? 0.3183098861837907 : 0.7071067811865476;
}

/* Within a thousandth: a cell of grids with up to a few hundred frequencies. */
static double one_cell(const ps_stress_spot *at) {
    const double side = 1e-3;
    return one_place(at) + side * ps_stress_uniform(at->state);
}

/* Below what fixed point holds exactly. */
static double near_zero(const ps_stress_spot *at) {
    return ps_stress_uniform(at->state) * 0x1p-20;
}

/* Pairs of equal points. */
static double duplicates(const ps_stress_spot *at) {
    uint64_t own = at->point / 2 * 2 + at->axis;
    return ps_stress_uniform(&own);
}

/* The first and the last coordinate there are, and cell boundaries. */
static double boundaries(const ps_stress_spot *at) {
    static const double places[] = {0, 1 - 0x1p-32, 0.5, 0.25, 1 - 0x1p-53, 0x1p-64, 0.125};
    return places[(size_t)(ps_stress_uniform(at->state) * 7)];
}

/* ---- weights ------------------------------------------------------------------------------- */

static double signed_weight(const ps_stress_spot *at) {
    return 2 * ps_stress_uniform(at->state) - 0.9;
}

/* Weights have either sign and spread over twelve decades. */
static double wild_weight(const ps_stress_spot *at) {
    const double decades = 12;
    return (at->point % 2 == 0 ? 1 : -1) * pow(10, decades * (ps_stress_uniform(at->state) - 0.5));
}

static double wild_size(const ps_stress_spot *at) {
    return pow(10, 12 * ps_stress_uniform(at->state) - 6);
}

/* 1e-12 to 1e12. */
static double wildest_weight(const ps_stress_spot *at) {
    const double decades = 24;
    return (at->point % 3 == 0 ? -1 : 1) * pow(10, decades * (ps_stress_uniform(at->state) - 0.5));
}

static double even_sign(const ps_stress_spot *at) {
    return 2 * ps_stress_uniform(at->state) - 1;
}

/* Sums of it are rounded. */
static double one_weight(const ps_stress_spot *at) {
    (void)at;
    return 0.7;
}

/* ---- places on the sphere ------------------------------------------------------------------ */

/* From the angle to the north pole, or with side -1 to the south pole, and the longitude: exact
 * near the poles. */
static void set_angles(double u[3], double theta, double phi, double side) {
    const double rho = theta == PS_PI ? 0 : sin(theta);
    u[0] = rho * cos(phi);
    u[1] = rho * sin(phi);
    u[2] = side * cos(theta);
}

static void white_place(const ps_stress_spot *at, double u[3]) {
    const double theta = 2 * asin(sqrt(ps_stress_uniform(at->state)));
    set_angles(u, theta, PS_TWO_PI * ps_stress_uniform(at->state), 1);
}

static void spiral(const ps_stress_spot *at, double u[3]) {
    const double golden_angle = 2.399963229728653;
    set_angles(u, acos(1 - (2 * (double)at->point + 1) / (double)at->num_points),
               fmod(golden_angle * (double)at->point, PS_TWO_PI), 1);
}

static void near_pole(const ps_stress_spot *at, double u[3]) {
    white_place(at, u);
    const double phi = atan2(u[1], u[0]);
    set_angles(u, 1e-2 * ps_stress_uniform(at->state), phi, 1);
}

/* So near that their height is 1, at either pole. */
static void within_1e_8_of_poles(const ps_stress_spot *at, double u[3]) {
    const double phi = PS_TWO_PI * ps_stress_uniform(at->state);
    set_angles(u, 1e-8 * (0.5 + ps_stress_uniform(at->state)), phi, at->point % 2 == 0 ? 1 : -1);
}

/* A circle where sin^m of the angle underflows from degree 243 on in single precision, 1970 in
 * double. */
static void polar_circle(const ps_stress_spot *at, double u[3]) {
    const double theta = 0.3;
    set_angles(u, theta, PS_TWO_PI * ps_stress_uniform(at->state), 1);
}

static void at_poles(const ps_stress_spot *at, double u[3]) {
    set_angles(u, at->point % 2 == 0 ? 0 : PS_PI, PS_TWO_PI * ps_stress_uniform(at->state), 1);
}

static void same_place(const ps_stress_spot *at, double u[3]) {
    (void)at;
    set_angles(u, 1.1, 2.3, 1);
}

static void cluster(const ps_stress_spot *at, double u[3]) {
    const double theta = 1.9 + 3e-3 * ps_stress_uniform(at->state);
    set_angles(u, theta, 6.28 + 3e-3 * ps_stress_uniform(at->state), 1);
}

/* So near that P_l is near 1 for all degrees, or for most. */
static void within(const ps_stress_spot *at, double side, double u[3]) {
    const double theta = 1 + side * ps_stress_uniform(at->state);
    set_angles(u, theta, 2 + side * ps_stress_uniform(at->state), 1);
}

static void within_1e_4(const ps_stress_spot *at, double u[3]) {
    within(at, 1e-4, u);
}

static void within_1e_5(const ps_stress_spot *at, double u[3]) {
    within(at, 1e-5, u);
}

/* Rows of points on circles, as many on each: regular along both angles. */
static void rows(const ps_stress_spot *at, double u[3]) {
    const size_t side = (size_t)ceil(sqrt((double)at->num_points));
    set_angles(u, PS_PI * ((double)(at->point / side) + 0.5) / (double)side,
               PS_TWO_PI * (double)(at->point % side) / (double)side, 1);
}

static void meridian(const ps_stress_spot *at, double u[3]) {
    set_angles(u, PS_PI * ((double)at->point + 0.5) / (double)at->num_points, 0, 1);
}

static void equator(const ps_stress_spot *at, double u[3]) {
    const double theta = PS_PI / 2 + 1e-3 * ps_stress_uniform(at->state);
    set_angles(u, theta, PS_TWO_PI * ps_stress_uniform(at->state), 1);
}

/* On one line through the centre, but for roundings. */
static void antipodes(const ps_stress_spot *at, double u[3]) {
    const double side = ps_stress_uniform(at->state) < 0.5 ? -1 : 1;
    set_angles(u, 1.234, 3.456, 1);
    for (int axis = 0; axis < PS_SPHERE_DIMENSION; axis++) {
        u[axis] *= side;
    }
}

/* All pairs at right angles or on a line: an octahedron, many times over. */
static void axes(const ps_stress_spot *at, double u[3]) {
    const double choice = 6 * ps_stress_uniform(at->state);
    u[0] = u[1] = u[2] = 0;
    u[(int)choice % PS_SPHERE_DIMENSION] = choice < 3 ? 1 : -1;
}

/* Pairs of equal points. */
static void equal_pairs(const ps_stress_spot *at, double u[3]) {
    uint64_t own = at->point / 2;
    white_place(&(ps_stress_spot){.state = &own}, u);
}

/* The 12 vertices of an icosahedron, a design of degree 5: powers of degrees 1 to 5 are 0. */
static void icosahedron(const ps_stress_spot *at, double u[3]) {
    const double latitude = atan(0.5);
    const size_t vertex = at->point % 12;
    if (vertex >= 10) {
        set_angles(u, 0, 0, vertex == 10 ? 1 : -1);
        return;
    }
    set_angles(u, PS_PI / 2 - latitude, PS_PI / 5 * (double)vertex, vertex % 2 == 0 ? 1 : -1);
}

/* ---- the tables ---------------------------------------------------------------------------- */

const ps_stress_shape ps_torus_shapes[] = {
    {"white", .coordinate = white},
    {"jittered", .coordinate = jittered},
    {"lattice", .coordinate = lattice},
    {"one place", .coordinate = one_place},
    {"one cell", .coordinate = one_cell},
    {"near zero", .coordinate = near_zero},
    {"duplicates", .coordinate = duplicates},
    {"boundaries", .coordinate = boundaries},
    {"signed weights", .coordinate = white, .weight = signed_weight},
    {"wild weights", .coordinate = white, .weight = wild_weight},
    {"wildest weights", .coordinate = white, .weight = wildest_weight},
    {"sorted", .coordinate = sorted},
    {0},
};

const ps_stress_shape ps_vector_shapes[] = {
    {"white", .place = white_place},
    {"spiral", .place = spiral},
    {"near the pole", .place = near_pole},
    {"poles", .place = at_poles},
    {"one place", .place = same_place},
    {"cluster", .place = cluster},
    {"rows", .place = rows},
    {"meridian", .place = meridian},
    {"signed weights", .place = white_place, .weight = even_sign},
    {"wild weights", .place = white_place, .weight = wild_size},
    {"wildest weights", .place = white_place, .weight = wildest_weight},
    {"within 1e-8 of poles", .place = within_1e_8_of_poles},
    {"polar circle", .place = polar_circle},
    {"equator", .place = equator},
    {"within 1e-4", .place = within_1e_4},
    {"within 1e-5", .place = within_1e_5},
    {"antipodes", .place = antipodes, .weight = one_weight},
    {"axes", .place = axes, .weight = one_weight},
    {"duplicates", .place = equal_pairs},
    {"icosahedron", .place = icosahedron},
    {0},
};

const ps_stress_shape *ps_stress_shape_find(const ps_stress_shape *shapes, const char *name) {
    for (; shapes->name != NULL; shapes++) {
        if (strcmp(shapes->name, name) == 0) {
            return shapes;
        }
    }
    return NULL;
}

/* ---- patterns ------------------------------------------------------------------------------ */

pspec_status ps_stress_shape_make(const ps_stress_shape *shape, unsigned dimension,
                                  size_t num_points, uint64_t seed, pspec_pattern *out,
                                  ps_error *error) {
    const size_t numbers = dimension + (shape->weight != NULL);
    double *points = NULL;
    ps_stress_spot at = {.num_points = num_points, .state = &seed};
    PS_TRY(ps_allocate_for(&points, num_points, numbers * sizeof(double), "points", error));
    double *const weights = shape->weight != NULL ? points + num_points * dimension : NULL;
    for (; at.point < num_points; at.point++) {
        double *const point = points + at.point * dimension;
        for (at.axis = 0; shape->place == NULL && at.axis < dimension; at.axis++) {
            point[at.axis] = shape->coordinate(&at);
        }
        if (shape->place != NULL) {
            shape->place(&at, point);
        }
        if (weights != NULL) {
            weights[at.point] = shape->weight(&at);
        }
    }
    *out = (pspec_pattern){dimension, num_points, points, weights};
    return PSPEC_OK;
}

void ps_stress_pattern_free(pspec_pattern *pattern) {
    free((void *)(uintptr_t)pattern->points); /* and weights behind them */
    *pattern = (pspec_pattern){0};
}
