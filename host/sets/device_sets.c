#include "sets/device_sets.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

struct ps_device_sets {
    ps_sampler_request request;
    ps_sampler_places places;
    ps_device *device;
    ps_kernel *kernel;
    ps_buffer table;
};

bool ps_device_sets_serve(const ps_sampler_request *request, const ps_device_limits *limits) {
    const ps_sampler_by_index *const by_index = &request->sampler->by_index;
    const bool has_numbers = limits != NULL && (limits->has_fp64 || !by_index->needs_doubles);
    /* products of an index and a step have 64 bits */
    return by_index->name != NULL && has_numbers && limits->has_dedicated_local_memory &&
           !ps_sampler_is_on_sphere(request) && !request->homogenize &&
           request->num_points <= UINT32_MAX;
}

static pspec_status create(ps_device_sets *self, ps_error *error) {
    ps_defines defines = {""};
    const ps_sampler_by_index *const by_index = &self->request.sampler->by_index;
    PS_TRY(ps_sampler_fill_places(&self->request, &self->places, error));
    ps_defines_add(&defines, "-DPOINTS=%s -DDIMENSION=%u -DDOUBLES=%d", by_index->name,
                   self->request.dimension, by_index->needs_doubles);
    PS_TRY(ps_kernel_get(self->device, &self->kernel, "samplers/points.cl", "sampler_points",
                         defines.text, error));
    return ps_buffer_upload(self->device, &self->table, self->places.table,
                            sizeof self->places.table, "a table of a sampler", error);
}

pspec_status ps_device_sets_create(ps_device_sets **out, const ps_sampler_request *request,
                                   ps_device *device, ps_error *error) {
    ps_device_sets *self = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&self, 1, "sets of a device", error));
    self->request = *request;
    self->device = device;
    const pspec_status status = create(self, error);
    if (status != PSPEC_OK) {
        ps_device_sets_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void ps_device_sets_destroy(ps_device_sets *sets) {
    if (sets == NULL) {
        return;
    }
    ps_buffer_release(&sets->table);
    free(sets);
}

uint64_t ps_device_sets_points(const ps_device_sets *sets) {
    return sets->request.num_points;
}

unsigned ps_device_sets_dimension(const ps_device_sets *sets) {
    return sets->request.dimension;
}

pspec_status ps_device_sets_write(ps_device_sets *sets, const sampler_range *range,
                                  const ps_buffer *out, ps_error *error) {
    const size_t num = (size_t)(range->count * range->num_realizations);
    const double bytes = (double)(num * sets->request.dimension * sizeof(uint64_t));
    const ps_range items = ps_range_light(sets->device, num, 1, 1, 0, bytes);
    return PS_LAUNCH(sets->device, sets->kernel, &items, error, PS_STRUCT(sets->places.numbers),
                     PS_STRUCT(*range), PS_BUFFER(sets->table), PS_BUFFER(*out));
}

pspec_status ps_device_sets_beginning(const ps_device_sets *sets, uint64_t realization, size_t num,
                                      double *points, ps_error *error) {
    const unsigned dimension = sets->request.dimension;
    if (num == sets->request.num_points) {
        return ps_sampler_generate(&sets->request, realization, points, NULL, NULL, error);
    }
    for (size_t j = 0; j < num; j++) {
        uint64_t places[PS_MAX_DIMENSION];
        sets->request.sampler->by_index.places(&sets->places.numbers, sets->places.table[0],
                                               dimension, realization, j, places);
        for (unsigned i = 0; i < dimension; i++) {
            points[j * dimension + i] = ldexp((double)places[i], -64);
        }
    }
    return PSPEC_OK;
}
