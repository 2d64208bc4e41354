/* The public library: spectra, from plans, files and other spectra. */
#include "api/public_objects.h"
#include "base/memory.h"
#include "base/workers.h"
#include "spectra/file/spectrum_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct pspec_spectrum {
    ps_spectrum_sums sums; /* what everything else follows from */
    size_t num_bins;
    pspec_bin *bins;
    double *powers, *standard_errors;
};

/* ---- from sums --------------------------------------------------------------------------- */

static pspec_status copy_bins(pspec_spectrum *spectrum, const ps_spectrum *averages,
                              ps_error *error) {
    PS_TRY(PS_NEW(&spectrum->bins, averages->num_bins, "bins", error));
    spectrum->num_bins = averages->num_bins;
    for (size_t b = 0; b < averages->num_bins; b++) {
        const ps_spectrum_bin *bin = &averages->bins[b];
        spectrum->bins[b] = (pspec_bin){
            bin->key,   bin->frequency,      bin->normalized_frequency, bin->count,
            bin->power, bin->standard_error, bin->anisotropy_db,        bin->num_computed};
    }
    return PSPEC_OK;
}

typedef struct copying {
    pspec_spectrum *spectrum;
    const ps_spectrum *averages;
} copying;

static void copy_some_powers(void *payload, unsigned index, unsigned count) {
    const copying *work = payload;
    const size_t num = work->averages->frequencies.num;
    const size_t end = ps_share_begin(num, index + 1, count);
    for (size_t i = ps_share_begin(num, index, count); i < end; i++) {
        work->spectrum->powers[i] = work->averages->powers[i].mean;
        work->spectrum->standard_errors[i] = work->averages->powers[i].standard_error;
    }
}

static pspec_status copy_powers(pspec_spectrum *spectrum, const ps_spectrum *averages,
                                ps_error *error) {
    ps_spares *const spares = spectrum->sums.spares;
    const size_t num = averages->frequencies.num;
    PS_TRY(PS_TAKE(spares, &spectrum->powers, num, "powers", error));
    PS_TRY(PS_TAKE(spares, &spectrum->standard_errors, num, "standard errors", error));
    copying work = {spectrum, averages};
    ps_workers_share(num, copy_some_powers, &work);
    return PSPEC_OK;
}

static pspec_status fill_spectrum(pspec_spectrum *spectrum, const ps_bins *bins, ps_error *error) {
    ps_spectrum averages = {0};
    PS_TRY(ps_spectrum_sums_finish(&spectrum->sums, bins, &averages, error));
    pspec_status status = copy_bins(spectrum, &averages, error);
    if (status == PSPEC_OK) {
        status = copy_powers(spectrum, &averages, error);
    }
    ps_spectrum_free(&averages);
    return status;
}

pspec_status ps_public_spectrum(pspec_spectrum **out, ps_spectrum_sums *sums, const ps_bins *bins,
                                ps_error *error) {
    void *memory = NULL;
    pspec_status status = ps_allocate(&memory, 1, sizeof(pspec_spectrum), "a spectrum", error);
    if (status != PSPEC_OK) {
        ps_spectrum_sums_free(sums);
        return status;
    }
    pspec_spectrum *spectrum = memory;
    spectrum->sums = *sums;
    *sums = (ps_spectrum_sums){0};
    status = fill_spectrum(spectrum, bins, error);
    if (status != PSPEC_OK) {
        pspec_spectrum_destroy(spectrum);
        return status;
    }
    *out = spectrum;
    return PSPEC_OK;
}

const ps_spectrum_sums *ps_public_sums(const pspec_spectrum *spectrum) {
    return &spectrum->sums;
}

