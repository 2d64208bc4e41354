#include "rules/distance_cells.h"

#include "base/memory.h"
#include "base/workers.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FACES = 6, AXES = 3, QUARTERS = 4, LEVEL_BITS = 2 };
/* Squares along a face at the last level. */
#define MOST_SQUARES ((double)(1u << PS_CELL_LEVELS))

/* ---- faces --------------------------------------------------------------------------------- */

/* A direction meets the face of its largest coordinate, at a, b in [-1,1]. */
static unsigned find_face(const double u[3], double *a, double *b) {
    unsigned axis = 0;
    for (unsigned i = 1; i < AXES; i++) {
        axis = fabs(u[i]) > fabs(u[axis]) ? i : axis;
    }
    const double size = fabs(u[axis]);
    *a = size > 0 ? u[(axis + 1) % AXES] / size : 0;
    *b = size > 0 ? u[(axis + 2) % AXES] / size : 0;
    return 2 * axis + (u[axis] < 0 ? 1 : 0);
}

static void find_direction(unsigned face, double a, double b, double u[3]) {
    const unsigned axis = face / 2;
    const double length = sqrt(1 + a * a + b * b);
    u[axis] = (face % 2 == 1 ? -1 : 1) / length;
    u[(axis + 1) % AXES] = a / length;
    u[(axis + 2) % AXES] = b / length;
}

/* Of a square: the middle, and half of the side. */
static double middle_of(const ps_cell *cell, uint32_t square, double *half) {
    *half = 1 / (double)(1u << cell->level);
    return (2 * (double)square + 1) * *half - 1;
}

/* ---- order --------------------------------------------------------------------------------- */

typedef struct place {
    uint64_t key; /* face, then bits of both squares by turns */
    size_t point;
} place;

static uint32_t find_square(double x) {
    const double square = floor((x + 1) * (MOST_SQUARES / 2));
    return (uint32_t)fmin(fmax(square, 0), MOST_SQUARES - 1);
}

static uint64_t key_of(const double u[3]) {
    double a = 0;
    double b = 0;
    uint64_t key = find_face(u, &a, &b);
    const uint32_t squares[2] = {find_square(a), find_square(b)};
    for (unsigned bit = PS_CELL_LEVELS; bit-- > 0;) {
        key = key << LEVEL_BITS | (squares[0] >> bit & 1) << 1 | (squares[1] >> bit & 1);
    }
    return key;
}

static int compare_places(const void *left, const void *right) {
    const place *const x = left;
    const place *const y = right;
    if (x->key != y->key) {
        return x->key < y->key ? -1 : 1;
    }
    return x->point < y->point ? -1 : x->point > y->point ? 1 : 0;
}

/* ---- cells --------------------------------------------------------------------------------- */

static void measure(ps_cell *cell) {
    double half = 0;
    const double a = middle_of(cell, cell->a, &half);
    const double b = middle_of(cell, cell->b, &half);
    find_direction(cell->face, a, b, cell->centre);
    for (int corner = 0; corner < QUARTERS; corner++) {
        double u[3];
        find_direction(cell->face, a + (corner & 1 ? half : -half), b + (corner & 2 ? half : -half),
                       u);
        cell->radius = fmax(cell->radius, ps_sobolev_distance(1.5, cell->centre, u));
    }
}

/* Ends a cell's range where keys, less the levels below, change. */
static size_t find_end(const place *places, size_t begin, size_t end, unsigned level) {
    const unsigned below = LEVEL_BITS * (PS_CELL_LEVELS - level);
    size_t low = begin;
    size_t high = end;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        const bool is_same = places[middle].key >> below == places[begin].key >> below;
        low = is_same ? middle : low;
        high = is_same ? high : middle;
    }
    return high;
}

/* Appends the cells of a level that points of a range are in; returns how many. */
static unsigned append(ps_cells *cells, const place *places, size_t begin, size_t end,
                       const ps_cell *parent) {
    const unsigned level = parent != NULL ? parent->level + 1 : 0;
    unsigned num = 0;
    while (begin < end) {
        const uint64_t key = places[begin].key >> (LEVEL_BITS * (PS_CELL_LEVELS - level));
        ps_cell *const cell = &cells->cells[cells->num++];
        *cell = (ps_cell){.begin = begin, .level = level, .face = (unsigned)key};
        if (parent != NULL) {
            cell->face = parent->face;
            cell->a = 2 * parent->a + (uint32_t)(key >> 1 & 1);
            cell->b = 2 * parent->b + (uint32_t)(key & 1);
        }
        cell->end = find_end(places, begin, end, level);
        measure(cell);
        begin = cell->end;
        num++;
    }
    return num;
}

