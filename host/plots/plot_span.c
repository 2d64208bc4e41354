/* What axes cover, which gnuplot would take to the next whole power of ten, or cut there. */
#include "plots/plot_script.h"

#include <math.h>

ps_plot_span ps_plot_span_none(void) {
    return (ps_plot_span){HUGE_VAL, -HUGE_VAL};
}

void ps_plot_span_widen(ps_plot_span *span, double value) {
    if (isfinite(value)) {
        *span = (ps_plot_span){fmin(span->least, value), fmax(span->most, value)};
    }
}

bool ps_plot_span_is_empty(ps_plot_span span) {
    return span.least > span.most;
}

ps_plot_span ps_plot_span_places(const ps_panel *panel) {
    ps_plot_span out = ps_plot_span_none();
    for (size_t i = 0; i < panel->num_series; i++) {
        for (size_t k = 0; k < panel->series[i].num; k++) {
            const double x = panel->series[i].x[k];
            ps_plot_span_widen(&out, x > 0 ? x : (double)NAN);
        }
    }
    return out;
}

/* ---- numbers that are more than rounding ----------------------------------------------------- */

static double find_most(const ps_panel *panel) {
    ps_plot_span all = {0, 0};
    for (size_t i = 0; i < panel->num_series; i++) {
        for (size_t k = 0; k < panel->series[i].num; k++) {
            ps_plot_span_widen(&all, panel->series[i].y[k]);
        }
    }
    return all.most;
}

ps_plot_span ps_plot_span_above(const ps_panel *panel) {
    const double most = find_most(panel);
    ps_plot_span out = ps_plot_span_none();
    for (size_t i = 0; i < panel->num_series; i++) {
        const ps_series *const series = &panel->series[i];
        const double floor = ps_series_floor(series, most);
        for (size_t k = 0; k < series->num; k++) {
            ps_plot_span_widen(&out, series->y[k] > floor ? series->y[k] : (double)NAN);
        }
    }
    return out;
}

double ps_plot_least_floor(const ps_panel *panel) {
    const double most = find_most(panel);
    ps_plot_span floors = ps_plot_span_none();
    for (size_t i = 0; i < panel->num_series; i++) {
        ps_plot_span_widen(&floors, ps_series_floor(&panel->series[i], most));
    }
    return ps_plot_span_is_empty(floors) ? 0 : floors.least;
}

/* ---- in the script --------------------------------------------------------------------------- */

void ps_script_print_span(const char *axis, ps_plot_span shown, FILE *stream) {
    fprintf(stream, "set %srange [%.9g:%.9g]\n", axis, shown.least, shown.most);
}

double ps_script_tick_step(ps_plot_span shown) {
    const double most_ticks = 6;
    const double least = shown.most > shown.least ? (shown.most - shown.least) / most_ticks : 1;
    const double unit = pow(10, floor(log10(least)));
    return unit * (least <= unit ? 1 : least <= 2 * unit ? 2 : least <= 5 * unit ? 5 : 10);
}

static void print_even_ticks(ps_plot_span shown, FILE *stream) {
    const double step = ps_script_tick_step(shown);
    const char *comma = "";
    for (double i = ceil(shown.least / step); i * step <= shown.most; i++) {
        fprintf(stream, "%s%.6g", comma, i * step);
        comma = ", ";
    }
}

static void print_decades(ps_plot_span shown, FILE *stream) {
    static const double steps[] = {1, 2, 5};
    const char *comma = "";
    for (double unit = pow(10, floor(log10(shown.least))); unit <= shown.most; unit *= 10) {
        for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
            const double at = unit * steps[i];
            if (at >= shown.least && at <= shown.most) {
                fprintf(stream, "%s%.6g", comma, at);
                comma = ", ";
            }
        }
    }
}

void ps_script_print_log_ticks(const char *axis, ps_plot_span shown, FILE *stream) {
    const double most_decades = 2;
    const double few = 5;          /* times: there 1, 2 and 5 would be two ticks */
    const double most_zeros = 1e4; /* powers of ten are shorter beyond it */
    if (log10(shown.most / shown.least) > most_decades || shown.most > most_zeros ||
        shown.least < 1 / most_zeros) {
        fprintf(stream, "set %stics in mirror autofreq\nset format %s '10^{%%T}'\n", axis, axis);
        return;
    }
    fprintf(stream, "set format %s '%%g'\nset %stics in mirror (", axis, axis);
    if (shown.most / shown.least < few) {
        print_even_ticks(shown, stream);
    } else {
        print_decades(shown, stream);
    }
    fputs(")\n", stream);
}
