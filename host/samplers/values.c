#include "samplers/values.h"

#include "base/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static pspec_status fail_choice(const ps_sampler_request *request, unsigned i_parameter,
                                const char *const *choices, ps_error *error) {
    ps_text known = {0};
    for (unsigned i = 0; choices[i] != NULL; i++) {
        ps_text_append(&known, "%s%s", i > 0 ? ", " : "", choices[i]);
    }
    const pspec_status status =
        ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "sampler %s: %s=%s is not one of %s",
                request->sampler->name, request->sampler->parameters[i_parameter].key,
                request->values[i_parameter], ps_text_string(&known));
    ps_text_free(&known);
    return status;
}

pspec_status ps_sampler_choice(const ps_sampler_request *request, unsigned i_parameter,
                               const char *const *choices, unsigned *choice, ps_error *error) {
    for (unsigned i = 0; choices[i] != NULL; i++) {
        if (strcmp(choices[i], request->values[i_parameter]) == 0) {
            *choice = i;
            return PSPEC_OK;
        }
    }
    return fail_choice(request, i_parameter, choices, error);
}

double ps_sampler_number(const ps_sampler_request *request, unsigned i_parameter) {
    double number = 0;
    return ps_parse_number(request->values[i_parameter], "", -HUGE_VAL, HUGE_VAL, &number, NULL) ==
                   PSPEC_OK
               ? number
               : 0;
}

bool ps_sampler_counts(const char *text, uint64_t counts[PS_MAX_DIMENSION], unsigned *num_counts) {
    enum { MOST_DIGITS = 13 }; /* 2^40, the most points that any request has, has 13 */
    for (*num_counts = 0; *num_counts < PS_MAX_DIMENSION;) {
        const size_t num_digits = strspn(text, "0123456789");
        if (num_digits == 0 || num_digits > MOST_DIGITS) {
            return false;
        }
        counts[(*num_counts)++] = strtoull(text, NULL, 10);
        text += num_digits;
        if (*text == '\0') {
            return counts[*num_counts - 1] > 0;
        }
        if (*text++ != 'x' || counts[*num_counts - 1] == 0) {
            return false;
        }
    }
    return false;
}

bool ps_sampler_always(const ps_sampler_request *request) {
    (void)request;
    return true;
}

bool ps_sampler_never(const ps_sampler_request *request) {
    (void)request;
    return false;
}

pspec_status ps_sampler_limit_points(const ps_sampler_request *request, uint64_t limit,
                                     ps_error *error) {
    if (request->num_points <= limit) {
        return PSPEC_OK;
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "sampler %s: %zu points are more than its limit of %llu", request->sampler->name,
                   request->num_points, (unsigned long long)limit);
}

double ps_sampler_white_power(const ps_sampler_request *request) {
    (void)request;
    return 1;
}