/* Chunks of a cell, whose children are known. */
static void count_chunks(ps_cells *cells, ps_cell *cell) {
    const size_t num = cell->end - cell->begin;
    if (cell->num_children == 0) {
        cell->points = cells->num_chunks;
        cell->num_points = (num + PS_SOBOLEV_CHUNK - 1) / PS_SOBOLEV_CHUNK;
        cells->num_chunks += cell->num_points;
        cells->largest = num > cells->largest ? num : cells->largest;
    }
    if (num > PS_CELL_PROXIES && cell->level >= PS_CELL_FLAT) {
        cell->proxies = cells->num_chunks;
        cell->num_proxies = PS_CELL_PROXIES / PS_SOBOLEV_CHUNK;
        cells->num_chunks += cell->num_proxies;
    }
}

/* Cells of all levels: those of a level that are cut have more than PS_CELL_MOST points each. */
static size_t most_cells(size_t num_points) {
    return FACES + QUARTERS * PS_CELL_LEVELS * (num_points / PS_CELL_MOST);
}

static pspec_status cut(ps_cells *out, size_t num, const place *places, ps_error *error) {
    PS_TRY(PS_NEW(&out->cells, most_cells(num), "cells of points", error));
    append(out, places, 0, num, NULL);
    for (size_t i = 0; i < out->num; i++) {
        ps_cell *const cell = &out->cells[i];
        if (cell->end - cell->begin > PS_CELL_MOST && cell->level < PS_CELL_LEVELS) {
            cell->children = out->num;
            cell->num_children = append(out, places, cell->begin, cell->end, cell);
        }
        count_chunks(out, cell);
    }
    return PSPEC_OK;
}

pspec_status ps_cells_create(ps_cells *out, const ps_rule *rule, ps_error *error) {
    const size_t num = rule->num_points;
    place *places = NULL;
    *out = (ps_cells){0};
    PS_TRY(PS_NEW(&out->order, num, "the order of points", error));
    PS_TRY(PS_NEW(&places, num, "places of points", error));
    for (size_t j = 0; j < num; j++) {
        places[j] = (place){key_of(rule->points + AXES * j), j};
    }
    qsort(places, num, sizeof *places, compare_places);
    for (size_t j = 0; j < num; j++) {
        out->order[j] = places[j].point;
    }
    const pspec_status status = cut(out, num, places, error);
    free(places);
    return status;
}

void ps_cells_free(ps_cells *cells) {
    free(cells->cells);
    free(cells->chunks);
    free(cells->order);
    *cells = (ps_cells){0};
}

/* ---- proxies ------------------------------------------------------------------------------- */

/* Chebyshev points of [-1,1], and their weights in the barycentric formula. */
typedef struct cell_nodes {
    double x[PS_CELL_NODES], weights[PS_CELL_NODES];
} cell_nodes;

static cell_nodes make_nodes(void) {
    cell_nodes out;
    for (int k = 0; k < PS_CELL_NODES; k++) {
        const double angle = (2 * k + 1) * PS_PI / (2 * PS_CELL_NODES);
        out.x[k] = cos(angle);
        out.weights[k] = (k % 2 == 1 ? -1 : 1) * sin(angle);
    }
    return out;
}

/* What the polynomials that are 1 at one node and 0 at the others are at x. */
static void interpolate(const cell_nodes *nodes, double x, double values[PS_CELL_NODES]) {
    double sum = 0;
    for (int k = 0; k < PS_CELL_NODES; k++) {
        const double distance = x - nodes->x[k];
        if (distance == 0) {
            memset(values, 0, PS_CELL_NODES * sizeof *values);
            values[k] = 1;
            return;
        }
        values[k] = nodes->weights[k] / distance;
        sum += values[k];
    }
    for (int k = 0; k < PS_CELL_NODES; k++) {
        values[k] /= sum;
    }
}

