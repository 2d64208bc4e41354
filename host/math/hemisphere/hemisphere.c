#include "math/hemisphere/hemisphere.h"

#include <math.h>

bool ps_hemisphere_stretch(const double *u, double *out) {
    const double rho = hypot(u[0], u[1]);
    const double length = hypot(rho, u[2]);
    /* 1 - z without cancellation near the pole; it doubles. */
    const double t = 2 * (rho / length) * (rho / (length + u[2]));
    const double stretched = sqrt(t * fmax(2 - t, 0));
    if (!(u[2] >= 0)) {
        return false;
    }
    out[0] = rho > 0 ? u[0] / rho * stretched : 0;
    out[1] = rho > 0 ? u[1] / rho * stretched : 0;
    out[2] = 1 - t;
    return true;
}
