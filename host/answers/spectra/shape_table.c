#include "answers/spectra/shape_table.h"

#include "answers/spectra/spectrum_header.h"
#include "spectra/shape/convergence.h"
#include "spectra/shape/features.h"

#include <math.h>
#include <stdio.h>

enum { SENTENCE_BYTES = 640 };

const char *const ps_shape_columns[PS_SHAPE_COLUMNS] = {"lower", "upper", "fit"};

void ps_shape_powers(double out[PS_SHAPE_COLUMNS], const ps_shape *shape,
                     const ps_spectrum *spectrum, const ps_spectrum_bin *bin) {
    const double nu = bin->normalized_frequency;
    const bool is_fitted = shape->low_reason.status == PSPEC_OK && nu <= shape->low.reach;
    out[0] = shape->below_reason.status == PSPEC_OK ? ps_bound_power(&shape->below, nu) : NAN;
    out[1] = shape->above_reason.status == PSPEC_OK ? ps_bound_power(&shape->above, nu) : NAN;
    out[2] = is_fitted ? ps_low_end_power(&shape->low, spectrum, bin) : NAN;
}

/* ---- rows --------------------------------------------------------------------------------- */

size_t ps_shape_add_columns(const char **columns, size_t num, const ps_request *request) {
    for (size_t i = 0; request->wants_fit && i < PS_SHAPE_COLUMNS; i++) {
        columns[num++] = ps_shape_columns[i];
    }
    return num;
}

size_t ps_shape_add_cells(ps_cell *cells, size_t num, const ps_request *request,
                          const ps_shape *shape, const ps_spectrum *spectrum,
                          const ps_spectrum_bin *bin) {
    double powers[PS_SHAPE_COLUMNS];
    if (!request->wants_fit) {
        return num;
    }
    ps_shape_powers(powers, shape, spectrum, bin);
    for (size_t i = 0; i < PS_SHAPE_COLUMNS; i++) {
        cells[num++] = ps_number_or_missing(powers[i]);
    }
    return num;
}

/* ---- sentences ---------------------------------------------------------------------------- */

static const char *const shape_names[] = {[PS_LOW_POWER_LAW] = "power law",
                                          [PS_LOW_PLATEAU] = "plateau",
                                          [PS_LOW_UNDECIDED] = "undecided",
                                          [PS_LOW_NEITHER] = "neither"};

static void write_fit(char out[SENTENCE_BYTES], const ps_shape *shape) {
    const ps_low_end *const low = &shape->low;
    static const char both[] =
        "%s: up to %.3g the exponent of a power law from 0 is %.4g with the standard error %.2g, "
        "chi^2 %.3g of %zu degrees of freedom; a plateau at 0 would be %.4g with the standard "
        "error %.2g, %.3g of them from 0, chi^2 %.3g";
    if (shape->low_reason.status != PSPEC_OK) {
        snprintf(out, SENTENCE_BYTES, "none: %.500s", shape->low_reason.message);
        return;
    }
    snprintf(out, SENTENCE_BYTES, both, shape_names[low->shape], low->reach, low->exponent,
             low->exponent_error, low->law_chi2, low->degrees_of_freedom, low->plateau,
             low->plateau_error, low->plateau / low->plateau_error, low->plateau_chi2);
}

/* "N^-1.5", or with an error. */
static int write_rate(char *out, size_t room, double rate, double rate_error) {
    return rate_error > 0 ? snprintf(out, room, "N^-%.4g (standard error %.2g)", rate, rate_error)
                          : snprintf(out, room, "N^-%.4g", rate);
}

/* A law: what the rates follow from, and what they would not survive. */
static void write_law(char out[SENTENCE_BYTES], const ps_convergence *found,
                      const ps_low_end *low) {
    const bool is_fast = found->kind == PS_CONVERGENCE_FAST;
    int length = snprintf(out, SENTENCE_BYTES, "converges as ");
    length +=
        write_rate(out + length, SENTENCE_BYTES - (size_t)length, found->jump, found->jump_error);
    length += snprintf(out + length, SENTENCE_BYTES - (size_t)length,
                       " for discontinuous integrands and ");
    length += write_rate(out + length, SENTENCE_BYTES - (size_t)length, found->smooth,
                         found->smooth_error);
    length += snprintf(out + length, SENTENCE_BYTES - (size_t)length,
                       " for those of limited frequency, since power %s as nu^b %s (b = %.4g, "
                       "standard error %.2g)",
                       is_fast ? "rises" : "falls", is_fast ? "from zero" : "without end from zero",
                       low->exponent, low->exponent_error);
    if (is_fast) {
        snprintf(out + length, SENTENCE_BYTES - (size_t)length,
                 "; a power at zero of up to %.2g, with which it would be N^-1 in the end, is not "
                 "excluded",
                 found->most_plateau);
    }
}

