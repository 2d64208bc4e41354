/* Power cells of a torus by all images of all sites, with nothing of
 * the library: slow, in long double, one cell at a time.
 */
#ifndef BRUTE_CELLS_H
#define BRUTE_CELLS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#define assert_close(a, b, tolerance)                                                              \
    assert_numbers_close((a), (b), (tolerance), __FILE__, __LINE__)
static inline void assert_numbers_close(double a, double b, double tolerance, const char *file,
                                        int line) {
    if (!(fabs(a - b) <= tolerance)) {
        print_error("%s:%d: %.17g is not %.17g to %g\n", file, line, a, b, tolerance);
        _fail(file, line);
    }
}

enum { BRUTE_ROOM = 512, BRUTE_IMAGES = 2 /* periods to either side */ };

typedef struct brute_polygon {
    int num;
    long double x[BRUTE_ROOM], y[BRUTE_ROOM];
} brute_polygon;

typedef struct brute_cell {
    double area, x, y; /* centroid relative to the site */
} brute_cell;

/* Sutherland and Hodgman: places p with p.d <= h stay. */
static inline void brute_cut(brute_polygon *polygon, long double dx, long double dy,
                             long double h) {
    brute_polygon out = {.num = 0};
    for (int k = 0; k < polygon->num; k++) {
        const int next = (k + 1) % polygon->num;
        const long double here = polygon->x[k] * dx + polygon->y[k] * dy - h;
        const long double there = polygon->x[next] * dx + polygon->y[next] * dy - h;
        if (here <= 0) {
            out.x[out.num] = polygon->x[k];
            out.y[out.num++] = polygon->y[k];
        }
        if ((here <= 0) != (there <= 0)) {
            const long double t = here / (here - there);
            out.x[out.num] = polygon->x[k] + t * (polygon->x[next] - polygon->x[k]);
            out.y[out.num++] = polygon->y[k] + t * (polygon->y[next] - polygon->y[k]);
        }
        assert_true(out.num + 2 < BRUTE_ROOM);
    }
    *polygon = out;
}

static inline brute_cell brute_moments(const brute_polygon *polygon) {
    long double area = 0;
    long double x = 0;
    long double y = 0;
    for (int k = 0; k < polygon->num; k++) {
        const int next = (k + 1) % polygon->num;
        const long double cross =
            polygon->x[k] * polygon->y[next] - polygon->x[next] * polygon->y[k];
        area += cross / 2;
        x += cross * (polygon->x[k] + polygon->x[next]) / 6;
        y += cross * (polygon->y[k] + polygon->y[next]) / 6;
    }
    return area > 0 ? (brute_cell){(double)area, (double)(x / area), (double)(y / area)}
                    : (brute_cell){0, 0, 0};
}

/* Of sites x, y with weights w: the cell of site i. No two sites may coincide. */
static inline brute_cell brute_clip(size_t num, const double *x, const double *y, const double *w,
                                    size_t i) {
    brute_polygon polygon = {4, {2, 2, -2, -2}, {-2, 2, 2, -2}};
    for (size_t j = 0; j < num; j++) {
        for (int image = 0; image < (2 * BRUTE_IMAGES + 1) * (2 * BRUTE_IMAGES + 1); image++) {
            const int a = image / (2 * BRUTE_IMAGES + 1) - BRUTE_IMAGES;
            const int b = image % (2 * BRUTE_IMAGES + 1) - BRUTE_IMAGES;
            const long double dx = (long double)x[j] + a - x[i];
            const long double dy = (long double)y[j] + b - y[i];
            if (polygon.num > 0 && (j != i || a != 0 || b != 0)) {
                brute_cut(&polygon, dx, dy, (dx * dx + dy * dy + w[i] - w[j]) / 2);
            }
        }
    }
    return brute_moments(&polygon);
}

#endif
