#include "samplers/optimized/fpo_mesh.h"

#include "base/memory.h"

#include <stdlib.h>

/* ---- a tournament ---------------------------------------------------------------------------- */

/* The winner of two children, 2 k and 2 k + 1 of node k. */
static uint32_t winner_of(const ps_tournament *t, uint32_t k) {
    const uint32_t half = t->num_leaves / 2;
    const uint32_t left = k < half ? t->winners[2 * k] : 2 * (k - half);
    const uint32_t right = k < half ? t->winners[2 * k + 1] : 2 * (k - half) + 1;
    return t->keys[right] > t->keys[left] ? right : left;
}

pspec_status ps_tournament_create(ps_tournament *t, size_t num, ps_error *error) {
    *t = (ps_tournament){.num_leaves = 2};
    while (t->num_leaves < num) {
        t->num_leaves *= 2;
    }
    PS_TRY(PS_NEW(&t->keys, t->num_leaves, "a tournament", error));
    const pspec_status status = PS_NEW(&t->winners, t->num_leaves, "a tournament", error);
    if (status != PSPEC_OK) {
        ps_tournament_destroy(t);
        return status;
    }
    for (size_t i = num; i < t->num_leaves; i++) {
        t->keys[i] = -1;
    }
    for (uint32_t k = t->num_leaves - 1; k > 0; k--) {
        t->winners[k] = winner_of(t, k);
    }
    return PSPEC_OK;
}

void ps_tournament_destroy(ps_tournament *t) {
    free(t->keys);
    free(t->winners);
    *t = (ps_tournament){0};
}

/* Up to where another wins that won before: nothing changes above. */
void ps_tournament_set(ps_tournament *t, uint32_t i, double key) {
    t->keys[i] = key;
    for (uint32_t k = (t->num_leaves + i) / 2; k > 0; k /= 2) {
        const uint32_t winner = winner_of(t, k);
        if (winner == t->winners[k] && winner != i) {
            return;
        }
        t->winners[k] = winner;
    }
}

/* Keeps the cell that was made as that of point i. */
static void keep_cell(ps_fpo_mesh *mesh, uint32_t i) {
    const ps_polygon *const polygon = ps_cell_polygon(&mesh->cell);
    ps_fpo_cell *const kept = &mesh->cells[i];
    if (polygon->num > PS_FPO_MOST_EDGES || mesh->cell.has_no_room) {
        mesh->has_no_room = true;
        return;
    }
    double most = 0;
    kept->num = polygon->num;
    kept->farthest = 0;
    for (uint32_t k = 0; k < polygon->num; k++) {
        const double r2 = polygon->x[k] * polygon->x[k] + polygon->y[k] * polygon->y[k];
        kept->x[k] = polygon->x[k];
        kept->y[k] = polygon->y[k];
        kept->neighbour[k] = polygon->neighbour[k];
        kept->farthest = r2 > most ? k : kept->farthest;
        most = r2 > most ? r2 : most;
    }
    ps_tournament_set(&mesh->reach2, i, most);
}

static void load_cell(ps_fpo_mesh *mesh, uint32_t i) {
    const ps_fpo_cell *const kept = &mesh->cells[i];
    ps_polygon *const polygon = &mesh->cell.polygons[0];
    for (uint32_t k = 0; k < kept->num; k++) {
        polygon->x[k] = kept->x[k];
        polygon->y[k] = kept->y[k];
        polygon->neighbour[k] = kept->neighbour[k];
    }
    polygon->num = kept->num;
    mesh->cell.current = 0;
    mesh->cell.has_no_room = false;
    mesh->cell.reach2 = mesh->reach2.keys[i];
}

static void empty_cell(ps_fpo_mesh *mesh, uint32_t i) {
    mesh->cells[i].num = 0;
    ps_tournament_set(&mesh->reach2, i, 0);
}

static pspec_status allocate(ps_fpo_mesh *mesh, size_t num, ps_error *error) {
    PS_TRY(PS_NEW(&mesh->x, num, "points", error));
    PS_TRY(PS_NEW(&mesh->y, num, "points", error));
    PS_TRY(PS_NEW(&mesh->cells, num, "cells of points", error));
    return ps_tournament_create(&mesh->reach2, num, error);
}

