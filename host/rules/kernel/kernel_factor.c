#include "rules/kernel/kernel_private.h"

#include "base/memory.h"
#include "base/pieces.h"
#include "math/random/subset.h"
#include "math/sobolev.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = PS_KERNEL_NEIGHBOURS, CHUNK = PS_SOBOLEV_CHUNK };

/* A pivot below this part of c says nothing: the point is as good as one that is there. */
static const double LEAST_PIVOT = 64 * DBL_EPSILON;

typedef struct neighbour_search {
    ps_kernel_factor *factor;
    double smoothness;
    const double *points;
    uint32_t *order;          /* [num]: which point is the i-th */
    ps_sobolev_chunk *chunks; /* of points in that order */
    double *nearest;          /* [num]: distance of the i-th to those before it */
} neighbour_search;

/* The points nearest to one of them, nearest first. */
typedef struct neighbours {
    size_t num;
    double distances[MOST];
    uint32_t places[MOST]; /* in the order */
} neighbours;

uint64_t ps_kernel_factor_bytes(size_t num) {
    const uint64_t kept = MOST * (sizeof(double) + sizeof(uint32_t));
    const uint64_t chunks = 4 * sizeof(double); /* of numbers per point */
    return num * (kept + chunks + sizeof(uint32_t) + sizeof(double));
}

/* ---- neighbours ---------------------------------------------------------------------------- */

static void insert(neighbours *list, double distance, uint32_t place) {
    const size_t most = MOST - 1; /* the last entry of a row is its own point */
    size_t i = list->num < most ? list->num++ : most - 1;
    for (; i > 0 && list->distances[i - 1] > distance; i--) {
        list->distances[i] = list->distances[i - 1];
        list->places[i] = list->places[i - 1];
    }
    list->distances[i] = distance;
    list->places[i] = place;
}

static double farthest(const neighbours *list) {
    return list->num < MOST - 1 ? INFINITY : list->distances[list->num - 1];
}

/* Among the first `place` points. */
static void find_neighbours(const neighbour_search *search, size_t place, neighbours *list) {
    const double length = 1.5; /* the smoothness whose distance is |u-v| */
    const double *const u = search->points + 3 * (size_t)search->order[place];
    double distances[CHUNK];
    list->num = 0;
    for (size_t begin = 0; begin < place; begin += CHUNK) {
        const size_t num = place - begin < CHUNK ? place - begin : CHUNK;
        ps_sobolev_chunk_distances(length, u, &search->chunks[begin / CHUNK], distances);
        for (size_t j = 0; j < num; j++) {
            if (distances[j] < farthest(list)) {
                insert(list, distances[j], (uint32_t)(begin + j));
            }
        }
    }
}

/* ---- rows ---------------------------------------------------------------------------------- */

typedef struct local {
    size_t num;
    uint32_t members[MOST]; /* points */
    double factor[MOST][MOST];
} local;

static double kernel(const neighbour_search *search, uint32_t i, uint32_t j) {
    return ps_sobolev_constant(search->smoothness) -
           ps_sobolev_distance(search->smoothness, search->points + 3 * (size_t)i,
                               search->points + 3 * (size_t)j);
}

/* One more row of the Cholesky factor of the members' matrix; a member that is needed stays
 * whatever its pivot. */
static void add_member(const neighbour_search *search, local *near, uint32_t member,
                       bool is_needed) {
    const size_t n = near->num;
    const double constant = ps_sobolev_constant(search->smoothness);
    double *const row = near->factor[n];
    double pivot = constant;
    for (size_t j = 0; j < n; j++) {
        double sum = kernel(search, member, near->members[j]);
        for (size_t k = 0; k < j; k++) {
            sum -= row[k] * near->factor[j][k];
        }
        row[j] = sum / near->factor[j][j];
        pivot -= row[j] * row[j];
    }
    if (is_needed || pivot > LEAST_PIVOT * constant) {
        row[n] = sqrt(fmax(pivot, LEAST_PIVOT * constant));
        near->members[near->num++] = member;
    }
}

/* C^-T e for the last unit vector e: the row of the inverse. */
static void solve_transposed(const local *near, double *row) {
    memset(row, 0, MOST * sizeof *row);
    row[near->num - 1] = 1;
    for (size_t i = near->num; i-- > 0;) {
        row[i] /= near->factor[i][i];
        for (size_t k = 0; k < i; k++) {
            row[k] -= near->factor[i][k] * row[i];
        }
    }
}

