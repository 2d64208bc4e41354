/* One channel of an image of light, row by row: nothing of it is negative, or not finite. */
#ifndef PS_IMAGES_CHANNEL_H
#define PS_IMAGES_CHANNEL_H

#include "images/image.h"

typedef enum ps_map_channel {
    PS_MAP_LUMINANCE,
    PS_MAP_RED,
    PS_MAP_GREEN,
    PS_MAP_BLUE
} ps_map_channel;
#define PS_MAP_CHANNELS "luminance|red|green|blue"

/* Who takes the rows, in the order of the file, as ps_image_taker. */
typedef struct ps_channel_taker {
    void *payload;
    pspec_status (*begin)(void *payload, size_t width, size_t height, ps_error *error);
    void (*take)(void *payload, size_t y, const double *row); /* [width] */
} ps_channel_taker;

/* Which channel of what: any of an image with a single channel is that. */
typedef struct ps_channel_source {
    const char *path; /* NULL: of light that is made up, with .. */
    size_t width;     /* .. so many pixels in a row */
    ps_map_channel channel;
    bool may_clamp; /* what is negative or not finite counts as 0 */
} ps_channel_source;

/* Reads the rows, and counts what was clamped; else it is PSPEC_ERROR_INPUT, which names the pixel.
 */
pspec_status ps_channel_read(const ps_channel_source *source, const ps_channel_taker *taker,
                             size_t *num_clamped, ps_error *error) PS_MUST_CHECK;

#endif
