/* The gnuplot script of lines in one panel. */
#include "io/plot_script.h"

#include <math.h>

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

static void print_axis(const char *axis, const char *label, bool is_log, FILE *stream) {
    if (is_log) {
        fprintf(stream, "set logscale %s\nset format %s '10^{%%T}'\n", axis, axis);
    }
    fprintf(stream, "set %slabel ", axis);
    ps_plot_print_text(label, stream);
    fputs(" offset 0,0\n", stream);
}

void ps_line_plot_write_script(const ps_line_plot *plot, const char *terminal, FILE *stream) {
    enum { WIDTH = 1000 };
    ps_plot_print_page(plot->title, terminal, WIDTH, stream);
    for (size_t i = 0; i < plot->num_lines; i++) {
        print_line(plot, i, stream);
    }
    /* the key stands below, two lines in a row */
    const double bottom = 0.10;
    const double row = 0.032;
    const size_t num_rows = plot->num_lines > 1 ? (plot->num_lines + 1) / 2 : 0;
    fprintf(stream, "set bmargin at screen %.3f\n", bottom + row * (double)num_rows);
    fputs("set lmargin at screen 0.095\nset rmargin at screen 0.985\n"
          "set tmargin at screen 0.92\nset xtics in mirror\nset ytics in mirror\n"
          "set grid linecolor '#d8d8d8' linewidth 0.8 dashtype solid\n",
          stream);
    print_axis("x", plot->x_label, plot->is_log_x, stream);
    print_axis("y", plot->y_label, plot->is_log_y, stream);
    const double least = plot->is_log_y ? find_least(plot) : 0;
    if (least > 0) {
        fprintf(stream, "set yrange [%.3g:*]\n", least);
    }
    fputs(plot->num_lines > 1 ? "set key at screen 0.54,0.01 center bottom horizontal Left reverse "
                                "maxcols 2 samplen 2 noenhanced\nplot "
                              : "unset key\nplot ",
          stream);
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
