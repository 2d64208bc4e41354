/* The gnuplot script of a picture, data included. Private to host/plots. */
#ifndef PS_PLOTS_PLOT_SCRIPT_H
#define PS_PLOTS_PLOT_SCRIPT_H

#include "plots/plot.h"

#include <stdio.h>

/* terminal: "pngcairo", "svg" or "pdfcairo". Errors of the stream are the caller's to check. */
pspec_status ps_plot_write_script(const ps_plot *plot, const char *terminal, FILE *stream,
                                  ps_error *error) PS_MUST_CHECK;

/* The same of lines. */
void ps_line_plot_write_script(const ps_line_plot *plot, const char *terminal, FILE *stream);

/* The same of panels. */
void ps_panel_plot_write_script(const ps_panel_plot *plot, const char *terminal, FILE *stream);

/* What all have: the page, with its title, in pixels; a text constant of gnuplot; a number or NaN; colour and dashes of line
 * number. */
void ps_plot_print_page(const char *title, const char *terminal, int width, int height,
                        FILE *stream);
enum { PS_PLOT_HEIGHT = 700 }; /* of one row of panels */
void ps_plot_print_text(const char *text, FILE *stream);
void ps_plot_print_value(double value, FILE *stream);
void ps_plot_print_style(size_t number, FILE *stream);

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
