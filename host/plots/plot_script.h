/* The gnuplot script of a figure, data included. Private to host/plots. */
#ifndef PS_PLOTS_PLOT_SCRIPT_H
#define PS_PLOTS_PLOT_SCRIPT_H

#include "plots/plot.h"

#include <stdio.h>

/* terminal: "pngcairo", "svg" or "pdfcairo". Errors of the stream are the caller's to check. */
pspec_status ps_script_print_figure(const ps_figure *figure, const char *terminal, FILE *stream,
                                    ps_error *error) PS_MUST_CHECK;

/* Appends the picture that gnuplot makes of a script, which is at its start, to a text. last: the
 * bytes that a whole picture ends in, but for empty lines. */
pspec_status ps_gnuplot_run(FILE *script, const char *last, ps_text *picture,
                            ps_error *error) PS_MUST_CHECK;

/* ---- what stands between the page and its end ------------------------------------------------ */

/* Spectra, frames, panels of lines or marks, points; the data are there. */
pspec_status ps_script_print_spectra(const ps_figure *figure, const char *terminal, FILE *stream,
                                     ps_error *error) PS_MUST_CHECK;
void ps_script_print_frames(const ps_figure *figure, FILE *stream);
void ps_script_print_panels(const ps_figure *figure, FILE *stream);
void ps_script_print_points(const ps_figure *figure, const char *terminal, FILE *stream);
/* Sizes of the page, in pixels. */
enum { PS_SCRIPT_WIDTH = 1000, PS_SCRIPT_HEIGHT = 700 };
void ps_script_size_spectra(const ps_figure *figure, int *width, int *height);
void ps_script_size_frames(const ps_figure *figure, int *width, int *height);
void ps_script_size_panels(const ps_figure *figure, int *width, int *height);
void ps_script_size_points(const ps_figure *figure, int *width, int *height);
/* Where the part of the page begins over which the title stands, in pixels: points beside spectra
 * have their own. */
int ps_script_title_left(const ps_figure *figure);
/* Diameter, in pixels, of the marks of a panel of points. */
double ps_script_mark_size(const ps_figure *figure, size_t panel);

/* ---- what all have --------------------------------------------------------------------------- */

/* A text constant of gnuplot, "" for NULL; a number or NaN; colour and dashes of series of a kind.
 */
void ps_script_print_text(const char *text, FILE *stream);
/* The same for enhanced text: the formula as it is, and behind it the label, whose characters mean
 * what they are. */
void ps_script_print_formula(const char *formula, const char *label, FILE *stream);
/* How much larger a formula is than a label, so that what is raised can be read in small pictures,
 * too. */
#define PS_SCRIPT_FORMULA_SIZE 1.35
void ps_script_print_value(double value, FILE *stream);
size_t ps_script_count_characters(const char *text);
/* The text, or without its middle, in `cut`, where it has more characters than `most`. */
enum { PS_SCRIPT_CUT_BYTES = 1024 };
const char *ps_script_cut(char cut[PS_SCRIPT_CUT_BYTES], const char *text, size_t most);
void ps_script_print_colour(size_t kind, FILE *stream);
void ps_script_print_style(size_t kind, FILE *stream);
/* The label of the axis "x" or "y"; numbers of a logarithmic one, or nothing. */
void ps_script_print_label(const char *axis, const char *label, const char *offset, FILE *stream);
void ps_script_print_scale(const char *axis, bool is_log, FILE *stream);
/* The range that was asked for, or nothing. */
void ps_script_print_asked(const ps_figure *figure, FILE *stream);
/* Where a panel is, without its numbers and labels: pixels from the upper left corner of a page. */
typedef struct ps_script_box {
    double left, top, right, bottom;
    double page_width, page_height;
} ps_script_box;

void ps_script_print_margins(const ps_script_box *where, FILE *stream);

/* ---- keys ------------------------------------------------------------------------------------ */

