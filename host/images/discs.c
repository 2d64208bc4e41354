#include "images/discs.h"

#include "base/memory.h"
#include "math/random/random.h"

#include <math.h>
#include <stdlib.h>

/* Their areas come to 4.4 times that of the image, so that 1 % of it is behind all of them. */
enum { NUM_DISCS = 1024 };
#define LEAST_RADIUS (1.0 / 64)
#define MOST_RADIUS (1.0 / 4)
/* Light is 2^-STOPS to 2^STOPS, and 1 behind all discs. */
#define STOPS 6.0

typedef struct disc {
    double down, right, radius, light;
} disc;

/* From the farthest to the nearest; any seed makes such an image. */
static void make_discs(disc *out) {
    const double ratio = LEAST_RADIUS / MOST_RADIUS;
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    for (size_t i = 0; i < NUM_DISCS; i++) {
        const double share = ps_random_uniform(&random) * (1 - ratio * ratio);
        out[i].radius = LEAST_RADIUS / sqrt(1 - share);
        out[i].down = ps_random_uniform(&random);
        out[i].right = ps_random_uniform(&random);
        out[i].light = exp2(STOPS * (2 * ps_random_uniform(&random) - 1));
    }
}

/* Pixels of row y that have their centres in the disc. */
static void paint(const disc *self, double *row, size_t y, size_t side) {
    const double distance = ((double)y + 0.5) / (double)side - self->down;
    const double down = distance - rint(distance);
    const double square = self->radius * self->radius - down * down;
    if (square < 0) {
        return;
    }
    const double first = ceil((self->right - sqrt(square)) * (double)side - 0.5);
    const double last = floor((self->right + sqrt(square)) * (double)side - 0.5);
    size_t x = (size_t)(first < 0 ? first + (double)side : first);
    for (double i = first; i <= last; i++) {
        row[x] = self->light;
        x = x + 1 < side ? x + 1 : 0;
    }
}

pspec_status ps_discs_make(size_t side, const ps_channel_taker *taker, ps_error *error) {
    disc *discs = NULL;
    double *row = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, PS_NEW(&discs, NUM_DISCS, "discs", error));
    PS_TRY_OUT(status, PS_NEW(&row, side, "a row of an image", error));
    PS_TRY_OUT(status, taker->begin(taker->payload, side, side, error));
    make_discs(discs);
    for (size_t y = 0; y < side; y++) {
        for (size_t x = 0; x < side; x++) {
            row[x] = 1;
        }
        for (size_t i = 0; i < NUM_DISCS; i++) {
            paint(&discs[i], row, y, side);
        }
        taker->take(taker->payload, y, row);
    }
out:
    free(discs);
    free(row);
    return status;
}
