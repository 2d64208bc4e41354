#include "math/gsl/legendre.h"

#include "math/gsl/fence.h"

#include <gsl/gsl_sf_legendre.h>

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