/* Entries in rows below each other, as many side by side as have room, where nothing else is. */
typedef struct ps_script_key {
    ps_script_box where; /* the rows end at its bottom, in its middle; its top is not looked at */
    size_t num;          /* of entries; 0: there is no key */
    double longest;      /* letters of the longest one */
    bool has_formula;
} ps_script_key;

/* Another entry; `where` has been set. */
void ps_script_key_add(ps_script_key *key, const char *formula, const char *label);
/* In pixels; 0 without entries. */
double ps_script_key_height(const ps_script_key *key);
/* For the next "plot", whose entries have a title of ps_script_print_entry: in one that would leave
 * the page the middle of the label is left out. */
void ps_script_print_key(const ps_script_key *key, FILE *stream);
void ps_script_print_entry(const ps_script_key *key, const char *formula, const char *label,
                           FILE *stream);

/* ---- points ---------------------------------------------------------------------------------- */

/* A panel of points, whose series are $NAME_0, .. */
typedef struct ps_script_points {
    const ps_panel *panel;
    const ps_point_frame *frame;
    ps_script_box where;
    const char *data;
    const char *terminal;
} ps_script_points;

/* Beside panels of other things, and before them: it takes the page's own title away. */
void ps_script_print_beside(const ps_script_points *what, FILE *stream);
/* Of a curve of a panel: PS_SCRIPT_LINE_WIDTH, larger where others that come later lie on it; and
 * what marks, and rings that are curves of a single place, are larger for the same reason. */
#define PS_SCRIPT_LINE_WIDTH 1.6
double ps_script_line_width(const ps_figure *figure, const ps_panel *panel, size_t index);
double ps_script_more_size(const ps_figure *figure, const ps_panel *panel, size_t index);

/* ---- what axes cover ------------------------------------------------------------------------- */

/* least above most: nothing. */
typedef struct ps_plot_span {
    double least, most;
} ps_plot_span;

/* That of nothing, and one that has this number, too; what is not finite changes nothing. */
ps_plot_span ps_plot_span_none(void);
void ps_plot_span_widen(ps_plot_span *span, double value);
bool ps_plot_span_is_empty(ps_plot_span span);
/* Where series are, on a logarithmic axis: places above 0. */
ps_plot_span ps_plot_span_places(const ps_panel *panel);
/* Numbers of series that are more than rounding: above the floor of their series. */
ps_plot_span ps_plot_span_above(const ps_panel *panel);
/* The least of these floors; 0 where nothing is above 0. */
double ps_plot_least_floor(const ps_panel *panel);
void ps_script_print_span(const char *axis, ps_plot_span shown, FILE *stream);
/* Six ticks at most: a step of 1, 2 or 5 times a power of ten. */
double ps_script_tick_step(ps_plot_span shown);
/* Where a logarithmic axis has more than two decades, ticks at powers of ten; else plain numbers,
 * at 1, 2 and 5 of each decade, or at even steps where these would be too few. */
void ps_script_print_log_ticks(const char *axis, ps_plot_span shown, FILE *stream);

/* Ticks and lines of panels. */
extern const char ps_script_ticks[];
/* Can this place of a series be shown with these axes? */
bool ps_script_is_shown(const ps_figure *figure, const ps_series *series, size_t place);
/* Any place of any series? gnuplot makes no axes for nothing. */
bool ps_script_has_places(const ps_figure *figure, const ps_panel *panel);
/* Does a line through these numbers of a series, NaN being gaps, miss one that stands alone? */
bool ps_script_has_lone(const ps_figure *figure, const ps_series *series, const double *numbers);

/* ---- spectra --------------------------------------------------------------------------------- */

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

/* The image, and the colours beside it. */
pspec_status ps_script_print_image(const ps_plot_image *image, const ps_script_box *where,
                                   FILE *stream, ps_error *error) PS_MUST_CHECK;

#endif
