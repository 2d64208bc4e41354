/* Light that is made up, for where no file is: the sky over a courtyard, as wide as the map. It has
 * what photographs of such places have: a bright sun in haze, edges at roofs, small dark windows.
 *
 * All numbers are chosen by eye; the mean is near that of photographs with exposure 1. */
#include "base/memory.h"
#include "images/image.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

typedef struct colour {
    double red, green, blue;
} colour;

static const colour zenith = {0.15, 0.25, 0.5};
static const colour haze = {0.5, 0.55, 0.6};
static const colour sun = {8, 7, 5};
static const colour wall = {0.3, 0.24, 0.18};
static const colour ground = {0.2, 0.18, 0.16};

static const double sun_height = 0.9; /* radians above the horizon */
static const double sun_azimuth = 1;
static const double sun_exponent = 200; /* of e^{n(z-1)}: half of its light within 5 degrees */

static void add(colour *self, const colour *what, double factor) {
    self->red += factor * what->red;
    self->green += factor * what->green;
    self->blue += factor * what->blue;
}

static double part_of(double x) {
    return x - floor(x);
}

static colour sky_at(double height, double azimuth) {
    const double z = sin(height);
    const double to_sun =
        sin(sun_height) * z + cos(sun_height) * cos(height) * cos(azimuth - sun_azimuth);
    colour out = {0, 0, 0};
    add(&out, &zenith, z);
    add(&out, &haze, 1 - z);
    add(&out, &sun, exp(sun_exponent * (to_sun - 1)));
    return out;
}

/* Walls face the middle: those opposite the sun are lit. */
static colour wall_at(double height, double azimuth) {
    const double windows = 40; /* around the courtyard */
    const double floors = 7;   /* of a radian */
    const bool is_window =
        part_of(azimuth / PS_TWO_PI * windows) < 0.4 && part_of(height * floors) > 0.45;
    const double lit = 0.7 - 0.5 * cos(azimuth - sun_azimuth);
    colour out = {0, 0, 0};
    add(&out, &wall, is_window ? 0.25 * lit : lit);
    return out;
}

/* Where the roofs end: four sides of a square, and a tower on one of them. */
static double roof_at(double azimuth) {
    const double side = PS_PI / 2;
    const double from_middle = (part_of(azimuth / side) - 0.5) * side;
    const bool is_tower = fabs(azimuth - 4) < 0.15;
    return atan((is_tower ? 0.9 : 0.4) * cos(from_middle));
}

static colour light_at(double height, double azimuth) {
    colour out = {0, 0, 0};
    if (height >= roof_at(azimuth)) {
        return sky_at(height, azimuth);
    }
    if (height >= 0) {
        return wall_at(height, azimuth);
    }
    add(&out, &ground, 0.6 - 0.4 * sin(height));
    return out;
}

static void fill_row(float *row, size_t y, const ps_image *image) {
    const double height = PS_PI * (0.5 - ((double)y + 0.5) / (double)image->height);
    for (size_t x = 0; x < image->width; x++) {
        const double azimuth = PS_TWO_PI * ((double)x + 0.5) / (double)image->width;
        const colour own = light_at(height, azimuth);
        row[3 * x] = (float)own.red;
        row[3 * x + 1] = (float)own.green;
        row[3 * x + 2] = (float)own.blue;
    }
}

pspec_status ps_image_invent(size_t width, size_t height, const ps_image_taker *taker,
                             ps_error *error) {
    const ps_image image = {width, height, 3};
    float *row = NULL;
    PS_TRY(PS_NEW(&row, 3 * width, "a row of an image", error));
    pspec_status status = taker->begin(taker->payload, &image, error);
    for (size_t y = 0; y < height && status == PSPEC_OK; y++) {
        fill_row(row, y, &image);
        status = taker->take(taker->payload, &image, y, row, error);
    }
    free(row);
    return status;
}
