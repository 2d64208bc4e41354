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

/* What a figure may be: host/store/figures_text.c does not take others. */
static const double least_scale = 1e-3, most_scale = 1e3;

/* Seconds over predicted ones, of every round. */
typedef double probe_scales[PS_NUM_HOST_KINDS][ROUNDS];

static pspec_status measure(ps_probe_data *data, const ps_probe *what, double *scale,
                            ps_error *error) {
    double predicted = 1;
    data->unmeasured = 0;
    const double begin = ps_clock_seconds();
    PS_TRY(what->run(data, what, &predicted, error));
    const double found = (ps_clock_seconds() - begin - data->unmeasured) / predicted;
    *scale = fmin(fmax(found, least_scale), most_scale);
    return PSPEC_OK;
}

static pspec_status measure_rounds(ps_probe_data *data, const ps_bench_options *options,
                                   probe_scales scales, ps_error *error) {
    for (size_t round = 0; round < ROUNDS; round++) {
        if (options->advance != NULL) {
            options->advance(options->payload, round, ROUNDS);
        }
        for (size_t i = 0; ps_probes[i].run != NULL; i++) {
            PS_TRY(ps_bench_go_on(options, error));
            PS_TRY(measure(data, &ps_probes[i], &scales[i][round], error));
        }
    }
    return PSPEC_OK;
}

static pspec_status measure_all(ps_probe_data *data, const ps_bench_options *options,
                                ps_figures *figures, ps_error *error) {
    probe_scales scales;
    PS_TRY(measure_rounds(data, options, scales, error));
    for (size_t i = 0; ps_probes[i].run != NULL; i++) {
        ps_host_figure *const row =
            ps_figures_host_row(figures, ps_host_kind_name(ps_probes[i].kind));
        if (row != NULL) {
            row->scale = ps_bench_median(scales[i], ROUNDS);
        }
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
    return ps_sampler_generate(&white, 0, data->points, NULL, error);
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
