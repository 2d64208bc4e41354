/* The gnuplot script of panels side by side, and their key below them. */
#include "plots/plot_script.h"

#include <math.h>

enum { COLUMNS = 3, MOST_KINDS = 32 };
/* In pixels. */
enum { PANEL_WIDTH = 470, PANEL_HEIGHT = 370, HEAD = 44, LEFT = 82, RIGHT = 20, ABOVE_KEY = 20 };

/* Circles, squares, triangles: filled and hollow ones in turn. */
static const int marks[] = {7, 6, 5, 4, 9, 8, 11, 10, 13, 12, 15, 14};
enum { NUM_MARKS = sizeof marks / sizeof marks[0] };

static size_t num_columns(const ps_figure *figure) {
    return figure->num_panels < COLUMNS ? figure->num_panels : COLUMNS;
}

/* One panel is as wide as two. */
static int page_width(const ps_figure *figure) {
    return PANEL_WIDTH * (int)(figure->num_panels > 1 ? num_columns(figure) : 2);
}

static int panels_height(const ps_figure *figure) {
    const size_t columns = num_columns(figure);
    return HEAD + PANEL_HEIGHT * (int)((figure->num_panels + columns - 1) / columns);
}

/* ---- the key --------------------------------------------------------------------------------- */

/* The first series of every kind that there is: entries[MOST_KINDS + 1]. */
static size_t list_entries(const ps_figure *figure, const ps_series **entries) {
    bool is_done[MOST_KINDS + 1] = {false};
    size_t num = 0;
    for (size_t i = 0; i < figure->num_panels; i++) {
        for (size_t j = 0; j < figure->panels[i].num_series; j++) {
            const ps_series *const series = &figure->panels[i].series[j];
            const size_t kind = series->is_front ? MOST_KINDS : series->kind;
            if (kind <= MOST_KINDS && !is_done[kind]) {
                is_done[kind] = true;
                entries[num++] = series;
            }
        }
    }
    return num;
}

static ps_script_key make_key(const ps_figure *figure) {
    const ps_series *entries[MOST_KINDS + 1];
    const size_t num = list_entries(figure, entries);
    ps_script_key key = {.where = {.left = LEFT, .right = page_width(figure) - RIGHT}};
    for (size_t i = 0; i < num; i++) {
        ps_script_key_add(&key, NULL, entries[i]->label);
    }
    key.where.page_width = page_width(figure);
    key.where.page_height = key.where.bottom =
        panels_height(figure) + ABOVE_KEY + ceil(ps_script_key_height(&key));
    return key;
}

/* ---- panels ---------------------------------------------------------------------------------- */

static void print_look(const ps_figure *figure, const ps_series *series, double width,
                       FILE *stream) {
    if (figure->form == PS_FIGURE_PANELS) {
        fprintf(stream, "with linespoints pointtype 7 pointsize 0.3 linewidth %g ", width);
        ps_script_print_style(series->kind, stream);
        return;
    }
    if (series->is_front) {
        fputs("with lines linewidth 2 linecolor rgb '#b0b0b0'", stream);
        return;
    }
    fprintf(stream, "with points pointtype %d pointsize 0.9 linewidth 1.4 ",
            marks[series->kind % NUM_MARKS]);
    ps_script_print_style(series->kind / 2, stream);
}

static void print_margins(const ps_figure *figure, size_t panel, FILE *stream) {
    const double above = 30;
    const double below = 52;
    const size_t columns = num_columns(figure);
    const ps_script_key key = make_key(figure);
    const double width = key.where.page_width / (double)columns;
    const double x = (double)(panel % columns) * width;
    const double y = HEAD + (double)(panel / columns) * PANEL_HEIGHT;
    ps_script_print_margins(&(ps_script_box){x + LEFT, y + above, x + width - RIGHT,
                                             y + PANEL_HEIGHT - below, key.where.page_width,
                                             key.where.page_height},
                            stream);
}

