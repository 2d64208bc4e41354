/* The gnuplot script of panels side by side. */
#include "plots/plot_script.h"

#include <math.h>

enum { COLUMNS = 3, PANEL_WIDTH = 470, PANEL_HEIGHT = 370, HEAD = 44, MOST_KINDS = 32 };

/* Circles, squares, triangles: filled and hollow ones in turn. */
static const int marks[] = {7, 6, 5, 4, 9, 8, 11, 10, 13, 12, 15, 14};
enum { NUM_MARKS = sizeof marks / sizeof marks[0] };

/* Panels, and a place for the key. */
static size_t num_columns(const ps_panel_plot *plot) {
    return plot->num_panels + 1 < COLUMNS ? plot->num_panels + 1 : COLUMNS;
}

static int page_height(const ps_panel_plot *plot) {
    const size_t columns = num_columns(plot);
    return HEAD + PANEL_HEIGHT * (int)((plot->num_panels + columns) / columns);
}

/* On a logarithmic axis is only what is above 0. */
static bool is_shown(const ps_panel_plot *plot, const ps_plot_series *series, size_t place) {
    const double x = series->x[place];
    const double y = series->y[place];
    return isfinite(x) && isfinite(y) && (plot->is_linear_x || x > 0) &&
           (plot->is_linear_y || y > 0);
}

/* gnuplot makes no axes for nothing. */
static bool has_places(const ps_panel_plot *plot, const ps_plot_panel *panel) {
    for (size_t j = 0; j < panel->num_series; j++) {
        for (size_t place = 0; place < panel->series[j].num; place++) {
            if (is_shown(plot, &panel->series[j], place)) {
                return true;
            }
        }
    }
    return false;
}

static void print_data(const ps_panel_plot *plot, FILE *stream) {
    for (size_t i = 0; i < plot->num_panels; i++) {
        for (size_t j = 0; j < plot->panels[i].num_series; j++) {
            const ps_plot_series *const series = &plot->panels[i].series[j];
            fprintf(stream, "$data%zu_%zu << EOD\n", i, j);
            for (size_t place = 0; place < series->num; place++) {
                const bool shows = is_shown(plot, series, place);
                ps_plot_print_value(shows ? series->x[place] : NAN, stream);
                ps_plot_print_value(shows ? series->y[place] : NAN, stream);
                putc('\n', stream);
            }
            fputs("EOD\n", stream);
        }
    }
}

static void print_look(const ps_panel_plot *plot, const ps_plot_series *series, FILE *stream) {
    if (plot->has_lines) {
        fputs("with linespoints pointtype 7 pointsize 0.3 linewidth 1.6 ", stream);
        ps_plot_print_style(series->kind, stream);
        return;
    }
    if (series->is_front) {
        fputs("with lines linewidth 2 linecolor rgb '#b0b0b0'", stream);
        return;
    }
    fprintf(stream, "with points pointtype %d pointsize 0.9 linewidth 1.4 ",
            marks[series->kind % NUM_MARKS]);
    ps_plot_print_style(series->kind / 2, stream);
}

/* Margins of cell number `cell`, in pixels of the page. */
static void print_margins(const ps_panel_plot *plot, size_t cell, FILE *stream) {
    const double left = 82;
    const double right = 20;
    const double above = 30;
    const double below = 52;
    const size_t columns = num_columns(plot);
    const double width = (double)columns * PANEL_WIDTH;
    const double height = page_height(plot);
    const double x = (double)(cell % columns) * PANEL_WIDTH;
    const double y = HEAD + (double)(cell / columns) * PANEL_HEIGHT;
    fprintf(stream,
            "set lmargin at screen %.4f\nset rmargin at screen %.4f\n"
            "set tmargin at screen %.4f\nset bmargin at screen %.4f\n",
            (x + left) / width, (x + PANEL_WIDTH - right) / width, 1 - (y + above) / height,
            1 - (y + PANEL_HEIGHT - below) / height);
}

static void print_label(const char *axis, const char *label, const char *offset, FILE *stream) {
    fprintf(stream, "set %slabel ", axis);
    ps_plot_print_text(label, stream);
    fprintf(stream, " offset %s\n", offset);
}

