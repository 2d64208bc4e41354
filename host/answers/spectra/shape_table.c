#include "answers/spectra/shape_table.h"

#include "answers/spectra/spectrum_header.h"
#include "base/text.h"
#include "spectra/shape/shape.h"

#include <math.h>

static const char *const shape_columns[PS_SHAPE_COLUMNS] = {"lower", "upper", "fit"};

static void find_powers(double out[PS_SHAPE_COLUMNS], const ps_shape *shape,
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
        columns[num++] = shape_columns[i];
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
    find_powers(powers, shape, spectrum, bin);
    for (size_t i = 0; i < PS_SHAPE_COLUMNS; i++) {
        cells[num++] = ps_number_or_missing(powers[i]);
    }
    return num;
}

/* ---- the low end, in words ----------------------------------------------------------------- */

static const char *const shape_names[] = {[PS_LOW_POWER_LAW] = "power law",
                                          [PS_LOW_PLATEAU] = "plateau",
                                          [PS_LOW_UNDECIDED] = "undecided",
                                          [PS_LOW_NEITHER] = "neither"};

static void write_fit(ps_text *out, const ps_shape *shape) {
    const ps_low_end *const low = &shape->low;
    if (shape->low_reason.status != PSPEC_OK) {
        ps_text_append(out, "none: %s", shape->low_reason.message);
        return;
    }
    ps_text_append(out,
                   "%s: up to %.3g the exponent of a power law from 0 is %.4g with the standard "
                   "error %.2g, chi^2 %.3g of %zu degrees of freedom; a plateau at 0 would be %.4g "
                   "with the standard error %.2g, %.3g of them from 0, chi^2 %.3g",
                   shape_names[low->shape], low->reach, low->exponent, low->exponent_error,
                   low->law_chi2, low->degrees_of_freedom, low->plateau, low->plateau_error,
                   low->plateau / low->plateau_error, low->plateau_chi2);
}

/* ---- convergence, in words ----------------------------------------------------------------- */

/* What a sentence is made of. */
typedef struct finding {
    const ps_convergence *rates;
    const ps_low_end *low;
    const ps_spectrum *spectrum;
} finding;

static void write_unknown(ps_text *out, const finding *it) {
    ps_text_append(out,
                   "unknown: up to nu = %.3g power may rise from zero or not; more realizations "
                   "would say",
                   it->low->reach);
}

static void write_unfit(ps_text *out, const finding *it) {
    ps_text_append(out,
                   "unknown: up to nu = %.3g power is neither a law nor a plateau (chi^2 %.3g and "
                   "%.3g of %zu degrees of freedom)",
                   it->low->reach, it->low->law_chi2, it->low->plateau_chi2,
                   it->low->degrees_of_freedom);
}

static void write_faint(ps_text *out, const finding *it) {
    ps_text_append(out,
                   "unknown: a power at zero of %.2g is told by a fit alone, for that of the first "
                   "%s is %.2g; more points have some nearer to zero",
                   it->low->plateau, ps_shape_bin_name(it->spectrum), it->spectrum->bins[0].power);
}

static void write_mixed(ps_text *out, const finding *it) {
    ps_text_append(out,
                   "unknown: up to nu = %.3g power depends on the direction (s^2/P^2 of rings is "
                   "%.2g, without noise), and rings are means of what may behave in several ways",
                   it->low->reach, it->rates->anisotropy);
}

static void write_white(ps_text *out, const finding *it) {
    ps_text_append(out,
                   "converges as N^-1 for all integrands, in the end with %.4g (standard error "
                   "%.2g) of the variance of white noise, since that is the power at zero",
                   it->low->plateau, it->low->plateau_error);
}

/* "N^-1.5", or with an error. */
static void write_rate(ps_text *out, double rate, double rate_error) {
    ps_text_append(out, "N^-%.4g", rate);
    if (rate_error > 0) {
        ps_text_append(out, " (standard error %.2g)", rate_error);
    }
}

