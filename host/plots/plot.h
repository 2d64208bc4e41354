/* Figures: panels of series, drawn by gnuplot as PNG, SVG or PDF by the ending of the path. */
#ifndef PS_PLOTS_PLOT_H
#define PS_PLOTS_PLOT_H

#include "base/status.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* How a series looks. Those of spectra have bars of `error`, the band of their profiles and a fit;
 * the looks behind them are for painters, and for names in keys. */
typedef enum ps_look {
    PS_LOOK_LINE,  /* marks that a line joins */
    PS_LOOK_SMALL, /* the same, of small panels */
    PS_LOOK_CURVE, /* a line without marks, on the band from `low` to `high` if there is one */
    PS_LOOK_MARKS, /* marks that nothing joins, with bars of `error` up and down if there are any */
    PS_LOOK_SIGNS, /* larger ones: two kinds have a colour, and every kind a shape */
    PS_LOOK_BOUND, /* dots in the colour of the kind */
    PS_LOOK_CLOUD, /* small grey marks, of which there are many */
    PS_LOOK_REFERENCE, /* a thin grey line of dashes, to compare others with */
    PS_LOOK_FRONT,     /* a grey line that joins some of the marks */
    PS_LOOK_SPECTRUM,
    PS_LOOK_THIN, /* the same without bars, where there is less room */
    PS_LOOK_LEVEL,
    PS_LOOK_PROFILE,
    PS_LOOK_FIT
} ps_look;

/* Places of one thing in a panel; nan is a gap. Where axes are logarithmic what is not above 0 is a
 * gap, too. */
typedef struct ps_series {
    const char *formula; /* in gnuplot's enhanced text, "d_l^2", before the label; NULL: none.
                            Not "d@_l^2": SVG would have a 2 of full size on the l */
    const char *label;   /* NULL: none; in a frame, the key does not have it */
    /* From 0; series of a kind look the same, and have the same label, in every panel */
    size_t kind;
    size_t num, columns; /* of an image: pixels of a row */
    const double *x, *y;
    const double *error;      /* standard errors, of spectra and of marks; else NULL */
    const double *anisotropy; /* of spectra, in dB; else NULL */
    double num_realizations;  /* of spectra, that are averaged: 10 log10 of it is how far the
                                 anisotropy of pure noise is below 0 dB; below 2: nothing is said */
    /* Positive y from here down are rounding, to which no logarithmic axis is stretched, and which
     * have no slope */
    double floor;
    const double *low, *high; /* the band of a curve, lines about a spectrum; NULL: none */
    const double *fit;        /* of spectra, what goes through them; NULL: none */
    ps_look look;
} ps_series;

/* Where rounding begins: at the floor of the series, or at 1e-16 of the largest number beside which
 * it stands, as squares have it of numbers whose rounding is 1e-8 of the largest one at best. */
double ps_series_floor(const ps_series *series, double most);

/* Is anything of it drawn? No line goes through a single place among others. */
bool ps_series_is_drawn(const ps_series *series);

/* Appends the slope of a line whose axes are logarithmic to its label, "label: slope -0.5"; nothing
 * where it has none, as of a single place, or of two of which others are rounding. */
void ps_series_say_slope(const ps_series *series, ps_text *label);

/* What a panel shows. */
typedef enum ps_frame_form {
    PS_FRAME_AXES,   /* series against axes of their own */
    PS_FRAME_PLANE,  /* the same: 0 is in the middle, and both axes have the same unit */
    PS_FRAME_SQUARE, /* points: both axes from `first` to `last` */
    PS_FRAME_LINE,   /* the axis of x, points of one coordinate; y is not looked at */
    PS_FRAME_DISC,   /* the unit disc, a side of the sphere */
    /* An image: y of its only series, `columns` of a row from the top on; x is not looked at.
     * Colours go from `first` to `last`, and are signed where `first` is below 0. */
    PS_FRAME_PIXELS,
    /* The same of light, from black to white as bright as screens show it, without a scale. */
    PS_FRAME_LIGHT
} ps_frame_form;

