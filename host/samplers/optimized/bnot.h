/* Blue noise through optimal transport (de Goes, Breeden, Ostromoukhov, Desbrun 2012) on the torus
 * of the plane: points each of which is the centroid of its power cell, all cells of area 1/N.
 *
 * In turns, weights are found that give all cells their area, and every point moves to the centroid
 * of its cell, which lowers the transport cost sum int |x - x_i|^2 each time, so that no move needs
 * a search. It ends where points lie within 0.015 eps / sqrt(N) of their centroids (root mean
 * square), with weights for areas right to the capacity
 * (docs/samplers/optimized.md#bnot).
 */
#ifndef PS_SAMPLERS_OPTIMIZED_BNOT_H
#define PS_SAMPLERS_OPTIMIZED_BNOT_H

#include "base/watch.h"
#include "math/random/random.h"
#include "samplers/optimized/cells.h"

#include <stddef.h>

/* Below the first, moves are so many that nobody waits for them (340 at 0.05); above the second,
 * points stay as random as they began. */
#define PS_BNOT_LEAST_EPS 0.02
#define PS_BNOT_MOST_EPS 10.0
/* How far areas may be from 1/N in the end, in units of it. */
#define PS_BNOT_CAPACITY 1e-5

typedef struct ps_bnot_outcome {
    unsigned moves;  /* of all points to their centroids */
    unsigned steps;  /* of Newton's method on weights */
    unsigned tries;  /* times that all cells were made */
    double distance; /* from the centroids, root mean square, in units of 1/sqrt(N) */
    double capacity; /* the largest |area N - 1| */
} ps_bnot_outcome;

/* Refuses a number of points and an eps outside the limits with a sentence. */
pspec_status ps_bnot_check(size_t num, double eps, ps_error *error) PS_MUST_CHECK;

/* Points [num][2], from uniform random ones. */
pspec_status ps_bnot_make(size_t num, double eps, ps_random *random, const ps_watch *watch,
                          double *points, ps_error *error) PS_MUST_CHECK;

/* The same from points [num][2] as they are; they come back in another order. weights [num] and
 * outcome may be NULL. PSPEC_ERROR_INPUT where two points coincide. */
pspec_status ps_bnot_optimise(size_t num, double eps, const ps_watch *watch, double *points,
                              double *weights, ps_bnot_outcome *outcome,
                              ps_error *error) PS_MUST_CHECK;

/* Weights that give all power cells the area 1/N: damped Newton steps on the concave dual of
 * optimal transport (Kitagawa, Merigot, Thibert 2019), each by conjugate gradients.
 */

/* Edges between two cells, each once, by the first of both: those of site i, all to later sites,
 * are first[i] .. first[i + 1] - 1. */
typedef struct ps_bnot_edges {
    uint32_t *first, *to;
    double *slope; /* d area_i / d w_j = - length / (2 distance), without its sign */
} ps_bnot_edges;

typedef struct ps_bnot {
    ps_power_cells cells;
    double *area;              /* of cells */
    double *x, *y;             /* their centroids, relative to the sites */
    double least_area, error2; /* of all cells; sum of (area - 1/N)^2 */
    double worst_area;         /* the largest |area - 1/N| */
    ps_bnot_edges edges;
    size_t most_edges;
    uint32_t *known_first[2]; /* neighbours of each site as they were last found, and before */
    ps_image *known[2];
    unsigned latest;
    bool has_known;
    double *step, *kept;                               /* Newton's, and the weights before it */
    double *diagonal, *residual, *direction, *product; /* of conjugate gradients */
    const ps_watch *watch;
    unsigned num_moves, num_steps, num_tries;
    ps_cell cell;
} ps_bnot;

/* What ps_bnot_create allocates. */
double ps_bnot_bytes(size_t num);

pspec_status ps_bnot_create(ps_bnot *bnot, size_t num, const double *points, const ps_watch *watch,
                            ps_error *error) PS_MUST_CHECK;
void ps_bnot_destroy(ps_bnot *bnot);

/* PSPEC_ERROR_CANCELLED when the watch asks to stop. */
static inline pspec_status ps_bnot_go_on(const ps_bnot *bnot, ps_error *error) {
    return ps_watch_tell(bnot->watch, "sampler: bnot, moves of all points", bnot->num_moves, 0,
                         NULL, error);
}

/* What areas must be right to: root mean square and worst error, in units of 1/N. */
typedef struct ps_bnot_target {
    double rms, worst;
} ps_bnot_target;

/* All cells with the weights as they are. least_area is 0 when a cell is empty, and the rest of the
 * cells are then left out. */
pspec_status ps_bnot_evaluate(ps_bnot *bnot, ps_error *error) PS_MUST_CHECK;

/* Newton steps from weights that were evaluated and leave no cell empty. */
pspec_status ps_bnot_solve(ps_bnot *bnot, ps_bnot_target target, ps_error *error) PS_MUST_CHECK;

/* step = the solution of (d area / d w) step = 1/N - area, to a fraction of the right side. */
pspec_status ps_bnot_newton_step(ps_bnot *bnot, double fraction, ps_error *error) PS_MUST_CHECK;

#endif
