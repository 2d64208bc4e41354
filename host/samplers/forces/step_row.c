/* The row of step blue noise: docs/samplers/forces.md#step. */
#include "samplers/list.h"

#include "base/text.h"
#include "samplers/forces/loan.h"
#include "samplers/forces/step.h"
#include "samplers/values.h"

#include <math.h>

enum { ROUNDS };

static pspec_status rounds_of(const ps_sampler_request *request, unsigned *rounds,
                              ps_error *error) {
    uint64_t number = 0;
    PS_TRY(ps_parse_count(request->values[ROUNDS], "sampler step: rounds", 1, PS_STEP_MOST_ROUNDS,
                          &number, error));
    *rounds = (unsigned)number;
    return PSPEC_OK;
}

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    unsigned rounds = 0;
    PS_TRY(ps_sampler_limit_points(request, PS_STEP_MOST_POINTS, error));
    return rounds_of(request, &rounds, error);
}

/* Rounds grow like the fourth root of N, from 270 at 256 points to 550 at 4096; launches of a round
 * take 0.1 ms of one core, a pair 2.5 ns, what the host does in a round 0.2 us a point (an EPYC
 * with AVX-512, PoCL 3.1, 2026-11). A device is opened once for many sets. */
static double seconds(const ps_sampler_request *request) {
    const double num = (double)request->num_points;
    unsigned most = 0;
    const double rounds =
        rounds_of(request, &most, NULL) == PSPEC_OK ? fmin(270 * sqrt(sqrt(num / 256)), most) : 0;
    return rounds * (1e-4 + num * (num / 2 * 2.5e-9 + 0.2e-6));
}

static double work_bytes(const ps_sampler_request *request) {
    return ps_step_bytes(request->num_points);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    ps_loan loan = {0};
    unsigned rounds = 0;
    PS_TRY(rounds_of(request, &rounds, error));
    pspec_status status = ps_loan_begin(&loan, request, false, error);
    if (status == PSPEC_OK) {
        status = ps_step_make(request->num_points, (ps_step_options){rounds, PS_STEP_SMOOTHING},
                              &random, loan.device, request->watch, points, NULL, error);
    }
    ps_loan_end(&loan);
    return status;
}

static pspec_status check_device(const ps_sampler_request *request, const char *selector,
                                 ps_error *error) {
    return ps_loan_check(request, selector, false, error);
}

const ps_sampler ps_sampler_step = {
    .name = "step",
    .summary = "blue noise whose spectrum is a step, on a device",
    .aliases = {"step-blue-noise"},
    .minimum_dimension = 2,
    .maximum_dimension = 2,
    .minimum_points = PS_STEP_LEAST_POINTS,
    .parameters = {{"rounds", "10000",
                    "1 to 10000, moves of all points after which it ends with the best so far"}},
    .version = 2,
    .seconds = seconds,
    .work_bytes = work_bytes,
    .is_deterministic = ps_sampler_never,
    .check = check,
    .check_device = check_device,
    .generate = generate,
};
