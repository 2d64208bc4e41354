#include "math/polygon.h"

double ps_polygon_area(const ps_polygon *polygon) {
    double twice = 0;
    for (unsigned i = 1; i + 1 < polygon->num; i++) { /* triangles with the first corner */
        const double *const origin = polygon->corners[0];
        const double *const a = polygon->corners[i];
        const double *const b = polygon->corners[i + 1];
        twice += (a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0]);
    }
    return twice / 2;
}

ps_polygon ps_polygon_move(const ps_polygon *polygon, double dx, double dy) {
    ps_polygon moved = *polygon;
    for (unsigned i = 0; i < moved.num; i++) {
        moved.corners[i][0] += dx;
        moved.corners[i][1] += dy;
    }
    return moved;
}

static void append(ps_polygon *polygon, double x, double y) {
    if (polygon->num < PS_POLYGON_CORNERS) {
        polygon->corners[polygon->num][0] = x;
        polygon->corners[polygon->num][1] = y;
        polygon->num++;
    }
}

ps_polygon ps_polygon_clip(const ps_polygon *polygon, double nx, double ny, double offset) {
    ps_polygon part = {0};
    for (unsigned i = 0; i < polygon->num; i++) {
        const double *const a = polygon->corners[i];
        const double *const b = polygon->corners[(i + 1) % polygon->num];
        const double above_a = nx * a[0] + ny * a[1] - offset;
        const double above_b = nx * b[0] + ny * b[1] - offset;
        if (above_a <= 0) {
            append(&part, a[0], a[1]);
        }
        if ((above_a < 0 && above_b > 0) || (above_a > 0 && above_b < 0)) {
            const double share = above_a / (above_a - above_b);
            append(&part, a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]));
        }
    }
    return part;
}

ps_polygon ps_polygon_intersect(const ps_polygon *a, const ps_polygon *b) {
    ps_polygon part = *a;
    for (unsigned i = 0; i < b->num; i++) {
        const double *const from = b->corners[i];
        const double *const to = b->corners[(i + 1) % b->num];
        const double nx = to[1] - from[1]; /* outwards */
        const double ny = from[0] - to[0];
        part = ps_polygon_clip(&part, nx, ny, nx * from[0] + ny * from[1]);
    }
    return part;
}
