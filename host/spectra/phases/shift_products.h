/* Sums of products of amplitudes that translations multiply by one phase, on the torus: those of
 * the families below. Such a family is the transform of |f|^2, f being what has the coefficients
 * S'(k): one transform back and one forth, of two sets at a time, for f is real. */
#ifndef PS_SPECTRA_PHASES_SHIFT_PRODUCTS_H
#define PS_SPECTRA_PHASES_SHIFT_PRODUCTS_H

#include "frequencies/frequencies.h"

/* Which sums of products of amplitudes are made on the torus. A family is of a set of axes and a
 * reach q: it has the shifts h of the box |h_i| <= 2q that are 0 but on these axes, and for each of
 * them
 *
 *     Z(h) = sum_k S'(k + h) conj S'(k),   S'(k) = S(k) prod_i cos(pi k_i / (2 (q + 1)))
 *
 * over the k that are 0 but on these axes, |k_i| <= q, |k_i + h_i| <= q, neither k nor k + h being
 * 0. Every set of axes has the reaches K/2, K/4, .., 1, K being that of the box.
 *
 * Why axes: S(k) on them is the amplitude of what the points are when only these coordinates are
 * looked at. Points that are stratified along an axis alone, as a Latin hypercube's, correlate
 * there, and in the sum over the whole box the terms off the axis drown it.
 *
 * Why reaches and cosines: points that are one in each cell of a grid of n cells an axis are
 * correlated at h = (n, 0, ..) as prod_i sinc(k_i/n) sinc((k_i + h_i)/n), with one sign for
 * -n < k_1 < 0 and with the other beyond, and the sum over all k is 0. A reach about n has the
 * terms between, and the cosines weigh them nearly as that product does, the weights of the best
 * sum.
 * (For 64 jittered points in three dimensions the mean of phases at (4,0,0) has the length .64 so,
 * .23 without the cosines and .85 with the best weights, which nobody knows beforehand.) */

/* An amplitude of a family. */
typedef struct ps_shift_member {
    size_t frequency;      /* its number in the box */
    size_t cell, opposite; /* of the grid: those of k and -k */
    double weight;         /* the product of cosines */
} ps_shift_member;

typedef struct ps_shift_family {
    unsigned axes;      /* bit i: axis i */
    unsigned dimension; /* how many they are */
    int32_t reach;      /* q */
    size_t first, num;  /* its sums among those of all families */
    size_t side;        /* of a grid of that dimension that holds its shifts apart */
    size_t num_members; /* 0 until they are listed */
    ps_shift_member *members;
    ps_frequencies shifts; /* on these axes alone; enumerated with the members */
} ps_shift_family;

/* The families of a box that need not be enumerated, all axes and the largest reach first. *out is
 * for ps_shift_families_free, also after an error. */
pspec_status ps_shift_families_list(ps_shift_family **out, size_t *num, const ps_frequencies *box,
                                    ps_error *error) PS_MUST_CHECK;
void ps_shift_families_free(ps_shift_family *families, size_t num);

/* Shift number i: |h_i| <= 2q on the axes, 0 on the others. */
void ps_shift_family_shift(const ps_shift_family *family, size_t i, int32_t out[PS_MAX_DIMENSION]);

/* Without a list: sums of all families of a box. */
size_t ps_shift_families_sums(const ps_frequencies *box);

typedef struct ps_shift_products ps_shift_products;

/* Sets that are transformed together: one is the real part, one the imaginary. */
enum { PS_SHIFT_SETS = 2 };

/* Numbers of grids that a set takes, for boxes that need not be enumerated. */
double ps_shift_products_cells(const ps_frequencies *box);

/* For a box that is enumerated and outlives it. */
pspec_status ps_shift_products_create(ps_shift_products **out, const ps_frequencies *box,
                                      ps_error *error) PS_MUST_CHECK;
const ps_shift_family *ps_shift_products_families(const ps_shift_products *products, size_t *num);
/* Of 1 or 2 sets; set r has its amplitudes [box->num][2] at amplitudes + r * stride.
 * out[num_sets][ps_shift_families_sums][2]; norms[families]: the root of the sum of |S'(k)|^2 of
 * all that was transformed together, to which rounding is relative. */
void ps_shift_products_run(ps_shift_products *products, size_t num_sets, const double *amplitudes,
                           size_t stride, double *out, double *norms);
void ps_shift_products_destroy(ps_shift_products *products);

#endif