/* Cells of the plane are there while the mesh is filled; a tournament has up to two leaves a point.
 */
double ps_fpo_mesh_bytes(size_t num) {
    const size_t leaf = sizeof(double) + sizeof(uint32_t);
    return ps_power_cells_bytes(num) +
           (double)num * (double)(2 * sizeof(double) + sizeof(ps_fpo_cell) + 2 * leaf);
}

static pspec_status fill(ps_fpo_mesh *mesh, const ps_power_cells *cells, ps_error *error) {
    for (size_t i = 0; i < mesh->num; i++) {
        mesh->x[i] = cells->x[i];
        mesh->y[i] = cells->y[i];
        ps_power_cells_clip(cells, i, NULL, 0, &mesh->cell);
        if (ps_cell_polygon(&mesh->cell)->num == 0) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "two of the %zu points are at (%.17g, %.17g): their cells are one",
                           mesh->num, mesh->x[i], mesh->y[i]);
        }
        keep_cell(mesh, (uint32_t)i);
        if (mesh->has_no_room) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "the cell of the point (%.17g, %.17g) has more than %d edges",
                           mesh->x[i], mesh->y[i], PS_FPO_MOST_EDGES);
        }
    }
    return PSPEC_OK;
}

pspec_status ps_fpo_mesh_create(ps_fpo_mesh *mesh, size_t num, const double *points,
                                ps_error *error) {
    ps_power_cells cells;
    *mesh = (ps_fpo_mesh){.num = num};
    PS_TRY(ps_power_cells_create(&cells, num, points, error));
    pspec_status status = allocate(mesh, num, error);
    if (status == PSPEC_OK) {
        status = fill(mesh, &cells, error);
    }
    if (status != PSPEC_OK) {
        ps_fpo_mesh_destroy(mesh);
    }
    ps_power_cells_destroy(&cells);
    return status;
}

void ps_fpo_mesh_destroy(ps_fpo_mesh *mesh) {
    free(mesh->x);
    free(mesh->y);
    free(mesh->cells);
    ps_tournament_destroy(&mesh->reach2);
}

static double along_x(const ps_fpo_mesh *mesh, uint32_t p, ps_image image) {
    return mesh->x[ps_image_site(image)] + ps_image_a(image) - mesh->x[p];
}
static double along_y(const ps_fpo_mesh *mesh, uint32_t p, ps_image image) {
    return mesh->y[ps_image_site(image)] + ps_image_b(image) - mesh->y[p];
}

double ps_fpo_mesh_nearest(const ps_fpo_mesh *mesh, uint32_t p, ps_image *nearest) {
    const ps_fpo_cell *const cell = &mesh->cells[p];
    double least = -1;
    for (uint32_t k = 0; k < cell->num; k++) {
        const double dx = along_x(mesh, p, cell->neighbour[k]);
        const double dy = along_y(mesh, p, cell->neighbour[k]);
        const double d2 = dx * dx + dy * dy;
        if (ps_image_site(cell->neighbour[k]) != p && (least < 0 || d2 < least)) {
            least = d2;
            *nearest = cell->neighbour[k];
        }
    }
    return least;
}

/* Cuts the cell of p that is made by an image, unless that is beyond one of its edges already. */
static void cut_by(ps_fpo_mesh *mesh, uint32_t p, ps_image image) {
    const double dx = along_x(mesh, p, image);
    const double dy = along_y(mesh, p, image);
    const double d2 = dx * dx + dy * dy;
    const double height = 0.5 * d2;
    if (ps_cell_is_reached(&mesh->cell, d2, height) &&
        !ps_polygon_has(ps_cell_polygon(&mesh->cell), image)) {
        ps_cell_cut(&mesh->cell, dx, dy, height, image);
    }
}

/* An image seen from an image of another point, seen from where that other is seen; false where it
 * is more than a period away and does not matter. */
