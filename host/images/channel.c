#include "images/channel.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

typedef struct reading {
    const ps_channel_source *source;
    const ps_channel_taker *taker;
    double *row; /* [width] */
    size_t num_clamped;
} reading;

static pspec_status begin(void *payload, const ps_image *image, ps_error *error) {
    reading *const self = payload;
    PS_TRY(PS_NEW(&self->row, image->width, "a row of an image", error));
    return self->taker->begin(self->taker->payload, image->width, image->height, error);
}

/* All channels count: a luminance may hide a negative one. */
static bool is_light(const float *pixel, unsigned num_channels) {
    bool is = true;
    for (unsigned i = 0; i < num_channels; i++) {
        is = is && isfinite(pixel[i]) && pixel[i] >= 0;
    }
    return is;
}

static double number_of(const float *pixel, unsigned num_channels, ps_map_channel channel) {
    return channel == PS_MAP_LUMINANCE || num_channels == 1
               ? ps_image_luminance(pixel, num_channels)
               : (double)pixel[channel - PS_MAP_RED];
}

static pspec_status take(void *payload, const ps_image *image, size_t y, const float *row,
                         ps_error *error) {
    reading *const self = payload;
    const unsigned num_channels = image->num_channels;
    for (size_t x = 0; x < image->width; x++) {
        const float *const pixel = row + x * num_channels;
        const bool counts = is_light(pixel, num_channels);
        if (!counts && !self->source->may_clamp) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s: the pixel in row %zu, column %zu, from 0, is %g%s, which is no "
                           "light; clamp=yes takes such pixels as 0",
                           self->source->path, y, x, (double)pixel[0],
                           num_channels > 1 ? ", .." : "");
        }
        self->num_clamped += counts ? 0 : 1;
        self->row[x] = counts ? number_of(pixel, num_channels, self->source->channel) : 0;
    }
    self->taker->take(self->taker->payload, y, self->row);
    return PSPEC_OK;
}

pspec_status ps_channel_read(const ps_channel_source *source, const ps_channel_taker *taker,
                             size_t *num_clamped, ps_error *error) {
    reading self = {source, taker, NULL, 0};
    const ps_image_taker rows = {&self, begin, take};
    const pspec_status status =
        source->path != NULL
            ? ps_image_read(source->path, &rows, error)
            : ps_image_invent(source->width, (source->width + 1) / 2, &rows, error);
    free(self.row);
    *num_clamped = self.num_clamped;
    return status;
}
