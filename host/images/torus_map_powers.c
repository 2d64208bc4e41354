/* Squares of the Fourier transform of an image, of low frequencies alone: rows are transformed as
 * they are unpacked, two at a time, and a block of their columns is kept and transformed. */
#include "images/torus_map.h"

#include "base/memory.h"
#include "base/workers.h"
#include "math/gsl/fourier.h"

#include <stdlib.h>

/* Bytes of the columns that are kept at a time, and row pairs that share the tables of a transform:
 * a third of the time of one. */
#define BLOCK_BYTES ((size_t)1 << 26)
enum { PAIRS = 8, RE = 0, IM };

typedef struct transform {
    const ps_torus_map *map;
    ps_torus_map_powers *out;
    size_t first, num; /* columns of the block */
    double *columns;   /* [num][height][RE, IM] */
    double *lines;     /* [PS_WORKERS_MOST][room_of_worker] */
    ps_error errors[PS_WORKERS_MOST];
} transform;

/* Pairs of rows, as complex numbers, and a row. */
static size_t room_of_worker(const ps_torus_map *map) {
    return (2 * PAIRS + 1) * map->width;
}

static size_t smaller(size_t a, size_t b) {
    return a < b ? a : b;
}

/* ---- rows ---------------------------------------------------------------------------------- */

/* One row is the real part of a line, the next one the imaginary part; 0 where there is none. */
static void fill_pair(const ps_torus_map *map, size_t first, double *line, double *row) {
    for (size_t part = RE; part <= IM; part++) {
        const bool is_there = first + part < map->height;
        if (is_there) {
            ps_torus_map_row(map, first + part, row);
        }
        for (size_t j = 0; j < map->width; j++) {
            line[2 * j + part] = is_there ? row[j] - map->mean : 0;
        }
    }
}

/* With Z of a + ib, A_k = (Z_k + conj Z_-k)/2 and B_k = (Z_k - conj Z_-k)/2i. */
static void take_pair(const transform *self, size_t first, const double *line) {
    const size_t width = self->map->width;
    const size_t height = self->map->height;
    for (size_t i = 0; i < self->num; i++) {
        const size_t k = self->first + i;
        const double *const z = line + 2 * k;
        const double *const other = line + 2 * ((width - k) % width);
        double *const out = self->columns + 2 * (i * height + first);
        out[RE] = (z[RE] + other[RE]) / 2;
        out[IM] = (z[IM] - other[IM]) / 2;
        if (first + 1 < height) {
            out[2 + RE] = (z[IM] + other[IM]) / 2;
            out[2 + IM] = (other[RE] - z[RE]) / 2;
        }
    }
}

static void transform_rows(void *payload, unsigned index, unsigned count) {
    transform *const self = payload;
    const ps_torus_map *const map = self->map;
    double *const lines = self->lines + index * room_of_worker(map);
    double *const row = lines + 2 * PAIRS * map->width;
    const size_t step = 2 * PAIRS;
    pspec_status status = PSPEC_OK;
    for (size_t first = index * step; first < map->height && status == PSPEC_OK;
         first += count * step) {
        for (size_t i = 0; i < PAIRS; i++) {
            fill_pair(map, first + 2 * i, lines + 2 * i * map->width, row);
        }
        status = ps_fourier_lines(lines, map->width, PAIRS, &self->errors[index]);
        for (size_t i = 0; i < PAIRS && first + 2 * i < map->height; i++) {
            take_pair(self, first + 2 * i, lines + 2 * i * map->width);
        }
    }
}

/* ---- columns ------------------------------------------------------------------------------- */

static void take_column(const transform *self, size_t i) {
    const ps_torus_map *const map = self->map;
    const size_t most = self->out->most_row;
    const double num = (double)map->width * (double)map->height;
    const double *const column = self->columns + 2 * i * map->height;
    double *const out = self->out->all + (self->first + i) * (2 * most + 1);
    for (size_t j = 0; j <= 2 * most; j++) {
        const double *const f = column + 2 * ((j + map->height - most) % map->height);
        const double re = f[RE] / num;
        const double im = f[IM] / num;
        out[j] = re * re + im * im;
    }
}

static void transform_columns(void *payload, unsigned index, unsigned count) {
    transform *const self = payload;
    const size_t height = self->map->height;
    const size_t begin = ps_share_begin(self->num, index, count);
    const size_t end = ps_share_begin(self->num, index + 1, count);
    const pspec_status status = ps_fourier_lines(self->columns + 2 * begin * height, height,
                                                 end - begin, &self->errors[index]);
    for (size_t i = begin; i < end && status == PSPEC_OK; i++) {
        take_column(self, i);
    }
}

/* ---- both ---------------------------------------------------------------------------------- */

static pspec_status share(transform *self,
                          void (*task)(void *payload, unsigned index, unsigned count),
                          ps_error *error) {
    ps_workers_share(self->map->height * self->map->width, task, self);
    for (size_t i = 0; i < PS_WORKERS_MOST; i++) {
        if (self->errors[i].status != PSPEC_OK) {
            return ps_fail(error, self->errors[i].status, "%s", self->errors[i].message);
        }
    }
    return PSPEC_OK;
}

static pspec_status run(transform *self, ps_error *error) {
    const size_t block = BLOCK_BYTES / (2 * sizeof(double) * self->map->height) + 1;
    const size_t num = self->out->num_columns;
    PS_TRY(PS_NEW(&self->lines, PS_WORKERS_MOST * room_of_worker(self->map), "rows of an image",
                  error));
    PS_TRY(PS_NEW(&self->columns, 2 * smaller(block, num) * self->map->height,
                  "columns of an image", error));
    for (self->first = 0; self->first < num; self->first += self->num) {
        self->num = smaller(block, num - self->first);
        PS_TRY(share(self, transform_rows, error));
        PS_TRY(share(self, transform_columns, error));
    }
    return PSPEC_OK;
}

pspec_status ps_torus_map_find_powers(ps_torus_map_powers *out, const ps_torus_map *map,
                                      size_t cutoff, ps_error *error) {
    transform self = {.map = map, .out = out};
    *out = (ps_torus_map_powers){.num_columns = smaller(cutoff, map->width / 2) + 1,
                                 .most_row = smaller(cutoff, map->height / 2)};
    PS_TRY(
        PS_NEW(&out->all, out->num_columns * (2 * out->most_row + 1), "powers of an image", error));
    const pspec_status status = run(&self, error);
    free(self.lines);
    free(self.columns);
    return status;
}

void ps_torus_map_powers_free(ps_torus_map_powers *powers) {
    free(powers->all);
    *powers = (ps_torus_map_powers){0};
}

double ps_torus_map_power(const ps_torus_map_powers *powers, const ps_torus_map *map,
                          const int32_t k[2]) {
    const int64_t height = (int64_t)map->height;
    const int64_t width = (int64_t)map->width;
    const int64_t most = (int64_t)powers->most_row;
    int64_t row = (k[0] % height + height) % height;
    int64_t column = (k[1] % width + width) % width;
    if (column > width / 2) { /* f_-k is the conjugate of f_k */
        column = width - column;
        row = (height - row) % height;
    }
    row -= row > height / 2 ? height : 0;
    return powers->all[column * (2 * most + 1) + row + most];
}
