#include "images/torus_map.h"

#include "base/memory.h"
#include "base/process/memory_limit.h"
#include "images/discs.h"
#include "images/pixel.h"
#include "math/neumaier.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- pixels -------------------------------------------------------------------------------- */

typedef struct reading {
    ps_torus_map *map;
    const char *path;
    const ps_torus_map_limits *limits;
} reading;

static pspec_status begin(void *payload, size_t width, size_t height, ps_error *error) {
    const reading *const self = payload;
    const ps_torus_map_limits *const limits = self->limits;
    ps_torus_map *const map = self->map;
    char needed[PS_SIZE_TEXT];
    char limit[PS_SIZE_TEXT];
    ps_memory_room room = {limits->most_bytes, "the limit of --memory"};
    if (room.bytes == 0) {
        ps_memory_room_find(&room, 0);
    }
    map->width = width;
    map->height = height;
    map->pixel_bytes = width * height > limits->most_floats ? PIXEL_SHORT_BYTES : PIXEL_FLOAT_BYTES;
    const size_t bytes = ps_torus_map_bytes(map);
    return bytes <= room.bytes
               ? PS_NEW(&map->pixels, bytes, "an image", error)
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "%s: %zu x %zu pixels take %s of memory, above %s, %s", self->path, width,
                         height, ps_size_show(needed, (double)bytes),
                         ps_size_show(limit, (double)room.bytes), room.by);
}

/* The bits of a float that is not negative, or the first 24 of them, to the nearest even. */
static uint32_t bits_of(float number, unsigned bytes) {
    const uint32_t sign = 1U << 31;
    const uint32_t last = 0xfeffff; /* the largest that is finite */
    uint32_t bits = 0;
    memcpy(&bits, &number, sizeof bits);
    bits &= ~sign; /* of -0 */
    if (bytes == PIXEL_FLOAT_BYTES) {
        return bits;
    }
    const uint32_t half = 1U << (PIXEL_LOST_DIGITS - 1);
    const uint32_t rounded =
        (bits + half - 1 + (bits >> PIXEL_LOST_DIGITS & 1)) >> PIXEL_LOST_DIGITS;
    return rounded < last ? rounded : last;
}

static void take(void *payload, size_t y, const double *row) {
    ps_torus_map *const map = ((reading *)payload)->map;
    unsigned char *out = map->pixels + y * map->width * map->pixel_bytes;
    for (size_t x = 0; x < map->width; x++) {
        const uint32_t bits = bits_of((float)row[x], map->pixel_bytes);
        for (unsigned i = 0; i < map->pixel_bytes; i++) {
            *out++ = (unsigned char)(bits >> 8 * i);
        }
    }
}

void ps_torus_map_row(const ps_torus_map *map, size_t row, double *out) {
    for (size_t x = 0; x < map->width; x++) {
        out[x] = pixel_at(map->pixels, row * map->width + x, map->pixel_bytes);
    }
}

/* ---- moments ------------------------------------------------------------------------------- */

static void find_mean(ps_torus_map *map, double *row) {
    ps_neumaier sum = {0, 0};
    for (size_t i = 0; i < map->height; i++) {
        ps_torus_map_row(map, i, row);
        for (size_t j = 0; j < map->width; j++) {
            ps_neumaier_add(&sum, row[j]);
            map->largest = fmax(map->largest, row[j]);
        }
    }
    map->mean = ps_neumaier_value(&sum) / ((double)map->width * (double)map->height);
}

static void take_deviations(const ps_torus_map *map, size_t i, double *row) {
    ps_torus_map_row(map, i, row);
    for (size_t j = 0; j < map->width; j++) {
        row[j] -= map->mean;
    }
}

/* Adds W times the mean of F^2 between the rows a and b, less those of b alone: the mean of the
 * product of two linear pieces with the ends f, f' and g, g' is (2 f g + f g' + f' g + 2 f' g')/6.
 */
static void add_rows(ps_neumaier *sum, const double *a, const double *b, size_t width) {
    const double third = 1.0 / 3;
    for (size_t j = 0; j < width; j++) {
        const size_t next = j + 1 < width ? j + 1 : 0;
        const double square = 2 * a[j] * a[j] + a[j] * a[next];
        const double product = 2 * a[j] * b[j] + (a[j] * b[next] + a[next] * b[j]) / 2;
        ps_neumaier_add(sum, third * third * (2 * square + product));
    }
}

/* Row by row with the next one, and the last with the first. */
static void find_energy(ps_torus_map *map, double *rows) {
    double *above = rows;
    double *below = rows + map->width;
    ps_neumaier sum = {0, 0};
    take_deviations(map, 0, above);
    for (size_t i = 0; i < map->height; i++) {
        take_deviations(map, (i + 1) % map->height, below);
        add_rows(&sum, above, below, map->width);
        double *const done = above;
        above = below;
        below = done;
    }
    map->energy = ps_neumaier_value(&sum) / ((double)map->width * (double)map->height);
}

pspec_status ps_torus_map_read(ps_torus_map *out, const ps_channel_source *source,
                               const ps_torus_map_limits *limits, ps_error *error) {
    reading self = {out, source->path != NULL ? source->path : "an image made up", limits};
    const ps_channel_taker taker = {&self, begin, take};
    double *rows = NULL;
    *out = (ps_torus_map){0};
    PS_TRY(source->path != NULL ? ps_channel_read(source, &taker, &out->num_clamped, error)
                                : ps_discs_make(source->width, &taker, error));
    PS_TRY(PS_NEW(&rows, 2 * out->width, "rows of an image", error));
    find_mean(out, rows);
    find_energy(out, rows);
    free(rows);
    return PSPEC_OK;
}

void ps_torus_map_free(ps_torus_map *map) {
    free(map->pixels);
    *map = (ps_torus_map){0};
}
