/* Weights that give all power cells the area 1/N: damped Newton steps on the concave dual of
 * optimal transport (Kitagawa, Merigot, Thibert 2019), each by conjugate gradients.
 */
#ifndef PS_SAMPLERS_OPTIMIZED_BNOT_WEIGHTS_H
#define PS_SAMPLERS_OPTIMIZED_BNOT_WEIGHTS_H

#include "base/watch.h"
#include "samplers/optimized/cells.h"

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
