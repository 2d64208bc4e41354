#include "spectra/shape/shape.h"

#include <math.h>

pspec_status ps_shape_find(ps_shape *out, const ps_spectrum *spectrum, double exponent,
                           ps_error *error) {
    *out = (ps_shape){0};
    const pspec_status status = ps_low_end_fit(&out->low, spectrum, &out->low_reason);
    if (status == PSPEC_ERROR_MEMORY) {
        *error = out->low_reason;
        return status;
    }
    if (isnan(exponent) && status != PSPEC_OK) {
        out->above_reason = out->low_reason;
        out->below_reason = out->low_reason;
        return PSPEC_OK;
    }
    /* That of the law is taken to be whole, as those of P15 are, also where there is a small
     * plateau. */
    const double own = isnan(exponent) ? fmax(round(out->low.exponent), 0) : exponent;
    out->above_reason.status = ps_bound_above(&out->above, spectrum, own, &out->above_reason);
    out->below_reason.status = ps_bound_below(&out->below, spectrum, own, &out->below_reason);
    return PSPEC_OK;
}
