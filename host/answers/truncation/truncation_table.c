#include "answers/truncation/truncation_table.h"

#include "answers/spectra/spectrum_header.h"

#include <math.h>
#include <stdio.h>

static pspec_status add_header(ps_table *table, const ps_truncation_job *job,
                               const ps_request *request, ps_error *error) {
    char check[128];
    double worst = 0;
    for (size_t l = 0; l <= job->question.max_degree; l++) {
        worst = fmax(worst, job->bounds[l]);
    }
    snprintf(check, sizeof check, "sum b_l^2 to degree %zu is 1 %+.2g of its closed form",
             job->representer.max_degree, job->off);
    const char *const note = ps_brdf_note(job->brdf);
    const ps_meta entries[] = {
        {"pointspec_version", PS_TEXT(pspec_version())},
        {"schema", PS_INTEGER(PS_TABLE_SCHEMA)},
        {"command", PS_TEXT(request->command_line)},
        {"device", PS_TEXT("none")},
        {"engine", PS_TEXT("host")},
        {"precision", PS_TEXT("double")},
        {"tolerance", PS_NUMBER(PS_TRUNCATION_TOLERANCE)},
        {"predicted_error", PS_NUMBER(worst)},
        {"self_check", PS_TEXT(check)},
        {"brdf", PS_TEXT(job->question.brdf)},
        {"smoothness", PS_NUMBER(job->question.smoothness)},
        {"harmonics", PS_TEXT(job->question.is_hemispherical ? "hemispherical" : "spherical")},
        {"spherical_degrees", PS_INTEGER(job->sh_degree)},
        {"kappa_0", PS_NUMBER(job->representer.kappa_0)},
        {"equivalent_points",
         PS_TEXT(ps_brdf_morph(job->brdf).kind == PS_MORPH_NONE
                     ? "not known: no rule has the density of this lobe"
                     : "of equal-weight spherical Fibonacci points morphed to the lobe; empty "
                       "beyond 32768")},
        {"skipped", PS_TEXT("none")},
    };
    PS_TRY(ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error));
    return note != NULL ? ps_table_add_meta(table, "note", PS_TEXT(note), error) : PSPEC_OK;
}

pspec_status ps_truncation_table(ps_table **out, const ps_truncation_job *job,
                                 const ps_request *request, ps_error *error) {
    static const char *const columns[] = {"degree", "error", "equivalent_points"};
    enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };
    PS_TRY(ps_table_create(out, "truncation", columns, NUM_COLUMNS, error));
    PS_TRY(add_header(*out, job, request, error));
    for (size_t l = 0; l <= job->question.max_degree; l++) {
        const ps_cell cells[NUM_COLUMNS] = {PS_INTEGER(l), PS_NUMBER(job->errors[l]),
                                            ps_number_or_missing(job->points[l])};
        PS_TRY(ps_table_add_row(*out, cells, error));
    }
    return PSPEC_OK;
}
