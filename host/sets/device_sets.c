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
    bool is_on_sphere;
};

/* Lobes with powers are for the host alone. */
static bool is_morph_known(const ps_morph *morph) {
    return morph->kind == PS_MORPH_NONE || morph->kind == PS_MORPH_DIFFUSE;
}

static bool is_known(const ps_sampler_request *request, bool has_doubles) {
    const ps_sampler_by_index *const by_index = &request->sampler->by_index;
    if (ps_sampler_is_on_sphere(request)) {
        return by_index->point != NULL && is_morph_known(&request->morph) && has_doubles;
    }
    return by_index->places != NULL && (has_doubles || !by_index->needs_doubles);
}

bool ps_device_sets_serve(const ps_sampler_request *request, const ps_device_limits *limits) {
    /* products of an index and a step have 64 bits */
    return limits != NULL && limits->has_dedicated_local_memory &&
           is_known(request, limits->has_fp64) && !request->homogenize &&
           request->num_points <= UINT32_MAX;
}

static pspec_status create(ps_device_sets *self, ps_error *error) {
    ps_defines defines = {""};
    const ps_sampler_request *const request = &self->request;
    const ps_sampler_by_index *const by_index = &request->sampler->by_index;
    self->is_on_sphere = ps_sampler_is_on_sphere(request);
    PS_TRY(ps_sampler_fill_places(request, &self->places, error));
    if (self->is_on_sphere) {
        ps_defines_add(&defines, "-DPOINTS=%s -DON_HEMISPHERE=%d -DIS_DIFFUSE=%d", by_index->name,
                       ps_sampler_is_on_hemisphere(request),
                       request->morph.kind == PS_MORPH_DIFFUSE);
        PS_TRY(ps_kernel_get(self->device, &self->kernel, "samplers/sphere_points.cl",
                             "sampler_sphere_points", defines.text, error));
    } else {
        ps_defines_add(&defines, "-DPOINTS=%s -DDIMENSION=%u -DDOUBLES=%d", by_index->name,
                       request->dimension, by_index->needs_doubles);
        PS_TRY(ps_kernel_get(self->device, &self->kernel, "samplers/points.cl", "sampler_points",
                             defines.text, error));
    }
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

/* On the sphere, whose engines take doubles, exactly. */
static void make_point(const ps_device_sets *self, uint64_t realization, size_t j, double *point) {
    const ps_sampler_by_index *const by_index = &self->request.sampler->by_index;
    const sampler_numbers *const numbers = &self->places.numbers;
    uint64_t places[PS_MAX_DIMENSION];
    if (self->is_on_sphere) {
        by_index->point(numbers, ps_sampler_is_on_hemisphere(&self->request), realization, j,
                        point);
        ps_morph_points(&self->request.morph, 1, point);
        return;
    }
    by_index->places(numbers, self->places.table[0], self->request.dimension, realization, j,
                     places);
    for (unsigned i = 0; i < self->request.dimension; i++) {
        point[i] = ldexp((double)places[i], -64);
    }
}

pspec_status ps_device_sets_beginning(const ps_device_sets *sets, uint64_t realization, size_t num,
                                      double *points, ps_error *error) {
    if (num == sets->request.num_points) {
        return ps_sampler_generate(&sets->request, realization, points, NULL, NULL, error);
    }
    for (size_t j = 0; j < num; j++) {
        make_point(sets, realization, j, points + j * sets->request.dimension);
    }
    return PSPEC_OK;
}
