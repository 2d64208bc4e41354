#include "samplers/optimized/bnot.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Cells between two looks at the watch: some milliseconds. */
enum { CELLS_AT_A_TIME = 1 << 12 };
/* Neighbours of all cells are 6 N, each edge counted from both sides; rounding may add edges of no
 * length to that where four cells meet. */
enum { NEIGHBOURS_PER_CELL = 8 };
/* A Newton step may be halved this often, and there may be so many: points in a square of side 1e-5
 * took 24 steps and 20 halvings of one; two points at a distance of 1e-12 never end. */
enum { MOST_HALVINGS = 40, MOST_STEPS = 100 };
/* What conjugate gradients leave of the right side, in their norm. bench_cells bnot at N = 4096
 * makes all cells 27 times with 0.01, 30 with 0.03, 39 with 0.1; with 0.3 a step may lead nowhere.
 */
static const double LEFT_OF_STEP = 0.01;

static pspec_status allocate(ps_bnot *b, size_t num, ps_error *error) {
    double **const numbers[] = {&b->area,     &b->x,        &b->y,         &b->step,   &b->kept,
                                &b->diagonal, &b->residual, &b->direction, &b->product};
    for (unsigned k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
        PS_TRY(PS_NEW(numbers[k], num, "areas and weights of cells", error));
    }
    b->most_edges = NEIGHBOURS_PER_CELL * num;
    for (unsigned k = 0; k < 2; k++) {
        PS_TRY(PS_NEW(&b->known[k], b->most_edges, "neighbours of cells", error));
        PS_TRY(PS_NEW(&b->known_first[k], num + 1, "neighbours of cells", error));
    }
    PS_TRY(PS_NEW(&b->edges.first, num + 1, "edges of cells", error));
    PS_TRY(PS_NEW(&b->edges.to, b->most_edges, "edges of cells", error));
    return PS_NEW(&b->edges.slope, b->most_edges, "edges of cells", error);
}

double ps_bnot_bytes(size_t num) {
    const size_t numbers = 9;
    const size_t of_edge = 2 * sizeof(ps_image) + sizeof *((ps_bnot *)NULL)->edges.to +
                           sizeof *((ps_bnot *)NULL)->edges.slope;
    const size_t first = 3 * sizeof(uint32_t);
    return ps_power_cells_bytes(num) +
           (double)num * (double)(numbers * sizeof(double) + NEIGHBOURS_PER_CELL * of_edge + first);
}

pspec_status ps_bnot_create(ps_bnot *b, size_t num, const double *points, const ps_watch *watch,
                            ps_error *error) {
    *b = (ps_bnot){.watch = watch};
    PS_TRY(ps_power_cells_create(&b->cells, num, points, error));
    const pspec_status status = allocate(b, num, error);
    if (status != PSPEC_OK) {
        ps_bnot_destroy(b);
    }
    return status;
}

void ps_bnot_destroy(ps_bnot *b) {
    double *const numbers[] = {b->area,     b->x,        b->y,         b->step,   b->kept,
                               b->diagonal, b->residual, b->direction, b->product};
    for (unsigned k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
        free(numbers[k]);
    }
    for (unsigned k = 0; k < 2; k++) {
        free(b->known[k]);
        free(b->known_first[k]);
    }
    free(b->edges.first);
    free(b->edges.to);
    free(b->edges.slope);
    ps_power_cells_destroy(&b->cells);
}

/* Neighbours of site i for the next time, and its edges to later sites for the matrix. */
static void keep_edges(ps_bnot *b, uint32_t i, uint32_t *num_known, uint32_t *num_edges) {
    const ps_polygon *const polygon = ps_cell_polygon(&b->cell);
    for (unsigned k = 0; k < polygon->num; k++) {
        const ps_image image = polygon->neighbour[k];
        const uint32_t j = ps_image_site(image);
        b->known[b->latest][(*num_known)++] = image;
        if (j > i) {
            const unsigned next = k + 1 == polygon->num ? 0 : k + 1;
            const double ex = polygon->x[next] - polygon->x[k];
            const double ey = polygon->y[next] - polygon->y[k];
            const double dx = b->cells.x[j] + ps_image_a(image) - b->cells.x[i];
            const double dy = b->cells.y[j] + ps_image_b(image) - b->cells.y[i];
            b->edges.to[*num_edges] = j;
            b->edges.slope[(*num_edges)++] = 0.5 * sqrt((ex * ex + ey * ey) / (dx * dx + dy * dy));
        }
    }
}

