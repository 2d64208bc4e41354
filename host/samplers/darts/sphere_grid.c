#include "samplers/darts/sphere_grid.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { LEAST_BITS = 4, MOST_BITS = 31 };

pspec_status ps_sphere_grid_create(ps_sphere_grid *grid, double reach, const double *points,
                                   size_t most_points, ps_error *error) {
    unsigned bits = LEAST_BITS;
    while (bits < MOST_BITS && (size_t)1 << bits < most_points) {
        bits++;
    }
    /* The cubes that a place reaches into are then two along each axis. */
    *grid = (ps_sphere_grid){
        .side = 2 * reach, .points = points, .mask = (uint32_t)(((uint64_t)1 << bits) - 1)};
    PS_TRY(PS_NEW(&grid->first, (size_t)grid->mask + 1, "cubes", error));
    return PS_NEW(&grid->next, most_points, "points of cubes", error);
}

void ps_sphere_grid_free(ps_sphere_grid *grid) {
    free(grid->first);
    free(grid->next);
    *grid = (ps_sphere_grid){0};
}

/* Odd factors of 64 bits with digits at random; the upper bits of the sum are well mixed. */
static uint32_t hash(const ps_sphere_grid *grid, int64_t x, int64_t y, int64_t z) {
    const uint64_t sum = (uint64_t)x * 0x9E3779B97F4A7C15u + (uint64_t)y * 0xC2B2AE3D27D4EB4Fu +
                         (uint64_t)z * 0x165667B19E3779F9u;
    return (uint32_t)((sum ^ sum >> 29) * 0xBF58476D1CE4E5B9u >> 32) & grid->mask;
}

static int64_t cube_of(const ps_sphere_grid *grid, double x) {
    return (int64_t)floor(x / grid->side);
}

void ps_sphere_grid_put(ps_sphere_grid *grid, size_t i_point) {
    const double *const u = grid->points + PS_SPHERE_VECTOR * i_point;
    const uint32_t key = hash(grid, cube_of(grid, u[0]), cube_of(grid, u[1]), cube_of(grid, u[2]));
    grid->next[i_point] = grid->first[key];
    grid->first[key] = (uint32_t)i_point + 1;
}

/* The lists of the eight cubes around the corner that is nearest to the place. */
static inline void find_lists(const ps_sphere_grid *grid, const double *place,
                              uint32_t lists[PS_SPHERE_CUBES]) {
    int64_t low[PS_SPHERE_VECTOR];
    for (unsigned a = 0; a < PS_SPHERE_VECTOR; a++) {
        const double half = 0.5;
        low[a] = (int64_t)floor(place[a] / grid->side - half);
    }
    for (unsigned i = 0; i < PS_SPHERE_CUBES; i++) {
        lists[i] =
            grid->first[hash(grid, low[0] + (i & 1), low[1] + (i >> 1 & 1), low[2] + (i >> 2))];
    }
}

bool ps_sphere_grid_has_near(const ps_sphere_grid *grid, const double *place, double square) {
    uint32_t lists[PS_SPHERE_CUBES];
    find_lists(grid, place, lists);
    for (unsigned i = 0; i < PS_SPHERE_CUBES; i++) {
        for (uint32_t number = lists[i]; number != 0; number = grid->next[number - 1]) {
            const double *const point = grid->points + PS_SPHERE_VECTOR * (size_t)(number - 1);
            if (ps_sphere_square_distance(place, point) < square) {
                return true;
            }
        }
    }
    return false;
}

size_t ps_sphere_grid_gather(const ps_sphere_grid *grid, const double *place, double square,
                             uint32_t *numbers, size_t most) {
    uint32_t lists[PS_SPHERE_CUBES];
    size_t num = 0;
    find_lists(grid, place, lists);
    for (unsigned i = 0; i < PS_SPHERE_CUBES; i++) {
        for (unsigned j = 0; j < i; j++) { /* two cubes may share a list */
            lists[i] = lists[j] == lists[i] ? 0 : lists[i];
        }
        for (uint32_t number = lists[i]; number != 0; number = grid->next[number - 1]) {
            const double *const point = grid->points + PS_SPHERE_VECTOR * (size_t)(number - 1);
            if (num < most && ps_sphere_square_distance(place, point) < square) {
                numbers[num++] = number - 1;
            }
        }
    }
    return num;
}
