/* Pictures of a spectrum, drawn by gnuplot: PNG, SVG or PDF by the ending of the path.
 *
 * Panels: the averaged periodogram around DC as an image (2-D only), the radial mean with error
 * bars against normalized frequency, the anisotropy in dB below it; on the sphere the power of the degrees, and
 * below it once more with logarithmic axes.
 */
#ifndef PS_PLOTS_PLOT_H
#define PS_PLOTS_PLOT_H

#include "base/status.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* One radial curve. Arrays of length num_bins; standard_error and anisotropy_db may hold nan. */
typedef struct ps_plot_curve {
    const char *label;
    size_t num_bins;
    const double *normalized_frequency, *power, *standard_error, *anisotropy_db;
} ps_plot_curve;

/* The averaged periodogram on the whole square: [size][size], size odd, DC in the middle, row index
 * along x_1. NULL data: no image panel. */
typedef struct ps_plot_image {
    size_t size;
    const double *power;
    double unit; /* integer frequencies per unit of normalized frequency, N^(1/2) */
} ps_plot_image;

typedef struct ps_plot {
    const char *title;
    size_t num_curves;
    const ps_plot_curve *curves;
    const ps_plot_image *image; /* NULL: none */
    double noise_level_db;      /* level of pure noise in the anisotropy panel, nan: no line */
    bool on_sphere; /* normalized frequency is l / sqrt(N); anisotropy is not looked at */
} ps_plot;

/* Looks for the program that draws, as it is looked for to draw: an executable file gnuplot in a folder of PATH. *path is
 * its path; it is to be freed in either case. PSPEC_ERROR_IO with a sentence: there is none. */
pspec_status ps_plot_find_gnuplot(ps_text *path, ps_error *error) PS_MUST_CHECK;
/* Is the ending of path one that can be drawn (.png .svg .pdf)? */
bool ps_plot_is_supported(const char *path);
/* Draws into path, which appears when the picture is complete and on the disk. Fails with one
 * sentence when gnuplot is not installed. */
pspec_status ps_plot_write(const char *path, const ps_plot *plot, ps_error *error) PS_MUST_CHECK;
/* Appends the picture to a text. */
pspec_status ps_plot_draw_svg(ps_text *svg, const ps_plot *plot, ps_error *error) PS_MUST_CHECK;

/* ---- lines ---------------------------------------------------------------------------------- */

/* One line through num places; nan is a gap. */
typedef struct ps_plot_line {
    const char *label;
    size_t num;
    const double *x, *y;
} ps_plot_line;

/* Lines in one panel with whatever axes. */
typedef struct ps_line_plot {
    const char *title, *x_label, *y_label;
    bool is_log_x, is_log_y; /* what is not above 0 is a gap then */
    size_t num_lines;
    const ps_plot_line *lines;
} ps_line_plot;

pspec_status ps_line_plot_write(const char *path, const ps_line_plot *plot,
                                ps_error *error) PS_MUST_CHECK;
pspec_status ps_line_plot_draw_svg(ps_text *svg, const ps_line_plot *plot,
                                   ps_error *error) PS_MUST_CHECK;

/* ---- panels --------------------------------------------------------------------------------- */

/* Places of one kind in a panel. Kinds are numbered from 0; a kind has the same look and label in every panel. */
typedef struct ps_plot_series {
    const char *label;
    size_t kind;
    bool is_front; /* joined by a line, in grey, instead of marked */
    size_t num;
    const double *x, *y;
} ps_plot_series;

typedef struct ps_plot_panel {
    const char *title;
    size_t num_series;
    const ps_plot_series *series;
} ps_plot_panel;

/* Panels side by side, three in a row, with one key for all of them. */
typedef struct ps_panel_plot {
    const char *title, *x_label, *y_label;
    bool has_lines;                /* places are joined, and all panels have the same axes */
    bool is_linear_x, is_linear_y; /* not logarithmic */
    size_t num_panels;
    const ps_plot_panel *panels;
} ps_panel_plot;

pspec_status ps_panel_plot_write(const char *path, const ps_panel_plot *plot,
                                 ps_error *error) PS_MUST_CHECK;
pspec_status ps_panel_plot_draw_svg(ps_text *svg, const ps_panel_plot *plot,
                                    ps_error *error) PS_MUST_CHECK;

#endif
