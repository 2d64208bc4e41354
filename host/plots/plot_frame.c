/* The gnuplot script of frames: panels side by side, each with its key below it. */
#include "plots/plot_script.h"

#include <math.h>

/* In pixels. A panel among others is smaller than one alone, and the page has a line for the
 * title. */
enum {
    MOST_COLUMNS = 3,
    WIDTH = 720,
    HEIGHT = 640,
    HEAD = 40,
    LEFT = 104, /* numbers down to 10^-14, and the label */
    RIGHT = 15,
    ABOVE = 56,
    ABOVE_AMONG_OTHERS = 30,
    BELOW = 84 /* numbers and label of the axis, and what is between it and the key */
};

/* ---- where things are ------------------------------------------------------------------------ */

/* Four are two rows of two. */
static size_t num_columns(const ps_figure *figure) {
    return figure->num_panels == 4             ? 2
           : figure->num_panels < MOST_COLUMNS ? figure->num_panels
                                               : MOST_COLUMNS;
}

void ps_script_size_frames(const ps_figure *figure, int *width, int *height) {
    const size_t columns = num_columns(figure);
    if (figure->num_panels > 1) {
        *width = (int)columns * WIDTH;
        *height = HEAD + HEIGHT * (int)((figure->num_panels + columns - 1) / columns);
    }
}

/* The frame of a panel, above a key of that height. */
static ps_script_box find_frame(const ps_figure *figure, size_t index, double key_height) {
    int width = PS_SCRIPT_WIDTH;
    int height = PS_SCRIPT_HEIGHT;
    const size_t columns = num_columns(figure);
    const bool is_alone = figure->num_panels <= 1;
    ps_script_size_frames(figure, &width, &height);
    const double x = is_alone ? 0 : (double)(index % columns) * WIDTH;
    const double y = is_alone ? 0 : HEAD + (double)(index / columns) * HEIGHT;
    return (ps_script_box){x + LEFT,
                           y + (is_alone ? ABOVE : ABOVE_AMONG_OTHERS),
                           x + (is_alone ? width : WIDTH) - RIGHT,
                           y + (is_alone ? height : HEIGHT) - BELOW - key_height,
                           width,
                           height};
}

/* ---- ranges ---------------------------------------------------------------------------------- */

/* Where a logarithmic axis ends at the latest; 0 where nothing is above the floors of the numbers.
 * Bands may go down to nothing; an axis that has them shows nothing else. */
static double find_bottom(const ps_panel *panel) {
    const double below = 1e-2; /* of the least number: so much of bands is worth seeing */
    const double least = ps_plot_span_above(panel).least;
    return isfinite(least) ? fmax(least * below, ps_plot_least_floor(panel)) : 0;
}

/* Does a number, or the band around it, go further down? */
static bool goes_below(const ps_panel *panel, double bottom) {
    for (size_t i = 0; i < panel->num_series; i++) {
        const ps_series *const series = &panel->series[i];
        for (size_t k = 0; k < series->num; k++) {
            const bool has_low = series->low != NULL && series->low[k] < bottom;
            if (has_low || (series->y[k] > 0 && series->y[k] < bottom)) {
                return true;
            }
        }
    }
    return false;
}

static ps_panel_axes axes_of(const ps_figure *figure, size_t index) {
    return figure->panel_axes != NULL ? figure->panel_axes[index] : (ps_panel_axes){0};
}

/* The largest number of either axis, in a frame of that shape. */
static void print_plane_range(const ps_panel *panel, double width, double height, FILE *stream) {
    const double margin = 1.05;
    double reach = 0;
    for (size_t i = 0; i < panel->num_series; i++) {
        for (size_t k = 0; k < panel->series[i].num; k++) {
            reach = fmax(reach, fabs(panel->series[i].x[k]) * height / width);
            reach = fmax(reach, fabs(panel->series[i].y[k]));
        }
    }
    if (reach > 0) {
        const double y = reach * margin;
        const double x = y * width / height;
        fprintf(stream, "set xrange [%.9g:%.9g]\nset yrange [%.9g:%.9g]\n", -x, x, -y, y);
    }
}

/* gnuplot would go on to whole powers of ten, where few points are, and has no ticks between them.
 */
