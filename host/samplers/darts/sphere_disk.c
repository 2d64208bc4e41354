/* Maximal Poisson disk points of the sphere: as samplers/darts/poisson_disk.c on the torus, by
 * squares of the faces of HEALPix, which have equal areas. No two points are at an angle below the
 * radius, up to the rounding of their numbers.
 */
#include "samplers/list.h"

#include "base/memory.h"
#include "math/pi.h"
#include "samplers/darts/distance.h"
#include "samplers/darts/face.h"
#include "samplers/darts/parts.h"
#include "samplers/values.h"

#include <math.h>
#include <stdlib.h>

/* ---- points in cubes of space, found by a hash of the cube ----------------------------------- */

enum { VECTOR = 3, CUBES = 8 };

typedef struct sphere_grid {
    double side;          /* of a cube */
    const double *points; /* [..][3], of the caller */
    uint32_t *first;      /* numbers of points by hash, from 1; 0: none */
    uint32_t *next;
    uint32_t mask;
} sphere_grid;

static inline double square_distance(const double *u, const double *v) {
    const double x = u[0] - v[0];
    const double y = u[1] - v[1];
    const double z = u[2] - v[2];
    return x * x + y * y + z * z;
}

enum { LEAST_BITS = 4, MOST_BITS = 31 };

/* An empty grid for up to most_points points; places no farther than reach, in a straight line, are
 * found. */
static pspec_status create_grid(sphere_grid *grid, double reach, const double *points,
                                size_t most_points, ps_error *error) {
    unsigned bits = LEAST_BITS;
    while (bits < MOST_BITS && (size_t)1 << bits < most_points) {
        bits++;
    }
    /* The cubes that a place reaches into are then two along each axis. */
    *grid = (sphere_grid){
        .side = 2 * reach, .points = points, .mask = (uint32_t)(((uint64_t)1 << bits) - 1)};
    PS_TRY(PS_NEW(&grid->first, (size_t)grid->mask + 1, "cubes", error));
    return PS_NEW(&grid->next, most_points, "points of cubes", error);
}

static void free_grid(sphere_grid *grid) {
    free(grid->first);
    free(grid->next);
    *grid = (sphere_grid){0};
}

/* Odd factors of 64 bits with digits at random; the upper bits of the sum are well mixed. */
static uint32_t hash(const sphere_grid *grid, int64_t x, int64_t y, int64_t z) {
    const uint64_t sum = (uint64_t)x * 0x9E3779B97F4A7C15u + (uint64_t)y * 0xC2B2AE3D27D4EB4Fu +
                         (uint64_t)z * 0x165667B19E3779F9u;
    return (uint32_t)((sum ^ sum >> 29) * 0xBF58476D1CE4E5B9u >> 32) & grid->mask;
}

static int64_t cube_of(const sphere_grid *grid, double x) {
    return (int64_t)floor(x / grid->side);
}

static void put_in_grid(sphere_grid *grid, size_t i_point) {
    const double *const u = grid->points + VECTOR * i_point;
    const uint32_t key = hash(grid, cube_of(grid, u[0]), cube_of(grid, u[1]), cube_of(grid, u[2]));
    grid->next[i_point] = grid->first[key];
    grid->first[key] = (uint32_t)i_point + 1;
}

/* The lists of the eight cubes around the corner that is nearest to the place. */
static inline void find_lists(const sphere_grid *grid, const double *place, uint32_t lists[CUBES]) {
    int64_t low[VECTOR];
    for (unsigned a = 0; a < VECTOR; a++) {
        const double half = 0.5;
        low[a] = (int64_t)floor(place[a] / grid->side - half);
    }
    for (unsigned i = 0; i < CUBES; i++) {
        lists[i] =
            grid->first[hash(grid, low[0] + (i & 1), low[1] + (i >> 1 & 1), low[2] + (i >> 2))];
    }
}

/* Is a point nearer to the place than the root of this? */
static bool has_near(const sphere_grid *grid, const double *place, double square) {
    uint32_t lists[CUBES];
    find_lists(grid, place, lists);
    for (unsigned i = 0; i < CUBES; i++) {
        for (uint32_t number = lists[i]; number != 0; number = grid->next[number - 1]) {
            const double *const point = grid->points + VECTOR * (size_t)(number - 1);
            if (square_distance(place, point) < square) {
                return true;
            }
        }
    }
    return false;
}

/* Numbers from 0 of the points nearer than that, each once. At most `most` are written. */
static size_t gather(const sphere_grid *grid, const double *place, double square, uint32_t *numbers,
                     size_t most) {
    uint32_t lists[CUBES];
    size_t num = 0;
    find_lists(grid, place, lists);
    for (unsigned i = 0; i < CUBES; i++) {
        for (unsigned j = 0; j < i; j++) { /* two cubes may share a list */
            lists[i] = lists[j] == lists[i] ? 0 : lists[i];
        }
        for (uint32_t number = lists[i]; number != 0; number = grid->next[number - 1]) {
            const double *const point = grid->points + VECTOR * (size_t)(number - 1);
            if (num < most && square_distance(place, point) < square) {
                numbers[num++] = number - 1;
            }
        }
    }
    return num;
}

/* ---- disks ----------------------------------------------------------------------------------- */

