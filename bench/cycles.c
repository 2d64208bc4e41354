/* Kernels are timed by the profile of the device on problems that each have much of something; a
 * problem's cycles are to be the sum of the numbers of its parts times what they cost. The relative
 * deviations are made least, together with those of the parts from what the table has now, which
 * weigh little: a part that the problems tell nothing of stays as it is.
 */
#include "cycles.h"

#include "bench.h"
#include "engines/torus/nufft/choice.h"
#include "engines/torus/nufft/cost.h"
#include "engines/torus/nufft/layout.h"
#include "engines/engine.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>
#include <stdio.h>

/* What a problem is there for. Three dimensions in tiles are made of the same parts, but what their
 * many short rows cost beside is in none of them: they are measured, and not fitted. */
typedef enum kind { LINES, TILES, ROWS, GRIDS, BOXES, WHOLE, STRIPS, NUM_KINDS } kind;
static const char *const kind_names[NUM_KINDS] = {
    "tiles, 1 dimension", "tiles, 2", "tiles, 3 (not fitted)", "grids, 2", "grids, 3",
    "whole, 1 and 2",     "strips, 2"};
static const ps_nufft_variant *const variants[NUM_KINDS] = {
    &ps_nufft_tiles, &ps_nufft_tiles, &ps_nufft_tiles, &ps_nufft_large,
    &ps_nufft_large, &ps_nufft_whole, &ps_nufft_strips};

/* Points planned for: 0 as many as there are, so that many in few cells are done whole; NOT_WHOLE
 * more than are ever done whole; FOR_GRIDS a large set's. */
enum { NOT_WHOLE = (1 << 20) + 1, FOR_GRIDS = 20000000 };

/* Grids are as large as they are in use: beyond all caches. */
static const struct {
    kind kind;
    unsigned dimension;
    size_t num_points;
    int32_t k;
    uint64_t planned_points;
} shapes[] = {
    {LINES, 1, 1024, 1000, NOT_WHOLE},
    {LINES, 1, 16384, 4000, NOT_WHOLE},
    {LINES, 1, 65536, 500, NOT_WHOLE},
    {TILES, 2, 16, 8, 0},
    {TILES, 2, 64, 24, 0},
    {TILES, 2, 64, 100, 0},
    {TILES, 2, 256, 16, 0},
    {TILES, 2, 256, 80, 0},
    {TILES, 2, 256, 200, 0},
    {TILES, 2, 1024, 128, 0},
    {TILES, 2, 4096, 16, NOT_WHOLE},
    {TILES, 2, 4096, 300, 0},
    {TILES, 2, 16384, 40, NOT_WHOLE},
    {TILES, 2, 16384, 500, 0},
    {ROWS, 3, 64, 6, 0},
    {ROWS, 3, 512, 16, 0},
    {ROWS, 3, 4096, 8, 0},
    {ROWS, 3, 4096, 32, 0},
    {ROWS, 3, 16384, 16, 0},
    {GRIDS, 2, 30000, 1000, FOR_GRIDS},
    {GRIDS, 2, 1000000, 300, FOR_GRIDS},
    {GRIDS, 2, 1000000, 1000, FOR_GRIDS},
    {BOXES, 3, 30000, 60, FOR_GRIDS},
    {BOXES, 3, 300000, 30, FOR_GRIDS},
    {BOXES, 3, 1000000, 64, 1000000},
    {BOXES, 3, 1000000, 40, 1000000},
    {WHOLE, 1, 4096, 8000, 0},
    {WHOLE, 1, 16384, 500, 0},
    {WHOLE, 1, 65536, 8000, 0},
    {WHOLE, 1, 65536, 32000, 0},
    {WHOLE, 2, 256, 12, 0},
    {WHOLE, 2, 1024, 8, 0},
    {WHOLE, 2, 4096, 16, 0},
    {WHOLE, 2, 4096, 64, 0},
    {WHOLE, 2, 16384, 30, 0},
    {WHOLE, 2, 16384, 120, 0},
    {WHOLE, 2, 65536, 64, 0},
    {STRIPS, 2, 4096, 250, 0},
    {STRIPS, 2, 16384, 250, 0},
    {STRIPS, 2, 16384, 500, 0},
    {STRIPS, 2, 65536, 500, 0},
    {STRIPS, 2, 65536, 1000, 0},
};
static const struct {
    ps_precision precision;
    double tolerance;
} exactness[] = {{PS_SINGLE, 1e-2}, {PS_SINGLE, 1e-5}, {PS_DOUBLE, 1e-6}, {PS_DOUBLE, 1e-11}};
enum {
    NUM_SHAPES = sizeof shapes / sizeof shapes[0],
    NUM_EXACTNESS = sizeof exactness / sizeof exactness[0],
    MOST_PROBLEMS = NUM_SHAPES * NUM_EXACTNESS,
    NUM = PS_NUFFT_PARTS_OF_CPUS
};

/* ---- problems ---------------------------------------------------------------------------- */

typedef struct measured {
    kind kind;
    ps_nufft_counts counts;
    double cycles;
} measured;

