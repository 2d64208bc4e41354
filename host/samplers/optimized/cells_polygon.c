#include "samplers/optimized/cells.h"

void ps_cell_start(ps_cell *cell, uint32_t site) {
    static const double corner_x[4] = {0.5, 0.5, -0.5, -0.5};
    static const double corner_y[4] = {-0.5, 0.5, 0.5, -0.5};
    static const int a[4] = {1, 0, -1, 0};
    static const int b[4] = {0, 1, 0, -1};
    ps_polygon *const polygon = &cell->polygons[0];
    for (unsigned k = 0; k < 4; k++) {
        polygon->x[k] = corner_x[k];
        polygon->y[k] = corner_y[k];
        polygon->neighbour[k] = ps_image_of(site, a[k], b[k]);
    }
    polygon->num = 4;
    cell->current = 0;
    cell->reach2 = 0.5;
    cell->has_no_room = false;
}

bool ps_polygon_has(const ps_polygon *polygon, ps_image neighbour) {
    for (unsigned k = 0; k < polygon->num; k++) {
        if (polygon->neighbour[k] == neighbour) {
            return true;
        }
    }
    return false;
}

/* Vertices first, first + 1, .. of one polygon to the end of another. */
static void copy_vertices(const ps_polygon *whole, unsigned first, unsigned num, ps_polygon *cut) {
    for (unsigned k = 0; k < num; k++) {
        cut->x[cut->num + k] = whole->x[first + k];
        cut->y[cut->num + k] = whole->y[first + k];
        cut->neighbour[cut->num + k] = whole->neighbour[first + k];
    }
    cut->num += num;
}

/* Where the edge from vertex a to b meets the line, beyond which they are outside[a] and [b]. */
static void add_crossing(const ps_polygon *whole, const double *outside, unsigned a, unsigned b,
                         ps_image neighbour, ps_polygon *cut) {
    const double t = outside[a] / (outside[a] - outside[b]);
    cut->x[cut->num] = whole->x[a] + t * (whole->x[b] - whole->x[a]);
    cut->y[cut->num] = whole->y[a] + t * (whole->y[b] - whole->y[a]);
    cut->neighbour[cut->num++] = neighbour;
}

static double reach_of(const ps_polygon *polygon) {
    double most = 0;
    for (unsigned k = 0; k < polygon->num; k++) {
        const double r2 = polygon->x[k] * polygon->x[k] + polygon->y[k] * polygon->y[k];
        most = r2 > most ? r2 : most;
    }
    return most;
}

/* Vertices first .. end - 1, counted around, are cut away: two crossings take their place. */
static void replace(ps_cell *cell, const double *outside, unsigned first, unsigned end,
                    ps_image neighbour) {
    const ps_polygon *const whole = &cell->polygons[cell->current];
    ps_polygon *const cut = &cell->polygons[1 - cell->current];
    const unsigned num = whole->num;
    cut->num = 0;
    if (end > num) {
        copy_vertices(whole, end - num, first - (end - num), cut);
    } else {
        copy_vertices(whole, end, num - end, cut);
        copy_vertices(whole, 0, first, cut);
    }
    const unsigned last = (end - 1) % num;
    add_crossing(whole, outside, first == 0 ? num - 1 : first - 1, first, neighbour, cut);
    add_crossing(whole, outside, last, end % num, whole->neighbour[last], cut);
    cell->current = 1 - cell->current;
    cell->reach2 = reach_of(cut);
}

/* A convex polygon loses one run of vertices; where rounding makes more of a line that touches it,
 * the first is cut and the others, of size 1e-17, stay. */
void ps_cell_cut(ps_cell *cell, double dx, double dy, double height, ps_image neighbour) {
    ps_polygon *const whole = &cell->polygons[cell->current];
    const unsigned num = whole->num;
    double outside[PS_CELL_MOST_EDGES];
    double most = 0;
    for (unsigned k = 0; k < num; k++) {
        outside[k] = whole->x[k] * dx + whole->y[k] * dy - height;
        most = outside[k] > most ? outside[k] : most;
    }
    if (!(most > 0)) {
        return;
    }
    if (num + 1 > PS_CELL_MOST_EDGES) {
        cell->has_no_room = true;
        return;
    }
    unsigned inside = 0;
    while (inside < num && outside[inside] > 0) {
        inside++;
    }
    if (inside == num) {
        whole->num = 0;
        cell->reach2 = 0;
        return;
    }
    unsigned first = inside;
    while (!(outside[first % num] > 0)) {
        first++;
    }
    unsigned end = first;
    while (outside[end % num] > 0) {
        end++;
    }
    replace(cell, outside, first % num, first % num + (end - first), neighbour);
}

ps_cell_moments ps_polygon_moments(const ps_polygon *polygon) {
    ps_cell_moments sum = {0, 0, 0};
    for (unsigned k = 0; k < polygon->num; k++) {
        const unsigned next = k + 1 == polygon->num ? 0 : k + 1;
        const double twice = polygon->x[k] * polygon->y[next] - polygon->x[next] * polygon->y[k];
        sum.area += twice;
        sum.x += twice * (polygon->x[k] + polygon->x[next]);
        sum.y += twice * (polygon->y[k] + polygon->y[next]);
    }
    if (!(sum.area > 0)) {
        return (ps_cell_moments){0, 0, 0};
    }
    const double third = 1.0 / 3.0;
    return (ps_cell_moments){sum.area / 2, sum.x / sum.area * third, sum.y / sum.area * third};
}