enum {
    /* Points within 1.5 radii of a place, a radius from each other: their caps of half a radius lie
     * in one of two radii, so fewer than 16 on the plane, and on the sphere as well. */
    MOST_NEAR = 16
};

/* In radians. Up to here two points always find room, and between here and pi their straight
 * distance says less and less of their angle. */
static const double MOST_RADIUS = 3.0;

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
    sphere_grid grid;
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
    return !has_near(&self->grid, place, self->square_chord);
}

static void put(void *space, uint32_t cell, size_t i_point) {
    (void)cell;
    put_in_grid(&((sphere *)space)->grid, i_point);
}

/* Gathers the points whose disks may cover parts of the cell. */
static bool enter(void *space, uint32_t cell) {
    sphere *const self = (sphere *)space;
    const double half = 0.5;
    double middle[VECTOR];
    place_in_cell(self, cell, half, half, middle);
    self->num_near = gather(&self->grid, middle, self->square_gather, self->near, MOST_NEAR);
    return true;
}

static bool is_covered(const sphere *self, const double *middle, double square) {
    for (size_t i = 0; i < self->num_near; i++) {
        const double *const point = self->points + VECTOR * (size_t)self->near[i];
        if (square_distance(middle, point) < square) {
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
        double middle[VECTOR];
        place_in_cell(self, cell, (2 * at[0] + (child & 1) + half) * side,
                      (2 * at[1] + (child >> 1) + half) * side, middle);
        open |= (unsigned)!is_covered(self, middle, chord * chord) << child;
    }
    return open;
}

/* ---- numbers of points ---------------------------------------------------------------------- */

/* The caps of half the radius have no more area than the sphere. */
static size_t most_points(const ps_blue_noise *asked) {
    const double rounding = 1e-9;
    const double sine = ps_chord(asked->radius / 2) / 2;
    const double most = (1 + rounding) / (sine * sine);
    return most < MOST_CELLS ? (size_t)most : SIZE_MAX; /* of radii that are refused */
}

/* From 4 points on the mean is right within 2 %, from 16 on within 0.2 %; 3 make 2.9. */
static double radius(const ps_blue_noise *asked, size_t num_points) {
    const double found = sqrt(SATURATED / ((double)num_points - ROUND));
    (void)asked;
    return found < MOST_RADIUS ? found : MOST_RADIUS;
}

static double expected(const ps_blue_noise *asked) {
    return SATURATED / (asked->radius * asked->radius) + ROUND;
}

/* ---- the whole ----------------------------------------------------------------------------- */

static pspec_status check(const ps_blue_noise *asked, ps_error *error) {
    if (!(asked->radius > 0 && asked->radius <= MOST_RADIUS)) {
        return ps_fail(
            error, PSPEC_ERROR_INVALID_ARGUMENT,
            "radius %g is not above 0 and at most %g, nearly the farthest that points of "
            "the sphere are apart",
            asked->radius, MOST_RADIUS);
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
    PS_TRY(check(asked, error));
    const double num_side = ceil(CELLS_PER_RADIUS / asked->radius);
    self->num_side = (uint32_t)num_side;
    self->radius = asked->radius;
    self->reach = PS_FACE_REACH / num_side;
    const double widest = self->radius + self->reach;
    const double gather = ps_chord(widest < PS_PI ? widest : PS_PI);
    const double chord = ps_chord(self->radius);
    self->square_chord = chord * chord;
    self->square_gather = gather * gather;
    return create_grid(&self->grid, gather, self->points, asked->most_points, error);
}

static pspec_status make(const ps_blue_noise *asked, ps_random *random, double *points,
                         size_t *num_points, ps_error *error) {
    sphere self = {.points = points};
    *num_points = 0;
    pspec_status status = create(&self, asked, error);
    if (status == PSPEC_OK) {
        const ps_parts_space space = {.dimension = 2,
                                      .width = VECTOR,
                                      .num_cells =
                                          PS_NUM_FACES * (size_t)self.num_side * self.num_side,
                                      .self = &self,
                                      .throw_dart = throw_dart,
                                      .put = put,
                                      .enter = enter,
                                      .open_children = open_children};
        status =
            ps_parts_saturate(&space, asked, expected(asked), random, points, num_points, error);
    }
    free_grid(&self.grid);
    return status;
}

/* ---- the row --------------------------------------------------------------------------------- */

/* bench_blue_noise, N = 1024 to 16384. */
static double nanoseconds(const ps_blue_noise *asked) {
    const double any = 12500;
    (void)asked;
    return any;
}

const ps_distance_kind ps_sphere_disk_kind = {
    .radius = radius,
    .expected = expected,
    .most_points = most_points,
    .nanoseconds = nanoseconds,
    .check = check,
    .make = make,
};

const ps_sampler ps_sampler_poisson_disk_sphere = {
    .name = "poisson-disk-sphere",
    .summary = "random points that keep an angle, until no place is left",
    .aliases = {"darts-sphere"},
    .domain = PS_SAMPLES_SPHERE,
    .minimum_points = 2,
    .version = 1,
    .parameters = {PS_DISTANCE_RADIUS, PS_DISTANCE_EXACT},
    .distance = &ps_sphere_disk_kind,
    PS_DISTANCE_MEMBERS,
};
