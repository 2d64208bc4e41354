/* Points of the sphere in cubes of space, found by a hash of the cube.
 */
#ifndef PS_SAMPLERS_DARTS_SPHERE_GRID_H
#define PS_SAMPLERS_DARTS_SPHERE_GRID_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PS_SPHERE_VECTOR = 3, PS_SPHERE_CUBES = 8 };

typedef struct ps_sphere_grid {
    double side;          /* of a cube */
    const double *points; /* [..][3], of the caller */
    uint32_t *first;      /* numbers of points by hash, from 1; 0: none */
    uint32_t *next;
    uint32_t mask;
} ps_sphere_grid;

/* An empty grid for up to most_points points; places no farther than reach, in a straight line, are
 * found. ps_sphere_grid_free also after an error. */
pspec_status ps_sphere_grid_create(ps_sphere_grid *grid, double reach, const double *points,
                                   size_t most_points, ps_error *error) PS_MUST_CHECK;
void ps_sphere_grid_free(ps_sphere_grid *grid);

void ps_sphere_grid_put(ps_sphere_grid *grid, size_t i_point);

static inline double ps_sphere_square_distance(const double *u, const double *v) {
    const double x = u[0] - v[0];
    const double y = u[1] - v[1];
    const double z = u[2] - v[2];
    return x * x + y * y + z * z;
}

/* Is a point nearer to the place than the root of this? */
bool ps_sphere_grid_has_near(const ps_sphere_grid *grid, const double *place, double square);
/* Numbers from 0 of the points nearer than that, each once. At most `most` are written. */
size_t ps_sphere_grid_gather(const ps_sphere_grid *grid, const double *place, double square,
                             uint32_t *numbers, size_t most);

#endif
