/* Counts of rays that see nothing as a plain loop has them: one thread, the test of Moeller and
 * Trumbore, compiled with -O3 -march=native, which vectorises it over rays. What bench_occlusion is
 * measured against. */
#ifndef BENCH_OCCLUSION_PLAIN_H
#define BENCH_OCCLUSION_PLAIN_H

#include <stddef.h>

enum { BENCH_PLAIN_MOST_RAYS = 4096 };

/* corners[num_triangles][9]; place[6]: an origin and a normal; turn[9] rotates points[3][capacity],
 * of which there are num. */
size_t bench_plain_count(const float *corners, size_t num_triangles, const float *place,
                         const float *turn, const float *points, size_t capacity, size_t num);

#endif
