/* A step along a line: the part of the cell [0,1)^2 where n.x is below an offset, a polygon
 * (docs/mathematics/integrands.md#half-planes). */
#define PRECISION 64
#include "integrands/half_plane.h"

#include "integrands/integrand_kind.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* ---- polygons ---------------------------------------------------------------------------- */

enum { MOST_CORNERS = 16 }; /* of two that a square was cut to: 5 each, and 10 in common */

/* Convex, counter-clockwise. */
typedef struct polygon {
    unsigned num; /* 0: empty */
    double corners[MOST_CORNERS][2];
} polygon;

static double area_of(const polygon *self) {
    double twice = 0;
    for (unsigned i = 1; i + 1 < self->num; i++) { /* triangles with the first corner */
        const double *const origin = self->corners[0];
        const double *const a = self->corners[i];
        const double *const b = self->corners[i + 1];
        twice += (a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0]);
    }
    return twice / 2;
}

static polygon move_polygon(const polygon *self, double dx, double dy) {
    polygon moved = *self;
    for (unsigned i = 0; i < moved.num; i++) {
        moved.corners[i][0] += dx;
        moved.corners[i][1] += dy;
    }
    return moved;
}

static void append(polygon *self, double x, double y) {
    if (self->num < MOST_CORNERS) {
        self->corners[self->num][0] = x;
        self->corners[self->num][1] = y;
        self->num++;
    }
}

/* The part where nx x + ny y <= offset: one corner more at most. */
static polygon clip_polygon(const polygon *self, double nx, double ny, double offset) {
    polygon part = {0};
    for (unsigned i = 0; i < self->num; i++) {
        const double *const a = self->corners[i];
        const double *const b = self->corners[(i + 1) % self->num];
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

static polygon intersect_polygon(const polygon *a, const polygon *b) {
    polygon part = *a;
    for (unsigned i = 0; i < b->num; i++) {
        const double *const from = b->corners[i];
        const double *const to = b->corners[(i + 1) % b->num];
        const double nx = to[1] - from[1]; /* outwards */
        const double ny = from[0] - to[0];
        part = clip_polygon(&part, nx, ny, nx * from[0] + ny * from[1]);
    }
    return part;
}

/* ---- the integrand ----------------------------------------------------------------------- */

static const polygon CELL = {4, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    const double farthest = 2; /* a line further away misses the cell */
    double angle = 0;
    double *const n = &self->numbers[HALF_PLANE_NORMAL];
    double *const offset = &self->numbers[HALF_PLANE_OFFSET];
    PS_TRY(ps_integrand_number(self, "angle", values[0], -PS_TWO_PI, PS_TWO_PI, &angle, error));
    n[0] = cos(angle);
    n[1] = sin(angle);
    *offset = (n[0] + n[1]) / 2;
    if (strcmp(values[1], "middle") != 0) {
        PS_TRY(ps_integrand_number(self, "offset", values[1], -farthest, farthest, offset, error));
    }
    polygon *part = NULL;
    PS_TRY(PS_NEW(&part, 1, "a half-plane", error));
    self->own = part;
    *part = clip_polygon(&CELL, n[0], n[1], *offset);
    const double area = area_of(part);
    return area > 0 && area < 1 ? PSPEC_OK
                                : ps_integrand_fail(self, "offset", values[1],
                                                    "the line misses the cell [0,1)^2", error);
}

static double integral(const ps_integrand *self) {
    return area_of(self->own);
}

static double energy(const ps_integrand *self) {
    const double part = integral(self);
    return part * (1 - part);
}

static double sinc(double x) {
    return x == 0 ? 1 : sin(PS_PI * x) / (PS_PI * x);
}

/* f_k = i/(2 pi |k|^2) sum_edges (k_x dy - k_y dx) exp(-2 pi i k.m) sinc(k.(b - a)), m the middle
 * of the edge from a to b. */
static double power(const polygon *part, double kx, double ky) {
    double real_part = 0;
    double imaginary = 0;
    for (unsigned i = 0; i < part->num; i++) {
        const double *const a = part->corners[i];
        const double *const b = part->corners[(i + 1) % part->num];
        const double dx = b[0] - a[0];
        const double dy = b[1] - a[1];
        const double turns = (kx * (a[0] + b[0]) + ky * (a[1] + b[1])) / 2;
        const double size = (kx * dy - ky * dx) * sinc(kx * dx + ky * dy);
        real_part += size * cos(PS_TWO_PI * (turns - rint(turns)));
        imaginary += size * sin(PS_TWO_PI * (turns - rint(turns)));
    }
    const double scale = PS_TWO_PI * (kx * kx + ky * ky);
    return (real_part * real_part + imaginary * imaginary) / (scale * scale);
}

static pspec_status powers(const ps_integrand *self, const int32_t *vectors, size_t num,
                           double *out, ps_error *error) {
    (void)error;
    for (size_t i = 0; i < num; i++) {
        out[i] = power(self->own, vectors[2 * i], vectors[2 * i + 1]);
    }
    return PSPEC_OK;
}

typedef struct overlaps {
    const polygon *part;
    double sum;
} overlaps;

static void add_overlap(void *payload, const double *image) {
    overlaps *const self = payload;
    const polygon moved = move_polygon(self->part, image[0], image[1]);
    const polygon common = intersect_polygon(self->part, &moved);
    self->sum += area_of(&common);
}

static double correlation(const ps_integrand *self, const double *x) {
    overlaps all = {self->own, 0};
    ps_integrand_images(x, 2, add_overlap, &all);
    return all.sum;
}

static const char *note(const ps_integrand *self) {
    (void)self;
    return "it jumps at the edges of the cell, too, where only one side is inside";
}

static void destroy(ps_integrand *self) {
    free(self->own);
}

PS_INTEGRAND_VALUES(half_plane_value)

const ps_integrand_kind ps_integrand_half_plane = {
    .name = "half-plane",
    .aliases = "step",
    .summary = "1 where n.x is below an offset in the cell [0,1)^2",
    .kernel = "half_plane",
    .domains = PS_INTEGRAND_ON(PS_SAMPLES_TORUS),
    .least = 2,
    .most = 2,
    .parameters = {{"angle", "0.4", "of n against the first axis, in radians"},
                   {"offset", "middle", "a number; middle: through the centre of the cell"}},
    .create = create,
    .destroy = destroy,
    .integral = integral,
    .energy = energy,
    .powers = powers,
    .values = values,
    .correlation = correlation,
    .note = note,
};
