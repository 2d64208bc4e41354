/* What the axes of spectra cover. Private to host/plots. */
#ifndef PS_PLOTS_SPECTRA_AXES_H
#define PS_PLOTS_SPECTRA_AXES_H

#include "plots/plot_script.h"

/* A number of a curve at one of its places. */
typedef double ps_take_number(const ps_series *curve, size_t bin);

/* The power with its bar. */
double ps_spectra_top(const ps_series *curve, size_t bin);
double ps_spectra_error(const ps_series *curve, size_t bin);
double ps_spectra_anisotropy(const ps_series *curve, size_t bin);
/* In dB, of pure noise beside which the anisotropy of the curve stands; nan: there is none. */
double ps_spectra_level(const ps_series *curve, size_t bin);
/* The upper profile, and what goes through powers; nan: there is none. */
double ps_spectra_profile(const ps_series *curve, size_t bin);
double ps_spectra_fit(const ps_series *curve, size_t bin);
bool ps_spectra_has(const ps_panel *curves, ps_take_number *take);

/* The largest power of a curve with its bar; and of all, but for curves that are louder than all
 * others, which would flatten these: peaks of lattices beside noise. */
double ps_spectra_find_top(const ps_series *curve);
double ps_spectra_find_most(const ps_panel *curves);

/* What axes show unless something else was asked for. */
ps_plot_span ps_spectra_powers(const ps_figure *figure, const ps_panel *curves);
ps_plot_span ps_spectra_frequencies(const ps_figure *figure, const ps_panel *curves);
ps_plot_span ps_spectra_anisotropies(const ps_panel *curves);

#endif