static double profiled_seconds(const ps_device *device) {
    size_t num = 0;
    double seconds = 0;
    const ps_profile_row *rows = ps_device_profile(device, &num);
    for (size_t i = 0; i < num; i++) {
        seconds += rows[i].seconds;
    }
    return seconds;
}

/* Best of some runs: nothing but disturbance makes one slower. */
static double best_seconds(bench_job *job, ps_device *device) {
    enum { REPEATS = 5 };
    ps_rows rows = {0};
    double best = HUGE_VAL;
    bench_job_run(job, &rows);
    for (int i = 0; i < REPEATS; i++) {
        const double before = profiled_seconds(device);
        bench_job_run(job, &rows);
        best = fmin(best, profiled_seconds(device) - before);
    }
    return best;
}

static double total(const ps_nufft_counts *counts, const double *cycles) {
    double sum = 0;
    for (size_t i = 0; i < NUM; i++) {
        sum += counts->num[i] * cycles[i];
    }
    return sum;
}

/* As many as take about as long as timing can tell, and keep all cores at work. */
static size_t enough_realizations(double cycles_of_one, double cycles_per_second) {
    const double wanted = 0.01;
    const double num = ceil(wanted * cycles_per_second / cycles_of_one);
    return num < 2 ? 2 : num > 2048 ? 2048 : (size_t)num;
}

/* Is it chosen as the shape wants it? */
static bool is_of_kind(const ps_nufft_choice *choice, kind wanted) {
    return choice->variant == variants[wanted];
}

static double measure_cycles(ps_device *device, const ps_problem *problem, ps_precision precision,
                             double nominal_cycles) {
    const ps_device_limits *limits = ps_device_get_limits(device);
    const double mega = 1e6;
    const double cycles_per_second = mega * limits->clock_mhz * limits->compute_units;
    ps_problem some = *problem;
    bench_job job;
    some.num_realizations = enough_realizations(nominal_cycles, cycles_per_second);
    bench_job_create_for(&job, &ps_torus_nufft, precision, &some, device);
    const double seconds = best_seconds(&job, device) / (double)some.num_realizations;
    bench_job_destroy(&job);
    return seconds * cycles_per_second;
}

/* False where it is not done, or not in the way that it is there for. */
static bool measure(ps_device *device, size_t shape, size_t which, measured *out) {
    const ps_device_limits *limits = ps_device_get_limits(device);
    const ps_precision precision = exactness[which].precision;
    ps_frequencies grid = {0};
    BENCH_TRY(
        ps_frequencies_lattice(&grid, shapes[shape].dimension, shapes[shape].k, false, error));
    const ps_problem problem = {.frequencies = &grid,
                                .num_points = shapes[shape].num_points,
                                .tolerance = exactness[which].tolerance,
                                .planned_points = shapes[shape].planned_points};
    const ps_survey survey = ps_torus_nufft.survey(&problem, limits, precision);
    if (survey.why_not != NULL || survey.error > problem.tolerance) {
        return false;
    }
    const ps_nufft_layout layout = ps_nufft_layout_make(&problem, limits, precision);
    if (!is_of_kind(&layout.choice, shapes[shape].kind)) {
        return false;
    }
    out->kind = shapes[shape].kind;
    out->counts = ps_nufft_count(&layout.choice, precision, (double)problem.num_points);
    out->cycles = measure_cycles(device, &problem, precision, total(&out->counts, ps_nufft_cycles));
    return true;
}

/* ---- least squares ----------------------------------------------------------------------- */

/* What a deviation of a part from the table weighs against that of a problem. */
static const double prior_weight = 0.3;

/* Normal equations: unknowns are the parts as multiples of what the table has. */
typedef struct equations {
    double matrix[NUM][NUM], right[NUM];
} equations;

/* parts: the last solution. Large deviations weigh by their size and not its square, for neighbours
 * of a shared machine disturb some problems a lot. */
static void set_up(equations *sums, const measured *all, size_t num, const double *parts) {
    const double usual = 0.1;
    *sums = (equations){0};
    for (size_t i = 0; i < NUM; i++) {
        sums->matrix[i][i] = prior_weight * prior_weight;
        sums->right[i] = prior_weight * prior_weight;
    }
    for (size_t p = 0; p < num; p++) {
        double shares[NUM];
        double sum = 0;
        for (size_t i = 0; i < NUM; i++) {
            shares[i] = all[p].counts.num[i] * ps_nufft_cycles[i] / all[p].cycles;
            sum += shares[i] * parts[i];
        }
        const double weight = all[p].kind == ROWS ? 0 : usual / fmax(usual, fabs(sum - 1));
        for (size_t i = 0; i < NUM; i++) {
            sums->right[i] += weight * shares[i];
            for (size_t j = 0; j < NUM; j++) {
                sums->matrix[i][j] += weight * shares[i] * shares[j];
            }
        }
    }
}

/* The least sum of squares with every part at least `least` of what it was: the equations are
 * solved part by part, over and over (Gauss and Seidel), which converges since the matrix is
 * positive definite. */