static bool add_periods(ps_image of, ps_image from, ps_image *sum) {
    const int a = ps_image_a(of) + ps_image_a(from);
    const int b = ps_image_b(of) + ps_image_b(from);
    *sum = ps_image_of(ps_image_site(of), a, b);
    return a >= -1 && a <= 1 && b >= -1 && b <= 1;
}

/* Cuts the cell of q by the neighbours of p, q seeing p as from_q. */
static void cut_by_hole(ps_fpo_mesh *mesh, uint32_t q, const ps_fpo_cell *hole, ps_image from_q) {
    const uint32_t p = ps_image_site(from_q);
    for (uint32_t k = 0; k < hole->num; k++) {
        const uint32_t site = ps_image_site(hole->neighbour[k]);
        ps_image image;
        if (site != q && site != p && add_periods(hole->neighbour[k], from_q, &image)) {
            cut_by(mesh, q, image);
        }
    }
}

/* From a square: the cell of q by its neighbours without p. */
static void open_from_square(ps_fpo_mesh *mesh, uint32_t p, uint32_t q) {
    const ps_fpo_cell *const kept = &mesh->cells[q];
    ps_cell_start(&mesh->cell, q);
    for (uint32_t k = 0; k < kept->num; k++) {
        const uint32_t site = ps_image_site(kept->neighbour[k]);
        if (site != p && site != q) {
            cut_by(mesh, q, kept->neighbour[k]);
        }
    }
}

/* Where the edges of q with two neighbours meet when what is between them is gone: false where that
 * is not within the square of side 1 around q, or so far to the side that digits are lost. */
static bool find_apex(const ps_fpo_mesh *mesh, uint32_t q, ps_image before, ps_image after,
                      double *x, double *y) {
    static const double least_sine = 0.1;
    const double ax = along_x(mesh, q, before);
    const double ay = along_y(mesh, q, before);
    const double bx = along_x(mesh, q, after);
    const double by = along_y(mesh, q, after);
    const double a2 = ax * ax + ay * ay;
    const double b2 = bx * bx + by * by;
    const double cross = ax * by - ay * bx;
    if (!(cross > 0 && cross * cross > least_sine * least_sine * (a2 * b2))) {
        return false;
    }
    const double scale = 0.5 / cross;
    *x = (a2 * by - b2 * ay) * scale;
    *y = (b2 * ax - a2 * bx) * scale;
    return *x * *x <= 0.25 && *y * *y <= 0.25;
}

/* The same from the cell that q has: the edge with p, number edge, becomes a vertex. That leaves
 * few cuts, by the hole. False where it has no such vertex. */
static bool open_edge(ps_fpo_mesh *mesh, uint32_t q, uint32_t edge) {
    const ps_fpo_cell *const kept = &mesh->cells[q];
    ps_polygon *const polygon = &mesh->cell.polygons[0];
    const uint32_t num = kept->num;
    const ps_image before = kept->neighbour[edge == 0 ? num - 1 : edge - 1];
    const ps_image after = kept->neighbour[edge + 1 == num ? 0 : edge + 1];
    double most = 0;
    if (num < 4 || ps_image_site(before) == q || ps_image_site(after) == q ||
        !find_apex(mesh, q, before, after, &polygon->x[0], &polygon->y[0])) {
        return false;
    }
    polygon->neighbour[0] = after;
    for (uint32_t k = 1; k < num - 1; k++) {
        const uint32_t from = edge + 1 + k < num ? edge + 1 + k : edge + 1 + k - num;
        polygon->x[k] = kept->x[from];
        polygon->y[k] = kept->y[from];
        polygon->neighbour[k] = kept->neighbour[from];
    }
    for (uint32_t k = 0; k < num - 1; k++) {
        const double r2 = polygon->x[k] * polygon->x[k] + polygon->y[k] * polygon->y[k];
        most = r2 > most ? r2 : most;
    }
    polygon->num = num - 1;
    mesh->cell.current = 0;
    mesh->cell.has_no_room = false;
    mesh->cell.reach2 = most;
    return true;
}

