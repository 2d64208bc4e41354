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

ps_plot_span ps_plot_span_asked(ps_plot_span own, bool is_asked, const double asked[2]) {
    return is_asked ? (ps_plot_span){asked[0], asked[1]} : own;
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

double ps_series_floor(const ps_series *series, double most) {
    const double digits = 1e-16;
    return fmax(series->floor, digits * most);
}

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

double ps_plot_tick_step(ps_plot_span shown) {
    const double most_ticks = 6;
    const double least = shown.most > shown.least ? (shown.most - shown.least) / most_ticks : 1;
    const double unit = pow(10, floor(log10(least)));
    return unit * (least <= unit ? 1 : least <= 2 * unit ? 2 : least <= 5 * unit ? 5 : 10);
}

static void print_even_ticks(ps_text *out, ps_plot_span shown) {
    const double step = ps_plot_tick_step(shown);
    const char *comma = "";
    for (double i = ceil(shown.least / step); i * step <= shown.most; i++) {
        ps_text_append(out, "%s%.6g", comma, i * step);
        comma = ", ";
    }
}

static void print_decades(ps_text *out, ps_plot_span shown) {
    static const double steps[] = {1, 2, 5};
    const char *comma = "";
    for (double unit = pow(10, floor(log10(shown.least))); unit <= shown.most; unit *= 10) {
        for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
            const double at = unit * steps[i];
            if (at >= shown.least && at <= shown.most) {
                ps_text_append(out, "%s%.6g", comma, at);
                comma = ", ";
            }
        }
    }
}

/* Where a logarithmic axis has more than two decades, or nobody knows its ends, ticks at powers of
 * ten; else plain numbers, at 1, 2 and 5 of each decade, or at even steps where these would be too
 * few. */
static void print_log_ticks(ps_text *out, const char *name, ps_plot_span shown) {
    const double most_decades = 2;
    const double few = 5;          /* times: there 1, 2 and 5 would be two ticks */
    const double most_zeros = 1e4; /* powers of ten are shorter beyond it */
    if (!(log10(shown.most / shown.least) <= most_decades) || shown.most > most_zeros ||
        shown.least < 1 / most_zeros) {
        ps_text_append(out, "set %stics in mirror autofreq\nset format %s '10^{%%T}'\n", name,
                       name);
        return;
    }
    ps_text_append(out, "set format %s '%%g'\nset %stics in mirror (", name, name);
    if (shown.most / shown.least < few) {
        print_even_ticks(out, shown);
    } else {
        print_decades(out, shown);
    }
    ps_text_append(out, ")\n");
}

static void print_end(ps_text *out, double end) {
    if (isfinite(end)) {
        ps_text_append(out, "%.9g", end);
    } else {
        ps_text_append(out, "*");
    }
}

static void print_range(ps_text *out, const char *name, ps_plot_span shown) {
    if (isfinite(shown.least) || isfinite(shown.most)) {
        ps_text_append(out, "set %srange [", name);
        print_end(out, shown.least);
        ps_text_append(out, ":");
        print_end(out, shown.most);
        ps_text_append(out, "]\n");
    }
}

void ps_script_print_axis(ps_text *out, const char *name, const ps_script_axis *axis) {
    if (axis->label != NULL) {
        ps_text_append(out, "set %slabel ", name);
        ps_script_print_text(out, axis->label);
        ps_text_append(out, " offset %s\n", axis->offset);
    }
    if (axis->is_log) {
        ps_text_append(out, "set logscale %s\n", name);
        print_log_ticks(out, name, axis->shown);
    }
    if (axis->format != NULL) {
        ps_text_append(out, "set format %s '%s'\n", name, axis->format);
    }
    if (axis->step > 0) {
        ps_text_append(out, "set %stics %g in mirror\n", name, axis->step);
    }
    print_range(out, name, axis->shown);
}

/* ---- slopes ---------------------------------------------------------------------------------- */

bool ps_series_is_drawn(const ps_series *series) {
    size_t num = 0;
    for (size_t i = 0; i < series->num; i++) {
        num += isfinite(series->y[i]) && series->y[i] > series->floor ? 1 : 0;
    }
    return num > 1 || (num == 1 && (series->num == 1 || series->look == PS_LOOK_MARKS));
}

/* Sums over places that are more than rounding. */
typedef struct sums {
    double n, x, y, xx, xy;
} sums;

static sums add_places(const ps_series *series) {
    const ps_panel alone = {.num_series = 1, .series = series};
    const double floor = ps_series_floor(series, find_most(&alone));
    sums out = {0};
    for (size_t i = 0; i < series->num; i++) {
        if (isfinite(series->y[i]) && series->y[i] > floor) {
            const double u = log(series->x[i]);
            const double v = log(series->y[i]);
            out = (sums){out.n + 1, out.x + u, out.y + v, out.xx + u * u, out.xy + u * v};
        }
    }
    return out;
}

/* The slope of log y over log x by least squares; nan where there are not enough places: two, or
 * three where others are left out. */
static double find_slope(const ps_series *series) {
    const sums all = add_places(series);
    const double fewest = all.n < (double)series->num ? 3 : 2;
    return all.n >= fewest ? (all.n * all.xy - all.x * all.y) / (all.n * all.xx - all.x * all.x)
                           : (double)NAN;
}

void ps_series_say_slope(const ps_series *series, ps_text *label) {
    const double own = find_slope(series);
    if (isfinite(own)) {
        ps_text_append(label, "%sslope %.3f", label->length > 0 ? ": " : "", own);
    }
}
