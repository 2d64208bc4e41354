#include "spectra/shape/features.h"

#include <math.h>

static void find_peak(ps_features *out, const ps_spectrum *spectrum) {
    out->peak = -1;
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *const bin = &spectrum->bins[b];
        if (bin->power > out->peak) {
            out->peak = bin->power;
            out->peak_error = bin->standard_error;
            out->peak_frequency = bin->normalized_frequency;
        }
    }
}

/* The definition of Heck et al., 2013, over frequencies of the lattice. */
static double find_nyquist(const ps_spectrum *spectrum) {
    const double quiet = 0.1;
    const double loud = 0.5;
    double sum = 0;
    double count = 0;
    double mean = 0;
    double before = 0; /* the mean, and the frequency, of the bin before */
    double at = 0;
    double last = 0; /* where the mean was the quiet one */
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *const bin = &spectrum->bins[b];
        sum += (double)bin->count * bin->power;
        count += (double)bin->count;
        mean = sum / count;
        if (before < quiet && mean >= quiet && b > 0) {
            last = at + (bin->normalized_frequency - at) * (quiet - before) / (mean - before);
        }
        if (mean >= loud) {
            return last / 2;
        }
        before = mean;
        at = bin->normalized_frequency;
    }
    return NAN;
}

static double find_anisotropy(const ps_spectrum *spectrum) {
    const double decibels = 10;
    double sum = 0;
    double count = 0;
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *const bin = &spectrum->bins[b];
        if (isfinite(bin->anisotropy_db)) {
            sum += (double)bin->count * pow(10, bin->anisotropy_db / decibels);
            count += (double)bin->count;
        }
    }
    return count > 0 ? decibels * log10(sum / count) : NAN;
}

ps_features ps_features_find(const ps_spectrum *spectrum) {
    ps_features out = {0};
    find_peak(&out, spectrum);
    out.effective_nyquist = find_nyquist(spectrum);
    out.anisotropy_db = find_anisotropy(spectrum);
    return out;
}