static void print_log_range(const ps_figure *figure, const ps_panel *panel, FILE *stream) {
    const double margin = 1.15;
    const double *const asked = figure->axes.x;
    const ps_plot_span places = ps_plot_span_places(panel);
    if (figure->axes.has_x) {
        ps_script_print_log_ticks("x", (ps_plot_span){asked[0], asked[1]}, stream);
    } else if (!ps_plot_span_is_empty(places)) {
        const ps_plot_span shown = {places.least / margin, places.most * margin};
        ps_script_print_log_ticks("x", shown, stream);
        ps_script_print_span("x", shown, stream);
    }
}

/* ---- the key --------------------------------------------------------------------------------- */

static bool is_named(const ps_series *series) {
    return series->label != NULL || series->formula != NULL;
}

/* A single series needs none. */
static ps_script_key make_key(const ps_figure *figure, size_t index) {
    const ps_panel *const panel = &figure->panels[index];
    ps_script_key key = {.where = find_frame(figure, index, 0)};
    key.where.bottom += BELOW;
    for (size_t i = 0; panel->num_series > 1 && i < panel->num_series; i++) {
        const ps_series *const series = &panel->series[i];
        if (is_named(series)) {
            ps_script_key_add(&key, series->formula, series->label);
        }
    }
    return key;
}

/* ---- series ---------------------------------------------------------------------------------- */

/* A column that is no smaller than the end of a logarithmic axis; bottom 0: of a linear one. */
static void print_raised(const char *column, double bottom, FILE *stream) {
    if (bottom > 0) {
        fprintf(stream, "(%s > %.9g ? %s : %.9g)", column, bottom, column, bottom);
    } else {
        fprintf(stream, "(%s)", column);
    }
}

/* Around a single place the band is a box. */
static void print_band(const char *data, const ps_series *series, double bottom, FILE *stream) {
    fprintf(stream, "%s using 1:%s", data, series->num > 1 ? "" : "2:($1*0.985):($1*1.015):");
    print_raised("$5", bottom, stream);
    fprintf(stream, ":6 with %s fillstyle transparent solid 0.25 noborder ",
            series->num > 1 ? "filledcurves" : "boxxyerror");
    ps_script_print_colour(series->kind, stream);
    fputs(" notitle, ", stream);
}

/* None without a length. */
static void print_bars(const char *data, const ps_series *series, double bottom, FILE *stream) {
    fprintf(stream, "%s using 1:($3 > 0 ? $2 : NaN):", data);
    print_raised("$2-$3", bottom, stream);
    fputs(":($2+$3) with yerrorbars pointtype 7 pointsize 0.1 linewidth 1.2 ", stream);
    ps_script_print_colour(series->kind, stream);
    fputs(" notitle, ", stream);
}

/* Its figure, key and the name of its data; the width of its line, and what its marks are larger;
 * the end of a logarithmic axis, 0 of a linear one. */
typedef struct drawn {
    const ps_figure *figure;
    const ps_script_key *key;
    const char *data;
    double width, more, bottom;
} drawn;

/* No line goes through a place that stands alone: it is marked. */
static void print_line(const drawn *what, const ps_series *series, int mark, double size,
                       FILE *stream) {
    fputs(series->num > 1 ? "lines" : "", stream);
    if (ps_script_has_lone(what->figure, series, series->y)) {
        fprintf(stream, "points pointtype %d pointsize %g", mark, size + what->more);
    }
}

static void print_curve(const drawn *what, const ps_series *series, FILE *stream) {
    if (series->low != NULL && series->high != NULL) {
        print_band(what->data, series, what->bottom, stream);
    }
    fprintf(stream, "%s using 1:2 with ", what->data);
    print_line(what, series, 6, 1.4, stream); /* the ring leaves room for a mark in it */
    fprintf(stream, " linewidth %g ", series->num > 1 ? what->width : PS_SCRIPT_LINE_WIDTH);
    ps_script_print_style(series->kind, stream);
}

static void print_bound(const drawn *what, const ps_series *series, FILE *stream) {
    fprintf(stream, "%s using 1:2 with ", what->data);
    print_line(what, series, 2, 1, stream);
    fputs(" linewidth 1.2 dashtype 3 ", stream);
    ps_script_print_colour(series->kind, stream);
}