/* What the rates follow from. */
static void write_law(ps_text *out, const finding *it, const char *behaviour) {
    const ps_convergence *const rates = it->rates;
    ps_text_append(out, "converges as ");
    write_rate(out, rates->jump, rates->jump_error);
    ps_text_append(out, " for discontinuous integrands and ");
    write_rate(out, rates->smooth, rates->smooth_error);
    ps_text_append(out,
                   " for those of limited frequency, since power %s (b = %.4g, standard error "
                   "%.2g)",
                   behaviour, it->low->exponent, it->low->exponent_error);
}

/* And what they would not survive. */
static void write_fast(ps_text *out, const finding *it) {
    write_law(out, it, "rises as nu^b from zero");
    ps_text_append(out,
                   "; a power at zero of up to %.2g, with which it would be N^-1 in the end, is "
                   "not excluded",
                   it->rates->most_plateau);
}

static void write_slow(ps_text *out, const finding *it) {
    write_law(out, it, "falls as nu^b without end from zero");
}

static void (*const convergence_writers[])(ps_text *out, const finding *it) = {
    [PS_CONVERGENCE_UNKNOWN] = write_unknown, [PS_CONVERGENCE_UNFIT] = write_unfit,
    [PS_CONVERGENCE_FAINT] = write_faint,     [PS_CONVERGENCE_MIXED] = write_mixed,
    [PS_CONVERGENCE_WHITE] = write_white,     [PS_CONVERGENCE_FAST] = write_fast,
    [PS_CONVERGENCE_SLOW] = write_slow};

static void write_convergence(ps_text *out, const ps_convergence *found, const ps_shape *shape,
                              const ps_spectrum *spectrum) {
    const finding it = {found, &shape->low, spectrum};
    if (shape->low_reason.status != PSPEC_OK) {
        ps_text_append(out, "unknown: %s", shape->low_reason.message);
    } else {
        convergence_writers[found->kind](out, &it);
    }
}

/* ---- profiles and features, in words ------------------------------------------------------- */

static void write_bound(ps_text *out, const char *relation, const ps_bound *bound,
                        const ps_error *reason) {
    if (reason->status != PSPEC_OK) {
        ps_text_append(out, "none: %s", reason->message);
    } else if (bound->alpha > 0) {
        ps_text_append(out, "%s %.4g (nu/%.4g)^%.3g below nu = %.4g, %s %.4g above", relation,
                       bound->gamma, bound->alpha, bound->exponent, bound->alpha, relation,
                       bound->gamma);
    } else {
        ps_text_append(out, "%s %.4g", relation, bound->gamma);
    }
}

static void write_features(ps_text *out, const ps_features *features) {
    ps_text_append(out, "peak %.4g at %.4g", features->peak, features->peak_frequency);
    if (isnan(features->effective_nyquist)) {
        ps_text_append(out, ", effective Nyquist frequency beyond the cut-off");
    } else {
        ps_text_append(out, ", effective Nyquist frequency %.4g", features->effective_nyquist);
    }
    if (!isnan(features->anisotropy_db)) {
        ps_text_append(out, ", anisotropy %.3g dB", features->anisotropy_db);
    }
}

/* ---- the header --------------------------------------------------------------------------- */

/* The lines of entries, which may have texts of these sentences; frees them. */
static pspec_status add_entries(ps_table *table, const ps_meta *entries, size_t num,
                                ps_text *sentences, size_t num_sentences, ps_error *error) {
    pspec_status status = PSPEC_OK;
    for (size_t i = 0; status == PSPEC_OK && i < num_sentences; i++) {
        status = ps_text_check(&sentences[i], error);
    }
    if (status == PSPEC_OK) {
        status = ps_table_add_metas(table, entries, num, error);
    }
    for (size_t i = 0; i < num_sentences; i++) {
        ps_text_free(&sentences[i]);
    }
    return status;
}

static ps_cell number_if(const ps_error *reason, double number) {
    return reason->status == PSPEC_OK ? ps_number_or_missing(number) : PS_MISSING;
}

