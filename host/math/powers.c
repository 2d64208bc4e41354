#define PRECISION 64

#include "math/sobolev.h"

#include "base/wide.h"
#include "shared/power.h"

PS_WIDE_BODY(int, raise, (double exponent, double *values)) {
    double own[PS_POWERS]; /* overlaps nothing */
    memcpy(own, values, sizeof own);
    for (int i = 0; i < PS_POWERS; i++) {
        own[i] = power_of(own[i], exponent);
    }
    memcpy(values, own, sizeof own);
    return PS_POWERS;
}

PS_WIDE(int, raise, (double exponent, double *values), (exponent, values))

void ps_powers(double exponent, double values[PS_POWERS]) {
    raise(exponent, values);
}
