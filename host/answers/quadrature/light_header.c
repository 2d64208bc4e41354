#include "answers/quadrature/light_header.h"
#include "answers/spectra/spectrum_header.h"

#include "request/options.h"

pspec_status ps_light_check(const ps_request *request, bool is_needed, ps_error *error) {
    const size_t num = request->num_integrands;
    return num <= 1 && num + (is_needed ? 0 : 1) >= 1 && request->integrands_given.num == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "one --integrand is the light, as in --integrand map:file=sky.hdr, and "
                         "%zu were given",
                         num);
}

pspec_status ps_light_add_header(ps_table *table, const ps_request *request, const ps_light *light,
                                 ps_error *error) {
    const ps_meta entries[] = {
        {"light_degree", PS_INTEGER(light->max_degree)},
        {"shading_bound", PS_NUMBER(light->shading_bound)},
    };
    PS_TRY(ps_header_add_integrand(table, request->integrands[0], light->integrand, error));
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

const ps_field_row ps_fields_light[] = {
    {"integrand", "", PS_ENTRY, 0, "--integrand", "the light"},
    {"integral", "", PS_ENTRY, 0, "--integrand", "its integral over the sphere"},
    {"integrand_note", "", PS_ENTRY, 0, "where there is something to say",
     "what else there is to know of it"},
    {"light_degree", "", PS_ENTRY, 0, "--integrand",
     "the last degree of light in exact integrals and predictions"},
    {"shading_bound", "", PS_ENTRY, 0, "--integrand",
     "what exact integrals cannot be off by more than, at any orientation"},
    {.name = NULL}};
