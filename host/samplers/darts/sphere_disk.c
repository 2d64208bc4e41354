#include "samplers/darts/sphere_disk.h"

#include "base/memory.h"
#include "math/pi.h"
#include "samplers/darts/face.h"
#include "samplers/darts/parts.h"
#include "samplers/darts/sphere_grid.h"

#include <math.h>

enum {
    /* Points within 1.5 radii of a place, a radius from each other: their caps of half a radius lie
     * in one of two radii, so fewer than 16 on the plane, and on the sphere as well. */
    MOST_NEAR = 16
};

static const double CELLS_PER_RADIUS = 2 * PS_FACE_REACH; /* a cell reaches half a radius */
static const double MOST_CELLS = 0x1p32;                  /* they have numbers of 32 bits */

/* At saturation N r^2 is 4 pi times that of the plane, and a third of a point more fits for the
 * sphere is round: with r of the plane alone there are 4.37, 8.41, 16.38, 32.39, 64.32(4), 256.4(1)
 * for 4, 8, .. 256, means of 1500 sets and more. */
static const double SATURATED = 4 * PS_PI * 0.69656;
static const double ROUND = 0.36;

typedef struct sphere {
    const double *points;
    double radius, square_chord;
    uint32_t num_side; /* cells along a face */
    double reach;      /* from the middle of a cell to its farthest point, an angle */
    double square_gather;
    ps_sphere_grid grid;
    uint32_t near[MOST_NEAR];
    size_t num_near;
} sphere;

/* ---- cells --------------------------------------------------------------------------------- */

/* The vector at (x, y) of a cell, in its sides. */
static void place_in_cell(const sphere *self, uint32_t cell, double x, double y, double *vector) {
    const uint32_t column = cell % self->num_side;
    const uint32_t rest = cell / self->num_side;
    ps_face_point(rest / self->num_side, (rest % self->num_side + x) / self->num_side,
                  (column + y) / self->num_side, vector);
}

static bool throw_dart(void *space, uint32_t cell, const uint32_t *at, double side,
                       const double *uniforms, double *place) {
    const sphere *const self = (const sphere *)space;
    place_in_cell(self, cell, (at[0] + uniforms[0]) * side, (at[1] + uniforms[1]) * side, place);
    return !ps_sphere_grid_has_near(&self->grid, place, self->square_chord);
}

static void put(void *space, uint32_t cell, size_t i_point) {
    (void)cell;
    ps_sphere_grid_put(&((sphere *)space)->grid, i_point);
}

/* Gathers the points whose disks may cover parts of the cell. */
static bool enter(void *space, uint32_t cell) {
    sphere *const self = (sphere *)space;
    const double half = 0.5;
    double middle[PS_SPHERE_VECTOR];
    place_in_cell(self, cell, half, half, middle);
    self->num_near =
        ps_sphere_grid_gather(&self->grid, middle, self->square_gather, self->near, MOST_NEAR);
    return true;
}

static bool is_covered(const sphere *self, const double *middle, double square) {
    for (size_t i = 0; i < self->num_near; i++) {
        const double *const point = self->points + PS_SPHERE_VECTOR * (size_t)self->near[i];
        if (ps_sphere_square_distance(middle, point) < square) {
            return true;
        }
    }
    return false;
}

/* A part is inside a disk where its middle is, by as much as the part reaches: its edges are no
 * geodesics, so that corners alone would not decide. */
static unsigned open_children(void *space, uint32_t cell, const uint32_t *at, double side) {
    const sphere *const self = (const sphere *)space;
    const double half = 0.5;
    const double chord = ps_chord(self->radius - self->reach * side);
    unsigned open = 0;
    for (unsigned child = 0; child < 4; child++) {
        double middle[PS_SPHERE_VECTOR];
        place_in_cell(self, cell, (2 * at[0] + (child & 1) + half) * side,
                      (2 * at[1] + (child >> 1) + half) * side, middle);
        open |= (unsigned)!is_covered(self, middle, chord * chord) << child;
    }
    return open;
}

/* ---- the whole ----------------------------------------------------------------------------- */

pspec_status ps_sphere_disk_check(const ps_blue_noise *asked, ps_error *error) {
    if (!(asked->radius > 0 && asked->radius <= PS_SPHERE_MOST_RADIUS)) {
        return ps_fail(
            error, PSPEC_ERROR_INVALID_ARGUMENT,
            "radius %g is not above 0 and at most %g, nearly the farthest that points of "
            "the sphere are apart",
            asked->radius, PS_SPHERE_MOST_RADIUS);
    }
    const double num_side = ceil(CELLS_PER_RADIUS / asked->radius);
    if (!(PS_NUM_FACES * num_side * num_side <= MOST_CELLS)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "radius %g needs %.3g cells of the sphere, more than 2^32", asked->radius,
                       PS_NUM_FACES * num_side * num_side);
    }
    return PSPEC_OK;
}

static pspec_status create(sphere *self, const ps_blue_noise *asked, ps_error *error) {
    PS_TRY(ps_sphere_disk_check(asked, error));
    const double num_side = ceil(CELLS_PER_RADIUS / asked->radius);
    self->num_side = (uint32_t)num_side;
    self->radius = asked->radius;
    self->reach = PS_FACE_REACH / num_side;
    const double widest = self->radius + self->reach;
    const double gather = ps_chord(widest < PS_PI ? widest : PS_PI);
    const double chord = ps_chord(self->radius);
    self->square_chord = chord * chord;
    self->square_gather = gather * gather;
    return ps_sphere_grid_create(&self->grid, gather, self->points, asked->most_points, error);
}

pspec_status ps_sphere_disk_points(const ps_blue_noise *asked, ps_random *random, double *points,
                                   size_t *num_points, ps_error *error) {
    sphere self = {.points = points};
    *num_points = 0;
    pspec_status status = create(&self, asked, error);
    if (status == PSPEC_OK) {
        const ps_parts_space space = {.dimension = 2,
                                      .width = PS_SPHERE_VECTOR,
                                      .num_cells =
                                          PS_NUM_FACES * (size_t)self.num_side * self.num_side,
                                      .self = &self,
                                      .throw_dart = throw_dart,
                                      .put = put,
                                      .enter = enter,
                                      .open_children = open_children};
        status = ps_parts_saturate(&space, asked, ps_sphere_disk_expected(asked->radius), random,
                                   points, num_points, error);
    }
    ps_sphere_grid_free(&self.grid);
    return status;
}

size_t ps_sphere_disk_most_points(double radius) {
    const double rounding = 1e-9;
    const double sine = ps_chord(radius / 2) / 2;
    const double most = (1 + rounding) / (sine * sine);
    return most < MOST_CELLS ? (size_t)most : SIZE_MAX; /* of radii that are refused */
}

double ps_sphere_disk_radius(size_t num_points) {
    const double radius = sqrt(SATURATED / ((double)num_points - ROUND));
    return radius < PS_SPHERE_MOST_RADIUS ? radius : PS_SPHERE_MOST_RADIUS;
}

double ps_sphere_disk_expected(double radius) {
    return SATURATED / (radius * radius) + ROUND;
}
