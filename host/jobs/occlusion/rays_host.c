/* Counts of kernels/rays/visible.cl, by the same arithmetic. */
#define PRECISION 32
#include "rays/triangle.h"

#include "base/workers.h"
#include "jobs/occlusion/rays.h"

#include <string.h>

/* Rays that are tried with a triangle at a time. */
enum { PIECE = 64 };

typedef struct piece {
    size_t num;
    float rays[3][PIECE];
    bool is_hidden[PIECE];
} piece;

static void turn(piece *out, const ps_ray_batch *batch, size_t first, const float *m,
                 const float *normal) {
    for (size_t i = 0; i < out->num; i++) {
        const float a = batch->points[first + i];
        const float b = batch->points[batch->capacity + first + i];
        const float c = batch->points[2 * batch->capacity + first + i];
        const float to[3] = {a * m[0] + b * m[1] + c * m[2], a * m[3] + b * m[4] + c * m[5],
                             a * m[6] + b * m[7] + c * m[8]};
        const float up = to[0] * normal[0] + to[1] * normal[1] + to[2] * normal[2];
        const float side = batch->is_folded && up < 0 ? -1 : 1;
        for (unsigned axis = 0; axis < 3; axis++) {
            out->rays[axis][i] = to[axis] * side;
        }
        out->is_hidden[i] = up * side <= 0;
    }
}

static uint32_t count_piece(const ps_ray_batch *batch, size_t pixel, size_t first) {
    const ps_view *const view = batch->view;
    const float *const place = view->places + (batch->first + pixel) * PS_PLACE_NUMBERS;
    const size_t left = batch->num_points - first;
    piece own = {.num = left < PIECE ? left : PIECE};
    uint32_t count = 0;
    turn(&own, batch, first, batch->turns + pixel * PS_TURN_NUMBERS, place + 3);
    for (size_t t = 0; t < view->num_triangles; t++) {
        rays_cone cone;
        if (rays_see(&cone, view->corners + t * PS_CORNER_NUMBERS, place, place + 3)) {
            for (size_t i = 0; i < own.num; i++) {
                own.is_hidden[i] |= rays_meet(&cone, own.rays[0][i], own.rays[1][i], own.rays[2][i],
                                              view->is_bounded, view->radius) != 0;
            }
        }
    }
    for (size_t i = 0; i < own.num; i++) {
        count += !own.is_hidden[i];
    }
    return count;
}

static void count_some(void *payload, unsigned index, unsigned count) {
    const ps_ray_batch *const batch = payload;
    const size_t end = ps_share_begin(batch->num, index + 1, count);
    for (size_t pixel = ps_share_begin(batch->num, index, count); pixel < end; pixel++) {
        batch->counts[pixel] = 0;
        for (size_t first = 0; first < batch->num_points; first += PIECE) {
            batch->counts[pixel] += count_piece(batch, pixel, first);
        }
    }
}

void ps_rays_count_on_host(const ps_ray_batch *batch) {
    ps_ray_batch own = *batch;
    ps_workers_share(batch->num * batch->num_points * batch->view->num_triangles, count_some, &own);
}
