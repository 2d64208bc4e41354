#include "math/random/distributions.h"

#include "math/gsl/fence.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

/* t - log(1 + t) >= 0, without cancellation for small t. */
static double excess_of_log(double t) {
    const double series_ends = 1e-3; /* the next term is below 1e-15 of the first */
    if (fabs(t) >= series_ends) {
        return t - log1p(t);
    }
    return t * t * (1.0 / 2 - t * (1.0 / 3 - t * (1.0 / 4 - t * (1.0 / 5 - t / 6))));
}

/* With t = a X / (a X + b Y) the density of log(t / (1 - t)) is proportional to exp(-r^2 / 2), r^2
 * / 2 being the sum below, which is 0 at X = Y; u is the derivative of the exponent there over its
 * width. The probability of r is then that of a normal variable but for u / r, which is nearly 1
 * (Barndorff-Nielsen's r*). */
double ps_gamma_ratio_score(double x, double a, double y, double b) {
    const double middle = 1e-4; /* closer to the middle log(u / r) / r has lost its digits */
    const double both = a * x + b * y;
    const double t = (x - y) * b / both;  /* t relative to its middle, minus 1 */
    const double s = -(x - y) * a / both; /* 1 - t likewise */
    const double r = copysign(sqrt(2 * (a * excess_of_log(t) + b * excess_of_log(s))), x - y);
    const double u = t * sqrt(a * (a + b) / b);
    if (!isfinite(r)) {
        return copysign(HUGE_VAL, x - y);
    }
    return fabs(r) < middle ? r : r + log(u / r) / r;
}

/* What GSL is asked lies where it never calls its error handler: tests look at that. Below the
 * least number of degrees of freedom all scores have the probability 1. */
double ps_student_two_sided(double score, double degrees_of_freedom) {
    const double least = 1e-6;
    const double most = 1e18;
    const double most_of_score = 1e150; /* its square is a number */
    const double distance = fmin(fabs(score), most_of_score);
    if (isnan(score) || isnan(degrees_of_freedom)) {
        return NAN;
    }
    if (isinf(score)) {
        return 0;
    }
    if (degrees_of_freedom < least) {
        return 1;
    }
    ps_gsl_enter();
    const double tail = gsl_cdf_tdist_Q(distance, fmin(degrees_of_freedom, most));
    ps_gsl_leave();
    return fmin(1, 2 * tail);
}

double ps_student_score(double probability, double degrees_of_freedom) {
    const double most = 1e6;
    enum { HALVINGS = 24 }; /* relative 6e-8: nobody needs more of a score */
    double high = 1;
    while (high < most && ps_student_two_sided(high, degrees_of_freedom) > probability) {
        high *= 2;
    }
    double low = high > 1 ? high / 2 : 0;
    for (int i = 0; i < HALVINGS; i++) {
        const double score = low + (high - low) / 2;
        if (ps_student_two_sided(score, degrees_of_freedom) > probability) {
            low = score;
        } else {
            high = score;
        }
    }
    return fmin(high, most);
}

double ps_normal_score(double probability) {
    const double least = 1e-300;
    if (!(probability < 1)) {
        return 0;
    }
    ps_gsl_enter();
    const double score = gsl_cdf_ugaussian_Qinv(fmax(probability, least) / 2);
    ps_gsl_leave();
    return score;
}
