/* See host_probes.h. */
#include "verify/bench/host_probes.h"

#include "base/clock.h"
#include "base/memory.h"
#include "engines/host/host_direct.h"
#include "points/points.h"
#include "rules/kernel/kernel_factor.h"
#include "rules/worst_case_error.h"
#include "spectra/bins.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

/* ---- points -------------------------------------------------------------------------------- */

static const char *format_of(const ps_probe *what) {
    return what->kind == PS_HOST_BINARY ? "npy" : "utk-text";
}

static pspec_status write_points(ps_probe_data *data, const ps_probe *what, ps_error *error) {
    /* So many that making the file durable, some 10 ms whatever its size, weighs little: 42 MB, and
     * 2.6 MB of text. */
    enum { AXES = 2, BINARY_SETS = 20, TEXT_SETS = 5 };
    const uint32_t num_sets = what->kind == PS_HOST_BINARY ? BINARY_SETS : TEXT_SETS;
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
    PS_TRY(ps_points_create(&writer, data->file, format_of(what), &shape, error));
    pspec_status status = PSPEC_OK;
    for (uint32_t i = 0; i < num_sets && status == PSPEC_OK; i++) {
        status = ps_points_write(writer, &set, true, error);
    }
    if (status == PSPEC_OK) {
        status = ps_points_commit(writer, error);
    }
    ps_points_discard(writer);
    return status;
}

/* The file that was written last. */
static pspec_status read_points(ps_probe_data *data, const ps_probe *what, ps_error *error) {
    const ps_point_options options = {.format = format_of(what)};
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
    return status;
}

/* ---- sums ---------------------------------------------------------------------------------- */

static pspec_status refer(ps_probe_data *data, const ps_probe *what, ps_error *error) {
    enum { NUM = 20000 };
    (void)what;
    const pspec_pattern pattern = {2, NUM, data->points, NULL};
    const int32_t k[2] = {17, -5};
    long double re = 0;
    long double im = 0;
    (void)error;
    ps_host_sum(&pattern, k, &re, &im);
    return PSPEC_OK;
}

static pspec_status refer_degree(ps_probe_data *data, const ps_probe *what, ps_error *error) {
    enum { NUM = 1000, DEGREE = 200 };
    (void)what;
    const pspec_pattern pattern = {3, NUM, data->points, NULL};
    ps_frequencies degrees = {0};
    long double power = 0;
    PS_TRY(ps_frequencies_degrees(&degrees, DEGREE, false, error));
    pspec_status status = ps_frequencies_enumerate(&degrees, error);
    if (status == PSPEC_OK) {
        status = ps_host_power(&pattern, &degrees, DEGREE - 1, 0, &power, error);
    }
    ps_frequencies_free(&degrees);
    return status;
}

/* ---- quadrature ---------------------------------------------------------------------------- */

static pspec_status make_lobe(ps_probe_data *data, const ps_probe *what, ps_error *error) {
    enum { DEGREES = 20000 };
    (void)what;
    ps_brdf *brdf = NULL;
    PS_TRY(ps_brdf_parse(&brdf, "glossy:n=30", error));
    ps_representer_destroy(&data->representer);
    const pspec_status status =
        ps_representer_create(&data->representer, brdf, 1.5, 1, DEGREES, error);
    ps_brdf_destroy(brdf);
    return status;
}

static pspec_status make_kappa(ps_probe_data *data, const ps_probe *what, ps_error *error) {
    enum { NUM = 2048 };
    (void)what;
    (void)error;
    ps_representer_kappa(&data->representer, NUM, data->points, data->numbers);
    return PSPEC_OK;
}

static pspec_status sum_distances(ps_probe_data *data, const ps_probe *what, ps_error *error) {
    enum { NUM = 6000 };
    const ps_rule rule = {NUM, data->points, NULL};
    const double smoothness = what->kind == PS_HOST_POWERS ? 1.7 : 1.5;
    double sum = 0;
    return ps_rule_distance(&rule, smoothness, NULL, &sum, error);
}

static pspec_status invert_neighbours(ps_probe_data *data, const ps_probe *what, ps_error *error) {
    enum { NUM = 1000 };
    (void)what;
    ps_kernel_factor factor;
    const pspec_status status =
        ps_kernel_factor_create(&factor, 1.5, NUM, data->points, NULL, error);
    ps_kernel_factor_free(&factor);
    return status;
}

/* ---- memory -------------------------------------------------------------------------------- */

/* So much at once comes from the system and goes back to it. */
static pspec_status touch_memory(ps_probe_data *data, const ps_probe *what, ps_error *error) {
    enum { BYTES = 1 << 26, PAGE = 4096 };
    (void)what;
    char *memory = NULL;
    (void)data;
    PS_TRY(PS_NEW(&memory, BYTES, "memory to touch", error));
    for (size_t i = 0; i < BYTES; i += PAGE) {
        ((volatile char *)memory)[i] = 1;
    }
    free(memory);
    return PSPEC_OK;
}

/* ---- frequencies --------------------------------------------------------------------------- */

static pspec_status enumerate(ps_probe_data *data, const ps_probe *what, ps_error *error) {
    enum { K = 300 };
    (void)what;
    ps_frequencies grid = {0};
    ps_bins bins = {0};
    (void)data;
    PS_TRY(ps_frequencies_lattice(&grid, 2, K, true, error));
    pspec_status status = ps_frequencies_enumerate(&grid, error);
    if (status == PSPEC_OK) {
        status = ps_bins_create(&bins, &grid, error);
    }
    ps_bins_free(&bins);
    ps_frequencies_free(&grid);
    return status;
}

/* ---- all ----------------------------------------------------------------------------------- */

const ps_probe ps_probes[PS_NUM_PROBES] = {
    {PS_HOST_START, 647e-3, ps_probe_start}, {PS_HOST_MEMORY, 34e-3, touch_memory},
    {PS_HOST_BINARY, 31e-3, write_points},   {PS_HOST_BINARY, 6.3e-3, read_points},
    {PS_HOST_TEXT, 79e-3, write_points},     {PS_HOST_TEXT, 22e-3, read_points},
    {PS_HOST_REFEREE, 3.8e-3, refer},        {PS_HOST_REFEREE, 4e-3, refer_degree},
    {PS_HOST_SCALAR, 0.7e-3, make_lobe},     {PS_HOST_SCALAR, 3.6e-3, enumerate},
    {PS_HOST_SUMS, 16e-3, make_kappa},       {PS_HOST_SUMS, 20e-3, sum_distances},
    {PS_HOST_POWERS, 72e-3, sum_distances},  {PS_HOST_DENSE, 14e-3, invert_neighbours},
};
