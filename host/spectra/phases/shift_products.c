#include "spectra/phases/shift_products.h"

#include "base/memory.h"
#include "math/gsl/fourier.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- families -------------------------------------------------------------------------------- */

/* ---- which ------------------------------------------------------------------------------- */

static unsigned count_bits(unsigned axes) {
    unsigned num = 0;
    for (; axes != 0; axes &= axes - 1) {
        num++;
    }
    return num;
}

static unsigned all_axes(const ps_frequencies *box) {
    return (1U << box->dimension) - 1;
}

static size_t count_families(const ps_frequencies *box) {
    size_t num = 0;
    for (int32_t reach = box->max_frequency / 2; reach > 0; reach /= 2) {
        num += all_axes(box);
    }
    return num;
}

/* Shifts go from -2q to 2q. */
static size_t side_of(int32_t reach) {
    const size_t least = 4 * (size_t)reach + 1;
    size_t side = 1;
    while (side < least) {
        side *= 2;
    }
    return side;
}

/* They are no more than those of the box, which was small enough. */
static pspec_status begin_family(ps_shift_family *out, unsigned axes, int32_t reach,
                                 ps_error *error) {
    *out = (ps_shift_family){
        .axes = axes, .dimension = count_bits(axes), .reach = reach, .side = side_of(reach)};
    PS_TRY(ps_frequencies_lattice(&out->shifts, out->dimension, 2 * reach, false, error));
    out->num = out->shifts.num;
    return PSPEC_OK;
}

pspec_status ps_shift_families_list(ps_shift_family **out, size_t *num, const ps_frequencies *box,
                                    ps_error *error) {
    size_t first = 0;
    *num = 0;
    PS_TRY(PS_NEW(out, count_families(box), "sums of products", error));
    for (int32_t reach = box->max_frequency / 2; reach > 0; reach /= 2) {
        for (unsigned axes = all_axes(box); axes > 0; axes--) {
            ps_shift_family *const family = &(*out)[(*num)++];
            PS_TRY(begin_family(family, axes, reach, error));
            family->first = first;
            first += family->num;
        }
    }
    return PSPEC_OK;
}

void ps_shift_families_free(ps_shift_family *families, size_t num) {
    for (size_t i = 0; i < num; i++) {
        free(families[i].members);
        ps_frequencies_free(&families[i].shifts);
    }
    free(families);
}

/* a axes have (4q + 1)^a - 1 shifts of both signs; the sum over all sets of axes is, by the
 * binomial theorem, (4q + 2)^d - 2^d. */
size_t ps_shift_families_sums(const ps_frequencies *box) {
    size_t num = 0;
    for (int32_t reach = box->max_frequency / 2; reach > 0; reach /= 2) {
        size_t both = 1;
        for (unsigned axis = 0; axis < box->dimension; axis++) {
            both *= 4 * (size_t)reach + 2;
        }
        num += (both - ((size_t)1 << box->dimension)) / 2;
    }
    return num;
}

/* ---- grids ------------------------------------------------------------------------------- */

/* Numbers of a grid of side^dimension; it may be too many to index. */
static double count_cells(const ps_shift_family *family) {
    return pow((double)family->side, family->dimension);
}

/* The place of k in the grid, which is 0 but on the axes; sign -1: that of -k. */
static size_t find_cell(const ps_shift_family *family, const int32_t *k, int sign) {
    size_t cell = 0;
    for (unsigned axis = 0; family->axes >> axis != 0; axis++) {
        if ((family->axes >> axis & 1) != 0) {
            const int32_t component = sign * k[axis];
            const size_t size = (size_t)abs(component);
            cell = cell * family->side + (component < 0 ? family->side - size : size);
        }
    }
    return cell;
}

void ps_shift_family_shift(const ps_shift_family *family, size_t i, int32_t out[PS_MAX_DIMENSION]) {
    const int32_t *from = family->shifts.vectors + i * family->dimension;
    for (unsigned axis = 0; axis < PS_MAX_DIMENSION; axis++) {
        out[axis] = (family->axes >> axis & 1) != 0 ? *from++ : 0;
    }
}