static void write_convergence(char out[SENTENCE_BYTES], const ps_convergence *found,
                              const ps_shape *shape, const ps_spectrum *spectrum) {
    const ps_low_end *const low = &shape->low;
    if (shape->low_reason.status != PSPEC_OK) {
        snprintf(out, SENTENCE_BYTES, "unknown: %.500s", shape->low_reason.message);
    } else if (found->kind == PS_CONVERGENCE_UNKNOWN) {
        snprintf(out, SENTENCE_BYTES,
                 "unknown: up to nu = %.3g power may rise from zero or not; more realizations "
                 "would say",
                 low->reach);
    } else if (found->kind == PS_CONVERGENCE_UNFIT) {
        snprintf(out, SENTENCE_BYTES,
                 "unknown: up to nu = %.3g power is neither a law nor a plateau (chi^2 %.3g and "
                 "%.3g of %zu degrees of freedom)",
                 low->reach, low->law_chi2, low->plateau_chi2, low->degrees_of_freedom);
    } else if (found->kind == PS_CONVERGENCE_FAINT) {
        snprintf(
            out, SENTENCE_BYTES,
            "unknown: a power at zero of %.2g is told by a fit alone, for that of the first %s "
            "is %.2g; more points have some nearer to zero",
            low->plateau, ps_shape_bin_name(spectrum), spectrum->bins[0].power);
    } else if (found->kind == PS_CONVERGENCE_MIXED) {
        snprintf(out, SENTENCE_BYTES,
                 "unknown: up to nu = %.3g power depends on the direction (s^2/P^2 of rings is "
                 "%.2g, without noise), and rings are means of what may behave in several ways",
                 low->reach, found->anisotropy);
    } else if (found->kind == PS_CONVERGENCE_WHITE) {
        snprintf(out, SENTENCE_BYTES,
                 "converges as N^-1 for all integrands, in the end with %.4g (standard error "
                 "%.2g) of the variance of white noise, since that is the power at zero",
                 low->plateau, low->plateau_error);
    } else {
        write_law(out, found, low);
    }
}

static void write_bound(char out[SENTENCE_BYTES], const char *relation, const ps_bound *bound,
                        const ps_error *reason) {
    if (reason->status != PSPEC_OK) {
        snprintf(out, SENTENCE_BYTES, "none: %.500s", reason->message);
    } else if (bound->alpha > 0) {
        snprintf(out, SENTENCE_BYTES, "%s %.4g (nu/%.4g)^%.3g below nu = %.4g, %s %.4g above",
                 relation, bound->gamma, bound->alpha, bound->exponent, bound->alpha, relation,
                 bound->gamma);
    } else {
        snprintf(out, SENTENCE_BYTES, "%s %.4g", relation, bound->gamma);
    }
}

static void write_features(char out[SENTENCE_BYTES], const ps_features *features) {
    int length = snprintf(out, SENTENCE_BYTES, "peak %.4g at %.4g", features->peak,
                          features->peak_frequency);
    length += isnan(features->effective_nyquist)
                  ? snprintf(out + length, SENTENCE_BYTES - (size_t)length,
                             ", effective Nyquist frequency beyond the cut-off")
                  : snprintf(out + length, SENTENCE_BYTES - (size_t)length,
                             ", effective Nyquist frequency %.4g", features->effective_nyquist);
    if (!isnan(features->anisotropy_db)) {
        snprintf(out + length, SENTENCE_BYTES - (size_t)length, ", anisotropy %.3g dB",
                 features->anisotropy_db);
    }
}

/* ---- the header --------------------------------------------------------------------------- */

static ps_cell number_if(const ps_error *reason, double number) {
    return reason->status == PSPEC_OK ? ps_number_or_missing(number) : PS_MISSING;
}

