/* The gnuplot script of a frame: lines in one panel. */
#include "plots/plot_script.h"

#include <math.h>
#include <string.h>

/* Rounding leaves numbers far below all that matter; an axis that shows them shows nothing else. */
static double find_least(const ps_panel *panel) {
    const double digits = 1e-16;
    double most = 0;
    double least = INFINITY;
    for (size_t i = 0; i < panel->num_series; i++) {
        for (size_t k = 0; k < panel->series[i].num; k++) {
            const double y = panel->series[i].y[k];
            most = isfinite(y) ? fmax(most, y) : most;
            least = y > 0 ? fmin(least, y) : least;
        }
    }
    return least < most * digits ? most * digits : 0;
}

/* gnuplot would go on to whole powers of ten, where few points are. */
static void print_log_range(const ps_panel *panel, FILE *stream) {
    const double margin = 1.15;
    double least = INFINITY;
    double most = 0;
    for (size_t i = 0; i < panel->num_series; i++) {
        for (size_t k = 0; k < panel->series[i].num; k++) {
            const double x = panel->series[i].x[k];
            least = x > 0 ? fmin(least, x) : least;
            most = isfinite(x) ? fmax(most, x) : most;
        }
    }
    if (most > least) {
        fprintf(stream, "set xrange [%.9g:%.9g]\n", least / margin, most * margin);
    }
}

/* The key stands below: labels beside each other where they are short. */
static size_t count_key_columns(const ps_panel *panel) {
    const size_t longest_of_two = 40;
    for (size_t i = 0; i < panel->num_series; i++) {
        if (panel->series[i].label != NULL && strlen(panel->series[i].label) > longest_of_two) {
            return 1;
        }
    }
    return 2;
}

void ps_script_print_frame(const ps_figure *figure, FILE *stream) {
    const ps_panel *const panel = figure->panels;
    const double bottom = 0.11; /* of the page: numbers and label of the axis */
    const double row = 0.033;   /* a line of the key */
    const size_t num_columns = count_key_columns(panel);
    const size_t num_rows =
        panel->num_series > 1 ? (panel->num_series + num_columns - 1) / num_columns : 0;
    fprintf(stream,
            "set bmargin at screen %.3f\nset lmargin at screen 0.095\n"
            "set rmargin at screen 0.985\nset tmargin at screen 0.92\n%s",
            bottom + row * (double)num_rows, ps_script_ticks);
    ps_script_print_scale("x", figure->is_log_x, stream);
    ps_script_print_scale("y", figure->is_log_y, stream);
    ps_script_print_label("x", figure->x_label, "0,0", stream);
    ps_script_print_label("y", figure->y_label, "0,0", stream);
    if (figure->is_log_x) {
        print_log_range(panel, stream);
    }
    const double least = figure->is_log_y ? find_least(panel) : 0;
    if (least > 0) {
        fprintf(stream, "set yrange [%.3g:*]\n", least);
    }
    ps_script_print_asked(figure, stream);
    if (panel->num_series > 1) {
        fprintf(stream,
                "set key at screen 0.54,0.01 center bottom horizontal Left reverse maxcols %zu "
                "samplen 2\nplot ",
                num_columns);
    } else {
        fputs("unset key\nplot ", stream);
    }
    for (size_t i = 0; i < panel->num_series; i++) {
        fprintf(stream,
                "$data0_%zu using 1:2 with linespoints pointtype 7 pointsize 0.4 linewidth 1.6 ",
                i);
        ps_script_print_style(panel->series[i].kind, stream);
        fputs(" title ", stream);
        ps_script_print_formula(panel->series[i].formula, panel->series[i].label, stream);
        fputs(i + 1 < panel->num_series ? ", " : "\n", stream);
    }
}
