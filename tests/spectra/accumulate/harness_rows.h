/* Rows of powers in every layout, on the host and on the device, made without an engine, and
 * accumulators that take them. What has no frequency is NaN.
 */
#ifndef TESTS_SPECTRA_ACCUMULATE_HARNESS_ROWS_H
#define TESTS_SPECTRA_ACCUMULATE_HARNESS_ROWS_H

#include "harness.h"

#include "spectra/accumulate/accumulate.h"

enum { ROWS_M = 21, ROWS_WEIGHTED = 4 };

/* Where the rows are, and how they are laid out. */
typedef struct rows_layout {
    bool is_on_device;
    ps_precision precision;
    unsigned lanes;
    size_t stride, step; /* slots: step i mod stride; no common divisor */
    size_t batch;
} rows_layout;

/* Those on the host come first, then single precision, then double. */
enum { ROWS_LAYOUTS = 10, ROWS_FIRST_SINGLE = 2, ROWS_FIRST_DOUBLE = 7 };
extern const rows_layout rows_layouts[ROWS_LAYOUTS];

typedef struct rows_fixture {
    ps_device *device;
    ps_frequencies set;
    ps_bins bins;
    double *powers;  /* [ROWS_M][set.num], numbers of single precision */
    double *weights; /* [ROWS_WEIGHTED][set.num] */
} rows_fixture;

/* With every layout that the device has the precision for. */
void rows_for_all_layouts(ps_device *device,
                          void (*check)(const rows_fixture *, const rows_layout *));

/* Where in a row each frequency stands; freed by the caller. */
uint32_t *rows_make_slots(const rows_fixture *what, const rows_layout *how);
/* Destroyed by the caller. */
ps_accumulator *rows_make_accumulator(const rows_fixture *what, const rows_layout *how,
                                      const uint32_t *slots, bool mean_only);
/* More than ROWS_M realizations are the same ones again. */
void rows_add_all(ps_accumulator *accumulator, const rows_fixture *what, const rows_layout *how,
                  const uint32_t *slots, size_t num);

#endif