/* A neighbour of p, whose cell was the hole, without it. */
static void close_hole(ps_fpo_mesh *mesh, uint32_t p, const ps_fpo_cell *hole, uint32_t q) {
    const ps_fpo_cell *const kept = &mesh->cells[q];
    uint32_t num_edges = 0;
    uint32_t edge = 0;
    for (uint32_t k = 0; k < kept->num; k++) {
        if (ps_image_site(kept->neighbour[k]) == p) {
            num_edges++;
            edge = k;
        }
    }
    if (num_edges == 0) {
        return;
    }
    if (num_edges > 1 || !open_edge(mesh, q, edge)) {
        open_from_square(mesh, p, q);
    }
    for (uint32_t k = 0; k < kept->num; k++) {
        if (ps_image_site(kept->neighbour[k]) == p) {
            cut_by_hole(mesh, q, hole, kept->neighbour[k]);
        }
    }
    keep_cell(mesh, q);
}

void ps_fpo_mesh_remove(ps_fpo_mesh *mesh, uint32_t p) {
    const ps_fpo_cell *const hole = &mesh->cells[p];
    for (uint32_t k = 0; k < hole->num; k++) {
        const uint32_t q = ps_image_site(hole->neighbour[k]);
        if (q != p) { /* the second image of a q has nothing left to close */
            close_hole(mesh, p, hole, q);
        }
    }
    empty_cell(mesh, p);
}

/* The first neighbour of a polygon that is not among the num given ones. */
static bool find_new(const ps_polygon *polygon, const ps_image *given, uint32_t num, uint32_t p,
                     ps_image *found) {
    for (uint32_t k = 0; k < polygon->num; k++) {
        bool is_new = ps_image_site(polygon->neighbour[k]) != p;
        for (uint32_t g = 0; g < num && is_new; g++) {
            is_new = given[g] != polygon->neighbour[k];
        }
        if (is_new) {
            *found = polygon->neighbour[k];
            return true;
        }
    }
    return false;
}

/* The cell of p, from one neighbour on. */
static void make_cell(ps_fpo_mesh *mesh, uint32_t p, ps_image first) {
    ps_image asked[PS_CELL_MOST_EDGES];
    ps_image neighbour;
    uint32_t num = 0;
    ps_cell_start(&mesh->cell, p);
    cut_by(mesh, p, first);
    while (num < PS_CELL_MOST_EDGES &&
           find_new(ps_cell_polygon(&mesh->cell), asked, num, p, &neighbour)) {
        const ps_fpo_cell *const cell = &mesh->cells[ps_image_site(neighbour)];
        asked[num++] = neighbour;
        for (uint32_t k = 0; k < cell->num; k++) {
            ps_image image;
            if (ps_image_site(cell->neighbour[k]) != p &&
                add_periods(cell->neighbour[k], neighbour, &image)) {
                cut_by(mesh, p, image);
            }
        }
    }
}

void ps_fpo_mesh_insert(ps_fpo_mesh *mesh, uint32_t p, double x, double y, ps_image nearest) {
    mesh->x[p] = x;
    mesh->y[p] = y;
    make_cell(mesh, p, nearest);
    keep_cell(mesh, p);
    const ps_fpo_cell *const cell = &mesh->cells[p];
    for (uint32_t k = 0; k < cell->num; k++) {
        const ps_image image = cell->neighbour[k];
        const uint32_t q = ps_image_site(image);
        if (q != p) {
            load_cell(mesh, q);
            cut_by(mesh, q, ps_image_of(p, -ps_image_a(image), -ps_image_b(image)));
            keep_cell(mesh, q);
        }
    }
}

double ps_fpo_mesh_farthest(const ps_fpo_mesh *mesh, double *x, double *y, ps_image *nearest) {
    const uint32_t q = ps_tournament_winner(&mesh->reach2);
    const ps_fpo_cell *const cell = &mesh->cells[q];
    int a;
    int b;
    *x = ps_power_cells_wrap(mesh->x[q] + cell->x[cell->farthest], &a);
    *y = ps_power_cells_wrap(mesh->y[q] + cell->y[cell->farthest], &b);
    *nearest = ps_image_of(q, a, b);
    return mesh->reach2.keys[q];
}
