/* How long samplers take on this host against their rows. */
#include "verify/bench/bench_private.h"

#include "base/clock.h"
#include "base/memory.h"
#include "samplers/sampler.h"

#include <math.h>
#include <stdlib.h>

/* All samplers take their turn so often, and the middle of their times counts: a plan says what a
 * job usually takes here, on a machine with neighbours, too. */
enum { ROUNDS = 7 };

enum { MOST_POINTS = 1 << 17 };

/* A realization should not take longer, and cannot be timed well far below. */
static const double most_seconds = 10e-3;

/* What a figure may be: host/store/figures_file.c does not take others. */
static const double least_scale = 1e-3, most_scale = 1e3;

/* May it be, and is there room? */
static bool fits(ps_sampler_request *request, size_t num_points) {
    request->num_points = num_points;
    return ps_sampler_resolve(request, NULL) == PSPEC_OK &&
           ps_sampler_most_points(request) <= MOST_POINTS &&
           ps_sampler_seconds(request) <= most_seconds;
}

/* Every sampler has some of the powers of two, or of three quarters of them: HEALPix has 12 nside^2
 * points. False: it takes too long even for the fewest points. */
static bool choose_points(ps_sampler_request *request) {
    for (size_t num = MOST_POINTS; num > 0; num /= 2) {
        if (fits(request, num) || fits(request, num - num / 4)) {
            return true;
        }
    }
    return false;
}

static pspec_status measure(const ps_sampler *sampler, double *room, double *scale,
                            ps_error *error) {
    ps_sampler_request request = {.seed = 1};
    size_t num = 0;
    *scale = 1;
    PS_TRY(ps_sampler_parse(&request, sampler->name, error));
    if (choose_points(&request)) {
        const double begin = ps_clock_seconds();
        PS_TRY(ps_sampler_generate(&request, 0, room, &num, NULL, error));
        *scale = (ps_clock_seconds() - begin) / ps_sampler_seconds(&request);
        *scale = fmin(fmax(*scale, least_scale), most_scale);
    }
    return PSPEC_OK;
}

static pspec_status measure_all(const ps_suite_options *options, double *room,
                                double scales[PS_FIGURES_HOST][ROUNDS], ps_error *error) {
    for (size_t round = 0; round < ROUNDS; round++) {
        if (options->advance != NULL) {
            options->advance(options->payload, round, ROUNDS);
        }
        for (size_t i = 0; ps_samplers[i] != NULL && i < PS_FIGURES_HOST; i++) {
            PS_TRY(ps_suite_go_on(options, error));
            PS_TRY(measure(ps_samplers[i], room, &scales[i][round], error));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_bench_calibrate_host(const ps_suite_options *options, ps_figures *figures,
                                     ps_error *error) {
    double scales[PS_FIGURES_HOST][ROUNDS];
    double *room = NULL;
    *figures = (ps_figures){.is_measured = true};
    PS_TRY(ps_allocate_for(&room, MOST_POINTS, 3 * sizeof *room, "points", error));
    const pspec_status status = measure_all(options, room, scales, error);
    free(room);
    for (size_t i = 0; status == PSPEC_OK && ps_samplers[i] != NULL && i < PS_FIGURES_HOST; i++) {
        ps_host_figure *const row = ps_figures_host_row(figures, ps_samplers[i]->name);
        if (row != NULL) {
            row->scale = ps_bench_median(scales[i], ROUNDS);
        }
    }
    return status;
}
