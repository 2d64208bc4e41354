#include "answers/spectra/angular_table.h"

#include "answers/spectra/job_table.h"
#include "answers/spectra/spectrum_header.h"

static const char *const columns[] = {"degree", "normalized_degree", "power", "standard_error"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };

static pspec_status add_degrees(ps_table *table, const ps_request *arguments,
                                const ps_power_job *job, const ps_lead *lead, ps_error *error) {
    (void)arguments;
    const ps_spectrum *spectrum = ps_power_job_spectrum(job);
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *bin = &spectrum->bins[b];
        const ps_cell cells[NUM_COLUMNS] = {
            PS_INTEGER(bin->key),
            PS_NUMBER(bin->normalized_frequency),
            PS_NUMBER(bin->power),
            ps_number_or_missing(bin->standard_error),
        };
        PS_TRY(ps_lead_add_row(table, lead, cells, NUM_COLUMNS, error));
    }
    return PSPEC_OK;
}

pspec_status ps_angular_table(ps_table **out, const ps_request *arguments,
                              const ps_power_job *const *jobs, size_t num, ps_error *error) {
    const ps_job_table kind = {"angular", columns, NUM_COLUMNS, add_degrees};
    return ps_job_table_make(out, &kind, arguments, jobs, num, error);
}
