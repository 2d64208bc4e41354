/* See host_probes.h. */
#include "verify/bench/host_probes.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/workers.h"
#include "engines/host/host_direct.h"
#include "engines/pairs/pairs_zonal.h"
#include "points/points.h"
#include "rules/kernel_factor.h"
#include "rules/kernel_system.h"
#include "rules/worst_case_error.h"
#include "spectra/bins.h"
#include "verify/bench/start_probes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static double predict(const ps_probe *what, double units) {
    return ps_host_seconds(NULL, what->kind, units);
}

/* ---- points -------------------------------------------------------------------------------- */

static pspec_status write_points(ps_probe_data *data, const ps_probe *what, double *predicted,
                                 ps_error *error) {
    /* So many that making the file durable, some 10 ms whatever its size, weighs little: 42 MB, and
     * 2.6 MB of text. */
    enum { AXES = 2, BINARY_SETS = 20, TEXT_SETS = 5 };
    const uint32_t num_sets = what->kind == PS_HOST_WRITE_BINARY ? BINARY_SETS : TEXT_SETS;
    ps_point_writer *writer = NULL;
    const size_t num = PS_PROBE_POINTS;
    const ps_point_shape shape = {.num_sets = num_sets, .num_points = num, .dimension = AXES};
    const ps_point_set set = {.dimension = AXES, .num_points = num, .points = data->numbers};
    for (size_t i = 0; i < AXES * num; i++) { /* what was sampled last may be vectors */
        data->numbers[i] = fabs(data->points[i]) / 2;
    }
    const double begin = ps_clock_seconds();
    unlink(data->file); /* of the round before: what it takes is not of a new file */
    data->unmeasured = ps_clock_seconds() - begin;
    PS_TRY(ps_points_create(&writer, data->file, what->argument, &shape, error));
    pspec_status status = PSPEC_OK;
    for (uint32_t i = 0; i < num_sets && status == PSPEC_OK; i++) {
        status = ps_points_write(writer, &set, true, error);
    }
    if (status == PSPEC_OK) {
        status = ps_points_commit(writer, error);
    }
    ps_points_discard(writer);
    *predicted = predict(what, (double)(num_sets * num * AXES));
    return status;
}

/* The file that was written last. */
static pspec_status read_points(ps_probe_data *data, const ps_probe *what, double *predicted,
                                ps_error *error) {
    const ps_point_options options = {.format = what->argument};
    ps_point_reader *reader = NULL;
    ps_point_set set = {0};
    bool has_set = false;
    PS_TRY(ps_points_open(&reader, data->file, &options, error));
    pspec_status status = PSPEC_OK;
    do {
        status = ps_points_next(reader, &set, &has_set, error);
    } while (status == PSPEC_OK && has_set);
    ps_points_close(reader);
    ps_point_set_free(&set);
    struct stat found;
    if (stat(data->file, &found) == 0) {
        *predicted = predict(what, (double)found.st_size);
    }
    return status;
}

/* ---- sums ---------------------------------------------------------------------------------- */

static pspec_status refer(ps_probe_data *data, const ps_probe *what, double *predicted,
                          ps_error *error) {
    enum { NUM = 20000 };
    const pspec_pattern pattern = {2, NUM, data->points, NULL};
    const int32_t k[2] = {17, -5};
    long double re = 0;
    long double im = 0;
    (void)error;
    ps_host_sum(&pattern, k, &re, &im);
    *predicted = predict(what, NUM);
    return PSPEC_OK;
}

static pspec_status refer_degree(ps_probe_data *data, const ps_probe *what, double *predicted,
                                 ps_error *error) {
    enum { NUM = 1000, DEGREE = 200 };
    const pspec_pattern pattern = {3, NUM, data->points, NULL};
    ps_frequencies degrees = {0};
    long double power = 0;
    PS_TRY(ps_frequencies_degrees(&degrees, DEGREE, false, error));
    pspec_status status = ps_frequencies_enumerate(&degrees, error);
    if (status == PSPEC_OK) {
        status = ps_host_power(&pattern, &degrees, DEGREE - 1, 0, &power, error);
    }
    ps_frequencies_free(&degrees);
    *predicted = predict(what, (double)NUM * DEGREE);
    return status;
}

static pspec_status sum_zonal(ps_probe_data *data, const ps_probe *what, double *predicted,
                              ps_error *error) {
    enum { NUM = 8192, DEGREE = 256 };
    const pspec_pattern pattern = {3, NUM, data->points, NULL};
    (void)error;
    ps_zonal_sums(&pattern, 0, DEGREE, data->numbers, data->numbers + ps_zonal_scratch(DEGREE));
    *predicted = predict(what, (double)NUM * DEGREE * ps_workers_most()); /* by one thread */
    return PSPEC_OK;
}

/* ---- quadrature ---------------------------------------------------------------------------- */

static pspec_status make_lobe(ps_probe_data *data, const ps_probe *what, double *predicted,
                              ps_error *error) {
    enum { DEGREES = 2000 };
    ps_brdf *brdf = NULL;
    PS_TRY(ps_brdf_parse(&brdf, what->argument, error));
    ps_representer_destroy(&data->representer);
    const pspec_status status =
        ps_representer_create(&data->representer, brdf, 1.5, 1, DEGREES, error);
    ps_brdf_destroy(brdf);
    *predicted = predict(what, (double)data->representer.max_degree);
    return status;
}

