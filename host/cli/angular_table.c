#include "cli/angular_table.h"

#include "cli/spectrum_header.h"

static const char *const columns[] = {"sampler", "degree", "normalized_degree", "power",
                                      "standard_error"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };

static pspec_status add_degrees(ps_table *table, const ps_spectrum *spectrum, const char *sampler,
                                ps_error *error) {
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *bin = &spectrum->bins[b];
        const ps_cell cells[NUM_COLUMNS] = {
            PS_TEXT(sampler),
            PS_INTEGER(bin->key),
            PS_NUMBER(bin->normalized_frequency),
            PS_NUMBER(bin->power),
            ps_number_or_missing(bin->standard_error),
        };
        PS_TRY(ps_table_add_row(table, sampler != NULL ? cells : cells + 1, error));
    }
    return PSPEC_OK;
}

static pspec_status fill(ps_table *table, const ps_arguments *arguments,
                         const ps_power_job *const *jobs, size_t num, ps_error *error) {
    PS_TRY(ps_header_begin(table, arguments, jobs[0], error));
    for (size_t i = 0; i < num; i++) {
        const char *sampler = arguments->num_samplers > 1 ? arguments->samplers[i] : NULL;
        PS_TRY(ps_header_add_job(table, arguments, jobs[i], i, error));
        PS_TRY(add_degrees(table, ps_power_job_spectrum(jobs[i]), sampler, error));
    }
    return PSPEC_OK;
}

pspec_status ps_angular_table(ps_table **out, const ps_arguments *arguments,
                              const ps_power_job *const *jobs, size_t num, ps_error *error) {
    const size_t first = arguments->num_samplers > 1 ? 0 : 1;
    PS_TRY(ps_table_create(out, "angular", columns + first, NUM_COLUMNS - first, error));
    const pspec_status status = fill(*out, arguments, jobs, num, error);
    if (status != PSPEC_OK) {
        ps_table_destroy(*out);
        *out = NULL;
    }
    return status;
}
