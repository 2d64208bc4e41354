#define PRECISION 64
#include "rays/triangle.h"

#include "base/memory.h"
#include "base/workers.h"
#include "jobs/occlusion/view.h"
#include "meshes/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How far above the mesh and before it rays begin: 64 times what single precision rounds places to,
 * so that they are above it, on an edge before both of its sides, and every other triangle is seen
 * from the right side. */
static const double LIFT = 0x1p-18;

/* Primary rays begin so far before the middle of the mesh, outside its ball, or at the camera where
 * that is nearer: of a far camera rounding of distances, as the cube of how far it is, would pass
 * LIFT. */
static const double FARTHEST = 2;

typedef struct beam {
    double from[3], ray[3];
} beam;

/* The middle of a pixel is seen along a ray. */
typedef struct sight {
    bool is_there;
    double place[PS_PLACE_NUMBERS];
} sight;

typedef struct work {
    size_t width, height;
    double origin[3], axes[3][3];
    double pixel; /* its width at distance 1 */
    size_t num_triangles;
    double *corners; /* [num_triangles][9] */
    size_t first_row;
    sight *sights; /* of the rows of a piece */
    size_t num_sights;
} work;

/* ---- one ray -------------------------------------------------------------------------------- */

/* 0: it does not meet the triangle. */
static double find_distance(const work *self, size_t triangle, const beam *way) {
    const double *const ray = way->ray;
    rays_cone cone;
    if (!rays_see(&cone, self->corners + triangle * PS_CORNER_NUMBERS, way->from, ray) ||
        !rays_meet(&cone, ray[0], ray[1], ray[2], false, 0)) {
        return 0;
    }
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        sum += rays_height(&cone, i, ray[0], ray[1], ray[2]);
    }
    return cone.volume / sum;
}

static void make_place(const work *self, sight *out, size_t triangle, const beam *way,
                       double distance) {
    const double *const ray = way->ray;
    const double *const corners = self->corners + triangle * PS_CORNER_NUMBERS;
    double *const normal = out->place + 3;
    double sides[2][3];
    ps_vector_subtract(sides[0], corners + 3, corners);
    ps_vector_subtract(sides[1], corners + 6, corners);
    ps_vector_cross(normal, sides[0], sides[1]);
    const double length = ps_vector_length(normal);
    ps_vector_scale(normal, (ps_vector_dot(normal, ray) > 0 ? -1 : 1) / length);
    for (unsigned i = 0; i < 3; i++) {
        out->place[i] = way->from[i] + (distance - LIFT) * ray[i] + LIFT * normal[i];
    }
}

static beam aim(const work *self, size_t x, size_t y) {
    const double right = ((double)x + 0.5 - (double)self->width / 2) * self->pixel;
    const double up = ((double)self->height / 2 - (double)y - 0.5) * self->pixel;
    beam out;
    for (unsigned i = 0; i < 3; i++) {
        out.ray[i] = self->axes[2][i] + right * self->axes[0][i] + up * self->axes[1][i];
    }
    ps_vector_scale(out.ray, 1 / ps_vector_length(out.ray));
    const double skipped = fmax(0, -ps_vector_dot(self->origin, out.ray) - FARTHEST);
    for (unsigned i = 0; i < 3; i++) {
        out.from[i] = self->origin[i] + skipped * out.ray[i];
    }
    return out;
}

static void look(const work *self, sight *out, size_t x, size_t y) {
    const beam way = aim(self, x, y);
    double nearest = INFINITY;
    size_t seen = 0;
    for (size_t t = 0; t < self->num_triangles; t++) {
        const double distance = find_distance(self, t, &way);
        if (distance > 0 && distance < nearest) {
            nearest = distance;
            seen = t;
        }
    }
    out->is_there = isfinite(nearest);
    if (out->is_there) {
        make_place(self, out, seen, &way, nearest);
    }
}

static void look_some(void *payload, unsigned index, unsigned count) {
    work *const self = payload;
    const size_t end = ps_share_begin(self->num_sights, index + 1, count);
    for (size_t i = ps_share_begin(self->num_sights, index, count); i < end; i++) {
        look(self, &self->sights[i], i % self->width, self->first_row + i / self->width);
    }
}

