#include "plots/plot.h"

#include <math.h>

double ps_series_floor(const ps_series *series, double most) {
    const double digits = 1e-16;
    return fmax(series->floor, digits * most);
}

/* Sums over places that are more than rounding. */
typedef struct sums {
    double n, x, y, xx, xy;
} sums;

static sums add_places(const ps_series *series) {
    double most = 0;
    sums out = {0};
    for (size_t i = 0; i < series->num; i++) {
        most = isfinite(series->y[i]) ? fmax(most, series->y[i]) : most;
    }
    const double floor = ps_series_floor(series, most);
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
