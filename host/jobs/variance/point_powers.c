#include "jobs/variance/prediction.h"

#include "base/memory.h"
#include "plan/choose.h"

#include <math.h>
#include <stdlib.h>

typedef struct work {
    ps_integrand_points points;
    const ps_point_way *way;
    const ps_engine *engine;
    void *state;
} work;

/* The largest weight becomes 1, so that squares are numbers; 0: all of them are 0. */
static double scale_weights(ps_integrand_points *points) {
    double largest = 0;
    for (size_t i = 0; i < points->num; i++) {
        largest = fmax(largest, fabs(points->weights[i]));
    }
    for (size_t i = 0; largest > 0 && i < points->num; i++) {
        points->weights[i] /= largest;
    }
    return largest;
}

static ps_problem make_problem(const work *self, const ps_frequencies *frequencies) {
    return (ps_problem){.frequencies = frequencies,
                        .num_points = self->points.num,
                        .num_realizations = 1,
                        .has_weights = true,
                        .tolerance = 1e-9};
}

static pspec_status make_plan(const work *self, const ps_problem *problem, ps_plan *plan,
                              ps_error *error) {
    ps_device *const device = self->way->device;
    const ps_plan_constraints constraints = {.precision = -1,
                                             .memory_limit = self->way->memory_limit};
    return ps_plan_make(plan, problem, ps_device_get_limits(device), &constraints, error);
}

static pspec_status start(work *self, const ps_frequencies *frequencies, ps_error *error) {
    const ps_problem problem = make_problem(self, frequencies);
    ps_plan plan;
    PS_TRY(make_plan(self, &problem, &plan, error));
    PS_TRY(ps_plan_require(&plan, &problem, error));
    self->engine = plan.chosen->engine;
    return ps_engine_create(self->engine, &self->state, &problem, plan.chosen->precision, 1,
                            self->way->device, error);
}

static bool should_stop(void *payload) {
    const work *const self = payload;
    ps_error ignored = {0};
    return ps_watch_tell(self->way->watch, "image", 0, 0, NULL, &ignored) != PSPEC_OK;
}

static pspec_status run(work *self, const ps_frequencies *frequencies, double *powers,
                        ps_error *error) {
    const double scale = 1;
    const pspec_pattern pattern = {frequencies->dimension, self->points.num, self->points.points,
                                   self->points.weights};
    const ps_batch batch = {.num_patterns = 1,
                            .patterns = &pattern,
                            .scales = &scale,
                            .should_stop = should_stop,
                            .payload = self};
    PS_TRY(start(self, frequencies, error));
    return ps_engine_powers(self->engine, self->state, &batch, frequencies->num, self->way->device,
                            powers, error);
}

static pspec_status multiply(const ps_integrand *integrand, const ps_frequencies *frequencies,
                             double scale, double *powers, ps_error *error) {
    double *factors = NULL;
    PS_TRY(PS_NEW(&factors, frequencies->num, "factors of an integrand", error));
    ps_integrand_factors(integrand, frequencies->vectors, frequencies->num, factors);
    for (size_t i = 0; i < frequencies->num; i++) {
        powers[i] = scale > 0 ? scale * scale * factors[i] * powers[i] : 0;
    }
    free(factors);
    return PSPEC_OK;
}

pspec_status ps_point_powers(const ps_integrand *integrand, const ps_frequencies *frequencies,
                             const ps_point_way *way, double *powers, ps_error *error) {
    work self = {.way = way};
    pspec_status status = PSPEC_OK;
    double scale = 0;
    PS_TRY_OUT(status, ps_integrand_make_points(integrand, &self.points, error));
    scale = scale_weights(&self.points);
    if (scale > 0) {
        PS_TRY_OUT(status, run(&self, frequencies, powers, error));
    }
    status = multiply(integrand, frequencies, scale, powers, error);
out:
    if (self.engine != NULL) {
        ps_engine_destroy(self.engine, self.state);
    }
    ps_integrand_points_free(&self.points);
    return status;
}

pspec_status ps_point_powers_seconds(double *seconds, const ps_integrand *integrand,
                                     const ps_frequencies *frequencies, const ps_point_way *way,
                                     ps_error *error) {
    work self = {.way = way};
    ps_plan plan;
    PS_TRY(ps_integrand_make_points(integrand, &self.points, error));
    const ps_problem problem = make_problem(&self, frequencies);
    const pspec_status status = make_plan(&self, &problem, &plan, error);
    *seconds = status == PSPEC_OK && plan.chosen != NULL ? plan.chosen->seconds : 0;
    ps_integrand_points_free(&self.points);
    return status;
}
