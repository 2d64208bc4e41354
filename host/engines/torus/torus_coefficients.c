#include "engines/torus/torus_coefficients.h"

#include "base/memory.h"
#include "device/reals.h"

#include <math.h>
#include <stdlib.h>

/* Numbers of a vector of frequencies: cc, sc, cs, ss, each high and low, in
 * kernels/torus/product.cl; cosines and sines, each high and low, in kernels/torus/fold.cl. */
enum { PRODUCT_SUMS = 8, TOTAL_SUMS = 4 };

typedef struct sums {
    double *products; /* [pair][left in tile][PRODUCT_SUMS][lanes] */
    double *totals;   /* [tile][TOTAL_SUMS][lanes] */
    size_t lanes;
} sums;

/* high and low of sum number i of a vector, added. */
static double sum_at(const double *vector, size_t i, size_t lanes) {
    return vector[2 * i * lanes] + vector[(2 * i + 1) * lanes];
}

static void write_total(const sums *copies, size_t place, double out[2]) {
    const size_t lanes = copies->lanes;
    const double *const vector =
        copies->totals + place / lanes * TOTAL_SUMS * lanes + place % lanes;
    out[0] = sum_at(vector, 0, lanes);
    out[1] = -sum_at(vector, 1, lanes);
}

/* slot: [pair][left in tile][l + r, l - r][right in tile] */
static void write_product(const sums *copies, size_t slot, double out[2]) {
    const size_t lanes = copies->lanes;
    const size_t left = slot / (2 * lanes); /* of all pairs */
    const double sign = slot / lanes % 2 == 0 ? 1 : -1;
    const double *const vector = copies->products + left * PRODUCT_SUMS * lanes + slot % lanes;
    out[0] = sum_at(vector, 0, lanes) - sign * sum_at(vector, 3, lanes);
    out[1] = -(sum_at(vector, 1, lanes) + sign * sum_at(vector, 2, lanes));
}

static void write_all(const ps_torus_finished *finished, const sums *copies, double *out) {
    const ps_frequencies *const set = finished->frequencies;
    const size_t first_total = finished->split != NULL ? ps_split_left_slot(finished->split) : 0;
    for (size_t i = 0; i < set->num; i++) {
        const size_t slot = finished->split != NULL
                                ? ps_split_slot(finished->split, set->vectors + i * set->dimension)
                                : i;
        double *const to = out + 2 * i;
        if (slot < first_total) {
            write_product(copies, slot, to);
        } else {
            write_total(copies, slot - first_total, to);
        }
        to[0] = ldexp(to[0], finished->exponent);
        to[1] = ldexp(to[1], finished->exponent);
    }
}

static pspec_status read_sums(const ps_torus_finished *finished, sums *out, ps_device *device,
                              ps_error *error) {
    const size_t lanes = out->lanes;
    const size_t num_pairs = finished->split != NULL ? finished->split->num_pairs : 0;
    const size_t num_products = num_pairs * lanes * PRODUCT_SUMS * lanes;
    const size_t num_totals = finished->sums->num_tiles * TOTAL_SUMS * lanes;
    PS_TRY(PS_NEW(&out->totals, num_totals, "sums of a list", error));
    PS_TRY(ps_reals_read(device, &finished->sums->totals, finished->precision, out->totals,
                         num_totals, error));
    if (num_products == 0) {
        return PSPEC_OK;
    }
    PS_TRY(PS_NEW(&out->products, num_products, "sums of products", error));
    return ps_reals_read(device, finished->products, finished->precision, out->products,
                         num_products, error);
}

pspec_status ps_torus_coefficients(const ps_torus_finished *finished, ps_device *device,
                                   double *out, ps_error *error) {
    sums copies = {.lanes = finished->sums->lanes};
    const pspec_status status = read_sums(finished, &copies, device, error);
    if (status == PSPEC_OK) {
        write_all(finished, &copies, out);
    }
    free(copies.products);
    free(copies.totals);
    return status;
}

double ps_torus_coefficient_bytes(double num_pairs, double num_tiles, double lanes) {
    return (num_pairs * lanes * PRODUCT_SUMS + num_tiles * TOTAL_SUMS) * lanes *
           (double)sizeof(double);
}