static void keep_moments(ps_bnot *b, size_t i, double mean) {
    const ps_cell_moments moments = ps_polygon_moments(ps_cell_polygon(&b->cell));
    const double away = fabs(moments.area - mean);
    b->area[i] = moments.area;
    b->x[i] = moments.x;
    b->y[i] = moments.y;
    b->error2 += away * away;
    b->worst_area = away > b->worst_area ? away : b->worst_area;
    b->least_area = moments.area < b->least_area ? moments.area : b->least_area;
}

static pspec_status fail_edges(const ps_bnot *b, size_t i, ps_error *error) {
    return b->cell.has_no_room ? ps_power_cells_fail_room(&b->cells, i, error)
                               : ps_fail(error, PSPEC_ERROR_INPUT,
                                         "cells of %zu points have more than %zu edges: many "
                                         "points lie on circles",
                                         b->cells.num, b->most_edges);
}

/* Cells first .. end - 1. */
static pspec_status evaluate_some(ps_bnot *b, size_t first, size_t end, uint32_t *num_known,
                                  uint32_t *num_edges, ps_error *error) {
    const double mean = 1 / (double)b->cells.num;
    const ps_image *const known = b->known[1 - b->latest];
    const uint32_t *const known_first = b->known_first[1 - b->latest];
    for (size_t i = first; i < end && b->least_area > 0; i++) {
        const size_t num = b->has_known ? known_first[i + 1] - known_first[i] : 0;
        ps_power_cells_clip(&b->cells, i, num == 0 ? NULL : known + known_first[i], num, &b->cell);
        if (b->cell.has_no_room || *num_known + ps_cell_polygon(&b->cell)->num > b->most_edges) {
            return fail_edges(b, i, error);
        }
        keep_moments(b, i, mean);
        keep_edges(b, (uint32_t)i, num_known, num_edges);
        b->known_first[b->latest][i + 1] = *num_known;
        b->edges.first[i + 1] = *num_edges;
    }
    return PSPEC_OK;
}

pspec_status ps_bnot_evaluate(ps_bnot *b, ps_error *error) {
    const size_t num = b->cells.num;
    uint32_t num_known = 0;
    uint32_t num_edges = 0;
    b->latest = 1 - b->latest;
    b->num_tries++;
    b->error2 = 0;
    b->worst_area = 0;
    b->least_area = 1;
    for (size_t first = 0; first < num; first += CELLS_AT_A_TIME) {
        const size_t end = first + CELLS_AT_A_TIME < num ? first + CELLS_AT_A_TIME : num;
        PS_TRY(ps_bnot_go_on(b, error));
        PS_TRY(evaluate_some(b, first, end, &num_known, &num_edges, error));
    }
    b->has_known = b->least_area > 0;
    return PSPEC_OK;
}

static bool is_met(const ps_bnot *b, ps_bnot_target target) {
    const double num = (double)b->cells.num;
    return sqrt(b->error2 * num) <= target.rms && b->worst_area * num <= target.worst;
}

/* Halves the step until no cell is near to empty and errors of areas have become less by a share of
 * what the step promised. */
static pspec_status take_step(ps_bnot *b, double floor_area, ps_error *error) {
    const size_t num = b->cells.num;
    const double before = sqrt(b->error2);
    double length = 1;
    for (size_t i = 0; i < num; i++) {
        b->kept[i] = b->cells.w[i];
    }
    for (unsigned k = 0; k < MOST_HALVINGS; k++, length /= 2) {
        for (size_t i = 0; i < num; i++) {
            b->cells.w[i] = b->kept[i] + length * b->step[i];
        }
        ps_power_cells_weigh(&b->cells);
        PS_TRY(ps_bnot_evaluate(b, error));
        if (b->least_area >= floor_area && sqrt(b->error2) <= (1 - length / 2) * before) {
            return PSPEC_OK;
        }
    }
    return ps_fail(error, PSPEC_ERROR_CHECK,
                   "no step brings the areas of the cells of %zu points nearer to 1/N than %.3g/N",
                   num, before * sqrt((double)num));
}

pspec_status ps_bnot_solve(ps_bnot *b, ps_bnot_target target, ps_error *error) {
    const double mean = 1 / (double)b->cells.num;
    const double floor_area = (b->least_area < mean ? b->least_area : mean) / 2;
    for (unsigned k = 0; !is_met(b, target); k++) {
        if (k == MOST_STEPS) {
            return ps_fail(error, PSPEC_ERROR_CHECK,
                           "areas of the cells of %zu points are not 1/N after %d steps",
                           b->cells.num, MOST_STEPS);
        }
        PS_TRY(ps_bnot_newton_step(b, LEFT_OF_STEP, error));
        PS_TRY(take_step(b, floor_area, error));
        b->num_steps++;
    }
    return PSPEC_OK;
}
