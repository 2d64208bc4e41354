#include "images/sphere_map.h"

#include "base/memory.h"
#include "math/neumaier.h"

#include <math.h>
#include <stdlib.h>

static double number_of(const ps_image *image, size_t pixel, ps_map_channel channel) {
    return channel == PS_MAP_LUMINANCE || image->num_channels == 1
               ? ps_image_luminance(image, pixel)
               : (double)image->pixels[pixel * image->num_channels + channel - PS_MAP_RED];
}

/* All channels count: a luminance may hide a negative one. */
static bool is_light(const ps_image *image, size_t pixel) {
    bool is = true;
    for (unsigned i = 0; i < image->num_channels; i++) {
        const float own = image->pixels[pixel * image->num_channels + i];
        is = is && isfinite(own) && own >= 0;
    }
    return is;
}

static pspec_status take_pixels(ps_sphere_map *out, const ps_image *image, ps_map_channel channel,
                                bool may_clamp, const char *path, ps_error *error) {
    for (size_t i = 0; i < image->width * image->height; i++) {
        const bool counts = is_light(image, i);
        if (!counts && !may_clamp) {
            const float *const own = image->pixels + i * image->num_channels;
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s: the pixel in row %zu, column %zu, from 0, is %g%s, which is no "
                           "light; clamp=yes takes such pixels as 0",
                           path, i / image->width, i % image->width, (double)own[0],
                           image->num_channels > 1 ? ", .." : "");
        }
        out->num_clamped += counts ? 0 : 1;
        out->rows[out->width + i] = counts ? number_of(image, i, channel) : 0;
    }
    return PSPEC_OK;
}

static void fill_pole(double *pole, const double *row, size_t width) {
    ps_neumaier sum = {0, 0};
    for (size_t j = 0; j < width; j++) {
        ps_neumaier_add(&sum, row[j]);
    }
    for (size_t j = 0; j < width; j++) {
        pole[j] = ps_neumaier_value(&sum) / (double)width;
    }
}

pspec_status ps_sphere_map_read(ps_sphere_map *out, const char *path, size_t invented_width,
                                ps_map_channel channel, bool may_clamp, ps_error *error) {
    ps_image image = {0};
    *out = (ps_sphere_map){0};
    pspec_status status =
        path != NULL ? ps_image_read(&image, path, error)
                     : ps_image_invent(&image, invented_width, (invented_width + 1) / 2, error);
    if (status == PSPEC_OK) {
        out->width = image.width;
        out->height = image.height;
        status = PS_NEW(&out->rows, (image.height + 2) * image.width, "a map", error);
    }
    if (status == PSPEC_OK) {
        status = take_pixels(out, &image, channel, may_clamp, path, error);
    }
    if (status == PSPEC_OK) {
        double *const last = out->rows + out->height * out->width;
        fill_pole(out->rows, out->rows + out->width, out->width);
        fill_pole(last + out->width, last, out->width);
    }
    ps_image_free(&image);
    return status;
}

void ps_sphere_map_free(ps_sphere_map *map) {
    free(map->rows);
    *map = (ps_sphere_map){0};
}