static pspec_status add_low_end(ps_table *table, const ps_shape *shape, ps_error *error) {
    const ps_low_end *const low = &shape->low;
    const ps_error *const reason = &shape->low_reason;
    ps_text fit = {0};
    write_fit(&fit, shape);
    const ps_meta entries[] = {
        {"fit", PS_TEXT(ps_text_string(&fit))},
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
    return add_entries(table, entries, sizeof entries / sizeof entries[0], &fit, 1, error);
}

static pspec_status add_convergence(ps_table *table, const ps_shape *shape,
                                    const ps_spectrum *spectrum, ps_error *error) {
    const ps_error *const reason = &shape->low_reason;
    const ps_convergence found = ps_convergence_find(&shape->low, spectrum);
    ps_text sentence = {0};
    write_convergence(&sentence, &found, shape, spectrum);
    const ps_meta entries[] = {
        {"convergence", PS_TEXT(ps_text_string(&sentence))},
        {"smooth_rate", number_if(reason, found.smooth)},
        {"smooth_rate_error", number_if(reason, found.smooth_error)},
        {"jump_rate", number_if(reason, found.jump)},
        {"jump_rate_error", number_if(reason, found.jump_error)},
    };
    return add_entries(table, entries, sizeof entries / sizeof entries[0], &sentence, 1, error);
}

pspec_status ps_shape_add_profiles(ps_table *table, const ps_shape *shape,
                                   const ps_spectrum *spectrum, ps_error *error) {
    const ps_bound_rates rates =
        ps_bound_find_rates(&shape->above, ps_convergence_dimension(spectrum));
    const ps_error *const above = &shape->above_reason;
    const ps_error *const below = &shape->below_reason;
    ps_text sentences[2] = {{0}}; /* upper, lower */
    write_bound(&sentences[0], "P <=", &shape->above, above);
    write_bound(&sentences[1], "P >=", &shape->below, below);
    const ps_meta entries[] = {
        {"upper_profile", PS_TEXT(ps_text_string(&sentences[0]))},
        {"upper_gamma", number_if(above, shape->above.gamma)},
        {"upper_alpha", number_if(above, shape->above.alpha)},
        {"upper_exponent", number_if(above, shape->above.exponent)},
        {"best_case_rate", number_if(above, rates.smooth)},
        {"worst_case_rate", number_if(above, rates.jump)},
        {"lower_profile", PS_TEXT(ps_text_string(&sentences[1]))},
        {"lower_gamma", number_if(below, shape->below.gamma)},
        {"lower_alpha", number_if(below, shape->below.alpha)},
        {"lower_exponent", number_if(below, shape->below.exponent)},
    };
    return add_entries(table, entries, sizeof entries / sizeof entries[0], sentences, 2, error);
}

static pspec_status add_features(ps_table *table, const ps_spectrum *spectrum, ps_error *error) {
    const ps_features found = ps_features_find(spectrum);
    ps_text sentence = {0};
    write_features(&sentence, &found);
    const ps_meta entries[] = {
        {"features", PS_TEXT(ps_text_string(&sentence))},
        {"peak", PS_NUMBER(found.peak)},
        {"peak_error", ps_number_or_missing(found.peak_error)},
        {"peak_frequency", PS_NUMBER(found.peak_frequency)},
        {"effective_nyquist", ps_number_or_missing(found.effective_nyquist)},
        {"mean_anisotropy_db", ps_number_or_missing(found.anisotropy_db)},
    };
    return add_entries(table, entries, sizeof entries / sizeof entries[0], &sentence, 1, error);
}

pspec_status ps_shape_add_header(ps_table *table, const ps_shape *shape,
                                 const ps_spectrum *spectrum, ps_error *error) {
    PS_TRY(add_low_end(table, shape, error));
    PS_TRY(add_convergence(table, shape, spectrum, error));
    PS_TRY(ps_shape_add_profiles(table, shape, spectrum, error));
    return add_features(table, spectrum, error);
}
