#include "spectra/phases/shift_products.h"

#include "base/memory.h"

#include <gsl/gsl_fft_complex.h>

#include <stdlib.h>
#include <string.h>

struct ps_shift_products {
    const ps_frequencies *box;
    size_t side, cells; /* of the grid, side^d */
    double *grid;       /* [cells][2] */
    double *line;       /* [side][2]: a stride of a power of two would miss the caches */
};

/* Differences go from -K to K. */
static size_t find_side(const ps_frequencies *box) {
    const size_t least = 2 * (size_t)box->max_frequency + 1;
    size_t side = 1;
    while (side < least) {
        side *= 2;
    }
    return side;
}

double ps_shift_products_cells(const ps_frequencies *box) {
    double cells = 1;
    for (unsigned axis = 0; axis < box->dimension; axis++) {
        cells *= (double)find_side(box);
    }
    return cells;
}

pspec_status ps_shift_products_create(ps_shift_products **out, const ps_frequencies *box,
                                      ps_error *error) {
    const size_t side = find_side(box);
    size_t cells = 1;
    PS_TRY(PS_NEW(out, 1, "products of amplitudes", error));
    for (unsigned axis = 0; axis < box->dimension; axis++) {
        if (!ps_size_multiply(cells, side, &cells)) {
            return ps_fail(error, PSPEC_ERROR_MEMORY,
                           "a grid of %zu^%u numbers for products of amplitudes is too large", side,
                           box->dimension);
        }
    }
    ps_shift_products *const self = *out;
    self->box = box;
    self->side = side;
    self->cells = cells;
    PS_TRY(PS_NEW(&self->line, 2 * side, "a line of amplitudes", error));
    return ps_allocate_for(&self->grid, cells, 2 * sizeof(double), "a grid of amplitudes", error);
}

void ps_shift_products_destroy(ps_shift_products *products) {
    if (products != NULL) {
        free(products->grid);
        free(products->line);
        free(products);
    }
}

/* ---- one set ----------------------------------------------------------------------------- */

/* sign -1: that of -k. */
static size_t find_cell(const ps_shift_products *self, const int32_t *k, int sign) {
    size_t cell = 0;
    for (unsigned axis = 0; axis < self->box->dimension; axis++) {
        const int32_t component = sign * k[axis];
        const size_t place = component < 0 ? self->side - (size_t)-component : (size_t)component;
        cell = cell * self->side + place;
    }
    return cell;
}

static bool is_in_half(const ps_frequencies *box, const int32_t *k) {
    bool is_in = true;
    for (unsigned axis = 0; axis < box->dimension; axis++) {
        is_in = is_in && abs(k[axis]) <= box->max_frequency / 2;
    }
    return is_in;
}

/* S(-k) is the conjugate of S(k). */
static void spread(ps_shift_products *self, const double *amplitudes) {
    memset(self->grid, 0, 2 * self->cells * sizeof *self->grid);
    for (size_t i = 0; i < self->box->num; i++) {
        const int32_t *const k = self->box->vectors + i * self->box->dimension;
        if (!is_in_half(self->box, k)) {
            continue;
        }
        double *const cell = self->grid + 2 * find_cell(self, k, 1);
        double *const opposite = self->grid + 2 * find_cell(self, k, -1);
        cell[0] = opposite[0] = amplitudes[2 * i];
        cell[1] = amplitudes[2 * i + 1];
        opposite[1] = -amplitudes[2 * i + 1];
    }
}

/* Numbers `stride` apart. GSL refuses no length that is a power of two. */
static void transform_line(ps_shift_products *self, double *first, size_t stride,
                           gsl_fft_direction direction) {
    const size_t number = 2 * sizeof *first;
    for (size_t i = 0; i < self->side; i++) {
        memcpy(self->line + 2 * i, first + 2 * stride * i, number);
    }
    gsl_fft_complex_radix2_transform(self->line, 1, self->side, direction);
    for (size_t i = 0; i < self->side; i++) {
        memcpy(first + 2 * stride * i, self->line + 2 * i, number);
    }
}

/* Every line along every axis, in place. */
static void transform(ps_shift_products *self, gsl_fft_direction direction) {
    size_t stride = 1;
    for (unsigned axis = 0; axis < self->box->dimension; axis++, stride *= self->side) {
        for (size_t line = 0; line < self->cells / self->side; line++) {
            const size_t first = line / stride * stride * self->side + line % stride;
            transform_line(self, self->grid + 2 * first, stride, direction);
        }
    }
}

void ps_shift_products_run(ps_shift_products *self, const double *amplitudes, double *out) {
    spread(self, amplitudes);
    transform(self, gsl_fft_backward);
    for (size_t i = 0; i < self->cells; i++) {
        double *const cell = self->grid + 2 * i;
        cell[0] = (cell[0] * cell[0] + cell[1] * cell[1]) / (double)self->cells;
        cell[1] = 0;
    }
    transform(self, gsl_fft_forward);
    for (size_t i = 0; i < self->box->num; i++) {
        const int32_t *const k = self->box->vectors + i * self->box->dimension;
        memcpy(out + 2 * i, self->grid + 2 * find_cell(self, k, 1), 2 * sizeof *out);
    }
}
