/* Points that keep a least distance: milliseconds of a set beside plain C loops.
 *
 *     bench_blue_noise [times]           N = 1024, 4096, 16384, medians of runs that alternate
 *     bench_blue_noise means [SETS]      N r^d, of which radii are made (samplers/darts/radius.c)
 *
 * plain: 400 N darts on a grid of cells, which come to 97 % of saturation (the last points take any
 * time), and Bridson's paper with cosines and the same tries.
 */
#include "bench.h"

#include "math/pi.h"
#include "samplers/darts/bridson.h"
#include "samplers/darts/poisson_disk.h"
#include "samplers/darts/radius.h"
#include "samplers/darts/sphere_disk.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    REPEATS = 7,
    TRIES = 30,
    MOST_POINTS = 1 << 16,
    MOST_CELLS = 1 << 21,
    DARTS_PER_POINT = 400
};

typedef struct room {
    double *points;
    int *cells;
    int *active;
} room;

static double uniform(ps_random *random) {
    return (double)ps_random_u32(random) * 0x1p-32;
}

/* ---- plain loops on the torus -------------------------------------------------------------- */

static double wrapped(double difference) {
    return difference - rint(difference);
}

static int is_free(const room *r, int side, double radius, double x, double y) {
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

static int put(room *r, int side, int num, double x, double y) {
    r->points[2 * num] = x;
    r->points[2 * num + 1] = y;
    r->cells[(int)(x * side) * side + (int)(y * side)] = num;
    return num + 1;
}

static int start(room *r, double radius) {
    const int side = (int)ceil(sqrt(2) / radius);
    for (int i = 0; i < side * side; i++) {
        r->cells[i] = -1;
    }
    return side;
}

static size_t plain_darts(room *r, double radius, ps_random *random) {
    const int darts = (int)(DARTS_PER_POINT * ps_poisson_disk_expected(2, radius));
    const int side = start(r, radius);
    int num = 0;
    for (int i = 0; i < darts; i++) {
        const double x = uniform(random);
        const double y = uniform(random);
        num = is_free(r, side, radius, x, y) ? put(r, side, num, x, y) : num;
    }
    return (size_t)num;
}

static size_t plain_bridson(room *r, double radius, ps_random *random) {
    const int side = start(r, radius);
    int num = put(r, side, 0, uniform(random), uniform(random));
    int num_active = 1;
    r->active[0] = 0;
    while (num_active > 0) {
        const int chosen = (int)(uniform(random) * num_active);
        const int parent = r->active[chosen];
        int found = 0;
        for (int i = 0; i < TRIES && !found; i++) {
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

static int is_free_on_sphere(const room *r, int side, double chord, const double *u) {
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

static size_t plain_sphere(room *r, double radius, ps_random *random) {
    const double chord = 2 * sin(radius / 2);
    const int side = (int)(2 / chord) + 2;
    const int darts = (int)(DARTS_PER_POINT * ps_sphere_disk_expected(radius));
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

/* ---- both ---------------------------------------------------------------------------------- */

typedef struct blue {
    const char *name;
    unsigned dimension;
    pspec_status (*make)(const ps_blue_noise *, ps_random *, double *, size_t *, ps_error *);
    size_t (*plain)(room *, double radius, ps_random *); /* may be NULL */
} blue;

static const blue KINDS[] = {
    {"poisson-disk", 2, ps_poisson_disk_points, plain_darts},
    {"poisson-disk", 3, ps_poisson_disk_points, NULL},
    {"bridson", 2, ps_bridson_points, plain_bridson},
    {"bridson", 3, ps_bridson_points, NULL},
    {"bridson", 4, ps_bridson_points, NULL},
    {"poisson-disk-sphere", 3, ps_sphere_disk_points, plain_sphere},
};
enum { NUM_KINDS = sizeof KINDS / sizeof KINDS[0] };

static double radius_of(const blue *kind, unsigned tries, size_t num) {
    if (kind->make == ps_sphere_disk_points) {
        return ps_sphere_disk_radius(num);
    }
    return kind->make == ps_bridson_points ? ps_bridson_radius(kind->dimension, tries, num)
                                           : ps_poisson_disk_radius(kind->dimension, num);
}

static size_t make(const blue *kind, const room *r, double radius, unsigned tries, uint64_t set) {
    const ps_blue_noise asked = {
        .dimension = kind->dimension, .radius = radius, .tries = tries, .most_points = MOST_POINTS};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, set);
    size_t num = 0;
    BENCH_TRY(kind->make(&asked, &random, r->points, &num, error));
    return num;
}

static void time_kind(const blue *kind, room *r, size_t num) {
    const double radius = radius_of(kind, TRIES, num);
    double ours[REPEATS];
    double plain[REPEATS];
    size_t num_plain = 0;
    for (int i = 0; i < REPEATS; i++) {
        double begin = bench_seconds();
        make(kind, r, radius, TRIES, (uint64_t)i);
        ours[i] = bench_seconds() - begin;
        if (kind->plain != NULL) {
            ps_random random = ps_random_init(2, PS_STREAM_COORDINATES, (uint64_t)i);
            begin = bench_seconds();
            num_plain = kind->plain(r, radius, &random);
            plain[i] = bench_seconds() - begin;
        }
    }
    const double milliseconds = 1e3;
    const double median = bench_median(ours, REPEATS) * milliseconds;
    printf("%-20s %u %6zu %9.2f", kind->name, kind->dimension, num, median);
    if (kind->plain != NULL) {
        const double other = bench_median(plain, REPEATS) * milliseconds;
        printf(" %9.2f %6zu %6.1f", other, num_plain, other / median);
    }
    printf("\n");
}

static void count_kind(const blue *kind, const room *r, unsigned tries, int num_sets) {
    const size_t num = 4096;
    const double radius = radius_of(kind, tries, num);
    double sum = 0;
    double squares = 0;
    for (int i = 0; i < num_sets; i++) {
        const double made = (double)make(kind, r, radius, tries, (uint64_t)i);
        sum += made;
        squares += made * made;
    }
    const double mean = sum / num_sets;
    const double variance = squares / num_sets - mean * mean;
    const int power = kind->make == ps_sphere_disk_points ? 2 : (int)kind->dimension;
    printf("%-20s %u %6u %9.2f %6.2f %8.5f\n", kind->name, kind->dimension, tries, mean,
           sqrt(variance / num_sets), mean * pow(radius, power));
}

int main(int num_words, char **words) {
    const unsigned tries[] = {2, 3, 5, 10, 20, 30, 50, 100, 200, 400, 1000};
    room r = {malloc(3 * MOST_POINTS * sizeof(double)), malloc(MOST_CELLS * sizeof(int)),
              malloc(MOST_POINTS * sizeof(int))};
    if (r.points == NULL || r.cells == NULL || r.active == NULL) {
        bench_die("no memory");
    }
    if (num_words > 1 && strcmp(words[1], "means") == 0) {
        const int num_sets = num_words > 2 ? atoi(words[2]) : 20;
        printf("%-20s d %6s %9s %6s %8s\n", "sampler", "tries", "mean N", "error", "N r^d");
        for (size_t k = 0; k < NUM_KINDS; k++) {
            const bool has_tries = KINDS[k].make == ps_bridson_points;
            for (size_t i = 0; i < (has_tries ? sizeof tries / sizeof *tries : 1); i++) {
                count_kind(&KINDS[k], &r, has_tries ? tries[i] : 0, num_sets);
            }
        }
    } else {
        printf("%-20s d %6s %9s %9s %6s %6s\n", "sampler", "N", "ms", "plain ms", "N", "ratio");
        for (size_t k = 0; k < NUM_KINDS; k++) {
            for (size_t num = 1024; num <= 16384; num *= 4) {
                time_kind(&KINDS[k], &r, num);
            }
        }
    }
    free(r.points);
    free(r.cells);
    free(r.active);
    return EXIT_SUCCESS;
}
