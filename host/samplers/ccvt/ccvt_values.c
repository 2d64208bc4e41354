#include "samplers/ccvt/ccvt_values.h"

#include "base/text.h"

#include <math.h>
#include <stdio.h>

enum { CAPACITY };

pspec_status ps_ccvt_capacity(const ps_sampler_request *request, size_t *capacity,
                              ps_error *error) {
    enum { WORDS = 64 };
    char what[WORDS];
    uint64_t value = 0;
    (void)snprintf(what, sizeof what, "sampler %s: M", request->sampler->name);
    PS_TRY(ps_parse_count(request->values[CAPACITY], what, PS_CCVT_LEAST_CAPACITY,
                          PS_CCVT_MOST_CAPACITY, &value, error));
    *capacity = (size_t)value;
    return ps_ccvt_check(request->num_points, value, error);
}

pspec_status ps_ccvt_check_request(const ps_sampler_request *request, ps_error *error) {
    size_t capacity = 0;
    return ps_ccvt_capacity(request, &capacity, error);
}

double ps_ccvt_seconds(const ps_sampler_request *request, double each, double root) {
    const double microsecond = 1e-6;
    const double few = 64;
    const double many = 512;
    const double num = (double)request->num_points;
    size_t capacity = 0;
    if (ps_ccvt_capacity(request, &capacity, NULL) != PSPEC_OK) {
        return 0;
    }
    const double m = (double)capacity;
    const double growth = m / few * (1 + m / many) / (1 + few / many);
    return num * (each + root * sqrt(num)) * growth * microsecond;
}