typedef struct filling {
    ps_cells *cells;
    const ps_rule *rule;
    cell_nodes nodes;
} filling;

static double weight_at(const filling *work, size_t at) {
    const double *const weights = work->rule->weights;
    return weights != NULL ? weights[work->cells->order[at]] : 1;
}

/* Adds what a point gives to the weight of every proxy. */
static void share_point(const filling *work, const ps_cell *cell, size_t at, double *weights) {
    double half = 0;
    double a = 0;
    double b = 0;
    double of_a[PS_CELL_NODES];
    double of_b[PS_CELL_NODES];
    const double weight = weight_at(work, at);
    find_face(work->rule->points + AXES * work->cells->order[at], &a, &b);
    const double middle_a = middle_of(cell, cell->a, &half);
    const double middle_b = middle_of(cell, cell->b, &half);
    interpolate(&work->nodes, (a - middle_a) / half, of_a);
    interpolate(&work->nodes, (b - middle_b) / half, of_b);
    for (int i = 0; i < PS_CELL_NODES; i++) {
        const double row = weight * of_a[i];
        for (int j = 0; j < PS_CELL_NODES; j++) {
            weights[i * PS_CELL_NODES + j] += row * of_b[j];
        }
    }
}

static void fill_chunks(ps_cells *cells, size_t first, size_t num, const double *points,
                        const double *weights) {
    for (size_t begin = 0; begin < num; begin += PS_SOBOLEV_CHUNK) {
        const size_t left = num - begin;
        ps_sobolev_chunk_fill(&cells->chunks[first + begin / PS_SOBOLEV_CHUNK],
                              left < PS_SOBOLEV_CHUNK ? left : PS_SOBOLEV_CHUNK,
                              points + AXES * begin, weights + begin);
    }
}

static void fill_proxies(const filling *work, const ps_cell *cell) {
    double points[AXES * PS_CELL_PROXIES];
    double weights[PS_CELL_PROXIES] = {0};
    double half = 0;
    const double a = middle_of(cell, cell->a, &half);
    const double b = middle_of(cell, cell->b, &half);
    for (int i = 0; i < PS_CELL_PROXIES; i++) {
        find_direction(cell->face, a + half * work->nodes.x[i / PS_CELL_NODES],
                       b + half * work->nodes.x[i % PS_CELL_NODES], points + AXES * i);
    }
    for (size_t at = cell->begin; at < cell->end; at++) {
        share_point(work, cell, at, weights);
    }
    fill_chunks(work->cells, cell->proxies, PS_CELL_PROXIES, points, weights);
}

static void fill_points(const filling *work, const ps_cell *cell) {
    for (size_t c = 0; c < cell->num_points; c++) {
        const size_t begin = cell->begin + c * PS_SOBOLEV_CHUNK;
        const size_t left = cell->end - begin;
        const size_t num = left < PS_SOBOLEV_CHUNK ? left : PS_SOBOLEV_CHUNK;
        double points[AXES * PS_SOBOLEV_CHUNK];
        double weights[PS_SOBOLEV_CHUNK];
        for (size_t i = 0; i < num; i++) {
            memcpy(points + AXES * i, work->rule->points + AXES * work->cells->order[begin + i],
                   AXES * sizeof *points);
            weights[i] = weight_at(work, begin + i);
        }
        fill_chunks(work->cells, cell->points + c, num, points, weights);
    }
}

static void fill_cells(void *payload, unsigned index, unsigned count) {
    const filling *const work = payload;
    for (size_t i = index; i < work->cells->num; i += count) {
        const ps_cell *const cell = &work->cells->cells[i];
        fill_points(work, cell);
        if (cell->num_proxies > 0) {
            fill_proxies(work, cell);
        }
    }
}

pspec_status ps_cells_fill(ps_cells *cells, const ps_rule *rule, ps_error *error) {
    filling work = {cells, rule, make_nodes()};
    PS_TRY(PS_NEW(&cells->chunks, cells->num_chunks, "points of cells", error));
    ps_workers_share(rule->num_points * PS_CELL_NODES, fill_cells, &work);
    return PSPEC_OK;
}
