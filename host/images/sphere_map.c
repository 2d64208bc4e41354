#include "images/sphere_map.h"

#include "base/memory.h"
#include "math/neumaier.h"

#include <stdlib.h>
#include <string.h>

static void fill_pole(double *pole, const double *row, size_t width) {
    ps_neumaier sum = {0, 0};
    for (size_t j = 0; j < width; j++) {
        ps_neumaier_add(&sum, row[j]);
    }
    for (size_t j = 0; j < width; j++) {
        pole[j] = ps_neumaier_value(&sum) / (double)width;
    }
}

static pspec_status begin(void *payload, size_t width, size_t height, ps_error *error) {
    ps_sphere_map *const self = payload;
    self->width = width;
    self->height = height;
    return PS_NEW(&self->rows, (height + 2) * width, "a map", error);
}

static void take(void *payload, size_t y, const double *row) {
    const ps_sphere_map *const self = payload;
    memcpy(self->rows + (1 + y) * self->width, row, self->width * sizeof *row);
}

pspec_status ps_sphere_map_read(ps_sphere_map *out, const ps_channel_source *source,
                                ps_error *error) {
    const ps_channel_taker taker = {out, begin, take};
    *out = (ps_sphere_map){0};
    PS_TRY(ps_channel_read(source, &taker, &out->num_clamped, error));
    double *const last = out->rows + out->height * out->width;
    fill_pole(out->rows, out->rows + out->width, out->width);
    fill_pole(last + out->width, last, out->width);
    return PSPEC_OK;
}

void ps_sphere_map_free(ps_sphere_map *map) {
    free(map->rows);
    *map = (ps_sphere_map){0};
}
