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

static double white(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    (void)point;
    (void)num_points;
    (void)axis;
    return ps_stress_uniform(state);
}

static double jittered(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    const size_t cells = (size_t)ceil(sqrt((double)num_points));
    const size_t cell = axis % 2 == 0 ? point / cells : point % cells;
    return ((double)cell + ps_stress_uniform(state)) / (double)cells;
}

/* In one dimension, sorted: every run of points adds up in step at low frequencies, S does not. */
static double sorted(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    (void)axis;
    return ((double)point + ps_stress_uniform(state)) / (double)num_points;
}

static double lattice(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    (void)state;
    return fmod((double)point * (axis == 0 ? 1 : axis == 1 ? 17 : 113) / (double)num_points, 1.0);
}

static double one_place(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    (void)point;
    (void)num_points;
    (void)state;
    return axis % 2 == 0 ? 0.3183098861837907 : 0.7071067811865476;
}

/* Within a thousandth: a cell of grids with up to a few hundred frequencies. */
static double one_cell(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    const double side = 1e-3;
    return one_place(point, num_points, axis, state) + side * ps_stress_uniform(state);
}

/* Below what fixed point holds exactly. */
static double near_zero(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    (void)point;
    (void)num_points;
    (void)axis;
    return ps_stress_uniform(state) * 0x1p-20;
}

/* Pairs of equal points. */
static double duplicates(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    uint64_t own = point / 2 * 2 + axis;
    (void)num_points;
    (void)state;
    return ps_stress_uniform(&own);
}

/* The first and the last coordinate there are, and cell boundaries. */
static double boundaries(size_t point, size_t num_points, unsigned axis, uint64_t *state) {
    static const double places[] = {0, 1 - 0x1p-32, 0.5, 0.25, 1 - 0x1p-53, 0x1p-64, 0.125};
    (void)num_points;
    (void)axis;
    (void)point;
    return places[(size_t)(ps_stress_uniform(state) * 7)];
}

/* ---- weights ------------------------------------------------------------------------------- */

static double signed_weight(size_t point, uint64_t *state) {
    (void)point;
    return 2 * ps_stress_uniform(state) - 0.9;
}

/* Weights have either sign and spread over twelve decades. */
static double wild_weight(size_t point, uint64_t *state) {
    const double decades = 12;
    return (point % 2 == 0 ? 1 : -1) * pow(10, decades * (ps_stress_uniform(state) - 0.5));
}

static double wild_size(size_t point, uint64_t *state) {
    (void)point;
    return pow(10, 12 * ps_stress_uniform(state) - 6);
}

/* 1e-12 to 1e12. */
static double wildest_weight(size_t point, uint64_t *state) {
    const double decades = 24;
    return (point % 3 == 0 ? -1 : 1) * pow(10, decades * (ps_stress_uniform(state) - 0.5));
}

static double even_sign(size_t point, uint64_t *state) {
    (void)point;
    return 2 * ps_stress_uniform(state) - 1;
}