/* ---- all of them ---------------------------------------------------------------------------- */

static void take(ps_view *out, const work *self) {
    for (size_t i = 0; i < self->num_sights; i++) {
        if (!self->sights[i].is_there) {
            continue;
        }
        for (size_t k = 0; k < PS_PLACE_NUMBERS; k++) {
            out->places[out->num_pixels * PS_PLACE_NUMBERS + k] = (float)self->sights[i].place[k];
        }
        out->pixels[out->num_pixels++] = (uint32_t)(self->first_row * self->width + i);
    }
}

static pspec_status look_everywhere(ps_view *out, work *self, const ps_watch *watch,
                                    ps_error *error) {
    enum { PIECE = 1 << 22 }; /* triangles tried by rays between two calls of the watch: 20 ms */
    const size_t fit = PIECE / (self->width * self->num_triangles) + 1;
    const size_t rows = fit < self->height ? fit : self->height;
    PS_TRY(PS_NEW(&self->sights, rows * self->width, "pixels", error));
    for (; self->first_row < self->height; self->first_row += rows) {
        const size_t left = self->height - self->first_row;
        self->num_sights = (left < rows ? left : rows) * self->width;
        PS_TRY(
            ps_watch_tell(watch, "primary rays, rows", self->first_row, self->height, NULL, error));
        ps_workers_share(self->num_sights * self->num_triangles, look_some, self);
        take(out, self);
    }
    return out->num_pixels > 0 ? PSPEC_OK
                               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                                         "the camera sees nothing of the mesh");
}

/* In units of the mesh. */
static pspec_status begin(ps_view *out, work *self, const ps_mesh *mesh,
                          const ps_view_options *options, ps_error *error) {
    double middle[3];
    const double unit = ps_mesh_extent(mesh, middle);
    const size_t num = options->width * options->height;
    const size_t numbers = mesh->num_triangles * PS_CORNER_NUMBERS;
    if (!(ps_vector_length(options->camera.direction) > 0)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "the camera looks at the point where it is");
    }
    if (!ps_camera_axes(&options->camera, self->axes)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "the camera looks along the direction that is to be up");
    }
    *out = (ps_view){.width = options->width,
                     .height = options->height,
                     .is_bounded = options->radius > 0,
                     .radius = (float)(options->radius / unit),
                     .num_triangles = mesh->num_triangles};
    PS_TRY(PS_NEW(&out->corners, numbers, "triangles", error));
    PS_TRY(PS_NEW(&out->pixels, num, "pixels", error));
    PS_TRY(PS_NEW(&out->places, num * PS_PLACE_NUMBERS, "pixels", error));
    PS_TRY(PS_NEW(&self->corners, numbers, "triangles", error));
    self->width = options->width;
    self->height = options->height;
    self->pixel = options->camera.width / (double)options->width;
    self->num_triangles = mesh->num_triangles;
    for (size_t i = 0; i < numbers; i++) {
        self->corners[i] = ((&mesh->triangles[0][0][0])[i] - middle[i % 3]) / unit;
        out->corners[i] = (float)self->corners[i];
    }
    for (unsigned i = 0; i < 3; i++) {
        self->origin[i] = (options->camera.position[i] - middle[i]) / unit;
    }
    return PSPEC_OK;
}

pspec_status ps_view_make(ps_view *out, const ps_mesh *mesh, const ps_view_options *options,
                          const ps_watch *watch, ps_error *error) {
    work self = {0};
    *out = (ps_view){0};
    pspec_status status = begin(out, &self, mesh, options, error);
    if (status == PSPEC_OK) {
        status = look_everywhere(out, &self, watch, error);
    }
    free(self.corners);
    free(self.sights);
    return status;
}

uint64_t ps_view_bytes(size_t num_pixels, size_t num_triangles) {
    return num_pixels * (sizeof(uint32_t) + PS_PLACE_NUMBERS * sizeof(float) + sizeof(sight)) +
           num_triangles * PS_CORNER_NUMBERS * (sizeof(float) + sizeof(double));
}

void ps_view_free(ps_view *view) {
    free(view->corners);
    free(view->pixels);
    free(view->places);
    *view = (ps_view){0};
}