static void make_row(const neighbour_search *search, size_t place) {
    neighbours list;
    local near = {.num = 0};
    const uint32_t own = search->order[place];
    uint32_t *const columns = search->factor->columns + place * MOST;
    find_neighbours(search, place, &list);
    for (size_t i = 0; i < list.num; i++) {
        add_member(search, &near, search->order[list.places[i]], false);
    }
    add_member(search, &near, own, true);
    solve_transposed(&near, search->factor->values + place * MOST);
    for (size_t i = 0; i < MOST; i++) {
        columns[i] = i < near.num ? near.members[i] : own; /* entries beyond are 0 */
    }
    search->nearest[place] = list.num > 0 ? list.distances[0] : INFINITY;
}

static void make_one(void *payload, size_t i) {
    make_row(payload, i);
}

/* ---- all ----------------------------------------------------------------------------------- */

static void fill_chunks(const neighbour_search *search, size_t num) {
    for (size_t begin = 0; begin < num; begin += CHUNK) {
        const size_t size = num - begin < CHUNK ? num - begin : CHUNK;
        double points[3 * CHUNK];
        for (size_t j = 0; j < size; j++) {
            memcpy(points + 3 * j, search->points + 3 * (size_t)search->order[begin + j],
                   3 * sizeof *points);
        }
        ps_sobolev_chunk_fill(&search->chunks[begin / CHUNK], size, points, NULL);
    }
}

static void find_nearest(const neighbour_search *search) {
    ps_kernel_factor *const factor = search->factor;
    neighbours list = {.num = 0};
    size_t place = 0;
    for (size_t i = 0; i < factor->num; i++) {
        place = search->nearest[i] < search->nearest[place] ? i : place;
    }
    find_neighbours(search, place, &list);
    factor->nearest = search->nearest[place];
    factor->near[0] = search->order[place];
    factor->near[1] = list.num > 0 ? search->order[list.places[0]] : factor->near[0];
}

static pspec_status allocate(ps_kernel_factor *factor, neighbour_search *search, ps_error *error) {
    const size_t num = factor->num;
    PS_TRY(ps_allocate_for(&factor->values, num, MOST * sizeof(double), "an approximate inverse",
                           error));
    PS_TRY(ps_allocate_for(&factor->columns, num, MOST * sizeof(uint32_t), "an approximate inverse",
                           error));
    PS_TRY(PS_NEW(&search->order, num, "an order of points", error));
    PS_TRY(PS_NEW(&search->nearest, num, "distances of points", error));
    PS_TRY(PS_NEW(&search->chunks, num / CHUNK + 1, "points in order", error));
    return PSPEC_OK;
}

pspec_status ps_kernel_factor_create(ps_kernel_factor *out, double smoothness, size_t num,
                                     const double *points, const ps_watch *watch, ps_error *error) {
    ps_random random = ps_random_init(0, PS_STREAM_PERMUTATION, 0);
    neighbour_search search = {.factor = out, .smoothness = smoothness, .points = points};
    *out = (ps_kernel_factor){.num = num};
    pspec_status status = allocate(out, &search, error);
    if (status == PSPEC_OK) {
        ps_random_order(&random, search.order, num);
        fill_chunks(&search, num);
        /* a row searches the points before it */
        status = ps_pieces_share(watch, "rows of an approximate inverse",
                                 num * (MOST * MOST + num / 2), num, make_one, &search, error);
    }
    if (status == PSPEC_OK) {
        find_nearest(&search);
    }
    free(search.order);
    free(search.nearest);
    free(search.chunks);
    return status;
}

void ps_kernel_factor_free(ps_kernel_factor *factor) {
    free(factor->columns);
    free(factor->values);
    *factor = (ps_kernel_factor){0};
}

void ps_kernel_factor_apply(const ps_kernel_factor *factor, const double *x, double *out) {
    memset(out, 0, factor->num * sizeof *out);
    for (size_t i = 0; i < factor->num; i++) {
        const uint32_t *const columns = factor->columns + i * MOST;
        const double *const values = factor->values + i * MOST;
        double sum = 0;
        for (size_t j = 0; j < MOST; j++) {
            sum += values[j] * x[columns[j]];
        }
        for (size_t j = 0; j < MOST; j++) {
            out[columns[j]] += values[j] * sum;
        }
    }
}
