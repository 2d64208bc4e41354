#include "spectra/phases/shift_families.h"

#include "base/memory.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

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
size_t ps_shift_side(int32_t reach) {
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
        .axes = axes, .dimension = count_bits(axes), .reach = reach, .side = ps_shift_side(reach)};
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

double ps_shift_family_cells(const ps_shift_family *family) {
    return pow((double)family->side, family->dimension);
}

size_t ps_shift_family_cell(const ps_shift_family *family, const int32_t *k, int sign) {
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

pspec_status ps_shift_family_fill(ps_shift_family *family, const ps_frequencies *box,
                                  ps_error *error) {
    PS_TRY(ps_frequencies_enumerate(&family->shifts, error));
    PS_TRY(allocate(family, error));
    for (size_t i = 0; i < box->num; i++) {
        const int32_t *const k = box->vectors + i * box->dimension;
        if (is_member(family, k, box->dimension)) {
            family->members[family->num_members++] =
                (ps_shift_member){.frequency = i,
                                  .cell = ps_shift_family_cell(family, k, 1),
                                  .opposite = ps_shift_family_cell(family, k, -1),
                                  .weight = find_weight(family, k, box->dimension)};
        }
    }
    return PSPEC_OK;
}
