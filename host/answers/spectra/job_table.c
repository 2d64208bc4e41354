#include "answers/spectra/job_table.h"

#include "answers/spectra/spectrum_header.h"

static pspec_status fill(ps_table *table, const ps_job_table *kind, const ps_request *arguments,
                         const ps_measured *all, size_t num, ps_error *error) {
    PS_TRY(ps_header_begin(table, arguments, all, error));
    for (size_t i = 0; i < num; i++) {
        PS_TRY(ps_header_add(table, arguments, all, num, i, error));
        PS_TRY(kind->add_rows(table, arguments, &all[i], error));
    }
    return PSPEC_OK;
}

pspec_status ps_job_table_make(ps_table **out, const ps_job_table *kind,
                               const ps_request *arguments, const ps_measured *all, size_t num,
                               ps_error *error) {
    PS_TRY(ps_lead_create_table(out, kind->name, &all[0].lead, kind->columns, kind->num_columns,
                                error));
    const pspec_status status = fill(*out, kind, arguments, all, num, error);
    if (status != PSPEC_OK) {
        ps_table_destroy(*out);
        *out = NULL;
    }
    return status;
}
