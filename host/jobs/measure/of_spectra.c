/* Measures of a mean spectrum. */
#include "jobs/measure/measure_rows.h"

#include <math.h>

/* A number of a spectrum; its standard error from those of the bins, which are independent: the
 * root of the sum over bins of the squares of what it changes by when the power of one bin changes
 * by its standard error. nan where a bin has none. */
static ps_mean with_error(double (*number)(const ps_spectrum *), ps_spectrum *spectrum) {
    ps_mean out = {number(spectrum), NAN};
    double squares = 0;
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        ps_spectrum_bin *const bin = &spectrum->bins[b];
        const double power = bin->power;
        bin->power += bin->standard_error;
        const double change = number(spectrum) - out.mean;
        squares += isnan(bin->standard_error) ? (double)NAN : change * change;
        bin->power = power;
    }
    out.standard_error = sqrt(squares);
    return out;
}

PS_MEASURE_OF_SPECTRUM(low_exponent) {
    const ps_low_end *const low = &shape->low;
    (void)spectrum;
    return shape->low_reason.status == PSPEC_OK && low->shape == PS_LOW_POWER_LAW
               ? (ps_mean){low->exponent, low->exponent_error}
               : (ps_mean){NAN, NAN};
}

PS_MEASURE_OF_SPECTRUM(hyperuniformity_index) {
    const double peak = ps_features_find(spectrum).peak;
    const ps_low_end *const low = &shape->low;
    return shape->low_reason.status == PSPEC_OK
               ? (ps_mean){low->plateau / peak, low->plateau_error / peak}
               : (ps_mean){NAN, NAN};
}

PS_MEASURE_OF_SPECTRUM(peak_power) {
    const ps_features features = ps_features_find(spectrum);
    (void)shape;
    return (ps_mean){features.peak, features.peak_error};
}

static double find_nyquist(const ps_spectrum *spectrum) {
    return ps_features_find(spectrum).effective_nyquist;
}

PS_MEASURE_OF_SPECTRUM(effective_nyquist) {
    (void)shape;
    return with_error(find_nyquist, spectrum);
}

/* Where the largest power so far first comes to 1, or nearly. */
static size_t find_first_peak(const ps_spectrum *spectrum) {
    const double nearly = 0.98; /* PSA's */
    size_t b = 0;
    while (b < spectrum->num_bins && spectrum->bins[b].power < nearly) {
        b++;
    }
    return b;
}

static double find_oscillation(const ps_spectrum *spectrum) {
    const double width = 5;  /* ten times the Nyquist frequency of a square grid */
    const double scale = 10; /* Heck et al. */
    const size_t first = find_first_peak(spectrum);
    double squares = 0;
    double count = 0;
    for (size_t b = first; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *const bin = &spectrum->bins[b];
        const double noise = isnan(bin->standard_error) ? 0 : bin->standard_error;
        if (bin->normalized_frequency <= spectrum->bins[first].normalized_frequency + width) {
            const double off = bin->power - 1;
            squares += (double)bin->count * (off * off - noise * noise);
            count += (double)bin->count;
        }
    }
    return count > 0 ? scale * sqrt(fmax(squares / count, 0)) : (double)NAN;
}

PS_MEASURE_OF_SPECTRUM(oscillation) {
    (void)shape;
    return with_error(find_oscillation, spectrum);
}