static pspec_status make_kappa(ps_probe_data *data, const ps_probe *what, double *predicted,
                               ps_error *error) {
    enum { NUM = 8192 };
    (void)error;
    ps_representer_kappa(&data->representer, NUM, data->points, data->numbers);
    *predicted = predict(what, (double)NUM * (double)data->representer.num_terms);
    return PSPEC_OK;
}

static pspec_status sum_distances(ps_probe_data *data, const ps_probe *what, double *predicted,
                                  ps_error *error) {
    enum { NUM = 6000 };
    const ps_rule rule = {NUM, data->points, NULL};
    const double smoothness = strcmp(what->argument, "power") == 0 ? 1.7 : 1.5;
    double sum = 0;
    *predicted = predict(what, (double)NUM * NUM / 2);
    return ps_rule_distance(&rule, smoothness, NULL, &sum, error);
}

/* A whole system: mostly the factor where it is large, mostly the entries where it is small. */
static pspec_status solve_system(ps_probe_data *data, const ps_probe *what, double *predicted,
                                 ps_error *error) {
    ps_kernel_system *system = NULL;
    const size_t num = what->kind == PS_HOST_CHOLESKY ? 1600 : 400;
    const double square = (double)(num * num);
    double *const right = data->numbers;
    double *const x = data->numbers + num;
    for (size_t i = 0; i < num; i++) {
        right[i] = 1;
    }
    PS_TRY(ps_kernel_system_create(&system, num, data->points, 1.5, NULL, error));
    const pspec_status status = ps_kernel_system_solve(system, right, x, NULL, error);
    ps_kernel_system_destroy(system);
    *predicted = ps_host_seconds(NULL, PS_HOST_CHOLESKY, square * (double)num / 3) +
                 ps_host_seconds(NULL, PS_HOST_MATRIX, square) +
                 ps_host_seconds(NULL, PS_HOST_SOLVE, square);
    return status;
}

static pspec_status find_neighbours(ps_probe_data *data, const ps_probe *what, double *predicted,
                                    ps_error *error) {
    const double num = what->kind == PS_HOST_NEIGHBOURS ? 20000 : 1000;
    ps_kernel_factor factor;
    const pspec_status status =
        ps_kernel_factor_create(&factor, 1.5, (size_t)num, data->points, NULL, error);
    ps_kernel_factor_free(&factor);
    *predicted = ps_host_seconds(NULL, PS_HOST_NEIGHBOURS, num * num / 2) +
                 ps_host_seconds(NULL, PS_HOST_INVERSE, num);
    return status;
}

/* ---- memory -------------------------------------------------------------------------------- */

/* So much at once comes from the system and goes back to it. */
static pspec_status touch_memory(ps_probe_data *data, const ps_probe *what, double *predicted,
                                 ps_error *error) {
    enum { BYTES = 1 << 26, PAGE = 4096 };
    char *memory = NULL;
    (void)data;
    PS_TRY(PS_NEW(&memory, BYTES, "memory to touch", error));
    for (size_t i = 0; i < BYTES; i += PAGE) {
        ((volatile char *)memory)[i] = 1;
    }
    free(memory);
    *predicted = predict(what, BYTES);
    return PSPEC_OK;
}

/* ---- frequencies --------------------------------------------------------------------------- */

static pspec_status enumerate(ps_probe_data *data, const ps_probe *what, double *predicted,
                              ps_error *error) {
    enum { K = 300 };
    ps_frequencies grid = {0};
    ps_bins bins = {0};
    (void)data;
    PS_TRY(ps_frequencies_lattice(&grid, 2, K, true, error));
    pspec_status status = ps_frequencies_enumerate(&grid, error);
    if (status == PSPEC_OK) {
        status = ps_bins_create(&bins, &grid, error);
    }
    *predicted = predict(what, (double)grid.num);
    ps_bins_free(&bins);
    ps_frequencies_free(&grid);
    return status;
}

/* ---- all ----------------------------------------------------------------------------------- */

const ps_probe ps_probes[] = {
    {PS_HOST_START, "", ps_probe_start},
    {PS_HOST_DRIVER, "", ps_probe_start},
    {PS_HOST_KERNEL, "", ps_probe_start},
    {PS_HOST_MEMORY, "", touch_memory},
    {PS_HOST_WRITE_BINARY, "npy", write_points},
    {PS_HOST_READ_BINARY, "npy", read_points},
    {PS_HOST_WRITE_TEXT, "utk-text", write_points},
    {PS_HOST_READ_TEXT, "utk-text", read_points},
    {PS_HOST_REFEREE, "", refer},
    {PS_HOST_REFEREE_DEGREE, "", refer_degree},
    {PS_HOST_ZONAL, "", sum_zonal},
    {PS_HOST_LOBE, "glossy:n=30", make_lobe},
    {PS_HOST_KAPPA, "", make_kappa},
    {PS_HOST_PAIR, "", sum_distances},
    {PS_HOST_PAIR_POWER, "power", sum_distances},
    {PS_HOST_MATRIX, "", solve_system},
    {PS_HOST_CHOLESKY, "", solve_system},
    {PS_HOST_INVERSE, "", find_neighbours},
    {PS_HOST_NEIGHBOURS, "", find_neighbours},
    {PS_HOST_FREQUENCY, "", enumerate},
    {PS_NUM_HOST_KINDS, NULL, NULL},
};
