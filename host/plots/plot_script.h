/* The gnuplot script of a figure: a page of panels, each with its place, axes and key, and what is
 * printed of them. Private to host/plots. */
#ifndef PS_PLOTS_PLOT_SCRIPT_H
#define PS_PLOTS_PLOT_SCRIPT_H

#include "base/memory.h"
#include "plots/plot.h"

/* Appends the script, data included. terminal: "pngcairo", "svg" or "pdfcairo". */
pspec_status ps_script_print_figure(ps_text *out, const ps_figure *figure, const char *terminal,
                                    ps_error *error) PS_MUST_CHECK;

/* Appends the picture that gnuplot makes of a script. last: the bytes that a whole picture ends in,
 * but for empty lines. */
pspec_status ps_gnuplot_run(const ps_text *script, const char *last, ps_text *picture,
                            ps_error *error) PS_MUST_CHECK;

/* ---- pages ----------------------------------------------------------------------------------- */

/* Where a panel is, without its numbers and labels: pixels from the upper left corner of a page. */
typedef struct ps_script_box {
    double left, top, right, bottom;
    double page_width, page_height;
} ps_script_box;

/* What an axis covers. least above most: nothing; NAN: an end that gnuplot chooses. */
typedef struct ps_plot_span {
    double least, most;
} ps_plot_span;

typedef struct ps_script_axis {
    const char *label, *offset; /* of the label, from where gnuplot has it; NULL: there is none */
    const char *format;         /* of its numbers, "" for none; NULL: gnuplot's */
    bool is_log;
    ps_plot_span shown;
    double step; /* of its ticks; 0: gnuplot's */
} ps_script_axis;

/* Entries in rows below each other, as many side by side as have room, where nothing else is. */
typedef struct ps_script_key {
    ps_script_box where; /* the rows end at its bottom, in its middle; its top is not looked at */
    size_t num;          /* of entries; 0: there is no key */
    double longest;      /* letters of the longest one */
    bool has_formula;
} ps_script_key;

/* The values of an image, ready to draw. */
typedef struct ps_script_raster {
    size_t size;    /* pixels per side, odd */
    double pixel;   /* width of a pixel in normalised frequency */
    double maximum; /* power at the bright end of the scale */
    double *power;  /* [size][size], second index along x_1 */
    bool in_decibels;
} ps_script_raster;

/* A panel in its place. Series without places are entries of its key alone. */
typedef struct ps_script_panel {
    ps_script_box where;
    ps_panel panel; /* its title: NULL: none */
    ps_script_axis x, y;
    ps_script_key key;
    double bottom;           /* end of a logarithmic axis, for bands and bars; 0: there is none */
    bool has_white;          /* a line at white noise, where it is in sight */
    bool is_key;             /* nothing is seen but its key */
    ps_script_raster raster; /* size 0: there is none */
} ps_script_panel;

typedef struct ps_script_page {
    const char *terminal;
    int width, height;
    int title_left; /* where the part begins over which the title stands: points have their own */
    size_t num_panels;
    ps_script_panel *panels;
} ps_script_page;

/* Sizes of a page with one panel, in pixels. */
enum { PS_SCRIPT_WIDTH = 1000, PS_SCRIPT_HEIGHT = 700 };

/* The pages of figures. What they have is of the pool, of the figure, or a constant. */
typedef pspec_status ps_script_place(ps_script_page *out, ps_pool *memory, const ps_figure *figure,
                                     ps_error *error);
ps_script_place ps_script_place_spectra, ps_script_place_panels, ps_script_place_points;

/* ---- texts and numbers ----------------------------------------------------------------------- */

/* A text constant of gnuplot, "" for NULL; a number or NaN. */
void ps_script_print_text(ps_text *out, const char *text);
/* The same for enhanced text: the formula as it is, and behind it the label, whose characters mean
 * what they are. */
void ps_script_print_formula(ps_text *out, const char *formula, const char *label);
/* How much larger a formula is than a label, so that what is raised can be read in small pictures,
 * too. */
