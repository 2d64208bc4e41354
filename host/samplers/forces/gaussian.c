#include "samplers/forces/gaussian.h"

#include "base/memory.h"
#include "samplers/forces/loan.h"
#include "samplers/list.h"
#include "base/text.h"
#include "samplers/values.h"

#include <math.h>
#include <stdlib.h>

/* Of a step, in units of its force at sigma = 1. Where points lie evenly the energy falls below
 * e / (2 pi)^(d/2), 0.433 and 0.173: its strongest waves have half the length sqrt(2) pi sigma. At
 * 1/4 it would rise in space. */
static const double LENGTH_IN_PLANE = 0.25;
static const double LENGTH_IN_SPACE = 0.1;
/* After so many halvings no step was short enough: rounding alone is left of forces. */
enum { PLANE = 2, SPACE = 3, MOST_HALVINGS = 50 };

/* Refuses what cannot be made with a sentence. */
static pspec_status check(size_t num, unsigned dimension, double sigma, ps_error *error) {
    if (!(sigma >= PS_GAUSSIAN_LEAST_SIGMA && sigma <= PS_GAUSSIAN_MOST_SIGMA)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "sigma = %g: it is from %g to %g",
                       sigma, PS_GAUSSIAN_LEAST_SIGMA, PS_GAUSSIAN_MOST_SIGMA);
    }
    if (num < 1 || num > PS_GAUSSIAN_MOST_POINTS || dimension < PLANE || dimension > SPACE) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%zu points of %u coordinates: Gaussian blue noise has 1 to %d points of "
                       "%d or %d",
                       num, dimension, PS_GAUSSIAN_MOST_POINTS, PLANE, SPACE);
    }
    return PSPEC_OK;
}

/* sigma^d, and the stable length, which falls like its inverse; no longer below sigma = 1, where
 * pairs are on their own. */
static double step_length(unsigned dimension, double sigma) {
    const double volume = dimension == PLANE ? sigma * sigma : sigma * sigma * sigma;
    return (dimension == PLANE ? LENGTH_IN_PLANE : LENGTH_IN_SPACE) / (volume > 1 ? volume : 1);
}

static pspec_status allocate(ps_gaussian *g, size_t num, unsigned dimension, double sigma,
                             ps_error *error) {
    const size_t numbers = num * dimension;
    PS_TRY(ps_gaussian_sums_create(&g->sums, num, dimension, sigma, error));
    PS_TRY(PS_NEW(&g->x, numbers, "points", error));
    PS_TRY(PS_NEW(&g->next_x, numbers, "points of a step", error));
    PS_TRY(PS_NEW(&g->force, numbers, "forces on points", error));
    return PS_NEW(&g->next_force, numbers, "forces on points", error);
}

pspec_status ps_gaussian_begin(ps_gaussian *g, size_t num, unsigned dimension, double sigma,
                               const double *points, ps_device *device, const ps_watch *watch,
                               ps_error *error) {
    *g = (ps_gaussian){.unit = ps_gaussian_unit(num, dimension),
                       .length = step_length(dimension, sigma),
                       .watch = watch};
    PS_TRY(check(num, dimension, sigma, error));
    PS_TRY(allocate(g, num, dimension, sigma, error));
    if (device != NULL) {
        PS_TRY(ps_gaussian_device_create(&g->on_device, device, &g->sums, error));
        g->sums.device = &g->on_device;
    }
    for (size_t i = 0; i < num * dimension; i++) {
        g->x[i] = points[i];
    }
    return ps_gaussian_sums_find(&g->sums, g->x, watch, &g->energy, g->force, error);
}

void ps_gaussian_destroy(ps_gaussian *g) {
    ps_gaussian_device_destroy(&g->on_device);
    ps_gaussian_sums_destroy(&g->sums);
    free(g->x);
    free(g->next_x);
    free(g->force);
    free(g->next_force);
}

/* Points of the step that is tried; returns the farthest move. */
static double try_step(ps_gaussian *g) {
    const unsigned dimension = g->sums.dimension;
    double farthest2 = 0;
    for (size_t i = 0; i < g->sums.num; i++) {
        double square = 0;
        for (unsigned axis = 0; axis < dimension; axis++) {
            const size_t at = i * dimension + axis;
            const double move = g->length * g->force[at];
            g->next_x[at] = ps_forces_wrap(g->x[at] + move);
            square += move * move;
        }
        farthest2 = square > farthest2 ? square : farthest2;
    }
    return sqrt(farthest2) / g->unit;
}

static void exchange(double **a, double **b) {
    double *const kept = *a;
    *a = *b;
    *b = kept;
}

pspec_status ps_gaussian_step(ps_gaussian *g, ps_error *error) {
    for (;;) {
        double energy = 0;
        g->move = try_step(g);
        PS_TRY(ps_gaussian_sums_find(&g->sums, g->next_x, g->watch, &energy, g->next_force, error));
        if (energy <= g->energy) {
            g->energy = energy;
            break;
        }
        if (g->halvings == MOST_HALVINGS) {
            g->move = 0;
            return PSPEC_OK;
        }
        g->length /= 2;
        g->halvings++;
    }
    exchange(&g->x, &g->next_x);
    exchange(&g->force, &g->next_force);
    g->steps++;
    return PSPEC_OK;
}

