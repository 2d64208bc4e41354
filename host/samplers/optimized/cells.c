#include "samplers/optimized/cells.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Sites in a square on average. bench_cells bnot takes the same time with 1 to 2, and 1.3 times
 * that with 0.5. */
static const double SITES_IN_SQUARE = 1.0;

pspec_status ps_power_cells_check(size_t num, ps_error *error) {
    if (num < PS_CELLS_LEAST_POINTS || num > PS_CELLS_MOST_POINTS) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%zu points: cells of the torus are optimised from %d to %d points", num,
                       PS_CELLS_LEAST_POINTS, PS_CELLS_MOST_POINTS);
    }
    return PSPEC_OK;
}

static pspec_status allocate(ps_power_cells *cells, ps_error *error) {
    const size_t num = cells->num;
    const size_t num_squares = (size_t)cells->side * cells->side;
    PS_TRY(PS_NEW(&cells->x, num, "sites of cells", error));
    PS_TRY(PS_NEW(&cells->y, num, "sites of cells", error));
    PS_TRY(PS_NEW(&cells->w, num, "weights of cells", error));
    for (unsigned a = 0; a < 3; a++) {
        PS_TRY(PS_NEW(&cells->spare[a], num, "sites of cells, sorted", error));
    }
    PS_TRY(PS_NEW(&cells->square, num, "squares of sites", error));
    return PS_NEW(&cells->first, num_squares + 1, "squares of the torus", error);
}

double ps_power_cells_bytes(size_t num) {
    const size_t numbers = 6;
    return (double)num * (double)(numbers * sizeof(double) + 2 * sizeof(uint32_t));
}

pspec_status ps_power_cells_create(ps_power_cells *cells, size_t num, const double *points,
                                   ps_error *error) {
    *cells = (ps_power_cells){.num = num};
    PS_TRY(ps_power_cells_check(num, error));
    cells->side = (unsigned)sqrt((double)num / SITES_IN_SQUARE);
    const pspec_status status = allocate(cells, error);
    if (status != PSPEC_OK) {
        ps_power_cells_destroy(cells);
        return status;
    }
    for (size_t i = 0; i < num; i++) {
        cells->x[i] = points[2 * i];
        cells->y[i] = points[2 * i + 1];
    }
    ps_power_cells_sort(cells);
    return PSPEC_OK;
}

void ps_power_cells_destroy(ps_power_cells *cells) {
    free(cells->x);
    free(cells->y);
    free(cells->w);
    for (unsigned a = 0; a < 3; a++) {
        free(cells->spare[a]);
    }
    free(cells->first);
    free(cells->square);
    *cells = (ps_power_cells){0};
}

static unsigned square_along(const ps_power_cells *cells, double x) {
    const unsigned c = (unsigned)(x * cells->side);
    return c < cells->side ? c : cells->side - 1;
}

static void swap(double **a, double **b) {
    double *const kept = *a;
    *a = *b;
    *b = kept;
}

void ps_power_cells_weigh(ps_power_cells *cells) {
    double most = cells->w[0];
    for (size_t i = 1; i < cells->num; i++) {
        most = cells->w[i] > most ? cells->w[i] : most;
    }
    cells->most_weight = most;
}

/* Counting sort, which keeps the order within a square. */
void ps_power_cells_sort(ps_power_cells *cells) {
    const size_t num_squares = (size_t)cells->side * cells->side;
    uint32_t *const first = cells->first;
    for (size_t s = 0; s <= num_squares; s++) {
        first[s] = 0;
    }
    for (size_t i = 0; i < cells->num; i++) {
        cells->square[i] =
            square_along(cells, cells->x[i]) + cells->side * square_along(cells, cells->y[i]);
        first[cells->square[i] + 1]++;
    }
    for (size_t s = 0; s < num_squares; s++) {
        first[s + 1] += first[s];
    }
    for (size_t i = 0; i < cells->num; i++) {
        const uint32_t place = first[cells->square[i]]++;
        cells->spare[0][place] = cells->x[i];
        cells->spare[1][place] = cells->y[i];
        cells->spare[2][place] = cells->w[i];
    }
    for (size_t s = num_squares; s > 0; s--) {
        first[s] = first[s - 1];
    }
    first[0] = 0;
    swap(&cells->x, &cells->spare[0]);
    swap(&cells->y, &cells->spare[1]);
    swap(&cells->w, &cells->spare[2]);
    ps_power_cells_weigh(cells);
}

/* What stays the same while the cell of one site is made. */
typedef struct clipping {
    const ps_power_cells *cells;
    uint32_t site;
    double x, y, w;
    ps_cell *cell;
    const ps_image *known;
    size_t num_known;
} clipping;

/* Cuts by the image at (dx,dy) of site j. */
static void cut_by(const clipping *c, uint32_t j, double dx, double dy, ps_image image) {
    const double d2 = dx * dx + dy * dy;
    double height = (d2 + c->w - c->cells->w[j]) * 0.5;
    if (!ps_cell_is_reached(c->cell, d2, height)) {
        return;
    }
    if (d2 == 0 && height == 0) { /* at the same place with the same weight: one of them is empty */
        height = j < c->site ? -1 : 1;
    }
    if (c->num_known == 0 || !ps_polygon_has(ps_cell_polygon(c->cell), image)) {
        ps_cell_cut(c->cell, dx, dy, height, image);
    }
}

