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
    ps_plot_print_page(plot->title, terminal, WIDTH, PS_PLOT_HEIGHT, stream);
    for (size_t i = 0; i < plot->num_lines; i++) {
        print_line(plot, i, stream);
    }
    fputs("set lmargin at screen 0.095\nset rmargin at screen 0.985\nset bmargin at screen 0.10\n"
          "set tmargin at screen 0.92\nset xtics in mirror\nset ytics in mirror\n"
          "set grid linecolor '#d8d8d8' linewidth 0.8 dashtype solid\n",
          stream);
    print_axis("x", plot->x_label, plot->is_log_x, stream);
    print_axis("y", plot->y_label, plot->is_log_y, stream);
    fputs(plot->num_lines > 1 ? "set key top right opaque Left reverse width -1 box linecolor "
                                "'#c0c0c0' samplen 2 noenhanced\nplot "
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
