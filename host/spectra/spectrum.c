#include "spectra/spectrum.h"

#include "base/memory.h"
#include "base/workers.h"

#include <math.h>
#include <stdlib.h>

static void describe_ring(ps_spectrum_bin *out, const ps_mean *powers, const uint32_t *members,
                          const ps_bin *bin) {
    const size_t num = bin->end - bin->begin;
    out->anisotropy_db = ps_anisotropy_db(powers, members, num);
    out->standard_error =
        ps_subset_standard_error(powers, members, num, bin->num_frequencies, out->standard_error);
}

typedef struct rings {
    ps_spectrum *out;
    const ps_bins *bins;
} rings;

/* In turns, since rings grow. */
static void describe_some(void *payload, unsigned index, unsigned count) {
    const rings *work = payload;
    for (size_t b = index; b < work->bins->num_reported; b += count) {
        const ps_bin *bin = &work->bins->bins[b];
        describe_ring(&work->out->bins[b], work->out->powers, work->bins->members + bin->begin,
                      bin);
    }
}

double ps_spectrum_factor(pspec_normalization normalization, const ps_pattern_totals *totals,
                          double reference_points) {
    const double points = totals->points.sum + totals->points.sum_low;
    return normalization == PSPEC_NORMALIZATION_INTEGRAL
               ? points / (double)totals->num_realizations / reference_points
               : 1;
}

static void fill_bins(ps_spectrum *out, const ps_bins *bins, const ps_mean *means, double factor) {
    const double unit =
        pow(out->mean_points, 1.0 / ps_frequencies_space_dimension(&out->frequencies));
    for (size_t b = 0; b < bins->num_reported; b++) {
        const ps_bin *bin = &bins->bins[b];
        out->bins[b] = (ps_spectrum_bin){
            .key = bin->key,
            .frequency = bin->mean_frequency,
            .normalized_frequency = bin->mean_frequency / unit,
            .count = bin->num_modes,
            .num_computed = ps_bin_num_computed(bin),
            .power = means[b].mean * factor,
            .standard_error = means[b].standard_error * factor,
            .anisotropy_db = NAN,
        };
    }
    if (out->powers != NULL) {
        rings work = {out, bins};
        ps_workers_share(bins->num_members, describe_some, &work);
    }
}

static pspec_status fill(ps_spectrum *out, const ps_frequencies *frequencies, const ps_bins *bins,
                         const ps_mean *bin_means, double factor, ps_error *error) {
    PS_TRY(ps_frequencies_copy(&out->frequencies, frequencies, error));
    for (size_t i = 0; out->powers != NULL && i < frequencies->num; i++) {
        out->powers[i].mean *= factor;
        out->powers[i].standard_error *= factor;
    }
    PS_TRY(PS_NEW(&out->bins, bins->num_reported, "the bins", error));
    out->num_bins = bins->num_reported;
    fill_bins(out, bins, bin_means, factor);
    return PSPEC_OK;
}

pspec_status ps_spectrum_from_means(ps_spectrum *out, const ps_frequencies *frequencies,
                                    const ps_bins *bins, const ps_mean *bin_means, ps_mean *powers,
                                    double factor, const ps_pattern_totals *totals,
                                    ps_error *error) {
    const double n = (double)totals->num_realizations;
    *out = (ps_spectrum){.num_realizations = totals->num_realizations,
                         .smallest_points = totals->smallest_points,
                         .largest_points = totals->largest_points,
                         .mean_weight_sum = totals->sum_weights / n,
                         .powers = powers};
    ps_sums_finish(&totals->points, totals->num_realizations, &out->mean_points,
                   &out->points_error);
    ps_sums_finish(&totals->sample_sizes, totals->num_realizations, &out->sample_size.mean,
                   &out->sample_size.standard_error);
    const pspec_status status = fill(out, frequencies, bins, bin_means, factor, error);
    if (status != PSPEC_OK) {
        ps_spectrum_free(out);
    }
    return status;
}

pspec_status ps_spectrum_create(ps_spectrum *out, const ps_frequencies *frequencies,
                                const ps_bins *bins, ps_accumulator *accumulator, double factor,
                                const ps_pattern_totals *totals, bool with_frequencies,
                                ps_error *error) {
    ps_mean *bin_means = NULL;
    ps_mean *powers = NULL;
    pspec_status status = PSPEC_OK;
    *out = (ps_spectrum){0};
    PS_TRY_OUT(status, PS_NEW(&bin_means, bins->num, "the bins", error));
    PS_TRY_OUT(status, ps_accumulator_bins(accumulator, bin_means, error));
    if (with_frequencies) {
        PS_TRY_OUT(status, PS_NEW(&powers, frequencies->num, "the powers", error));
        PS_TRY_OUT(status, ps_accumulator_frequencies(accumulator, powers, error));
    }
    status =
        ps_spectrum_from_means(out, frequencies, bins, bin_means, powers, factor, totals, error);
    powers = NULL;
out:
    free(powers);
    free(bin_means);
    return status;
}

void ps_spectrum_free(ps_spectrum *spectrum) {
    free(spectrum->powers);
    ps_frequencies_free(&spectrum->frequencies);
    free(spectrum->bins);
    *spectrum = (ps_spectrum){0};
}

void ps_spectrum_repeat(ps_spectrum *spectrum, uint64_t num_realizations) {
    spectrum->num_realizations = num_realizations;
    spectrum->sample_size.standard_error = 0;
    spectrum->points_error = 0;
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        if (spectrum->bins[b].num_computed == spectrum->bins[b].count) {
            spectrum->bins[b].standard_error = 0;
        }
    }
    for (size_t i = 0; spectrum->powers != NULL && i < spectrum->frequencies.num; i++) {
        spectrum->powers[i].standard_error = 0;
    }
}

size_t ps_spectrum_place(const ps_frequencies *set, size_t i) {
    const size_t width = 2 * (size_t)set->max_frequency + 1;
    size_t place = 0;
    for (unsigned axis = 0; axis < set->dimension; axis++) {
        const int64_t k = set->vectors[i * set->dimension + axis];
        place = place * width + (size_t)(k + set->max_frequency);
    }
    return place;
}

pspec_status ps_spectrum_full(const ps_spectrum *spectrum, int which, ps_mean dc, double **array,
                              size_t *num_entries, ps_error *error) {
    const ps_frequencies *set = &spectrum->frequencies;
    const size_t width = 2 * (size_t)set->max_frequency + 1;
    *num_entries = 1;
    for (unsigned axis = 0; axis < set->dimension; axis++) {
        *num_entries *= width; /* fits: ps_frequencies_lattice checked the size of the box */
    }
    PS_TRY(PS_NEW(array, *num_entries, "the full spectrum", error));
    (*array)[*num_entries / 2] = which == 0 ? dc.mean : dc.standard_error;
    for (size_t i = 0; i < set->num; i++) {
        const size_t place = ps_spectrum_place(set, i);
        const ps_mean *power = &spectrum->powers[i];
        const double value = which == 0 ? power->mean : power->standard_error;
        (*array)[place] = value;
        (*array)[*num_entries - 1 - place] = value; /* -k */
    }
    return PSPEC_OK;
}
