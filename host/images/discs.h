/* A made image, where none is given: discs that hide each other, on a square that is periodic. With
 * radii of density r^-3 it looks the same at any scale, as photographs do (Lee, Mumford and Huang,
 * Occlusion models for natural images, 2001): edges of all sizes, and light over twelve stops. */
#ifndef PS_IMAGES_DISCS_H
#define PS_IMAGES_DISCS_H

#include "images/channel.h"

/* side x side pixels, each the light at its centre, so that images of any side are of one scene. */
pspec_status ps_discs_make(size_t side, const ps_channel_taker *taker,
                           ps_error *error) PS_MUST_CHECK;

#endif
