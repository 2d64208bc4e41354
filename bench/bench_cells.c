/* Optimised sets of the plane and the sphere: seconds a set of one core, moves or passes of all
 * points, and times that all cells were made, from realizations 0, 1, .. of seed 1. cells: one cell
 * of each random point.
 *
 *     bench_cells [cells|bnot|fpo|ccvt|ccvt-sphere] [PARAMETER] [N...]
 *                     default: each, eps 1, distance 0.925, M 256 and 64, 1024 4096 16384
 */
#include "bench.h"

#include "math/pi.h"
#include "samplers/ccvt/ccvt.h"
#include "samplers/optimized/bnot.h"
#include "samplers/optimized/cells.h"
#include "samplers/optimized/fpo.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_REPEATS = 9, POINTS_IN_ALL = 1 << 16, MOST_AXES = 3 };

static size_t repeats_of(size_t num) {
    const size_t repeats = POINTS_IN_ALL / num;
    return repeats < 1 ? 1 : repeats > MOST_REPEATS ? MOST_REPEATS : repeats;
}

typedef struct made {
    double seconds;
    unsigned moves, tries;
    double reached; /* what the set was made for */
} made;

static made make_cells(size_t num, double parameter, uint64_t realization, double *points) {
    ps_power_cells cells;
    static ps_cell cell;
    double sum = 0;
    (void)parameter;
    (void)realization;
    BENCH_TRY(ps_power_cells_create(&cells, num, points, error));
    const double begin = bench_thread_seconds();
    for (size_t i = 0; i < num; i++) {
        ps_power_cells_clip(&cells, i, NULL, 0, &cell);
        sum += ps_polygon_moments(ps_cell_polygon(&cell)).area;
    }
    const double seconds = bench_thread_seconds() - begin;
    ps_power_cells_destroy(&cells);
    return (made){seconds, 0, 1, sum};
}

static made make_bnot(size_t num, double parameter, uint64_t realization, double *points) {
    ps_bnot_outcome outcome;
    (void)realization;
    const double begin = bench_thread_seconds();
    BENCH_TRY(ps_bnot_optimise(num, parameter, NULL, points, NULL, &outcome, error));
    return (made){bench_thread_seconds() - begin, outcome.moves, outcome.tries, outcome.capacity};
}

static made make_fpo(size_t num, double parameter, uint64_t realization, double *points) {
    ps_fpo_outcome outcome;
    (void)realization;
    ps_random order = ps_random_init(1, PS_STREAM_PERMUTATION, num);
    const double begin = bench_thread_seconds();
    BENCH_TRY(ps_fpo_optimise(num, parameter, &order, NULL, points, &outcome, error));
    return (made){bench_thread_seconds() - begin, outcome.passes, 0, outcome.distance};
}

/* Sites at random are drawn by the sampler itself, from the same stream; the mean of the squared
 * distance of the area to its site, in units of its share. */
static made make_ccvt(size_t num, double parameter, uint64_t realization, double *points) {
    ps_ccvt_outcome outcome;
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, realization);
    const size_t capacity = (size_t)parameter;
    const double begin = bench_thread_seconds();
    BENCH_TRY(
        ps_ccvt_make(&ps_torus_ccvt_space, num, capacity, &random, NULL, points, &outcome, error));
    return (made){bench_thread_seconds() - begin, outcome.passes, 0, outcome.energy / parameter};
}

static made make_ccvt_sphere(size_t num, double parameter, uint64_t realization, double *points) {
    ps_ccvt_outcome outcome;
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, realization);
    const size_t capacity = (size_t)parameter;
    const double begin = bench_thread_seconds();
    BENCH_TRY(
        ps_ccvt_make(&ps_sphere_ccvt_space, num, capacity, &random, NULL, points, &outcome, error));
    return (made){bench_thread_seconds() - begin, outcome.passes, 0,
                  outcome.energy / parameter / (4 * PS_PI)};
}

typedef struct maker {
    const char *name;
    made (*make)(size_t num, double parameter, uint64_t realization, double *points);
    double parameter;
    const char *reached;
} maker;

static const maker makers[] = {{"cells", make_cells, 0, "sum of areas"},
                               {"bnot", make_bnot, 1, "capacity"},
                               {"fpo", make_fpo, 0.925, "distance"},
                               {"ccvt", make_ccvt, 256, "sum"},
                               {"ccvt-sphere", make_ccvt_sphere, 64, "sum"}};
enum { NUM_MAKERS = sizeof makers / sizeof makers[0] };

static void measure(const maker *way, double parameter, size_t num) {
    double seconds[MOST_REPEATS];
    const size_t repeats = repeats_of(num);
    double *const points = calloc(MOST_AXES * num, sizeof *points);
    made last = {0};
    if (points == NULL) {
        bench_die("no memory for points");
    }
    for (size_t r = 0; r < repeats; r++) {
        ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, r);
        ps_random_fill_uniform(&random, points, 2 * num);
        last = way->make(num, parameter, r, points);
        seconds[r] = last.seconds;
    }
    printf("%-11s %6g %8zu %10.4f s %8u %8u   %s %.6g\n", way->name, parameter, num,
           bench_median(seconds, repeats), last.moves, last.tries, way->reached, last.reached);
    free(points);
}

int main(int argc, char **argv) {
    static const size_t usual[] = {1024, 4096, 16384};
    printf("of what     parameter  points    a set       moves    tries\n");
    for (int k = 0; k < NUM_MAKERS; k++) {
        if (argc > 1 && strcmp(argv[1], makers[k].name) != 0) {
            continue;
        }
        const double parameter = argc > 2 ? strtod(argv[2], NULL) : makers[k].parameter;
        for (int i = 3; i < argc; i++) {
            measure(&makers[k], parameter, (size_t)strtoull(argv[i], NULL, 10));
        }
        for (unsigned i = 0; argc <= 3 && i < sizeof usual / sizeof usual[0]; i++) {
            measure(&makers[k], parameter, usual[i]);
        }
    }
    return 0;
}