static void print_panel(const ps_figure *figure, size_t i, FILE *stream) {
    const ps_panel *const panel = &figure->panels[i];
    print_margins(figure, i, stream);
    if (i > 0) {
        fputs("unset label 1\n", stream); /* the page has its title */
    }
    fputs("set title ", stream);
    ps_script_print_text(panel->title, stream);
    fputs(" noenhanced offset 0,-0.6\n", stream);
    if (!ps_script_has_places(figure, panel)) {
        fputs(figure->form == PS_FIGURE_PANELS
                  ? "plot NaN notitle\n"
                  : "set xrange [1:10]\nset yrange [1:10]\nplot NaN notitle\nset autoscale\n",
              stream);
        return;
    }
    fputs("plot ", stream);
    for (size_t j = 0; j < panel->num_series; j++) {
        fprintf(stream, "%s$data%zu_%zu using 1:2 ", j > 0 ? ", " : "", i, j);
        print_look(figure, &panel->series[j], ps_script_line_width(figure, panel, j), stream);
        fputs(" notitle", stream);
    }
    putc('\n', stream);
}

/* In a panel of its own, of which nothing else is seen. */
static void print_key(const ps_figure *figure, FILE *stream) {
    const ps_series *entries[MOST_KINDS + 1];
    const size_t num = list_entries(figure, entries);
    const ps_script_key key = make_key(figure);
    ps_script_box where = key.where;
    where.top = where.bottom - 1;
    ps_script_print_margins(&where, stream);
    ps_script_print_key(&key, stream);
    fputs("unset label 1\nunset title\nunset border\nunset tics\nunset xlabel\nunset ylabel\nunset "
          "grid\nset xrange [1:10]\nset yrange [1:10]\nplot ",
          stream);
    for (size_t i = 0; i < num; i++) {
        fputs("NaN ", stream);
        print_look(figure, entries[i], PS_SCRIPT_LINE_WIDTH, stream);
        ps_script_print_entry(&key, NULL, entries[i]->label, stream);
        fputs(", ", stream);
    }
    fputs("NaN notitle\n", stream);
}

/* A linear axis begins at 0, unless something is below it. */
static void print_range(const char *axis, ps_plot_span places, bool is_log, FILE *stream) {
    const double margin = 1.05;
    const double low = is_log ? places.least : fmin(places.least, 0);
    if (places.most > low) {
        const double end = is_log ? low / margin : low * margin;
        ps_script_print_span(axis, (ps_plot_span){end, places.most * margin}, stream);
    }
}

static void widen_by(ps_plot_span *places, ps_plot_span other) {
    ps_plot_span_widen(places, other.least);
    ps_plot_span_widen(places, other.most);
}

static void widen_by_places(const ps_figure *figure, const ps_series *series, ps_plot_span *x,
                            ps_plot_span *y) {
    for (size_t place = 0; place < series->num; place++) {
        if (ps_script_is_shown(figure, series, place)) {
            ps_plot_span_widen(x, series->x[place]);
            ps_plot_span_widen(y, series->y[place]);
        }
    }
}

/* A logarithmic axis of y leaves out what rounding left. */
static void print_ranges(const ps_figure *figure, FILE *stream) {
    ps_plot_span x = ps_plot_span_none();
    ps_plot_span y = ps_plot_span_none();
    ps_plot_span above = ps_plot_span_none();
    for (size_t i = 0; i < figure->num_panels; i++) {
        const ps_panel *const panel = &figure->panels[i];
        for (size_t j = 0; j < panel->num_series; j++) {
            widen_by_places(figure, &panel->series[j], &x, &y);
        }
        widen_by(&above, ps_plot_span_above(panel));
    }
    print_range("x", x, figure->is_log_x, stream);
    print_range("y", figure->is_log_y ? above : y, figure->is_log_y, stream);
}

void ps_script_size_panels(const ps_figure *figure, int *width, int *height) {
    const ps_script_key key = make_key(figure);
    *width = page_width(figure);
    *height = (int)key.where.page_height;
}

void ps_script_print_panels(const ps_figure *figure, FILE *stream) {
    ps_script_print_scale("x", figure->is_log_x, stream);
    ps_script_print_scale("y", figure->is_log_y, stream);
    fprintf(stream, "%sunset key\n", ps_script_ticks);
    ps_script_print_label("x", figure->x_label, "0,0.3", stream);
    ps_script_print_label("y", figure->y_label, "1,0", stream);
    if (figure->form == PS_FIGURE_PANELS) {
        print_ranges(figure, stream);
    }
    for (size_t i = 0; i < figure->num_panels; i++) {
        print_panel(figure, i, stream);
    }
    print_key(figure, stream);
}
