/* Light from every direction: an equirectangular image as a function F of the sphere
 * (docs/mathematics/maps.md).
 *
 * The top row is nearest to +z. Pixel (row i, column j) of H x W has its centre at theta = pi (i +
 * 1/2)/H, phi = 2 pi (j + 1/2)/W. Between centres F is linear in theta and in phi; between the last
 * centres and a pole it is linear in theta, and the pole has the mean of the row.
 */
#ifndef PS_IMAGES_SPHERE_MAP_H
#define PS_IMAGES_SPHERE_MAP_H

#include "images/channel.h"

typedef struct ps_sphere_map {
    size_t width, height;
    double *rows; /* [height + 2][width]: the north pole, all rows, the south pole */
    size_t num_clamped;
} ps_sphere_map;

/* Reads the image as ps_channel_read; ps_sphere_map_free frees it, also after a failure. */
pspec_status ps_sphere_map_read(ps_sphere_map *out, const ps_channel_source *source,
                                ps_error *error) PS_MUST_CHECK;
void ps_sphere_map_free(ps_sphere_map *map);

/* Over all of the sphere, or over z >= 0: int F dS and int (F - its mean)^2 dS, right to rounding.
 */
typedef struct ps_map_moments {
    double integral, deviation;
} ps_map_moments;
pspec_status ps_sphere_map_moments(ps_map_moments *out, const ps_sphere_map *map, bool only_upper,
                                   ps_error *error) PS_MUST_CHECK;

/* F_lm = int F conj(Y_lm) dS of 0 <= m <= l <= max_degree, over the sphere or z >= 0, right to
 * rounding: re, im at index m (2 max_degree + 1 - m)/2 + l. O(H max_degree^2) steps. */
pspec_status ps_sphere_map_coefficients(const ps_sphere_map *map, bool only_upper,
                                        size_t max_degree, double *out,
                                        ps_error *error) PS_MUST_CHECK;

#endif
