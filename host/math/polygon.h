/* Convex polygons of few corners, counter-clockwise. */
#ifndef PS_MATH_POLYGON_H
#define PS_MATH_POLYGON_H

enum { PS_POLYGON_CORNERS = 16 }; /* of two that a square was cut to: 5 each, and 10 in common */

typedef struct ps_polygon {
    unsigned num; /* 0: empty */
    double corners[PS_POLYGON_CORNERS][2];
} ps_polygon;

double ps_polygon_area(const ps_polygon *polygon);
ps_polygon ps_polygon_move(const ps_polygon *polygon, double dx, double dy);
/* The part where nx x + ny y <= offset: one corner more at most. */
ps_polygon ps_polygon_clip(const ps_polygon *polygon, double nx, double ny, double offset);
ps_polygon ps_polygon_intersect(const ps_polygon *a, const ps_polygon *b);

#endif
