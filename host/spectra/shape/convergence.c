#include "spectra/shape/convergence.h"

#include <math.h>

/* Standard errors from which on something is not what it may be. */
static const double SIGNIFICANT = 3;
/* Standard deviations of chi^2 above its mean that a fit may be off: of a right model with twenty
 * rings one in 10^5 is. */
static const double MOST_OFF = 5;

static bool fits(const ps_low_end *low) {
    const double freedom = (double)low->degrees_of_freedom;
    const double chi2 = low->shape == PS_LOW_PLATEAU ? low->plateau_chi2 : low->law_chi2;
    return chi2 <= freedom + MOST_OFF * sqrt(2 * freedom);
}

/* A ring in which the power differs from direction to direction by more is none of an isotropic
 * spectrum: it has 0.2 of a Latin hypercube. The first one has two lengths, of which one may be
 * sixteen times the other by a law of nu^8. */
static const double MOST_ANISOTROPY = 0.1;

typedef struct anisotropy {
    double excess; /* nan: unknown */
    double error;  /* of exponential powers */
} anisotropy;

static anisotropy find_anisotropy(const ps_low_end *low, const ps_spectrum *spectrum) {
    const double decibels = 10;
    const double num = (double)spectrum->num_realizations;
    double sum = 0;
    double count = 0;
    for (size_t b = 1; b < low->num_bins; b++) {
        const ps_spectrum_bin *const bin = &spectrum->bins[b];
        if (isfinite(bin->anisotropy_db)) {
            sum += (double)bin->count * pow(10, bin->anisotropy_db / decibels);
            count += (double)bin->count;
        }
    }
    return (anisotropy){count > 0 ? sum / count - 1 / num : NAN,
                        sqrt((2 + 6 / num) / (count / 2)) / num};
}

/* Of the power of the first ring, a plateau has so much at least: ten thousand realizations of
 * jittered points have one of 0.05 that is six standard errors from 0, by what the fits neglect. */
static const double LEAST_PLATEAU = 0.25;

static ps_convergence_kind find_kind(const ps_low_end *low, const ps_spectrum *spectrum,
                                     anisotropy found) {
    const bool is_faint = low->plateau < LEAST_PLATEAU * spectrum->bins[0].power;
    return low->shape == PS_LOW_UNDECIDED                               ? PS_CONVERGENCE_UNKNOWN
           : found.excess > MOST_ANISOTROPY + SIGNIFICANT * found.error ? PS_CONVERGENCE_MIXED
           : !fits(low)                                                 ? PS_CONVERGENCE_UNFIT
           : low->shape == PS_LOW_PLATEAU ? (is_faint ? PS_CONVERGENCE_FAINT : PS_CONVERGENCE_WHITE)
           : low->exponent > 0            ? PS_CONVERGENCE_FAST
                                          : PS_CONVERGENCE_SLOW;
}

/* 1 + b/d, and 1 + min(b, 1)/d. */
static void add_rates(ps_convergence *out, const ps_low_end *low, double dimension) {
    out->smooth = 1 + low->exponent / dimension;
    out->smooth_error = low->exponent_error / dimension;
    out->jump = 1 + fmin(low->exponent, 1) / dimension;
    out->jump_error =
        low->exponent - SIGNIFICANT * low->exponent_error > 1 ? 0 : low->exponent_error / dimension;
    out->most_plateau = fmax(low->plateau, 0) + SIGNIFICANT * low->plateau_error;
}

unsigned ps_convergence_dimension(const ps_spectrum *spectrum) {
    return spectrum->frequencies.kind == PS_FREQUENCIES_DEGREES ? 2
                                                                : spectrum->frequencies.dimension;
}

ps_convergence ps_convergence_find(const ps_low_end *low, const ps_spectrum *spectrum) {
    const anisotropy found = find_anisotropy(low, spectrum);
    ps_convergence out = {.kind = find_kind(low, spectrum, found),
                          .smooth = NAN,
                          .smooth_error = NAN,
                          .jump = NAN,
                          .jump_error = NAN,
                          .most_plateau = NAN,
                          .anisotropy = found.excess};
    if (out.kind == PS_CONVERGENCE_WHITE) {
        out.smooth = 1;
        out.smooth_error = 0;
        out.jump = 1;
        out.jump_error = 0;
    } else if (out.kind == PS_CONVERGENCE_FAST || out.kind == PS_CONVERGENCE_SLOW) {
        add_rates(&out, low, ps_convergence_dimension(spectrum));
    }
    return out;
}
