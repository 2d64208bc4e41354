/* Spectra that the program or the library saved, with the question that they answer: tables of
 * power and angular as NPZ. */
#ifndef PS_ANSWERS_CHECK_SAVED_SPECTRUM_H
#define PS_ANSWERS_CHECK_SAVED_SPECTRUM_H

#include "base/status.h"
#include "frequencies/bin_rule.h"
#include "spectra/spectrum.h"
#include "fields/table.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct ps_saved_bin {
    int64_t key; /* ring number (from 0 on by widths above 1), |k|^2 of a shell, or degree */
    double power, standard_error; /* nan: one realization */
    double frequency;             /* mean |k|, or the degree */
    uint64_t count;               /* lattice points of both signs; 0: the file does not say */
    uint64_t num_computed;        /* of them; 0: the file does not say */
} ps_saved_bin;

typedef struct ps_saved_spectrum {
    bool on_sphere, on_hemisphere;
    unsigned dimension;    /* of the points */
    int32_t max_frequency; /* K or L */
    ps_bin_rule bin_rule;  /* on the torus */
    uint64_t per_ring;     /* 0: all frequencies of a ring */
    bool has_seed;
    uint64_t seed; /* of the sampler, and of the choice with per_ring */
    pspec_normalization normalization;
    uint64_t num_realizations;
    uint64_t smallest_points, largest_points;
    double mean_points;
    double sample_size; /* mean of (sum w)^2 / sum w^2; mean_points where the file does not say */
    double modes;       /* frequencies of both signs, or orders, over which the error is a mean */
    double error;       /* bound of the error of S, in units of sqrt(V) */
    size_t num_bins;
    ps_saved_bin *bins; /* ascending keys */
} ps_saved_spectrum;

/* Has the file the beginning of a saved spectrum, or of a table as CSV or JSON, which is refused
 * when it is read, and is no stream? What is empty is none: who reads points of it says so. */
pspec_status ps_saved_spectrum_find(bool *is_one, const char *path, ps_error *error) PS_MUST_CHECK;

/* What is no saved spectrum, damaged, or has no rings or degrees, is PSPEC_ERROR_INPUT with path in
 * the sentence. */
pspec_status ps_saved_spectrum_read(ps_saved_spectrum *out, const char *path,
                                    ps_error *error) PS_MUST_CHECK;
void ps_saved_spectrum_free(ps_saved_spectrum *saved);

/* What such a table has, however it came; name is for sentences. *out is {0}, and to be freed, also
 * after an error. */
pspec_status ps_saved_table_take(ps_saved_spectrum *out, const ps_table *table, const char *name,
                                 ps_error *error) PS_MUST_CHECK;

#endif