/* ---- members ----------------------------------------------------------------------------- */

static bool is_member(const ps_shift_family *family, const int32_t *k, unsigned dimension) {
    bool is_in = true;
    for (unsigned axis = 0; axis < dimension; axis++) {
        const int32_t most = (family->axes >> axis & 1) != 0 ? family->reach : 0;
        is_in = is_in && abs(k[axis]) <= most;
    }
    return is_in;
}

static double find_weight(const ps_shift_family *family, const int32_t *k, unsigned dimension) {
    const double unit = PS_PI / (2 * ((double)family->reach + 1));
    double weight = 1;
    for (unsigned axis = 0; axis < dimension; axis++) {
        weight *= cos(unit * k[axis]);
    }
    return weight;
}

/* Half of the box of its reach: DC is in neither half. */
static pspec_status allocate(ps_shift_family *family, ps_error *error) {
    ps_frequencies half;
    PS_TRY(ps_frequencies_lattice(&half, family->dimension, family->reach, false, error));
    return PS_NEW(&family->members, half.num, "amplitudes to multiply", error);
}

/* The members, from a box that is enumerated. */
static pspec_status fill_members(ps_shift_family *family, const ps_frequencies *box,
                                 ps_error *error) {
    PS_TRY(ps_frequencies_enumerate(&family->shifts, error));
    PS_TRY(allocate(family, error));
    for (size_t i = 0; i < box->num; i++) {
        const int32_t *const k = box->vectors + i * box->dimension;
        if (is_member(family, k, box->dimension)) {
            family->members[family->num_members++] =
                (ps_shift_member){.frequency = i,
                                  .cell = find_cell(family, k, 1),
                                  .opposite = find_cell(family, k, -1),
                                  .weight = find_weight(family, k, box->dimension)};
        }
    }
    return PSPEC_OK;
}

struct ps_shift_products {
    ps_shift_family *families;
    size_t num_families, num_sums;
    double *grid; /* [cells of the largest family][2] */
    double *line; /* [largest side][2]: a stride of a power of two would miss the caches */
};

/* (1 + side)^d - 1 is the sum over sets of axes; a transform is of so many sets. */
double ps_shift_products_cells(const ps_frequencies *box) {
    double cells = 0;
    for (int32_t reach = box->max_frequency / 2; reach > 0; reach /= 2) {
        const double side = (double)side_of(reach);
        cells += pow(1 + side, box->dimension) - 1;
    }
    return cells / PS_SHIFT_SETS;
}

/* That of all axes and the largest reach comes first; with K = 1 there is none. */
static pspec_status allocate_grid(ps_shift_products *self, ps_error *error) {
    const ps_shift_family *const largest = self->families;
    size_t cells = 1;
    for (unsigned axis = 0; self->num_families > 0 && axis < largest->dimension; axis++) {
        if (!ps_size_multiply(cells, largest->side, &cells)) {
            return ps_fail(error, PSPEC_ERROR_MEMORY,
                           "a grid of %zu^%u numbers for products of amplitudes is too large",
                           largest->side, largest->dimension);
        }
    }
    PS_TRY(PS_NEW(&self->line, self->num_families > 0 ? 2 * largest->side : 1,
                  "a line of amplitudes", error));
    return ps_allocate_for(&self->grid, cells, 2 * sizeof(double), "a grid of amplitudes", error);
}

pspec_status ps_shift_products_create(ps_shift_products **out, const ps_frequencies *box,
                                      ps_error *error) {
    PS_TRY(PS_NEW(out, 1, "products of amplitudes", error));
    ps_shift_products *const self = *out;
    self->num_sums = ps_shift_families_sums(box);
    PS_TRY(ps_shift_families_list(&self->families, &self->num_families, box, error));
    for (size_t i = 0; i < self->num_families; i++) {
        PS_TRY(fill_members(&self->families[i], box, error));
    }
    return allocate_grid(self, error);
}

void ps_shift_products_destroy(ps_shift_products *products) {
    if (products != NULL) {
        ps_shift_families_free(products->families, products->num_families);
        free(products->grid);
        free(products->line);
        free(products);
    }
}

