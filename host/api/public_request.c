#include "api/public_request.h"

#include "base/memory.h"
#include "engines/engine.h"
#include "frequencies/frequency_sample.h"

#include <string.h>

/* ---- what both have ---------------------------------------------------------------------- */

pspec_status ps_public_parse_precision(const char *name, int *out, ps_error *error) {
    *out = -1;
    for (int precision = PS_SINGLE; name != NULL && precision <= PS_EXTENDED; precision++) {
        if (strcmp(name, ps_precision_name((ps_precision)precision)) == 0) {
            *out = precision;
        }
    }
    return name == NULL || *out >= 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "precision \"%s\" is none of single, double, extended", name);
}

pspec_status ps_public_check_size(size_t found, size_t expected, const char *begin_with,
                                  ps_error *error) {
    return found == expected ? PSPEC_OK
                             : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                                       "struct_size is %zu instead of %zu: begin with %s", found,
                                       expected, begin_with);
}

static pspec_status check_common(const ps_public_request *request, ps_error *error) {
    if (request->num_points == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "num_points is 0");
    }
    if (!(request->tolerance > 0 && request->tolerance <= 1) || !(request->floor >= 0)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "tolerance %g must be above 0 and at most 1, floor %g not below 0",
                       request->tolerance, request->floor);
    }
    if (request->normalization != PSPEC_NORMALIZATION_POWER &&
        request->normalization != PSPEC_NORMALIZATION_EFFECTIVE &&
        request->normalization != PSPEC_NORMALIZATION_INTEGRAL &&
        !(request->is_on_sphere && request->normalization == PSPEC_NORMALIZATION_PAIRS)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no normalization %d",
                       (int)request->normalization);
    }
    return PSPEC_OK;
}

/* ---- the torus --------------------------------------------------------------------------- */

static pspec_status draw_frequencies(ps_frequencies *out, const pspec_power_request *request,
                                     const ps_bin_rule *bins, ps_error *error) {
    const ps_frequency_sample sample = {.dimension = request->dimension,
                                        .max_frequency = request->max_frequency,
                                        .bins = *bins,
                                        .per_ring = request->per_ring,
                                        .seed = request->per_ring_seed};
    return ps_frequencies_sample(out, &sample, error);
}

static pspec_status set_frequencies(ps_frequencies *out, const pspec_power_request *request,
                                    ps_error *error) {
    void *copy = NULL;
    size_t num_components = 0;
    const size_t num = request->num_frequencies;
    ps_bin_rule bins = {.kind = PS_BINS_ROUND};
    if (request->bins != NULL) {
        PS_TRY(ps_bin_rule_parse(&bins, "bins", request->bins, error));
        ps_bin_rule_resolve(&bins, request->dimension, request->num_points);
    }
    if (request->per_ring > 0) {
        return draw_frequencies(out, request, &bins, error);
    }
    if (request->frequencies == NULL) {
        return ps_frequencies_grid(out, request->dimension, request->max_frequency,
                                   request->rings_only != 0, &bins, PS_OFFER_RINGS | PS_OFFER_LISTS,
                                   error);
    }
    if (num == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "the list of frequencies is empty");
    }
    if (!ps_size_multiply(num, request->dimension, &num_components)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "%zu frequencies are too many", num);
    }
    PS_TRY(ps_allocate(&copy, num_components, sizeof(int32_t), "frequencies", error));
    memcpy(copy, request->frequencies, num_components * sizeof(int32_t));
    return ps_frequencies_list(out, request->dimension, num, copy, error);
}

static pspec_status check_power(const pspec_power_request *request, ps_error *error) {
    if (request == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no request");
    }
    PS_TRY(ps_public_check_size(request->struct_size, sizeof *request, "PSPEC_POWER_REQUEST_INIT",
                                error));
    if (request->dimension < 1 || request->dimension > PS_MAX_DIMENSION) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "dimension %u is not between 1 and %d",
                       request->dimension, PS_MAX_DIMENSION);
    }
    if (request->frequencies != NULL &&
        (request->bins != NULL || request->rings_only != 0 || request->per_ring != 0)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "bins, rings_only and per_ring are for grids; a list is not "
                       "averaged");
    }
    return PSPEC_OK;
}

pspec_status ps_public_request_power(ps_public_request *out, const pspec_power_request *request,
                                     ps_error *error) {
    PS_TRY(check_power(request, error));
    *out = (ps_public_request){.num_points = request->num_points,
                               .num_realizations = request->num_realizations,
                               .normalization = request->normalization,
                               .tolerance = request->tolerance,
                               .floor = request->floor,
                               .engine = request->engine,
                               .no_self_check = request->no_self_check != 0};
    PS_TRY(check_common(out, error));
    PS_TRY(ps_public_parse_precision(request->precision, &out->precision, error));
    return set_frequencies(&out->frequencies, request, error);
}

/* ---- the sphere -------------------------------------------------------------------------- */

pspec_status ps_public_request_angular(ps_public_request *out, const pspec_angular_request *request,
                                       ps_error *error) {
    if (request == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no request");
    }
    PS_TRY(ps_public_check_size(request->struct_size, sizeof *request, "PSPEC_ANGULAR_REQUEST_INIT",
                                error));
    *out = (ps_public_request){.num_points = request->num_points,
                               .num_realizations = request->num_realizations,
                               .normalization = request->normalization,
                               .tolerance = request->tolerance,
                               .floor = request->floor,
                               .engine = request->engine,
                               .is_on_sphere = true,
                               .want_c2 = request->want_c2 != 0,
                               .no_self_check = request->no_self_check != 0};
    PS_TRY(check_common(out, error));
    if (out->want_c2 && out->normalization != PSPEC_NORMALIZATION_PAIRS) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "want_c2 is for PSPEC_NORMALIZATION_PAIRS");
    }
    PS_TRY(ps_public_parse_precision(request->precision, &out->precision, error));
    return ps_frequencies_degrees(&out->frequencies, request->max_degree, request->hemisphere != 0,
                                  error);
}