static void solve(const equations *sums, double *parts) {
    enum { ROUNDS = 2000 };
    const double least = 0.1;
    for (int round = 0; round < ROUNDS; round++) {
        for (size_t i = 0; i < NUM; i++) {
            double rest = sums->right[i];
            for (size_t j = 0; j < NUM; j++) {
                rest -= j != i ? sums->matrix[i][j] * parts[j] : 0;
            }
            parts[i] = fmax(least, rest / sums->matrix[i][i]);
        }
    }
}

static void fit(const measured *all, size_t num, double *cycles) {
    enum { ROUNDS = 20 };
    equations sums;
    double parts[NUM];
    for (size_t i = 0; i < NUM; i++) {
        parts[i] = 1;
    }
    for (int round = 0; round < ROUNDS; round++) {
        set_up(&sums, all, num, parts);
        solve(&sums, parts);
    }
    for (size_t i = 0; i < NUM; i++) {
        cycles[i] = parts[i] * ps_nufft_cycles[i];
    }
}

/* ---- output ------------------------------------------------------------------------------ */

#define NAME(part) [part] = #part
static const char *const names[NUM] = {
    NAME(PS_NUFFT_OPERATION),     NAME(PS_NUFFT_PASSED),
    NAME(PS_NUFFT_SORTED),        NAME(PS_NUFFT_PHASE),
    NAME(PS_NUFFT_COEFFICIENT),   NAME(PS_NUFFT_VALUE),
    NAME(PS_NUFFT_TOUCHED),       NAME(PS_NUFFT_CLEARED),
    NAME(PS_NUFFT_POWER),         NAME(PS_NUFFT_GRID_CELL),
    NAME(PS_NUFFT_GRID_PAIR),     NAME(PS_NUFFT_BOX_POINT),
    NAME(PS_NUFFT_BOX_ROW),       NAME(PS_NUFFT_BOX_CELL),
    NAME(PS_NUFFT_WHOLE_POINT),   NAME(PS_NUFFT_WHOLE_POLYNOMIAL),
    NAME(PS_NUFFT_WHOLE_ROW),     NAME(PS_NUFFT_WHOLE_FAR_ROW),
    NAME(PS_NUFFT_WHOLE_CELL),    NAME(PS_NUFFT_WHOLE_TURNED),
    NAME(PS_NUFFT_WHOLE_SHARED),  NAME(PS_NUFFT_WHOLE_POWER),
    NAME(PS_NUFFT_WHOLE_CLEARED), NAME(PS_NUFFT_STRIP_FAR),
};

/* The share of the cycles of all problems, each counting the same, that a part has. */
static double share_of(const measured *all, size_t num, size_t part) {
    double sum = 0;
    for (size_t p = 0; p < num; p++) {
        sum += all[p].counts.num[part] * ps_nufft_cycles[part] / all[p].cycles;
    }
    return sum / (double)num;
}

/* What a table says of the problems of a kind over what they took: geometric mean, and its spread.
 */
static void print_kind(const measured *all, size_t num, kind which, const double *cycles) {
    double sum = 0;
    double squares = 0;
    double count = 0;
    for (size_t p = 0; p < num; p++) {
        if (all[p].kind == which) {
            const double ratio = log(total(&all[p].counts, cycles) / all[p].cycles);
            sum += ratio;
            squares += ratio * ratio;
            count++;
        }
    }
    const double mean = sum / count;
    printf(" %8.2f x/ %4.2f", exp(mean), exp(sqrt(fmax(0, squares / count - mean * mean))));
}

static void print(const measured *all, size_t num, const double *cycles) {
    printf("ps_nufft_cycles, by %zu problems; kernels alone:\n", num);
    for (size_t i = 0; i < NUM; i++) {
        printf("    [%s] = %.2g, /* now %g, %.1f %% of the time */\n", names[i], cycles[i],
               ps_nufft_cycles[i], 100 * share_of(all, num, i));
    }
    printf("said / measured           by the table     by these\n");
    for (int which = 0; which < NUM_KINDS; which++) {
        printf("%-22s", kind_names[which]);
        print_kind(all, num, (kind)which, ps_nufft_cycles);
        print_kind(all, num, (kind)which, cycles);
        printf("\n");
    }
}

void bench_calibrate_cycles(const char *selector) {
    static measured all[MOST_PROBLEMS];
    size_t num = 0;
    ps_device *device = NULL;
    double cycles[NUM];
    BENCH_TRY(ps_device_open(&device, selector, true, error));
    const bool has_fp64 = ps_device_get_limits(device)->has_fp64;
    for (size_t s = 0; s < NUM_SHAPES; s++) {
        for (size_t e = 0; e < NUM_EXACTNESS; e++) {
            if (exactness[e].precision == PS_SINGLE || has_fp64) {
                num += measure(device, s, e, &all[num]);
            }
        }
    }
    fit(all, num, cycles);
    print(all, num, cycles);
    ps_device_close(device);
}