const ps_shift_family *ps_shift_products_families(const ps_shift_products *products, size_t *num) {
    *num = products->num_families;
    return products->families;
}

/* ---- transforms -------------------------------------------------------------------------- */

/* Numbers `stride` apart. */
static void transform_line(ps_shift_products *self, size_t side, double *first, size_t stride,
                           int sign) {
    const size_t number = 2 * sizeof *first;
    for (size_t i = 0; i < side; i++) {
        memcpy(self->line + 2 * i, first + 2 * stride * i, number);
    }
    ps_fourier(self->line, side, sign);
    for (size_t i = 0; i < side; i++) {
        memcpy(first + 2 * stride * i, self->line + 2 * i, number);
    }
}

/* Every line along every axis, in place. */
static void transform(ps_shift_products *self, const ps_shift_family *family, size_t cells,
                      int sign) {
    const size_t side = family->side;
    size_t stride = 1;
    for (unsigned axis = 0; axis < family->dimension; axis++, stride *= side) {
        for (size_t line = 0; line < cells / side; line++) {
            const size_t first = line / stride * stride * side + line % stride;
            transform_line(self, side, self->grid + 2 * first, stride, sign);
        }
    }
}

/* ---- sets -------------------------------------------------------------------------------- */

/* Adds S'(k), or with `is_second` i times that; S(-k) is the conjugate of S(k). */
static double spread(ps_shift_products *self, const ps_shift_family *family,
                     const double *amplitudes, bool is_second) {
    double sum = 0;
    for (size_t i = 0; i < family->num_members; i++) {
        const ps_shift_member *const member = &family->members[i];
        const double re = member->weight * amplitudes[2 * member->frequency];
        const double im = member->weight * amplitudes[2 * member->frequency + 1];
        double *const cell = self->grid + 2 * member->cell;
        double *const opposite = self->grid + 2 * member->opposite;
        cell[0] += is_second ? -im : re;
        cell[1] += is_second ? re : im;
        opposite[0] += is_second ? im : re;
        opposite[1] += is_second ? re : -im;
        sum += 2 * (re * re + im * im);
    }
    return sum;
}

/* The real part is f of the first set, the imaginary part that of the second. */
static void square(ps_shift_products *self, size_t cells) {
    for (size_t i = 0; i < 2 * cells; i++) {
        self->grid[i] *= self->grid[i] / (double)cells;
    }
}

/* Of F = Z_1 + i Z_2, where Z(-h) is the conjugate of Z(h). */
static void pick(const ps_shift_products *self, const ps_shift_family *family, size_t num_sets,
                 double *out) {
    int32_t h[PS_MAX_DIMENSION];
    for (size_t i = 0; i < family->num; i++) {
        ps_shift_family_shift(family, i, h);
        const double *const there = self->grid + 2 * find_cell(family, h, 1);
        const double *const opposite = self->grid + 2 * find_cell(family, h, -1);
        double *const first = out + 2 * (family->first + i);
        first[0] = (there[0] + opposite[0]) / 2;
        first[1] = (there[1] - opposite[1]) / 2;
        if (num_sets > 1) {
            double *const second = first + 2 * self->num_sums;
            second[0] = (there[1] + opposite[1]) / 2;
            second[1] = (opposite[0] - there[0]) / 2;
        }
    }
}

void ps_shift_products_run(ps_shift_products *self, size_t num_sets, const double *amplitudes,
                           size_t stride, double *out, double *norms) {
    for (size_t f = 0; f < self->num_families; f++) {
        const ps_shift_family *const family = &self->families[f];
        const size_t cells = (size_t)count_cells(family);
        double sum = 0;
        memset(self->grid, 0, 2 * cells * sizeof *self->grid);
        for (size_t r = 0; r < num_sets; r++) {
            sum += spread(self, family, amplitudes + r * stride, r > 0);
        }
        norms[f] = sqrt(sum);
        transform(self, family, cells, 1);
        square(self, cells);
        transform(self, family, cells, -1);
        pick(self, family, num_sets, out);
    }
}
