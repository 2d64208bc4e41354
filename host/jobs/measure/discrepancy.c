#include "jobs/measure/discrepancy.h"

#include "base/memory.h"
#include "base/round.h"
#include "engines/engine.h"
#include "math/neumaier.h"
#include "measures/discrepancy.h"

#include <math.h>
#include <stdlib.h>

enum { STAR, STAR_LOW, PERIODIC, PERIODIC_LOW, NUM_SUMS };

struct ps_discrepancy {
    ps_device *device;
    ps_kernel *kernel;
    unsigned dimension, lanes;
    size_t room; /* numbers of an axis */
    ps_buffer points, sums;
    double *coordinates, *found; /* [dimension][room], [NUM_SUMS][room] */
};

static void release_room(ps_discrepancy *self) {
    PS_BUFFERS_RELEASE(&self->points, &self->sums);
    free(self->coordinates);
    free(self->found);
    self->coordinates = self->found = NULL;
    self->room = 0;
}

static pspec_status make_room(ps_discrepancy *self, size_t capacity, ps_error *error) {
    if (capacity <= self->room) {
        return PSPEC_OK;
    }
    release_room(self);
    PS_TRY(PS_NEW(&self->coordinates, self->dimension * capacity, "points", error));
    PS_TRY(PS_NEW(&self->found, NUM_SUMS * capacity, "sums over points", error));
    const ps_wanted_buffer wanted[] = {
        {&self->points, self->dimension * capacity * sizeof(double), "points"},
        {&self->sums, NUM_SUMS * capacity * sizeof(double), "sums over points"}};
    PS_TRY(PS_BUFFERS_CREATE(self->device, wanted, error));
    self->room = capacity;
    return PSPEC_OK;
}

pspec_status ps_discrepancy_create(ps_discrepancy **out, unsigned dimension, ps_device *device,
                                   ps_error *error) {
    ps_discrepancy *self = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&self, 1, "discrepancies", error));
    self->device = device;
    self->dimension = dimension;
    self->lanes = ps_engine_lanes(ps_device_get_limits(device), PS_DOUBLE);
    ps_defines defines = ps_defines_of(sizeof(double), self->lanes);
    ps_defines_add(&defines, "-DDIMENSION=%u", dimension);
    const pspec_status status = ps_kernel_get(device, &self->kernel, "measures/discrepancy.cl",
                                              "measure_discrepancy", defines.text, error);
    if (status != PSPEC_OK) {
        ps_discrepancy_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void ps_discrepancy_destroy(ps_discrepancy *discrepancy) {
    if (discrepancy != NULL) {
        release_room(discrepancy);
    }
    free(discrepancy);
}

static pspec_status launch(ps_discrepancy *self, size_t num, size_t capacity, ps_error *error) {
    const discrepancy_sizes sizes = {num, capacity};
    const double flops = 4.0 * self->dimension * (double)num * (double)num;
    const ps_range range = ps_range_heavy(self->device, capacity / self->lanes, 1, 1, flops,
                                          (double)(capacity * sizeof(double)));
    return PS_LAUNCH(self->device, self->kernel, &range, error, PS_STRUCT(sizes),
                     PS_BUFFER(self->points), PS_BUFFER(self->sums));
}

/* Two rows of sums, high and low. */
static double add_up(const double *high, const double *low, size_t num) {
    ps_neumaier sum = {0, 0};
    for (size_t i = 0; i < num; i++) {
        ps_neumaier_add(&sum, high[i]);
        ps_neumaier_add(&sum, low[i]);
    }
    return ps_neumaier_value(&sum);
}

static double sum_of_boxes(const ps_discrepancy *self, const double *points, size_t num) {
    ps_neumaier sum = {0, 0};
    for (size_t i = 0; i < num; i++) {
        double product = 1;
        for (unsigned axis = 0; axis < self->dimension; axis++) {
            const double x = points[i * self->dimension + axis];
            product *= (1 - x) * (1 + x) / 2;
        }
        ps_neumaier_add(&sum, product);
    }
    return ps_neumaier_value(&sum);
}

/* Below 0 by rounding alone. */
static double root_of(double square) {
    return sqrt(fmax(square, 0));
}

pspec_status ps_discrepancy_find(ps_discrepancy *discrepancy, const double *points, size_t num,
                                 ps_discrepancies *out, ps_error *error) {
    ps_discrepancy *const self = discrepancy;
    const size_t capacity = ps_round_up(num, self->lanes);
    const double cube = pow(3, -(double)self->dimension);
    const double n = (double)num;
    PS_TRY(make_room(self, capacity, error));
    for (size_t i = 0; i < num * self->dimension; i++) {
        self->coordinates[i % self->dimension * capacity + i / self->dimension] = points[i];
    }
    PS_TRY(ps_buffer_write(self->device, &self->points, 0, self->coordinates,
                           self->dimension * capacity * sizeof(double), error));
    PS_TRY(launch(self, num, capacity, error));
    PS_TRY(ps_buffer_read(self->device, &self->sums, 0, self->found,
                          NUM_SUMS * capacity * sizeof(double), error));
    const double *const found = self->found;
    const double star = add_up(found, found + STAR_LOW * capacity, num);
    const double periodic =
        add_up(found + PERIODIC * capacity, found + PERIODIC_LOW * capacity, num);
    out->star = root_of(cube - 2 / n * sum_of_boxes(self, points, num) + star / (n * n));
    out->periodic = root_of(periodic / (n * n) - cube);
    return PSPEC_OK;
}
