/* Voronoi cells of points of the torus that are taken out and put in one at a time: only cells that
 * change are made, from the neighbours that are known, without a search.
 *
 * When point p goes, each neighbour q gets a new cell by its own neighbours and those of p, which
 * are all that can meet in the hole. When p comes to a place whose nearest point is known, its cell
 * is cut by that point, then by the neighbours of whatever is beyond an edge; each of those then
 * loses what is nearer to p. Where four points lie on a circle, rounding may leave an edge of 1e-16
 * out on one side: neighbours are only where to look, and each half plane is that of a point
 * where it is now, so that no harm follows.
 */
#ifndef PS_SAMPLERS_OPTIMIZED_FPO_MESH_H
#define PS_SAMPLERS_OPTIMIZED_FPO_MESH_H

#include "samplers/optimized/cells.h"
#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

/* The largest of many numbers that change one by one: a tree of the winners of pairs, pairs of
 * pairs and so on. A change costs the logarithm of their number, the winner nothing.
 */
typedef struct ps_tournament {
    uint32_t num_leaves; /* a power of two; those without a number have -1 */
    double *keys;        /* of leaves */
    uint32_t *winners;   /* of node k, whose children are 2 k and 2 k + 1; 1 is the root */
} ps_tournament;

/* Numbers 0 .. num - 1, num <= 2^31, all of them 0. */
pspec_status ps_tournament_create(ps_tournament *tournament, size_t num,
                                  ps_error *error) PS_MUST_CHECK;
void ps_tournament_destroy(ps_tournament *tournament);

/* Number i becomes key >= 0. */
void ps_tournament_set(ps_tournament *tournament, uint32_t i, double key);

/* Which number is the largest; of equal ones the first. */
static inline uint32_t ps_tournament_winner(const ps_tournament *tournament) {
    return tournament->winners[1];
}

/* Edges of a cell that is kept; of random points, one in 1e25 has more. */
enum { PS_FPO_MOST_EDGES = 32 };

/* A kept cell: vertices relative to the point, neighbours as in ps_polygon. */
typedef struct ps_fpo_cell {
    double x[PS_FPO_MOST_EDGES], y[PS_FPO_MOST_EDGES];
    ps_image neighbour[PS_FPO_MOST_EDGES];
    uint32_t num, farthest; /* vertices, and the one farthest from the point */
} ps_fpo_cell;

typedef struct ps_fpo_mesh {
    size_t num;
    double *x, *y;
    ps_fpo_cell *cells;
    ps_tournament
        reach2;       /* of points: the squared distance of the farthest vertex; 0 without cell */
    ps_cell cell;     /* in the making */
    bool has_no_room; /* a cell had too many edges: the mesh is of no use */
} ps_fpo_mesh;

/* What ps_fpo_mesh_create allocates, at most. */
double ps_fpo_mesh_bytes(size_t num);

/* Of points [num][2], which it takes in the order of ps_power_cells. */
pspec_status ps_fpo_mesh_create(ps_fpo_mesh *mesh, size_t num, const double *points,
                                ps_error *error) PS_MUST_CHECK;
void ps_fpo_mesh_destroy(ps_fpo_mesh *mesh);

/* The nearest other point, an image of it, and the squared distance; -1 where no other is known. */
double ps_fpo_mesh_nearest(const ps_fpo_mesh *mesh, uint32_t p, ps_image *nearest);

/* Takes point p out. */
void ps_fpo_mesh_remove(ps_fpo_mesh *mesh, uint32_t p);

/* Puts point p, which was taken out, at (x,y) in [0,1)^2: nearest is the image of a point to which
 * no other is nearer there. */
void ps_fpo_mesh_insert(ps_fpo_mesh *mesh, uint32_t p, double x, double y, ps_image nearest);

/* The farthest place from all points: (x,y) in [0,1)^2, the image of a point that is nearest to it,
 * and the squared distance. */
double ps_fpo_mesh_farthest(const ps_fpo_mesh *mesh, double *x, double *y, ps_image *nearest);

#endif