static void print_panel(const ps_panel_plot *plot, size_t i, FILE *stream) {
    const ps_plot_panel *const panel = &plot->panels[i];
    print_margins(plot, i, stream);
    if (i > 0) {
        fputs("unset label 1\n", stream); /* the page has its title */
    }
    fputs("set title ", stream);
    ps_plot_print_text(panel->title, stream);
    fputs(" noenhanced offset 0,-0.6\n", stream);
    if (!has_places(plot, panel)) {
        fputs(plot->has_lines
                  ? "plot NaN notitle\n"
                  : "set xrange [1:10]\nset yrange [1:10]\nplot NaN notitle\nset autoscale\n",
              stream);
        return;
    }
    fputs("plot ", stream);
    for (size_t j = 0; j < panel->num_series; j++) {
        fprintf(stream, "%s$data%zu_%zu using 1:2 ", j > 0 ? ", " : "", i, j);
        print_look(plot, &panel->series[j], stream);
        fputs(" notitle", stream);
    }
    putc('\n', stream);
}

/* One entry for every kind that there is. */
static void print_key(const ps_panel_plot *plot, FILE *stream) {
    bool is_done[MOST_KINDS + 1] = {false};
    print_margins(plot, plot->num_panels, stream);
    fputs("unset label 1\nunset title\nunset border\nunset tics\nunset xlabel\nunset ylabel\nunset "
          "grid\n"
          "set key center center Left reverse noenhanced box linecolor '#c0c0c0' samplen 2 "
          "maxcols 1 font ',9'\n"
          "set xrange [1:10]\nset yrange [1:10]\nplot ",
          stream);
    for (size_t i = 0; i < plot->num_panels; i++) {
        for (size_t j = 0; j < plot->panels[i].num_series; j++) {
            const ps_plot_series *const series = &plot->panels[i].series[j];
            const size_t kind = series->is_front ? MOST_KINDS : series->kind;
            if (kind > MOST_KINDS || is_done[kind]) {
                continue;
            }
            is_done[kind] = true;
            fputs("NaN ", stream);
            print_look(plot, series, stream);
            fputs(" title ", stream);
            ps_plot_print_text(series->label, stream);
            fputs(", ", stream);
        }
    }
    fputs("NaN notitle\n", stream);
}

static void print_scale(const char *axis, bool is_linear, FILE *stream) {
    if (!is_linear) {
        fprintf(stream, "set logscale %s\nset format %s '10^{%%T}'\n", axis, axis);
    }
}

/* What all places of one axis lie in. */
typedef struct range {
    double least, most;
} range;

static void widen(range *to, double value) {
    to->least = fmin(to->least, value);
    to->most = fmax(to->most, value);
}

/* A linear axis begins at 0, unless something is below it; a logarithmic one leaves out what rounding left. */
static void print_range(const char *axis, range of, bool is_linear, FILE *stream) {
    const double digits = 1e-16;
    const double margin = 1.05;
    const double low = is_linear ? fmin(of.least, 0) : fmax(of.least, of.most * digits);
    if (of.most > low) {
        fprintf(stream, "set %srange [%.9g:%.9g]\n", axis, is_linear ? low * margin : low / margin,
                of.most * margin);
    }
}

static void print_ranges(const ps_panel_plot *plot, FILE *stream) {
    range x = {INFINITY, -INFINITY};
    range y = {INFINITY, -INFINITY};
    for (size_t i = 0; i < plot->num_panels; i++) {
        for (size_t j = 0; j < plot->panels[i].num_series; j++) {
            const ps_plot_series *const series = &plot->panels[i].series[j];
            for (size_t place = 0; place < series->num; place++) {
                if (is_shown(plot, series, place)) {
                    widen(&x, series->x[place]);
                    widen(&y, series->y[place]);
                }
            }
        }
    }
    print_range("x", x, plot->is_linear_x, stream);
    print_range("y", y, plot->is_linear_y, stream);
}

void ps_panel_plot_write_script(const ps_panel_plot *plot, const char *terminal, FILE *stream) {
    ps_plot_print_page(plot->title, terminal, (int)num_columns(plot) * PANEL_WIDTH,
                       page_height(plot), stream);
    print_data(plot, stream);
    print_scale("x", plot->is_linear_x, stream);
    print_scale("y", plot->is_linear_y, stream);
    fputs("set xtics in mirror\nset ytics in mirror\n"
          "set grid linecolor '#d8d8d8' linewidth 0.8 dashtype solid\nunset key\n",
          stream);
    print_label("x", plot->x_label, "0,0.3", stream);
    print_label("y", plot->y_label, "0.4,0", stream);
    if (plot->has_lines) {
        print_ranges(plot, stream);
    }
    for (size_t i = 0; i < plot->num_panels; i++) {
        print_panel(plot, i, stream);
    }
    print_key(plot, stream);
    fputs("unset multiplot\n", stream);
}
