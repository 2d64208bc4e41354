#include "plots/plot_script.h"

#include <math.h>

/* ---- numbers --------------------------------------------------------------------------------- */

double ps_spectra_top(const ps_series *curve, size_t bin) {
    return curve->y[bin] + (isfinite(curve->error[bin]) ? curve->error[bin] : 0);
}

double ps_spectra_error(const ps_series *curve, size_t bin) {
    return curve->error[bin];
}

double ps_spectra_anisotropy(const ps_series *curve, size_t bin) {
    return curve->anisotropy[bin];
}

double ps_spectra_level(const ps_series *curve, size_t bin) {
    (void)bin;
    return curve->num_realizations >= 2 ? -10 * log10(curve->num_realizations) : (double)NAN;
}

double ps_spectra_profile(const ps_series *curve, size_t bin) {
    return curve->low != NULL && curve->high != NULL ? curve->high[bin] : (double)NAN;
}

double ps_spectra_fit(const ps_series *curve, size_t bin) {
    return curve->fit != NULL ? curve->fit[bin] : (double)NAN;
}

static void widen_by(ps_plot_span *span, const ps_panel *curves, ps_take_number *take) {
    for (size_t i = 0; i < curves->num_series; i++) {
        for (size_t bin = 0; bin < curves->series[i].num; bin++) {
            ps_plot_span_widen(span, take(&curves->series[i], bin));
        }
    }
}

bool ps_spectra_has(const ps_panel *curves, ps_take_number *take) {
    ps_plot_span all = ps_plot_span_none();
    widen_by(&all, curves, take);
    return !ps_plot_span_is_empty(all);
}

/* ---- powers ---------------------------------------------------------------------------------- */

double ps_spectra_find_top(const ps_series *curve) {
    double top = 0;
    for (size_t bin = 0; bin < curve->num; bin++) {
        const double power = ps_spectra_top(curve, bin);
        top = isfinite(power) ? fmax(top, power) : top;
    }
    return top;
}

/* Loud is what is so many times as large as all others. White noise stays in sight. */
double ps_spectra_find_most(const ps_panel *curves) {
    const double loud = 5;
    const double least = 1.2;
    double most = least;
    bool is_wider = true;
    while (is_wider) { /* as long as another curve is not loud beside what is in sight */
        is_wider = false;
        for (size_t i = 0; i < curves->num_series; i++) {
            const double top = ps_spectra_find_top(&curves->series[i]);
            if (top > most && (top <= loud * most || curves->num_series == 1)) {
                most = top;
                is_wider = true;
            }
        }
    }
    return most;
}

/* The upper profile of a curve that is in sight is, too. */
static double with_profiles(const ps_panel *curves, double most) {
    ps_plot_span all = {0, most};
    for (size_t i = 0; i < curves->num_series; i++) {
        if (ps_spectra_find_top(&curves->series[i]) <= most) {
            widen_by(&all, &(ps_panel){NULL, 1, &curves->series[i]}, ps_spectra_profile);
        }
    }
    return all.most;
}

ps_plot_span ps_spectra_powers(const ps_figure *figure, const ps_panel *curves) {
    const double margin = figure->is_log_y ? 1.4 : 1.05;
    if (!figure->is_log_y) {
        return (ps_plot_span){0, margin * with_profiles(curves, ps_spectra_find_most(curves))};
    }
    ps_plot_span all = ps_plot_span_above(curves);
    ps_plot_span tops = ps_plot_span_none();
    widen_by(&tops, curves, ps_spectra_top);
    ps_plot_span_widen(&all, with_profiles(curves, tops.most));
    ps_plot_span_widen(&all, 1); /* white noise */
    return (ps_plot_span){all.least / margin, all.most * margin};
}

/* ---- the other axes -------------------------------------------------------------------------- */

ps_plot_span ps_spectra_frequencies(const ps_figure *figure, const ps_panel *curves) {
    const double margin = 1.1;
    const ps_plot_span places = ps_plot_span_places(curves);
    if (ps_plot_span_is_empty(places)) {
        return (ps_plot_span){figure->is_log_x ? 1 / margin : 0, margin};
    }
    return figure->is_log_x ? (ps_plot_span){places.least / margin, places.most * margin}
                            : (ps_plot_span){0, places.most};
}

/* Those of curves and of levels of noise. */
ps_plot_span ps_spectra_anisotropies(const ps_panel *curves) {
    const double margin = 0.05; /* of what there is */
    const double least_margin = 0.5;
    ps_plot_span all = ps_plot_span_none();
    widen_by(&all, curves, ps_spectra_anisotropy);
    widen_by(&all, curves, ps_spectra_level);
    const double around = fmax(margin * (all.most - all.least), least_margin);
    return (ps_plot_span){all.least - around, all.most + around};
}
