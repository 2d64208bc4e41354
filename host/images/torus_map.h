/* An image as a function F of the torus (docs/mathematics/maps.md#images-on-the-torus).
 *
 * Pixel (row i from the top, column j) of H x W has its centre at x = ((i + 1/2)/H, (j + 1/2)/W).
 * Between centres F is linear along both axes, across the edges of the image, too.
 */
#ifndef PS_IMAGES_TORUS_MAP_H
#define PS_IMAGES_TORUS_MAP_H

#include "images/channel.h"

#include <stdint.h>

typedef struct ps_torus_map {
    size_t width, height;
    /* Of a pixel: 4, of a float; of images that are large 3, without its sign and its last seven
     * digits: relative to itself a pixel is off by 2^-17 at most. */
    unsigned pixel_bytes;
    unsigned char *pixels; /* as kernels/images/pixel.h reads them */
    size_t num_clamped;
    double largest; /* pixel */
    double mean;    /* of the pixels as they are kept: int F */
    double energy;  /* int (F - mean)^2, right to rounding */
} ps_torus_map;

/* How much of an image there may be. */
typedef struct ps_torus_map_limits {
    size_t most_floats;  /* images of more pixels have three bytes for each */
    uint64_t most_bytes; /* else it is PSPEC_ERROR_MEMORY; 0: what is free */
} ps_torus_map_limits;
/* 512 MB: 16000 x 16000 floats would take more than a gigabyte. */
#define PS_TORUS_MAP_MOST_FLOATS ((size_t)1 << 27)

/* Reads the image as ps_channel_read, or makes one of images/discs.h where the path is NULL, with
 * a row beside what is kept; ps_torus_map_free frees it, also after a failure. */
pspec_status ps_torus_map_read(ps_torus_map *out, const ps_channel_source *source,
                               const ps_torus_map_limits *limits, ps_error *error) PS_MUST_CHECK;
void ps_torus_map_free(ps_torus_map *map);
static inline size_t ps_torus_map_bytes(const ps_torus_map *map) {
    return map->width * map->height * map->pixel_bytes;
}
/* out [width] */
void ps_torus_map_row(const ps_torus_map *map, size_t row, double *out);

/* |DFT of the pixels less their mean|^2 over (H W)^2, of whole frequencies up to a cut-off. What
 * is beyond half of a side is an alias. */
typedef struct ps_torus_map_powers {
    size_t num_columns; /* k_2 = 0 .. num_columns - 1 */
    size_t most_row;    /* k_1 = -most_row .. most_row */
    double *all;        /* [num_columns][2 most_row + 1] */
} ps_torus_map_powers;

/* *out is freed by ps_torus_map_powers_free, also after a failure. Two passes over the pixels for
 * every 64 MiB of columns. */
pspec_status ps_torus_map_find_powers(ps_torus_map_powers *out, const ps_torus_map *map,
                                      size_t cutoff, ps_error *error) PS_MUST_CHECK;
void ps_torus_map_powers_free(ps_torus_map_powers *powers);
/* Of any k whose alias is within the cut-off. */
double ps_torus_map_power(const ps_torus_map_powers *powers, const ps_torus_map *map,
                          const int32_t k[2]);

#endif
