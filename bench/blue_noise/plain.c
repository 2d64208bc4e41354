#include "blue_noise/plain.h"

#include "math/pi.h"
#include "samplers/darts/distance.h"

#include <math.h>

enum { DARTS_PER_POINT = 400 };

static double uniform(ps_random *random) {
    return (double)ps_random_u32(random) * 0x1p-32;
}

/* ---- plain loops on the torus -------------------------------------------------------------- */

static double wrapped(double difference) {
    return difference - rint(difference);
}

static int is_free(const bench_room *r, int side, double radius, double x, double y) {
    const int cx = (int)(x * side);
    const int cy = (int)(y * side);
    for (int i = -2; i <= 2; i++) {
        for (int j = -2; j <= 2; j++) {
            const int at = r->cells[(cx + i + side) % side * side + (cy + j + side) % side];
            if (at >= 0) {
                const double dx = wrapped(x - r->points[2 * at]);
                const double dy = wrapped(y - r->points[2 * at + 1]);
                if (dx * dx + dy * dy < radius * radius) {
                    return 0;
                }
            }
        }
    }
    return 1;
}

static int put(bench_room *r, int side, int num, double x, double y) {
    r->points[2 * num] = x;
    r->points[2 * num + 1] = y;
    r->cells[(int)(x * side) * side + (int)(y * side)] = num;
    return num + 1;
}

static int start(bench_room *r, double radius) {
    const int side = (int)ceil(sqrt(2) / radius);
    for (int i = 0; i < side * side; i++) {
        r->cells[i] = -1;
    }
    return side;
}

size_t bench_plain_darts(bench_room *r, double radius, ps_random *random) {
    const ps_blue_noise asked = {.dimension = 2, .radius = radius};
    const int darts = (int)(DARTS_PER_POINT * ps_poisson_disk_kind.expected(&asked));
    const int side = start(r, radius);
    int num = 0;
    for (int i = 0; i < darts; i++) {
        const double x = uniform(random);
        const double y = uniform(random);
        num = is_free(r, side, radius, x, y) ? put(r, side, num, x, y) : num;
    }
    return (size_t)num;
}

size_t bench_plain_bridson(bench_room *r, double radius, ps_random *random) {
    const int side = start(r, radius);
    int num = put(r, side, 0, uniform(random), uniform(random));
    int num_active = 1;
    r->active[0] = 0;
    while (num_active > 0) {
        const int chosen = (int)(uniform(random) * num_active);
        const int parent = r->active[chosen];
        int found = 0;
        for (int i = 0; i < BENCH_TRIES && !found; i++) {
            const double far = radius * sqrt(1 + 3 * uniform(random));
            const double angle = PS_TWO_PI * uniform(random);
            double x = r->points[2 * parent] + far * cos(angle);
            double y = r->points[2 * parent + 1] + far * sin(angle);
            x -= floor(x);
            y -= floor(y);
            if (x < 1 && y < 1 && is_free(r, side, radius, x, y)) {
                r->active[num_active++] = num;
                num = put(r, side, num, x, y);
                found = 1;
            }
        }
        if (!found) {
            r->active[chosen] = r->active[--num_active];
        }
    }
    return (size_t)num;
}

/* ---- and on the sphere --------------------------------------------------------------------- */

static int is_free_on_sphere(const bench_room *r, int side, double chord, const double *u) {
    int c[3];
    for (int a = 0; a < 3; a++) {
        c[a] = (int)((u[a] + 1) / 2 * (side - 2)) + 1; /* a rim of empty cubes */
    }
    for (int i = -1; i <= 1; i++) {
        for (int j = -1; j <= 1; j++) {
            for (int k = -1; k <= 1; k++) {
                int at = r->cells[((c[0] + i) * side + c[1] + j) * side + c[2] + k];
                for (; at >= 0; at = r->active[at]) {
                    const double *const v = r->points + 3 * at;
                    const double x = u[0] - v[0];
                    const double y = u[1] - v[1];
                    const double z = u[2] - v[2];
                    if (x * x + y * y + z * z < chord * chord) {
                        return 0;
                    }
                }
            }
        }
    }
    return 1;
}

size_t bench_plain_sphere(bench_room *r, double radius, ps_random *random) {
    const double chord = 2 * sin(radius / 2);
    const int side = (int)(2 / chord) + 2;
    const ps_blue_noise asked = {.radius = radius};
    const int darts = (int)(DARTS_PER_POINT * ps_sphere_disk_kind.expected(&asked));
    int num = 0;
    for (int i = 0; i < side * side * side; i++) {
        r->cells[i] = -1;
    }
    for (int i = 0; i < darts; i++) {
        const double z = 2 * uniform(random) - 1;
        const double angle = PS_TWO_PI * uniform(random);
        const double u[3] = {sqrt(1 - z * z) * cos(angle), sqrt(1 - z * z) * sin(angle), z};
        if (is_free_on_sphere(r, side, chord, u)) {
            int c[3];
            for (int a = 0; a < 3; a++) {
                c[a] = (int)((u[a] + 1) / 2 * (side - 2)) + 1;
                r->points[3 * num + a] = u[a];
            }
            int *const cell = &r->cells[(c[0] * side + c[1]) * side + c[2]];
            r->active[num] = *cell;
            *cell = num++;
        }
    }
    return (size_t)num;
}
