/* The gnuplot script of a figure, data included. Private to host/plots. */
#ifndef PS_PLOTS_PLOT_SCRIPT_H
#define PS_PLOTS_PLOT_SCRIPT_H

#include "plots/plot.h"

#include <stdio.h>

/* terminal: "pngcairo", "svg" or "pdfcairo". Errors of the stream are the caller's to check. */
pspec_status ps_figure_write_script(const ps_figure *figure, const char *terminal, FILE *stream,
                                    ps_error *error) PS_MUST_CHECK;

/* ---- what stands between the page and its end ------------------------------------------------ */

/* Spectra, frames, panels of lines or marks, points; the data are there. */
pspec_status ps_script_print_spectra(const ps_figure *figure, FILE *stream,
                                     ps_error *error) PS_MUST_CHECK;
void ps_script_print_frames(const ps_figure *figure, FILE *stream);
void ps_script_print_panels(const ps_figure *figure, FILE *stream);
void ps_script_print_points(const ps_figure *figure, const char *terminal, FILE *stream);
/* Sizes of the page, in pixels. */
enum { PS_SCRIPT_WIDTH = 1000, PS_SCRIPT_HEIGHT = 700 };
void ps_script_size_frames(const ps_figure *figure, int *width, int *height);
void ps_script_size_panels(const ps_figure *figure, int *width, int *height);
void ps_script_size_points(const ps_figure *figure, int *width, int *height);
/* Diameter, in pixels, of the marks of a panel of points. */
double ps_script_mark_size(const ps_figure *figure, size_t panel);

/* ---- what all have --------------------------------------------------------------------------- */

/* A text constant of gnuplot, "" for NULL; a number or NaN; colour and dashes of series of a kind.
 */
void ps_script_print_text(const char *text, FILE *stream);
/* The same for enhanced text: the formula as it is, and behind it the label, whose characters mean
 * what they are. */
void ps_script_print_formula(const char *formula, const char *label, FILE *stream);
void ps_script_print_value(double value, FILE *stream);
void ps_script_print_colour(size_t kind, FILE *stream);
void ps_script_print_style(size_t kind, FILE *stream);
/* The label of the axis "x" or "y"; numbers of a logarithmic one, or nothing. */
void ps_script_print_label(const char *axis, const char *label, const char *offset, FILE *stream);
void ps_script_print_scale(const char *axis, bool is_log, FILE *stream);
/* The range that was asked for, or nothing. */
void ps_script_print_asked(const ps_figure *figure, FILE *stream);
/* Ticks and lines of panels. */
extern const char ps_script_ticks[];
/* Can this place of a series be shown with these axes? */
bool ps_script_is_shown(const ps_figure *figure, const ps_series *series, size_t place);

/* The image panel's values, ready to draw: blocks averaged until they fit the panel, DC left out,
 * transposed so that x_1 runs to the right. */
typedef struct ps_plot_raster {
    size_t size;    /* pixels per side, odd */
    double pixel;   /* width of a pixel in normalised frequency */
    double maximum; /* power at the bright end of the scale */
    double *power;  /* [size][size], second index along x_1 */
} ps_plot_raster;

pspec_status ps_plot_raster_make(ps_plot_raster *out, const ps_plot_image *image,
                                 ps_error *error) PS_MUST_CHECK;

#endif