static pspec_status add_low_end(ps_table *table, const ps_shape *shape, ps_error *error) {
    const ps_low_end *const low = &shape->low;
    const ps_error *const reason = &shape->low_reason;
    char fit[SENTENCE_BYTES];
    write_fit(fit, shape);
    const ps_meta entries[] = {
        {"fit", PS_TEXT(fit)},
        {"fit_shape", PS_TEXT(reason->status == PSPEC_OK ? shape_names[low->shape] : "none")},
        {"fit_reach", number_if(reason, low->reach)},
        {"exponent", number_if(reason, low->exponent)},
        {"exponent_error", number_if(reason, low->exponent_error)},
        {"exponent_chi2", number_if(reason, low->law_chi2)},
        {"plateau", number_if(reason, low->plateau)},
        {"plateau_error", number_if(reason, low->plateau_error)},
        {"plateau_score", number_if(reason, low->plateau / low->plateau_error)},
        {"plateau_chi2", number_if(reason, low->plateau_chi2)},
        {"degrees_of_freedom", number_if(reason, (double)low->degrees_of_freedom)},
    };
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

static pspec_status add_convergence(ps_table *table, const ps_shape *shape,
                                    const ps_spectrum *spectrum, ps_error *error) {
    const ps_error *const reason = &shape->low_reason;
    const ps_convergence found = ps_convergence_find(&shape->low, spectrum);
    char sentence[SENTENCE_BYTES];
    write_convergence(sentence, &found, shape, spectrum);
    const ps_meta entries[] = {
        {"convergence", PS_TEXT(sentence)},
        {"smooth_rate", number_if(reason, found.smooth)},
        {"smooth_rate_error", number_if(reason, found.smooth_error)},
        {"jump_rate", number_if(reason, found.jump)},
        {"jump_rate_error", number_if(reason, found.jump_error)},
    };
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

pspec_status ps_shape_add_profiles(ps_table *table, const ps_shape *shape,
                                   const ps_spectrum *spectrum, ps_error *error) {
    const ps_bound_rates rates =
        ps_bound_find_rates(&shape->above, ps_convergence_dimension(spectrum));
    const ps_error *const above = &shape->above_reason;
    const ps_error *const below = &shape->below_reason;
    char upper[SENTENCE_BYTES];
    char lower[SENTENCE_BYTES];
    write_bound(upper, "P <=", &shape->above, above);
    write_bound(lower, "P >=", &shape->below, below);
    const ps_meta entries[] = {
        {"upper_profile", PS_TEXT(upper)},
        {"upper_gamma", number_if(above, shape->above.gamma)},
        {"upper_alpha", number_if(above, shape->above.alpha)},
        {"upper_exponent", number_if(above, shape->above.exponent)},
        {"best_case_rate", number_if(above, rates.smooth)},
        {"worst_case_rate", number_if(above, rates.jump)},
        {"lower_profile", PS_TEXT(lower)},
        {"lower_gamma", number_if(below, shape->below.gamma)},
        {"lower_alpha", number_if(below, shape->below.alpha)},
        {"lower_exponent", number_if(below, shape->below.exponent)},
    };
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

static pspec_status add_features(ps_table *table, const ps_spectrum *spectrum, ps_error *error) {
    const ps_features found = ps_features_find(spectrum);
    char sentence[SENTENCE_BYTES];
    write_features(sentence, &found);
    const ps_meta entries[] = {
        {"features", PS_TEXT(sentence)},
        {"peak", PS_NUMBER(found.peak)},
        {"peak_error", ps_number_or_missing(found.peak_error)},
        {"peak_frequency", PS_NUMBER(found.peak_frequency)},
        {"effective_nyquist", ps_number_or_missing(found.effective_nyquist)},
        {"mean_anisotropy_db", ps_number_or_missing(found.anisotropy_db)},
    };
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

pspec_status ps_shape_add_header(ps_table *table, const ps_shape *shape,
                                 const ps_spectrum *spectrum, ps_error *error) {
    PS_TRY(add_low_end(table, shape, error));
    PS_TRY(add_convergence(table, shape, spectrum, error));
    PS_TRY(ps_shape_add_profiles(table, shape, spectrum, error));
    return add_features(table, spectrum, error);
}
