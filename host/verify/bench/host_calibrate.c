/* How long the host's own work takes against the built-in cost model: every kind that has a probe
 * (host_probes.h). */
#include "verify/bench/bench_private.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/text.h"
#include "samplers/sampler.h"
#include "verify/bench/host_probes.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

/* All probes take their turn so often, and the middle of their times counts: a plan says what a job
 * usually takes here, on a machine with neighbours, too. */
enum { ROUNDS = 7 };

/* What a figure may be: host/store/figures_file.c does not take others. */
static const double least_scale = 1e-3, most_scale = 1e3;

/* Seconds over predicted ones, of every round: of the probes, then of the samplers. */
typedef double probe_scales[PS_FIGURES_HOST][ROUNDS];

static double limit_scale(double scale) {
    return fmin(fmax(scale, least_scale), most_scale);
}

static pspec_status measure_probe(ps_probe_data *data, const ps_probe *what, double *scale,
                                  ps_error *error) {
    data->unmeasured = 0;
    const double begin = ps_clock_seconds();
    PS_TRY(what->run(data, what, error));
    *scale = limit_scale((ps_clock_seconds() - begin - data->unmeasured) /
                         ps_host_seconds(NULL, what->kind, what->seconds));
    return PSPEC_OK;
}

static pspec_status measure_sampler(ps_probe_data *data, const ps_sampler *sampler, double *scale,
                                    ps_error *error) {
    double predicted = 1;
    const double begin = ps_clock_seconds();
    PS_TRY(ps_probe_sampler(sampler, data->numbers, &predicted, error));
    *scale = predicted > 0 ? limit_scale((ps_clock_seconds() - begin) / predicted) : 1;
    return PSPEC_OK;
}

static pspec_status measure_round(ps_probe_data *data, const ps_bench_options *options,
                                  probe_scales scales, size_t round, ps_error *error) {
    size_t at = 0;
    for (size_t i = 0; i < PS_NUM_PROBES; i++) {
        PS_TRY(ps_bench_go_on(options, error));
        PS_TRY(measure_probe(data, &ps_probes[i], &scales[at++][round], error));
    }
    for (size_t i = 0; ps_samplers[i] != NULL && at < PS_FIGURES_HOST; i++) {
        PS_TRY(ps_bench_go_on(options, error));
        PS_TRY(measure_sampler(data, ps_samplers[i], &scales[at++][round], error));
    }
    return PSPEC_OK;
}

static void keep(ps_figures *figures, const char *name, double scale) {
    ps_host_figure *const row = ps_figures_host_row(figures, name);
    if (row != NULL) {
        row->scale = scale;
    }
}

/* Of a kind that has several probes, the geometric mean of theirs. */
static void keep_kind(ps_figures *figures, ps_host_kind kind, probe_scales scales) {
    double logarithms = 0;
    double num = 0;
    for (size_t i = 0; i < PS_NUM_PROBES; i++) {
        if (ps_probes[i].kind == kind) {
            logarithms += log(ps_bench_median(scales[i], ROUNDS));
            num++;
        }
    }
    keep(figures, ps_host_kind_name(kind), exp(logarithms / num));
}

static pspec_status measure_all(ps_probe_data *data, const ps_bench_options *options,
                                ps_figures *figures, ps_error *error) {
    probe_scales scales;
    size_t at = PS_NUM_PROBES;
    for (size_t round = 0; round < ROUNDS; round++) {
        if (options->advance != NULL) {
            options->advance(options->payload, round, ROUNDS);
        }
        PS_TRY(measure_round(data, options, scales, round, error));
    }
    for (int kind = 0; kind < PS_NUM_HOST_KINDS; kind++) {
        keep_kind(figures, (ps_host_kind)kind, scales);
    }
    for (size_t i = 0; ps_samplers[i] != NULL && at < PS_FIGURES_HOST; i++) {
        keep(figures, ps_samplers[i]->name, ps_bench_median(scales[at++], ROUNDS));
    }
    return PSPEC_OK;
}

static pspec_status prepare(ps_probe_data *data, void **memory, ps_error *error) {
    ps_sampler_request white = {0};
    PS_TRY(ps_allocate(memory, PS_PROBE_POINTS, 6 * sizeof(double), "points", error));
    data->points = *memory;
    data->numbers = data->points + (size_t)3 * PS_PROBE_POINTS;
    PS_TRY(ps_sampler_parse(&white, "white-sphere", error));
    white.num_points = PS_PROBE_POINTS;
    PS_TRY(ps_sampler_resolve(&white, error));
    return ps_sampler_generate(&white, 0, data->points, NULL, NULL, error);
}

pspec_status ps_bench_calibrate_host(const ps_bench_options *options, const char *folder,
                                     ps_figures *figures, ps_error *error) {
    void *memory = NULL;
    ps_text file = {0};
    ps_text_append(&file, "%s/devices/probe.%ld", folder, (long)getpid());
    ps_probe_data data = {
        .file = ps_text_string(&file), .program = options->program, .device = options->device};
    *figures = (ps_figures){.is_measured = true};
    pspec_status status = ps_text_check(&file, error);
    if (status == PSPEC_OK) {
        status = prepare(&data, &memory, error);
    }
    if (status == PSPEC_OK) {
        status = measure_all(&data, options, figures, error);
        unlink(data.file);
    }
    ps_representer_destroy(&data.representer);
    free(memory);
    ps_text_free(&file);
    return status;
}