typedef struct ps_frame {
    ps_frame_form form;
    double first, last;            /* of a square or a line, and of the colours of an image */
    const char *x_label, *y_label; /* names of the axes, at the ends of those of a disc; NULL: those
                                      of the figure */
    bool is_mirrored;              /* x runs to the left */
} ps_frame;

typedef struct ps_panel {
    const char *title; /* looked at where there may be several panels */
    size_t num_series;
    const ps_series *series;
    ps_frame frame;
} ps_panel;

/* The averaged periodogram on the whole square: [size][size], size odd, DC in the middle, row index
 * along x_1. */
typedef struct ps_plot_image {
    size_t size;
    const double *power;
    double unit;    /* integer frequencies per unit of normalized frequency, N^(1/2) */
    double maximum; /* power at the bright end of the scale; 0: as ps_plot_find_maximum finds it */
    bool in_decibels; /* 10 log10 of the power, which shows how small small powers are */
} ps_plot_image;

/* Where the scale of an image ends that has its own: so that a few peaks do not make the rest dark.
 * Images that are to be compared share the largest. */
pspec_status ps_plot_find_maximum(double *out, const ps_plot_image *image,
                                  ps_error *error) PS_MUST_CHECK;

/* What somebody asked of the axes of a spectrum or a frame; {0}: nothing. */
typedef struct ps_plot_axes {
    bool has_log, is_log_x, is_log_y;
    bool has_x, has_y; /* from .. to */
    double x[2], y[2];
} ps_plot_axes;

typedef enum ps_figure_form {
    /* One panel of powers with bars against normalized frequencies, their anisotropy below it, the
     * image beside it, the key of all below; on the sphere the powers once more with logarithmic
     * axes instead, unless these were asked for. It labels its axes itself, but for that of
     * powers. */
    PS_FIGURE_SPECTRA,
    /* Panels side by side, each with axes and a key of its own, which stands below it. One panel
     * has the page for itself. */
    PS_FIGURE_FRAME,
    /* Panels of lines, three in a row, and one key for all below them. */
    PS_FIGURE_PANELS,
    PS_FIGURE_POINTS /* panels of points, whose axes have the same unit */
} ps_figure_form;

typedef struct ps_figure {
    ps_figure_form form;
    const char *title, *x_label, *y_label;
    bool is_log_x, is_log_y; /* unless axes say more */
    ps_plot_axes axes;
    size_t num_panels;
    const ps_panel *panels;
    bool shares_axes; /* panels of lines show the same part of them */
    /* of spectra */
    const ps_plot_image *image; /* NULL: none */
    bool on_sphere;         /* normalized frequency is l / sqrt(N); anisotropy is not looked at */
    const ps_panel *points; /* beside the spectrum; NULL: none */
    size_t num_columns;     /* of panels of points, 1 to PS_MOST_POINT_COLUMNS */
} ps_figure;

enum { PS_MOST_POINT_COLUMNS = 4 };

/* Looks for the program that draws, as it is looked for to draw: an executable file gnuplot in a
 * folder of PATH. *path is its path; it is to be freed in either case. PSPEC_ERROR_IO with a
 * sentence: there is none. */
pspec_status ps_plot_find_gnuplot(ps_text *path, ps_error *error) PS_MUST_CHECK;
/* Is the ending of path one that can be drawn (.png .svg .pdf)? */
bool ps_plot_is_supported(const char *path);
/* Draws into path, which appears when the picture is complete and on the disk. Fails with one
 * sentence when gnuplot is not installed. */
pspec_status ps_figure_write(const char *path, const ps_figure *figure,
                             ps_error *error) PS_MUST_CHECK;
/* The same in two steps: the script by which gnuplot draws the figure as SVG, which is all that the
 * picture depends on, in an empty text, and the picture of it, which is appended. */
pspec_status ps_figure_write_script(ps_text *script, const ps_figure *figure,
                                    ps_error *error) PS_MUST_CHECK;
pspec_status ps_plot_draw_script(ps_text *svg, const ps_text *script,
                                 ps_error *error) PS_MUST_CHECK;

#endif