pspec_status pspec_spectrum_create(pspec_spectrum **out, pspec_plan *plan) {
    ps_spectrum_sums sums = {0};
    const ps_bins *bins = NULL;
    if (out == NULL || plan == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    *out = NULL;
    PS_TRY(ps_plan_sums(plan, &sums, &bins));
    return ps_public_spectrum(out, &sums, bins, &ps_plan_context(plan)->error);
}

void pspec_spectrum_destroy(pspec_spectrum *spectrum) {
    if (spectrum != NULL) {
        const size_t bytes = spectrum->sums.frequencies.num * sizeof(double);
        ps_spares_give(spectrum->sums.spares, spectrum->powers, bytes);
        ps_spares_give(spectrum->sums.spares, spectrum->standard_errors, bytes);
        ps_spectrum_sums_free(&spectrum->sums);
        free(spectrum->bins);
        free(spectrum);
    }
}

/* ---- files ------------------------------------------------------------------------------- */

pspec_status pspec_spectrum_save(const pspec_spectrum *spectrum, pspec_context *context,
                                 const char *path) {
    if (context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    if (spectrum == NULL) {
        return ps_fail(&context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "there is no spectrum to save");
    }
    if (path == NULL || strcmp(path, "-") == 0) {
        return ps_fail(&context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "a spectrum is saved to a file, and standard output is none");
    }
    PS_TRY(ps_spectrum_write(&spectrum->sums, path, &context->error));
    ps_log_say(&context->log, "saved a spectrum of %llu realizations to \"%s\"",
               (unsigned long long)spectrum->sums.totals.num_realizations, path);
    return PSPEC_OK;
}

pspec_status pspec_spectrum_load(pspec_spectrum **out, pspec_context *context, const char *path) {
    ps_spectrum_sums sums = {0};
    ps_bins bins = {0};
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    *out = NULL;
    if (path == NULL) {
        return ps_fail(&context->error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no name of a file");
    }
    PS_TRY(ps_spectrum_read(&sums, &bins, path, &context->error));
    ps_log_say(&context->log, "loaded a spectrum of %llu realizations from \"%s\"",
               (unsigned long long)sums.totals.num_realizations, path);
    const pspec_status status = ps_public_spectrum(out, &sums, &bins, &context->error);
    ps_bins_free(&bins);
    return status;
}

/* ---- merge ------------------------------------------------------------------------------- */

static pspec_status merge_sums(ps_spectrum_sums *sums, const pspec_spectrum *const *spectra,
                               size_t num_spectra, ps_error *error) {
    enum { WHICH_BYTES = 48 };
    char which[WHICH_BYTES];
    PS_TRY(ps_spectrum_sums_copy(sums, &spectra[0]->sums, error));
    for (size_t i = 1; i < num_spectra; i++) {
        snprintf(which, sizeof which, "spectrum %zu of those to merge", i + 1);
        PS_TRY(ps_spectrum_sums_merge(sums, &spectra[i]->sums, which, error));
    }
    return PSPEC_OK;
}

pspec_status pspec_spectrum_merge(pspec_spectrum **out, pspec_context *context,
                                  const pspec_spectrum *const *spectra, size_t num_spectra) {
    ps_spectrum_sums sums = {0};
    ps_bins bins = {0};
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    *out = NULL;
    if (num_spectra == 0 || spectra == NULL) {
        return ps_fail(&context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "there are no spectra to merge");
    }
    for (size_t i = 0; i < num_spectra; i++) {
        if (spectra[i] == NULL) {
            return ps_fail(&context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                           "spectrum %zu of those to merge is NULL", i + 1);
        }
    }
    pspec_status status = merge_sums(&sums, spectra, num_spectra, &context->error);
    if (status == PSPEC_OK) {
        status = ps_bins_create(&bins, &sums.frequencies, &context->error);
    }
    if (status == PSPEC_OK) {
        status = ps_public_spectrum(out, &sums, &bins, &context->error);
    }
    ps_spectrum_sums_free(&sums);
    ps_bins_free(&bins);
    return status;
}

/* ---- contents ---------------------------------------------------------------------------- */

unsigned pspec_spectrum_dimension(const pspec_spectrum *spectrum) {
    return spectrum->sums.frequencies.dimension;
}

uint64_t pspec_spectrum_num_realizations(const pspec_spectrum *spectrum) {
    return spectrum->sums.totals.num_realizations;
}

double pspec_spectrum_mean_points(const pspec_spectrum *spectrum) {
    return ps_pattern_mean_points(&spectrum->sums.totals);
}

double pspec_spectrum_error(const pspec_spectrum *spectrum) {
    return spectrum->sums.error;
}

const pspec_bin *pspec_spectrum_bins(const pspec_spectrum *spectrum, size_t *num_bins) {
    if (num_bins != NULL) {
        *num_bins = spectrum->num_bins;
    }
    return spectrum->bins;
}

unsigned pspec_spectrum_components(const pspec_spectrum *spectrum) {
    return ps_frequency_components(&spectrum->sums.frequencies);
}

const int32_t *pspec_spectrum_frequencies(const pspec_spectrum *spectrum, size_t *num_frequencies) {
    if (num_frequencies != NULL) {
        *num_frequencies = spectrum->sums.frequencies.num;
    }
    return spectrum->sums.frequencies.vectors;
}

const double *pspec_spectrum_powers(const pspec_spectrum *spectrum) {
    return spectrum->powers;
}

const double *pspec_spectrum_standard_errors(const pspec_spectrum *spectrum) {
    return spectrum->standard_errors;
}
