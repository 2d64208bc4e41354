/* Widths of lines: where curves lie on each other the one below shows on both sides. */
#include "plots/plot_script.h"

#include <math.h>

/* So many curves that lie on one are told apart; of more the lower ones look the same. */
enum { MOST_ABOVE = 3 };

/* Of a logarithmic axis numbers are near that differ by a part of themselves, of a linear one by a
 * part of the lower curve, about the width of a line. */
static bool are_near(double a, double b, bool is_log, double most) {
    const double near = is_log ? 0.02 * fmax(fabs(a), fabs(b)) : 0.005 * most;
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
static bool do_coincide(const ps_figure *figure, const ps_series *a, const ps_series *b) {
    const double most = fmin(find_most(a), find_most(b));
    const size_t num = a->num < b->num ? a->num : b->num;
    size_t num_both = 0;
    size_t num_near = 0;
    for (size_t i = 0; i < num; i++) {
        const bool are_both = ps_script_is_shown(figure, a, i) &&
                              ps_script_is_shown(figure, b, i) && a->x[i] == b->x[i];
        num_both += are_both;
        num_near += are_both && are_near(a->y[i], b->y[i], figure->is_log_y, most);
    }
    return num_both > 0 && 4 * num_near >= num_both;
}

static bool is_curve(const ps_series *series) {
    return series->look == PS_LOOK_LINE || series->look == PS_LOOK_CURVE;
}

double ps_script_line_width(const ps_figure *figure, const ps_panel *panel, size_t index) {
    const double more = 2.2; /* of each curve above */
    const ps_series *const own = &panel->series[index];
    size_t num_above = 0;
    for (size_t i = index + 1; is_curve(own) && i < panel->num_series; i++) {
        num_above += is_curve(&panel->series[i]) && do_coincide(figure, own, &panel->series[i]);
    }
    return PS_SCRIPT_LINE_WIDTH + more * (double)(num_above < MOST_ABOVE ? num_above : MOST_ABOVE);
}
