/* Widths of lines and sizes of marks: where they lie on each other the one below shows around. */
#include "plots/plot_script.h"

#include <math.h>

/* So many curves that lie on one are told apart; of more the lower ones look the same. */
enum { MOST_ABOVE = 3 };

/* Of a logarithmic axis numbers are near that differ by a part of themselves, of a linear one by a
 * part of the lower curve, about the width of a line; `wide` times that where marks are. */
static bool are_near(double a, double b, bool is_log, double most, double wide) {
    const double near = wide * (is_log ? 0.02 * fmax(fabs(a), fabs(b)) : 0.005 * most);
    return fabs(a - b) <= near;
}

static double find_most(const ps_series *curve) {
    double most = 0;
    for (size_t i = 0; i < curve->num; i++) {
        most = isfinite(curve->y[i]) ? fmax(most, fabs(curve->y[i])) : most;
    }
    return most;
}

/* At a quarter of the places that both have: there the lower one would be missed. */
static bool do_coincide(const ps_figure *figure, const ps_series *a, const ps_series *b,
                        double wide) {
    const double most = fmin(find_most(a), find_most(b));
    const size_t num = a->num < b->num ? a->num : b->num;
    size_t num_both = 0;
    size_t num_near = 0;
    for (size_t i = 0; i < num; i++) {
        const bool are_both = ps_script_is_shown(figure, a, i) &&
                              ps_script_is_shown(figure, b, i) && a->x[i] == b->x[i];
        num_both += are_both;
        num_near += are_both && are_near(a->y[i], b->y[i], figure->is_log_y, most, wide);
    }
    return num_both > 0 && 4 * num_near >= num_both;
}

static bool is_curve(const ps_series *series) {
    return series->look == PS_LOOK_LINE || series->look == PS_LOOK_CURVE;
}

static bool can_hide(const ps_series *above, const ps_series *below) {
    const bool is_mark = above->look == PS_LOOK_MARKS || above->look == PS_LOOK_BOUND;
    return (is_curve(above) && is_curve(below)) || (is_mark && above->look == below->look);
}

/* Those that come later, and lie on this one: MOST_ABOVE at most. */
static size_t count_above(const ps_figure *figure, const ps_panel *panel, size_t index,
                          double wide) {
    const ps_series *const own = &panel->series[index];
    size_t num = 0;
    for (size_t i = index + 1; i < panel->num_series; i++) {
        const ps_series *const other = &panel->series[i];
        num += can_hide(other, own) && do_coincide(figure, own, other, wide);
    }
    return num < MOST_ABOVE ? num : MOST_ABOVE;
}

double ps_script_line_width(const ps_figure *figure, const ps_panel *panel, size_t index) {
    const double more = 2.2; /* of each curve above */
    return PS_SCRIPT_LINE_WIDTH + more * (double)count_above(figure, panel, index, 1);
}

double ps_script_more_size(const ps_figure *figure, const ps_panel *panel, size_t index) {
    const double more = 0.35; /* of each mark above: rows of keys have room for rings of four */
    const double wide = 5;    /* marks beside lines */
    return more * (double)count_above(figure, panel, index, wide);
}