double ps_gaussian_excess(const ps_gaussian *g, double sigma) {
    const double twice_pi = 6.283185307179586477;
    const double area = twice_pi * sigma * sigma;
    const double volume = g->sums.dimension == PLANE ? area : area * sqrt(area);
    return g->energy - (double)g->sums.num / 2 * (volume - 1);
}

static pspec_status run(ps_gaussian *g, ps_error *error) {
    do {
        PS_TRY(ps_watch_tell(g->watch, "sampler: gaussian-blue-noise, steps", g->steps, 0, NULL,
                             error));
        PS_TRY(ps_gaussian_step(g, error));
    } while (g->move > PS_GAUSSIAN_STILL && g->steps < PS_GAUSSIAN_MOST_STEPS);
    return PSPEC_OK;
}

pspec_status ps_gaussian_make(size_t num, unsigned dimension, double sigma, ps_random *random,
                              ps_device *device, const ps_watch *watch, double *points,
                              ps_error *error) {
    ps_gaussian g;
    PS_TRY(check(num, dimension, sigma, error));
    ps_random_fill_uniform(random, points, num * dimension);
    pspec_status status =
        ps_gaussian_begin(&g, num, dimension, sigma, points, device, watch, error);
    if (status == PSPEC_OK) {
        status = run(&g, error);
    }
    for (size_t i = 0; i < num * dimension && status == PSPEC_OK; i++) {
        points[i] = g.x[i];
    }
    ps_gaussian_destroy(&g);
    return status;
}

/* ---- the row --------------------------------------------------------------------------------- */

enum { SIGMA };

/* Steps: 2000 to 2800 for N from 256 to 4096 at sigma = 1, 8000 at 0.7, as many as may be at 0.5,
 * 1370 at 1.5 and 2. */
static double steps_of(double sigma) {
    const double steps = 2400;
    const double s2 = sigma * sigma;
    return sigma >= 1 ? steps / sigma : fmin(steps / (s2 * s2), PS_GAUSSIAN_MOST_STEPS);
}

/* On the host. Microseconds of a point and step are 0.64, 1.65 and 5.2 in the plane at sigma = 0.5,
 * 1 and 2, 26 and 158 in space at 1 and 2 (a core of an EPYC with AVX2, gcc 12 -O2, 2026-11). */
static double host_seconds(const ps_sampler_request *request) {
    const double sigma = ps_sampler_number(request, SIGMA);
    const double s2 = sigma * sigma;
    const double microseconds = request->dimension == PLANE ? 0.3 + 1.3 * s2 : 4 + 20 * s2 * sigma;
    return (double)request->num_points * steps_of(sigma) * microseconds * 1e-6;
}

/* Sets that take longer on the host are the device's work. */
static const double LEAST_SECONDS = 1;

static bool is_of_device(const ps_sampler_request *request) {
    return host_seconds(request) >= LEAST_SECONDS;
}

/* A device takes half of the host's time of one core (PoCL 3.1). */
static double seconds(const ps_sampler_request *request) {
    const double host = host_seconds(request);
    return is_of_device(request) ? host / 2 : host;
}

static pspec_status check_device(const ps_sampler_request *request, const char *selector,
                                 ps_error *error) {
    return is_of_device(request) ? ps_loan_check(request, selector, true, error) : PSPEC_OK;
}

/* Points and forces before and after a step, and the sums, which a device has once more. */
static double work_bytes(const ps_sampler_request *request) {
    const double steps = 4 * (double)sizeof(double) * request->dimension;
    return (double)request->num_points * steps +
           2 * ps_gaussian_sums_bytes(request->num_points, request->dimension);
}

static pspec_status generate(const ps_sampler_request *request, uint64_t realization,
                             double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_COORDINATES, realization);
    ps_loan loan = {0};
    const double sigma = ps_sampler_number(request, SIGMA);
    pspec_status status =
        is_of_device(request) ? ps_loan_begin(&loan, request, true, error) : PSPEC_OK;
    if (status == PSPEC_OK) {
        status = ps_gaussian_make(request->num_points, request->dimension, sigma, &random,
                                  loan.device, request->watch, points, error);
    }
    ps_loan_end(&loan);
    return status;
}

const ps_sampler ps_sampler_gaussian_blue_noise = {
    .name = "gaussian-blue-noise",
    .summary = "points at a low of the sum of Gaussians of their distances",
    .aliases = {"gbn"},
    .minimum_dimension = PLANE,
    .maximum_dimension = SPACE,
    .maximum_points = PS_GAUSSIAN_MOST_POINTS,
    .parameters = {{"sigma", "1",
                    "0.5 to 2, width of the Gaussians in N^(-1/d); larger ones order more"}},
    .ranges = {{PS_GAUSSIAN_LEAST_SIGMA, PS_GAUSSIAN_MOST_SIGMA, false}},
    .version = 2,
    .seconds = seconds,
    .work_bytes = work_bytes,
    .is_deterministic = ps_sampler_never,
    .check_device = check_device,
    .generate = generate,
};