static void cut_by_known(const clipping *c) {
    for (size_t k = 0; k < c->num_known; k++) {
        const ps_image image = c->known[k];
        const uint32_t j = ps_image_site(image);
        if (j != c->site) {
            cut_by(c, j, c->cells->x[j] + ps_image_a(image) - c->x,
                   c->cells->y[j] + ps_image_b(image) - c->y, image);
        }
    }
}

/* By the sites of squares from column0 to column1 of a row, none of which may cross the edge of the
 * torus; they are those of the image (a, b). Most cannot reach the cell: the loop is about them. */
static void cut_by_run(const clipping *c, unsigned row, unsigned column0, unsigned column1, int a,
                       int b) {
    const uint32_t *const first = c->cells->first + (size_t)row * c->cells->side;
    const double *const xs = c->cells->x;
    const double *const ys = c->cells->y;
    const double *const ws = c->cells->w;
    const double x = c->x - a;
    const double y = c->y - b;
    const double w = c->w;
    const uint32_t end = first[column1 + 1];
    double reach2 = c->cell->reach2;
    for (uint32_t j = first[column0]; j < end; j++) {
        const double dx = xs[j] - x;
        const double dy = ys[j] - y;
        const double d2 = dx * dx + dy * dy;
        const double height = (d2 + w - ws[j]) * 0.5;
        if ((height <= 0 || height * height < reach2 * d2) && j != c->site) {
            cut_by(c, j, dx, dy, ps_image_of(j, a, b));
            reach2 = c->cell->reach2;
        }
    }
}

/* The period that square s of an axis lies in, and its number there. Squares further than a period
 * away have no image that matters. */
static int period_of(const ps_power_cells *cells, int s) {
    return s < 0 ? -1 : s >= (int)cells->side ? 1 : 0;
}

/* Squares from column0 to column1 of a row, both counted from those of the torus without end. */
static void cut_by_row(const clipping *c, int row, int column0, int column1) {
    const int side = (int)c->cells->side;
    if (row < -side || row >= 2 * side) {
        return;
    }
    const int b = period_of(c->cells, row);
    const int from = column0 < -side ? -side : column0;
    const int to = column1 >= 2 * side ? 2 * side - 1 : column1;
    for (int s = from; s <= to;) {
        const int a = period_of(c->cells, s);
        const int end = (a + 1) * side - 1;
        const int last = end < to ? end : to;
        cut_by_run(c, (unsigned)(row - b * side), (unsigned)(s - a * side),
                   (unsigned)(last - a * side), a, b);
        s = last + 1;
    }
}

/* The squares at distance ring from the site's own. */
static void cut_by_ring(const clipping *c, int column, int row, int ring) {
    cut_by_row(c, row - ring, column - ring, column + ring);
    for (int dy = 1 - ring; dy < ring; dy++) {
        cut_by_row(c, row + dy, column - ring, column - ring);
        cut_by_row(c, row + dy, column + ring, column + ring);
    }
    cut_by_row(c, row + ring, column - ring, column + ring);
}

/* How far a site can be and still cut: beyond D > R + sqrt(R^2 + w_most - w) none does. */
static double cutting_distance(const clipping *c) {
    const double reach2 = c->cell->reach2;
    const double under = reach2 + (c->cells->most_weight - c->w);
    return under < 0 ? 0 : sqrt(reach2) + sqrt(under);
}

static double least(double a, double b) {
    return a < b ? a : b;
}

void ps_power_cells_clip(const ps_power_cells *cells, size_t i, const ps_image *known,
                         size_t num_known, ps_cell *cell) {
    const clipping c = {.cells = cells,
                        .site = (uint32_t)i,
                        .x = cells->x[i],
                        .y = cells->y[i],
                        .w = cells->w[i],
                        .cell = cell,
                        .known = known,
                        .num_known = num_known};
    const int column = (int)square_along(cells, c.x);
    const int row = (int)square_along(cells, c.y);
    const double width = 1.0 / cells->side;
    const double in_x = c.x - column * width;
    const double in_y = c.y - row * width;
    const double margin = least(least(in_x, width - in_x), least(in_y, width - in_y));
    ps_cell_start(cell, c.site);
    cut_by_known(&c);
    cut_by_row(&c, row, column - 1, column + 1);
    cut_by_row(&c, row - 1, column - 1, column + 1);
    cut_by_row(&c, row + 1, column - 1, column + 1);
    for (int ring = 2;
         ring <= (int)cells->side + 1 && (ring - 1) * width + margin < cutting_distance(&c);
         ring++) {
        cut_by_ring(&c, column, row, ring);
    }
}

pspec_status ps_power_cells_fail_room(const ps_power_cells *cells, size_t i, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "the cell of the point (%.17g, %.17g) has more than %d edges", cells->x[i],
                   cells->y[i], PS_CELL_MOST_EDGES);
}
