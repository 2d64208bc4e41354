/* The gnuplot script of lines in one panel. */
#include "plots/plot_script.h"

#include <math.h>
#include <string.h>

static void print_line(const ps_line_plot *plot, size_t number, FILE *stream) {
    const ps_plot_line *const line = &plot->lines[number];
    fprintf(stream, "$line%zu << EOD\n", number);
    for (size_t i = 0; i < line->num; i++) {
        const bool is_shown =
            (!plot->is_log_x || line->x[i] > 0) && (!plot->is_log_y || line->y[i] > 0);
        ps_plot_print_value(line->x[i], stream);
        ps_plot_print_value(is_shown ? line->y[i] : NAN, stream);
        putc('\n', stream);
    }
    fputs("EOD\n", stream);
}

/* Rounding leaves numbers far below all that matter; an axis that shows them shows nothing else. */
static double find_least(const ps_line_plot *plot) {
    const double digits = 1e-16;
    double most = 0;
    double least = INFINITY;
    for (size_t i = 0; i < plot->num_lines; i++) {
        for (size_t k = 0; k < plot->lines[i].num; k++) {
            const double y = plot->lines[i].y[k];
            most = isfinite(y) ? fmax(most, y) : most;
            least = y > 0 ? fmin(least, y) : least;
        }
    }
    return least < most * digits ? most * digits : 0;
}

/* gnuplot would go on to whole powers of ten, where few points are. */
static void print_log_range(const ps_line_plot *plot, FILE *stream) {
    const double margin = 1.15;
    double least = INFINITY;
    double most = 0;
    for (size_t i = 0; i < plot->num_lines; i++) {
        for (size_t k = 0; k < plot->lines[i].num; k++) {
            const double x = plot->lines[i].x[k];
            least = x > 0 ? fmin(least, x) : least;
            most = isfinite(x) ? fmax(most, x) : most;
        }
    }
    if (most > least) {
        fprintf(stream, "set xrange [%.9g:%.9g]\n", least / margin, most * margin);
    }
}

static void print_axis(const char *axis, const char *label, bool is_log, FILE *stream) {
    if (is_log) {
        fprintf(stream, "set logscale %s\nset format %s '10^{%%T}'\n", axis, axis);
    }
    fprintf(stream, "set %slabel ", axis);
    ps_plot_print_text(label, stream);
    fputs(" offset 0,0\n", stream);
}

/* The key stands below: labels beside each other where they are short. */
static size_t count_key_columns(const ps_line_plot *plot) {
    const size_t longest_of_two = 40;
    for (size_t i = 0; i < plot->num_lines; i++) {
        if (plot->lines[i].label != NULL && strlen(plot->lines[i].label) > longest_of_two) {
            return 1;
        }
    }
    return 2;
}

void ps_line_plot_write_script(const ps_line_plot *plot, const char *terminal, FILE *stream) {
    enum { WIDTH = 1000 };
    const double bottom = 0.11; /* of the page: numbers and label of the axis */
    const double row = 0.033;   /* a line of the key */
    ps_plot_print_page(plot->title, terminal, WIDTH, PS_PLOT_HEIGHT, stream);
    for (size_t i = 0; i < plot->num_lines; i++) {
        print_line(plot, i, stream);
    }
    const size_t num_columns = count_key_columns(plot);
    const size_t num_rows =
        plot->num_lines > 1 ? (plot->num_lines + num_columns - 1) / num_columns : 0;
    fprintf(stream, "set bmargin at screen %.3f\n", bottom + row * (double)num_rows);
    fputs("set lmargin at screen 0.095\nset rmargin at screen 0.985\n"
          "set tmargin at screen 0.92\nset xtics in mirror\nset ytics in mirror\n"
          "set grid linecolor '#d8d8d8' linewidth 0.8 dashtype solid\n",
          stream);
    print_axis("x", plot->x_label, plot->is_log_x, stream);
    print_axis("y", plot->y_label, plot->is_log_y, stream);
    if (plot->is_log_x) {
        print_log_range(plot, stream);
    }
    const double least = plot->is_log_y ? find_least(plot) : 0;
    if (least > 0) {
        fprintf(stream, "set yrange [%.3g:*]\n", least);
    }
    if (plot->num_lines > 1) {
        fprintf(stream,
                "set key at screen 0.54,0.01 center bottom horizontal Left reverse maxcols %zu "
                "samplen 2 noenhanced\nplot ",
                num_columns);
    } else {
        fputs("unset key\nplot ", stream);
    }
    for (size_t i = 0; i < plot->num_lines; i++) {
        fprintf(stream,
                "$line%zu using 1:2 with linespoints pointtype 7 pointsize 0.4 linewidth 1.6 ", i);
        ps_plot_print_style(i, stream);
        fputs(" title ", stream);
        ps_plot_print_text(plot->lines[i].label != NULL ? plot->lines[i].label : "", stream);
        fputs(i + 1 < plot->num_lines ? ", " : "\n", stream);
    }
    fputs("unset multiplot\n", stream);
}
