#include "math/gsl/special.h"

#include "math/gsl/fence.h"
#include "math/pi.h"

#include <gsl/gsl_sf_bessel.h>
#include <gsl/gsl_sf_gamma.h>
#include <math.h>

/* J_{n + 1/2}(z) = sqrt(2 z/pi) j_n(z). */
static double half_order(int n, double z) {
    return sqrt(2 * z / PS_PI) * gsl_sf_bessel_jl(n, z);
}

double ps_bessel_half(unsigned d, double z) {
    ps_gsl_enter();
    const double value =
        d % 2 == 0 ? gsl_sf_bessel_Jn((int)d / 2, z) : half_order((int)(d - 1) / 2, z);
    ps_gsl_leave();
    return value;
}

double ps_beta_regularised(double a, double b, double x) {
    ps_gsl_enter();
    const double value = gsl_sf_beta_inc(a, b, x);
    ps_gsl_leave();
    return value;
}