static void print_series(const drawn *what, const ps_series *series, FILE *stream) {
    const char *const data = what->data;
    switch (series->look) {
    case PS_LOOK_LINE:
        fprintf(stream, "%s using 1:2 with linespoints pointtype 7 pointsize 0.4 linewidth %g ",
                data, what->width);
        ps_script_print_style(series->kind, stream);
        break;
    case PS_LOOK_CURVE:
        print_curve(what, series, stream);
        break;
    case PS_LOOK_MARKS:
        if (series->error != NULL) {
            print_bars(data, series, what->bottom, stream);
        }
        fprintf(stream, "%s using 1:2 with points pointtype 7 pointsize %g ", data,
                0.6 + what->more);
        ps_script_print_colour(series->kind, stream);
        break;
    case PS_LOOK_BOUND:
        print_bound(what, series, stream);
        break;
    case PS_LOOK_CLOUD:
        fprintf(stream,
                "%s using 1:2 with points pointtype 7 pointsize 0.3 linecolor rgb '#b8b8b8'", data);
        break;
    case PS_LOOK_REFERENCE:
        fprintf(stream, "%s using 1:2 with %s linewidth 1 linecolor rgb '#808080' dashtype 2", data,
                series->num > 1 ? "lines" : "points pointtype 1 pointsize 1.4");
        break;
    }
    if (is_named(series)) {
        ps_script_print_entry(what->key, series->formula, series->label, stream);
    } else {
        fputs(" notitle", stream);
    }
}

/* ---- panels ---------------------------------------------------------------------------------- */

static void print_ranges(const ps_figure *figure, const ps_panel *panel, double bottom,
                         FILE *stream) {
    if (figure->is_log_x) {
        print_log_range(figure, panel, stream);
    }
    if (bottom > 0 && goes_below(panel, bottom)) {
        fprintf(stream, "set yrange [%.3g:*]\n", bottom);
    }
    ps_script_print_asked(figure, stream);
}

static void print_all_series(const ps_figure *figure, size_t index, const ps_script_key *key,
                             double bottom, FILE *stream) {
    enum { DATA_BYTES = 64 };
    const ps_panel *const panel = &figure->panels[index];
    fputs("plot ", stream);
    for (size_t i = 0; i < panel->num_series; i++) {
        char data[DATA_BYTES];
        snprintf(data, sizeof data, "$data%zu_%zu", index, i);
        print_series(&(drawn){figure, key, data, ps_script_line_width(figure, panel, i),
                              ps_script_more_size(figure, panel, i), bottom},
                     &panel->series[i], stream);
        fputs(i + 1 < panel->num_series ? ", " : "\n", stream);
    }
}

/* Its own, or those of all. */
static void print_labels(const ps_figure *figure, size_t index, FILE *stream) {
    const ps_panel_axes own = axes_of(figure, index);
    ps_script_print_label("x", own.x_label != NULL ? own.x_label : figure->x_label, "0,0", stream);
    ps_script_print_label("y", own.y_label != NULL ? own.y_label : figure->y_label, "0,0", stream);
}

static void print_panel(const ps_figure *figure, size_t index, FILE *stream) {
    const ps_panel *const panel = &figure->panels[index];
    const ps_script_key key = make_key(figure, index);
    const ps_script_box where = find_frame(figure, index, ps_script_key_height(&key));
    const double bottom = figure->is_log_y ? find_bottom(panel) : 0;
    ps_script_print_margins(&where, stream);
    print_labels(figure, index, stream);
    if (figure->num_panels > 1) {
        fputs(index > 0 ? "unset label 1\nset autoscale\nset title " : "set title ", stream);
        ps_script_print_text(panel->title, stream);
        fputs(" noenhanced offset 0,-0.6\n", stream);
    }
    if (figure->num_panels > 1 && !ps_script_has_places(figure, panel)) {
        fputs("unset key\nset xrange [1:10]\nset yrange [1:10]\nplot NaN notitle\n", stream);
        return;
    }
    if (axes_of(figure, index).is_plane) {
        print_plane_range(panel, where.right - where.left, where.bottom - where.top, stream);
    }
    print_ranges(figure, panel, bottom, stream);
    ps_script_print_key(&key, stream);
    print_all_series(figure, index, &key, bottom, stream);
}

void ps_script_print_frames(const ps_figure *figure, FILE *stream) {
    fputs(ps_script_ticks, stream);
    ps_script_print_scale("x", figure->is_log_x, stream);
    ps_script_print_scale("y", figure->is_log_y, stream);
    for (size_t i = 0; i < figure->num_panels; i++) {
        print_panel(figure, i, stream);
    }
}
