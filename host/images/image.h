/* Images of light: pixels of one or three channels, from Radiance HDR and PFM
 * (docs/user/formats.md#images-of-light). */
#ifndef PS_IMAGES_IMAGE_H
#define PS_IMAGES_IMAGE_H

#include "files/input_file.h"

/* Pixels of the largest image: a square of 16384 on each side. */
#define PS_IMAGE_MOST_PIXELS ((size_t)1 << 28)
/* Of either side: a row is in memory before it is known to be there. */
#define PS_IMAGE_MOST_SIDE 65536

typedef struct ps_image {
    size_t width, height;
    unsigned num_channels; /* 1; or 3: red, green, blue */
} ps_image;

/* Who takes the rows of an image, one after the other, as they come from the file: nothing else is
 * ever in memory. Any failure ends the reading. */
typedef struct ps_image_taker {
    void *payload;
    pspec_status (*begin)(void *payload, const ps_image *image, ps_error *error);
    /* row [width][num_channels]; y is 0 at the top, which is the first row to come or the last. */
    pspec_status (*take)(void *payload, const ps_image *image, size_t y, const float *row,
                         ps_error *error);
} ps_image_taker;

/* Reads the only image of a file, which its first bytes tell the format of. PSPEC_ERROR_INPUT names
 * what is no image, or is cut short, or one that is too large; formats that are known and not read
 * (OpenEXR, PNG, JPEG, TIFF) by their names. Numbers are those of the file: PFM may have some that
 * are negative or not finite. */
pspec_status ps_image_read(const char *path, const ps_image_taker *taker,
                           ps_error *error) PS_MUST_CHECK;
/* The same of light that is made up, as of every direction: the sky over a courtyard. */
pspec_status ps_image_invent(size_t width, size_t height, const ps_image_taker *taker,
                             ps_error *error) PS_MUST_CHECK;
/* Writes [height][width] numbers, the top row first, as a PFM image of one channel. */
pspec_status ps_image_write_pfm(const char *path, size_t width, size_t height, const double *pixels,
                                ps_error *error) PS_MUST_CHECK;

/* Luminance of linear red, green and blue (ITU-R BT.709), or the value of a single channel. */
double ps_image_luminance(const float *pixel, unsigned num_channels);

#endif
