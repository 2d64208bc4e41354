#include "jobs/variance/point_powers.h"

#include "base/memory.h"
#include "plan/choose.h"

#include <math.h>
#include <stdlib.h>

typedef struct work {
    ps_integrand_points points;
    ps_device *device;
    const ps_engine *engine;
    void *state;
    uint32_t *slots;
    void *row;
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

static pspec_status start(work *self, const ps_frequencies *frequencies, ps_error *error) {
    const ps_problem problem = {.frequencies = frequencies,
                                .num_points = self->points.num,
                                .num_realizations = 1,
                                .has_weights = true,
                                .tolerance = 1e-9};
    const ps_plan_constraints constraints = {.precision = -1};
    ps_plan plan;
    PS_TRY(ps_plan_make(&plan, &problem,
                        self->device != NULL ? ps_device_get_limits(self->device) : NULL,
                        &constraints, error));
    PS_TRY(ps_plan_require(&plan, &problem, error));
    self->engine = plan.chosen->engine;
    PS_TRY(self->engine->create(&self->state, &problem, plan.chosen->precision, 1, self->device,
                                error));
    PS_TRY(PS_NEW(&self->slots, frequencies->num, "slots", error));
    ps_engine_slots(self->engine, self->state, frequencies->num, self->slots);
    return PSPEC_OK;
}

static pspec_status read_rows(work *self, const ps_rows *rows, double *powers, size_t num,
                              ps_error *error) {
    const bool is_single = rows->precision == PS_SINGLE;
    const size_t bytes = is_single ? sizeof(float) : sizeof(double);
    if (rows->host == NULL) {
        PS_TRY(ps_allocate(&self->row, rows->stride, bytes, "a row of powers", error));
        PS_TRY(
            ps_buffer_read(self->device, &rows->device, 0, self->row, rows->stride * bytes, error));
    }
    const void *const from = rows->host != NULL ? (const void *)rows->host : self->row;
    for (size_t i = 0; i < num; i++) {
        powers[i] = is_single ? (double)((const float *)from)[self->slots[i]]
                              : ((const double *)from)[self->slots[i]];
    }
    return PSPEC_OK;
}

static pspec_status run(work *self, const ps_frequencies *frequencies, double *powers,
                        ps_error *error) {
    const double scale = 1;
    const pspec_pattern pattern = {frequencies->dimension, self->points.num, self->points.points,
                                   self->points.weights};
    const ps_batch batch = {.num_patterns = 1, .patterns = &pattern, .scales = &scale};
    ps_rows rows = {0};
    PS_TRY(start(self, frequencies, error));
    PS_TRY(self->engine->run(self->state, &batch, &rows, error));
    return read_rows(self, &rows, powers, frequencies->num, error);
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
                             ps_device *device, double *powers, ps_error *error) {
    work self = {.device = device};
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
        self.engine->destroy(self.state);
    }
    free(self.slots);
    free(self.row);
    ps_integrand_points_free(&self.points);
    return status;
}
