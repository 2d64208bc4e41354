#include "answers/spectra/pairs_table.h"

#include "answers/spectra/job_table.h"
#include "answers/spectra/spectrum_header.h"

static const char *const columns[] = {"degree", "legendre_sum", "legendre_sum_error", "c2",
                                      "c2_error"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };

static pspec_status add_degrees(ps_table *table, const ps_request *arguments,
                                const ps_power_job *job, const ps_lead *lead, ps_error *error) {
    (void)arguments;
    const ps_spectrum *spectrum = ps_power_job_spectrum(job);
    const ps_mean *c2 = ps_power_job_c2(job);
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *bin = &spectrum->bins[b];
        const ps_cell cells[NUM_COLUMNS] = {
            PS_INTEGER(bin->key),
            PS_NUMBER(bin->power),
            ps_number_or_missing(bin->standard_error),
            PS_NUMBER(c2[b].mean),
            ps_number_or_missing(c2[b].standard_error),
        };
        PS_TRY(ps_lead_add_row(table, lead, cells, NUM_COLUMNS, error));
    }
    return PSPEC_OK;
}

pspec_status ps_pairs_table(ps_table **out, const ps_request *arguments,
                            const ps_power_job *const *jobs, size_t num, ps_error *error) {
    const ps_job_table kind = {"pairs", columns, NUM_COLUMNS, add_degrees};
    return ps_job_table_make(out, &kind, arguments, jobs, num, error);
}
