#include "integrands/brdf_kind.h"

#include "base/text.h"

#include <math.h>

double ps_zonal_at_pole(size_t l) {
    return sqrt((2 * (double)l + 1) / PS_FOUR_PI);
}

pspec_status ps_brdf_read_exponent(ps_brdf *brdf, const char *text, ps_error *error) {
    if (text[0] == '\0') {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "BRDF %s needs its exponent, as in %s:n=30", brdf->kind->name,
                       brdf->kind->name);
    }
    return ps_parse_number(text, "exponent n of the lobe", PS_LEAST_LOBE, PS_MOST_LOBE,
                           &brdf->exponent, error);
}