#define PS_SCRIPT_FORMULA_SIZE 1.35
void ps_script_print_value(ps_text *out, double value);
size_t ps_script_count_characters(const char *text);
/* The text, or without its middle, in `cut`, where it has more characters than `most`. */
enum { PS_SCRIPT_CUT_BYTES = 1024 };
const char *ps_script_cut(char cut[PS_SCRIPT_CUT_BYTES], const char *text, size_t most);

/* ---- keys ------------------------------------------------------------------------------------ */

/* Of all series of the panel that have a name; `where` may still change. */
ps_script_key ps_script_key_of(const ps_panel *panel, ps_script_box where);
/* In pixels; 0 without entries. */
double ps_script_key_height(const ps_script_key *key);
/* For the next "plot", whose entries have a title of ps_script_print_entry: in one that would leave
 * the page the middle of the label is left out. */
void ps_script_print_key(ps_text *out, const ps_script_key *key);
/* Of a series, or that it has none. */
void ps_script_print_entry(ps_text *out, const ps_script_key *key, const ps_series *series);

/* ---- series ---------------------------------------------------------------------------------- */

/* Grey, not a colour of a kind. */
#define PS_SCRIPT_GREY SIZE_MAX

/* Can this place of a series be shown with these axes? */
bool ps_script_is_shown(const ps_script_panel *panel, const ps_series *series, size_t place);
/* Any place of any series? gnuplot makes no axes for nothing. */
bool ps_script_has_places(const ps_script_panel *panel);
/* What "plot" is followed by, for data $data<number>_0, .. */
void ps_script_print_series(ps_text *out, const ps_script_panel *panel, size_t number);
/* Of a curve of a panel: 1.6, larger where others that come later lie on it. */
double ps_script_line_width(const ps_script_panel *panel, size_t index);

/* ---- points ---------------------------------------------------------------------------------- */

/* The square, line or disc, and "plot" with the points in it. */
void ps_script_print_points(ps_text *out, const ps_script_page *page, size_t number);
/* Diameter of their marks, in pixels, as is that side of the panel. */
double ps_script_mark_size(const ps_panel *panel, double side);
/* Height of a panel that is a line. */
enum { PS_SCRIPT_LINE_HEIGHT = 60 };

/* ---- images ---------------------------------------------------------------------------------- */

pspec_status ps_script_make_raster(ps_script_raster *out, ps_pool *memory,
                                   const ps_plot_image *image, ps_error *error) PS_MUST_CHECK;
/* The image, and the colours beside it. */
void ps_script_print_image(ps_text *out, const ps_script_panel *panel);
/* The numbers of an image: means of blocks of pixels; of light how bright they are, from 0 to 255.
 */
void ps_script_print_pixel_data(ps_text *out, const ps_panel *panel);
/* The image, and but for light the colours below it. */
void ps_script_print_pixels(ps_text *out, const ps_script_panel *panel, size_t number);

/* ---- what axes cover ------------------------------------------------------------------------- */

/* That of nothing, and one that has this number, too; what is not finite changes nothing. */
ps_plot_span ps_plot_span_none(void);
void ps_plot_span_widen(ps_plot_span *span, double value);
bool ps_plot_span_is_empty(ps_plot_span span);
/* What was asked for, or else its own. */
ps_plot_span ps_plot_span_asked(ps_plot_span own, bool is_asked, const double asked[2]);
/* Where series are, on a logarithmic axis: places above 0. */
ps_plot_span ps_plot_span_places(const ps_panel *panel);
/* Numbers of series that are more than rounding: above the floor of their series. */
ps_plot_span ps_plot_span_above(const ps_panel *panel);
/* The least of these floors; 0 where nothing is above 0. */
double ps_plot_least_floor(const ps_panel *panel);
/* Six ticks at most: a step of 1, 2 or 5 times a power of ten. */
double ps_plot_tick_step(ps_plot_span shown);
/* Scale, numbers, range and label of the axis "x" or "y". */
void ps_script_print_axis(ps_text *out, const char *name, const ps_script_axis *axis);

#endif
