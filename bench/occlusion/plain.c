#include "plain.h"

#include <math.h>

typedef struct rays {
    float x[BENCH_PLAIN_MOST_RAYS], y[BENCH_PLAIN_MOST_RAYS], z[BENCH_PLAIN_MOST_RAYS];
    int is_hidden[BENCH_PLAIN_MOST_RAYS];
} rays;

static void try_triangle(rays *own, size_t num, const float *corners, const float *o) {
    const float ax = corners[3] - corners[0], ay = corners[4] - corners[1],
                az = corners[5] - corners[2];
    const float bx = corners[6] - corners[0], by = corners[7] - corners[1],
                bz = corners[8] - corners[2];
    const float tx = o[0] - corners[0], ty = o[1] - corners[1], tz = o[2] - corners[2];
    const float qx = ty * az - tz * ay, qy = tz * ax - tx * az, qz = tx * ay - ty * ax;
    const float far = bx * qx + by * qy + bz * qz;
    for (size_t i = 0; i < num; i++) {
        const float x = own->x[i], y = own->y[i], z = own->z[i];
        const float px = y * bz - z * by, py = z * bx - x * bz, pz = x * by - y * bx;
        const float inverse = 1 / (ax * px + ay * py + az * pz);
        const float u = (tx * px + ty * py + tz * pz) * inverse;
        const float v = (x * qx + y * qy + z * qz) * inverse;
        own->is_hidden[i] |= (u >= 0) & (v >= 0) & (u + v <= 1) & (far * inverse > 0);
    }
}

size_t bench_plain_count(const float *corners, size_t num_triangles, const float *place,
                         const float *turn, const float *points, size_t capacity, size_t num) {
    static rays own;
    size_t count = 0;
    for (size_t i = 0; i < num; i++) {
        const float a = points[i], b = points[capacity + i], c = points[2 * capacity + i];
        own.x[i] = a * turn[0] + b * turn[1] + c * turn[2];
        own.y[i] = a * turn[3] + b * turn[4] + c * turn[5];
        own.z[i] = a * turn[6] + b * turn[7] + c * turn[8];
        own.is_hidden[i] = own.x[i] * place[3] + own.y[i] * place[4] + own.z[i] * place[5] <= 0;
    }
    for (size_t t = 0; t < num_triangles; t++) {
        try_triangle(&own, num, corners + 9 * t, place);
    }
    for (size_t i = 0; i < num; i++) {
        count += own.is_hidden[i] == 0;
    }
    return count;
}