/* Sums of it are rounded. */
static double one_weight(size_t point, uint64_t *state) {
    (void)point;
    (void)state;
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

static void white_place(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    const double theta = 2 * asin(sqrt(ps_stress_uniform(state)));
    (void)point;
    (void)num_points;
    set_angles(u, theta, PS_TWO_PI * ps_stress_uniform(state), 1);
}

static void spiral(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    const double golden_angle = 2.399963229728653;
    (void)state;
    set_angles(u, acos(1 - (2 * (double)point + 1) / (double)num_points),
               fmod(golden_angle * (double)point, PS_TWO_PI), 1);
}

static void near_pole(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    white_place(point, num_points, state, u);
    const double phi = atan2(u[1], u[0]);
    set_angles(u, 1e-2 * ps_stress_uniform(state), phi, 1);
}

/* So near that their height is 1, at either pole. */
static void within_1e_8_of_poles(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    const double phi = PS_TWO_PI * ps_stress_uniform(state);
    (void)num_points;
    set_angles(u, 1e-8 * (0.5 + ps_stress_uniform(state)), phi, point % 2 == 0 ? 1 : -1);
}

/* A circle where sin^m of the angle underflows from degree 243 on in single precision, 1970 in
 * double. */
static void polar_circle(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    const double theta = 0.3;
    (void)point;
    (void)num_points;
    set_angles(u, theta, PS_TWO_PI * ps_stress_uniform(state), 1);
}

static void at_poles(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    (void)num_points;
    set_angles(u, point % 2 == 0 ? 0 : PS_PI, PS_TWO_PI * ps_stress_uniform(state), 1);
}

static void same_place(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    (void)point;
    (void)num_points;
    (void)state;
    set_angles(u, 1.1, 2.3, 1);
}

static void cluster(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    const double theta = 1.9 + 3e-3 * ps_stress_uniform(state);
    (void)point;
    (void)num_points;
    set_angles(u, theta, 6.28 + 3e-3 * ps_stress_uniform(state), 1);
}

/* So near that P_l is near 1 for all degrees, or for most. */
static void within(double side, uint64_t *state, double u[3]) {
    const double theta = 1 + side * ps_stress_uniform(state);
    set_angles(u, theta, 2 + side * ps_stress_uniform(state), 1);
}

static void within_1e_4(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    (void)point;
    (void)num_points;
    within(1e-4, state, u);
}

static void within_1e_5(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    (void)point;
    (void)num_points;
    within(1e-5, state, u);
}

/* Rows of points on circles, as many on each: regular along both angles. */
static void rows(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    const size_t side = (size_t)ceil(sqrt((double)num_points));
    (void)state;
    set_angles(u, PS_PI * ((double)(point / side) + 0.5) / (double)side,
               PS_TWO_PI * (double)(point % side) / (double)side, 1);
}

static void meridian(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    (void)state;
    set_angles(u, PS_PI * ((double)point + 0.5) / (double)num_points, 0, 1);
}

static void equator(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    const double theta = PS_PI / 2 + 1e-3 * ps_stress_uniform(state);
    (void)point;
    (void)num_points;
    set_angles(u, theta, PS_TWO_PI * ps_stress_uniform(state), 1);
}

/* On one line through the centre, but for roundings. */
static void antipodes(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    const double side = ps_stress_uniform(state) < 0.5 ? -1 : 1;
    (void)point;
    (void)num_points;
    set_angles(u, 1.234, 3.456, 1);
    for (int axis = 0; axis < PS_SPHERE_DIMENSION; axis++) {
        u[axis] *= side;
    }
}

/* All pairs at right angles or on a line: an octahedron, many times over. */
static void axes(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    const double choice = 6 * ps_stress_uniform(state);
    (void)point;
    (void)num_points;
    u[0] = u[1] = u[2] = 0;
    u[(int)choice % PS_SPHERE_DIMENSION] = choice < 3 ? 1 : -1;
}

/* Pairs of equal points. */
static void equal_pairs(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    uint64_t own = point / 2;
    (void)state;
    white_place(point, num_points, &own, u);
}

/* The 12 vertices of an icosahedron, a design of degree 5: powers of degrees 1 to 5 are 0. */
static void icosahedron(size_t point, size_t num_points, uint64_t *state, double u[3]) {
    const double latitude = atan(0.5);
    const size_t at = point % 12;
    (void)num_points;
    (void)state;
    if (at >= 10) {
        set_angles(u, 0, 0, at == 10 ? 1 : -1);
        return;
    }
    set_angles(u, PS_PI / 2 - latitude, PS_PI / 5 * (double)at, at % 2 == 0 ? 1 : -1);
}

/* ---- the tables ---------------------------------------------------------------------------- */

const ps_torus_shape ps_torus_shapes[] = {
    {"white", white, NULL},
    {"jittered", jittered, NULL},
    {"lattice", lattice, NULL},
    {"one place", one_place, NULL},
    {"one cell", one_cell, NULL},
    {"near zero", near_zero, NULL},
    {"duplicates", duplicates, NULL},
    {"boundaries", boundaries, NULL},
    {"signed weights", white, signed_weight},
    {"wild weights", white, wild_weight},
    {"wildest weights", white, wildest_weight},
    {"sorted", sorted, NULL},
    {NULL, NULL, NULL},
};

const ps_vector_shape ps_vector_shapes[] = {
    {"white", white_place, NULL},
    {"spiral", spiral, NULL},
    {"near the pole", near_pole, NULL},
    {"poles", at_poles, NULL},
    {"one place", same_place, NULL},
    {"cluster", cluster, NULL},
    {"rows", rows, NULL},
    {"meridian", meridian, NULL},
    {"signed weights", white_place, even_sign},
    {"wild weights", white_place, wild_size},
    {"wildest weights", white_place, wildest_weight},
    {"within 1e-8 of poles", within_1e_8_of_poles, NULL},
    {"polar circle", polar_circle, NULL},
    {"equator", equator, NULL},
    {"within 1e-4", within_1e_4, NULL},
    {"within 1e-5", within_1e_5, NULL},
    {"antipodes", antipodes, one_weight},
    {"axes", axes, one_weight},
    {"duplicates", equal_pairs, NULL},
    {"icosahedron", icosahedron, NULL},
    {NULL, NULL, NULL},
};

const ps_torus_shape *ps_torus_shape_find(const char *name) {
    for (const ps_torus_shape *shape = ps_torus_shapes; shape->name != NULL; shape++) {
        if (strcmp(shape->name, name) == 0) {
            return shape;
        }
    }
    return NULL;
}

const ps_vector_shape *ps_vector_shape_find(const char *name) {
    for (const ps_vector_shape *shape = ps_vector_shapes; shape->name != NULL; shape++) {
        if (strcmp(shape->name, name) == 0) {
            return shape;
        }
    }
    return NULL;
}

/* ---- patterns ------------------------------------------------------------------------------ */

static pspec_status allocate(pspec_pattern *out, double **points, double **weights,
                             unsigned dimension, size_t num_points, bool has_weights,
                             ps_error *error) {
    *out = (pspec_pattern){.dimension = dimension, .num_points = num_points};
    *weights = NULL;
    PS_TRY(ps_allocate_for(points, num_points, dimension * sizeof(double), "points", error));
    if (has_weights) {
        const pspec_status status = PS_NEW(weights, num_points, "weights", error);
        if (status != PSPEC_OK) {
            free(*points);
            return status;
        }
    }
    out->points = *points;
    out->weights = *weights;
    return PSPEC_OK;
}

pspec_status ps_torus_shape_make(const ps_torus_shape *shape, unsigned dimension, size_t num_points,
                                 uint64_t seed, pspec_pattern *out, ps_error *error) {
    double *points = NULL;
    double *weights = NULL;
    uint64_t state = seed;
    PS_TRY(allocate(out, &points, &weights, dimension, num_points, shape->weight != NULL, error));
    for (size_t j = 0; j < num_points; j++) {
        for (unsigned axis = 0; axis < dimension; axis++) {
            points[j * dimension + axis] = shape->coordinate(j, num_points, axis, &state);
        }
        if (weights != NULL) {
            weights[j] = shape->weight(j, &state);
        }
    }
    return PSPEC_OK;
}

pspec_status ps_vector_shape_make(const ps_vector_shape *shape, size_t num_points, uint64_t seed,
                                  pspec_pattern *out, ps_error *error) {
    double *points = NULL;
    double *weights = NULL;
    uint64_t state = seed;
    PS_TRY(allocate(out, &points, &weights, PS_SPHERE_DIMENSION, num_points, shape->weight != NULL,
                    error));
    for (size_t j = 0; j < num_points; j++) {
        shape->place(j, num_points, &state, points + j * PS_SPHERE_DIMENSION);
        if (weights != NULL) {
            weights[j] = shape->weight(j, &state);
        }
    }
    return PSPEC_OK;
}

void ps_stress_pattern_free(pspec_pattern *pattern) {
    free((void *)(uintptr_t)pattern->points);
    free((void *)(uintptr_t)pattern->weights);
    *pattern = (pspec_pattern){0};
}
