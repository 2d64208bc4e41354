#include "math/gsl/special.h"

#include "math/gsl/fence.h"
#include "math/pi.h"

#include <gsl/gsl_sf_bessel.h>
#include <gsl/gsl_sf_gamma.h>
#include <gsl/gsl_sf_legendre.h>
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

size_t ps_legendre_place(size_t degree, size_t order) {
    return gsl_sf_legendre_array_index(degree, order);
}

size_t ps_legendre_room(size_t max_degree) {
    return gsl_sf_legendre_array_n(max_degree);
}

/* GSL fails for |z| > 1 alone. */
void ps_legendre_functions(size_t max_degree, double z, double *out) {
    ps_gsl_enter();
    gsl_sf_legendre_array(GSL_SF_LEGENDRE_SPHARM, max_degree, z, out);
    ps_gsl_leave();
}
