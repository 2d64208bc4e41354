#include "plain.h"

#include <tgmath.h>

#define TWO_PI 6.283185307179586477

/* x to the nearest image of c. */
#define FOLDED(x, c) ((x) - (c)-rint((x) - (c)))

#define PLAIN_DISK(name, real)                                                                     \
    double name(const real *points, size_t num, bench_plain_numbers of) {                          \
        const real cx = (real)of.a[0], cy = (real)of.a[1], radius = (real)of.b[0];                 \
        double sum = 0;                                                                            \
        for (size_t j = 0; j < num; j++) {                                                         \
            const real x = FOLDED(points[2 * j], cx), y = FOLDED(points[2 * j + 1], cy);           \
            sum += x * x + y * y < radius * radius ? 1 : 0;                                        \
        }                                                                                          \
        return sum;                                                                                \
    }

#define PLAIN_BOX(name, real)                                                                      \
    double name(const real *points, size_t num, bench_plain_numbers of) {                          \
        const real cx = (real)of.a[0], cy = (real)of.a[1];                                         \
        const real width = (real)of.b[0], height = (real)of.b[1];                                  \
        double sum = 0;                                                                            \
        for (size_t j = 0; j < num; j++) {                                                         \
            const real x = FOLDED(points[2 * j], cx), y = FOLDED(points[2 * j + 1], cy);           \
            sum += 2 * fabs(x) < width && 2 * fabs(y) < height ? 1 : 0;                            \
        }                                                                                          \
        return sum;                                                                                \
    }

#define PLAIN_GAUSSIAN(name, real)                                                                 \
    static real name##_axis(real x, real rate, int images) {                                       \
        real sum = 0;                                                                              \
        for (int n = -images; n <= images; n++) {                                                  \
            const real far = x + (real)n;                                                          \
            sum += exp(-rate * far * far);                                                         \
        }                                                                                          \
        return sum;                                                                                \
    }                                                                                              \
    double name(const real *points, size_t num, bench_plain_numbers of) {                          \
        const real cx = (real)of.a[0], cy = (real)of.a[1], rate = (real)of.b[0];                   \
        const int images = (int)of.b[1];                                                           \
        double sum = 0;                                                                            \
        for (size_t j = 0; j < num; j++) {                                                         \
            const real x = FOLDED(points[2 * j], cx), y = FOLDED(points[2 * j + 1], cy);           \
            sum += images == 0 ? exp(-rate * (x * x + y * y))                                      \
                               : name##_axis(x, rate, images) * name##_axis(y, rate, images);      \
        }                                                                                          \
        return sum;                                                                                \
    }

#define PLAIN_WAVE(name, real)                                                                     \
    double name(const real *points, size_t num, bench_plain_numbers of) {                          \
        const real kx = (real)of.a[0], ky = (real)of.a[1], phase = (real)of.b[0];                  \
        double sum = 0;                                                                            \
        for (size_t j = 0; j < num; j++) {                                                         \
            sum += cos((real)TWO_PI * (kx * points[2 * j] + ky * points[2 * j + 1] + phase));      \
        }                                                                                          \
        return sum;                                                                                \
    }

#define PLAIN_MAP(name, real, table)                                                               \
    double name(const real *points, size_t num, bench_plain_numbers of) {                          \
        const size_t width = (size_t)of.a[0], height = (size_t)of.a[1];                            \
        double sum = 0;                                                                            \
        for (size_t j = 0; j < num; j++) {                                                         \
            const real x = points[3 * j], y = points[3 * j + 1], z = points[3 * j + 2];            \
            const real polar = atan2(sqrt(x * x + y * y), z);                                      \
            const real down = polar * (real)(2 * of.a[1] / TWO_PI) + (real)0.5;                    \
            const real turn = atan2(y, x) * (real)(of.a[0] / TWO_PI) - (real)0.5;                  \
            const real along = turn < 0 ? turn + (real)width : turn;                               \
            const size_t row = (size_t)down, column = (size_t)along % width;                       \
            const size_t next = column + 1 < width ? column + 1 : 0;                               \
            const real rest = down - (real)row, across = along - (real)column;                     \
            const real share = row == 0 ? 2 * rest - 1 : row == height ? 2 * rest : rest;          \
            const real *const above = of.table + row * width, *const below = above + width;        \
            sum += (1 - share) * (above[column] * (1 - across) + above[next] * across) +           \
                   share * (below[column] * (1 - across) + below[next] * across);                  \
        }                                                                                          \
        return sum;                                                                                \
    }

PLAIN_DISK(bench_plain_disk_single, float)
PLAIN_DISK(bench_plain_disk_double, double)
PLAIN_BOX(bench_plain_box_single, float)
PLAIN_BOX(bench_plain_box_double, double)
PLAIN_GAUSSIAN(bench_plain_gaussian_single, float)
PLAIN_GAUSSIAN(bench_plain_gaussian_double, double)
PLAIN_WAVE(bench_plain_wave_single, float)
PLAIN_WAVE(bench_plain_wave_double, double)
PLAIN_MAP(bench_plain_map_single, float, singles)
PLAIN_MAP(bench_plain_map_double, double, doubles)
