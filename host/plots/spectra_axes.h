/* What the axes of spectra cover, with room for keys, which must not lie on curves. Private to
 * host/plots. */
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
bool ps_spectra_has(const ps_panel *curves, ps_take_number *take);

/* Lines of a key that stand below each other in a panel of this height, others beside them; and the
 * part of the height that a key of so many lines takes, 0 for none. */
size_t ps_spectra_key_rows(double height);
double ps_spectra_key_part(size_t num_lines, double height);

/* The largest power of a curve with its bar; and of all, but for curves that are louder than all
 * others, which would flatten these: peaks of lattices beside noise. */
double ps_spectra_find_top(const ps_series *curve);
double ps_spectra_find_most(const ps_panel *curves);

/* What axes show unless something else was asked for; key_part: of the height of the panel. */
ps_plot_span ps_spectra_powers(const ps_figure *figure, const ps_panel *curves, double key_part);
ps_plot_span ps_spectra_frequencies(const ps_figure *figure, const ps_panel *curves);
ps_plot_span ps_spectra_anisotropies(const ps_panel *curves, double key_part);

#endif
