/* Counts the directions of a set in which a pixel sees no triangle. Launch: (pixels, pieces of the
 * set), the first extent rounded up at will.
 *
 * A work-item takes a piece, LANES * VECTORS directions, to one pixel, and tries all of them with
 * one triangle after the other. Counts do not depend on how a set falls into pieces.
 *
 *   scene    of rays/visible.h
 *   corners  [triangle][9]
 *   places   [pixel of all][6]: the origin of its rays, and the normal there
 *   turns    [pixel][9]: the rotation of the set, row by row
 *   points   [3][capacity]: unit vectors, then zeros, which count as hidden
 *   counts   [piece][pixel]
 *
 * Only directions to the side of the normal are tried; others count as hidden, or, with FOLD, are
 * replaced by their opposites. With BOUNDED a triangle hides nothing beyond the radius.
 */
#include "rays/triangle.h"
#include "rays/visible.h"
#include "shared/lanes.h"

#ifndef VECTORS
#define VECTORS 4
#endif
#ifndef BOUNDED
#define BOUNDED 0
#endif
#ifndef FOLD
#define FOLD 0
#endif

static inline real add_lanes(const realv x) {
    real each[LANES], sum = 0;
    STOREV(x, 0, each);
    for (uint i = 0; i < LANES; i++) {
        sum += each[i];
    }
    return sum;
}

__kernel void rays_visible(const rays_scene scene, __global const real *restrict corners,
                           __global const real *restrict places,
                           __global const real *restrict turns,
                           __global const real *restrict points, __global uint *restrict counts) {
    const size_t pixel = get_global_id(0), piece = get_global_id(1);
    if (pixel >= scene.num_pixels) {
        return;
    }
    real place[6], turn[9];
    for (uint i = 0; i < 6; i++) {
        place[i] = places[6 * (scene.first + pixel) + i];
    }
    for (uint i = 0; i < 9; i++) {
        turn[i] = turns[9 * pixel + i];
    }
    realv x[VECTORS], y[VECTORS], z[VECTORS];
    swordv is_hidden[VECTORS];
    for (uint v = 0; v < VECTORS; v++) {
        const size_t at = piece * VECTORS + v;
        const realv a = load_global(points, at);
        const realv b = load_global(points + scene.capacity, at);
        const realv c = load_global(points + 2 * scene.capacity, at);
        x[v] = a * turn[0] + b * turn[1] + c * turn[2];
        y[v] = a * turn[3] + b * turn[4] + c * turn[5];
        z[v] = a * turn[6] + b * turn[7] + c * turn[8];
        const realv up = x[v] * place[3] + y[v] * place[4] + z[v] * place[5];
        const realv side = FOLD ? (up < (realv)0 ? (realv)-1 : (realv)1) : (realv)1;
        x[v] *= side;
        y[v] *= side;
        z[v] *= side;
        is_hidden[v] = up * side <= (realv)0;
    }
    for (uint t = 0; t < scene.num_triangles; t++) {
        rays_cone cone;
        if (rays_see(&cone, corners + 9 * t, place, place + 3)) {
            for (uint v = 0; v < VECTORS; v++) {
                is_hidden[v] |= rays_meet(&cone, x[v], y[v], z[v], BOUNDED, scene.radius);
            }
        }
    }
    realv seen = 0;
    for (uint v = 0; v < VECTORS; v++) {
        seen += is_hidden[v] != (swordv)0 ? (realv)0 : (realv)1;
    }
    counts[piece * scene.num_pixels + pixel] = (uint)add_lanes(seen);
}
