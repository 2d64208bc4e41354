#include "plots/plot.h"

#include <math.h>

/* The slope of log y over log x by least squares; nan for fewer than two places. */
static double slope(const double *x, const double *y, size_t num) {
    double sx = 0;
    double sy = 0;
    double sxx = 0;
    double sxy = 0;
    for (size_t i = 0; i < num; i++) {
        const double u = log(x[i]);
        const double v = log(y[i]);
        sx += u;
        sy += v;
        sxx += u * u;
        sxy += u * v;
    }
    const double n = (double)num;
    return num > 1 ? (n * sxy - sx * sy) / (n * sxx - sx * sx) : NAN;
}

void ps_series_say_slope(const ps_series *series, ps_text *label) {
    const double own = slope(series->x, series->y, series->num);
    if (isfinite(own)) {
        ps_text_append(label, "%sslope %.3f", label->length > 0 ? ": " : "", own);
    }
}
