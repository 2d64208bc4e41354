#include "answers/spectra/power_table.h"

#include "answers/spectra/job_table.h"
#include "answers/spectra/scatter.h"
#include "answers/spectra/shape_table.h"
#include "answers/spectra/spectrum_header.h"

#include <math.h>

/* ---- rows -------------------------------------------------------------------------------- */

enum { MOST_COLUMNS = PS_MAX_DIMENSION + 7 };

static const char *const bin_columns[] = {"bin",          "frequency", "normalized_frequency",
                                          "count",        "power",     "standard_error",
                                          "anisotropy_db"};
static const char *const axis_columns[] = {"k1", "k2", "k3", "k4", "k5", "k6"};

static pspec_status add_bins(ps_table *table, const ps_request *arguments,
                             const ps_spectrum *spectrum, const ps_lead *lead, ps_error *error) {
    ps_shape shape = {0};
    if (arguments->wants_fit) {
        PS_TRY(ps_shape_find(&shape, spectrum, arguments->fit_exponent, error));
        PS_TRY(ps_shape_add_header(table, &shape, spectrum, error));
    }
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *bin = &spectrum->bins[b];
        ps_cell cells[MOST_COLUMNS] = {
            PS_INTEGER(bin->key),
            PS_NUMBER(bin->frequency),
            PS_NUMBER(bin->normalized_frequency),
            PS_INTEGER(bin->count),
            PS_NUMBER(bin->power),
            ps_number_or_missing(bin->standard_error),
            ps_number_or_missing(bin->anisotropy_db),
        };
        const size_t num = ps_shape_add_cells(cells, sizeof bin_columns / sizeof bin_columns[0],
                                              arguments, &shape, spectrum, bin);
        PS_TRY(ps_lead_add_row(table, lead, cells, num, error));
    }
    return PSPEC_OK;
}

static pspec_status add_frequencies(ps_table *table, const ps_spectrum *spectrum,
                                    const ps_lead *lead, ps_error *error) {
    const unsigned dimension = spectrum->frequencies.dimension;
    for (size_t i = 0; i < spectrum->frequencies.num; i++) {
        ps_cell cells[MOST_COLUMNS];
        size_t num = 0;
        for (unsigned axis = 0; axis < dimension; axis++) {
            cells[num++] = PS_INTEGER(spectrum->frequencies.vectors[i * dimension + axis]);
        }
        cells[num++] = PS_NUMBER(spectrum->powers[i].mean);
        cells[num++] = ps_number_or_missing(spectrum->powers[i].standard_error);
        PS_TRY(ps_lead_add_row(table, lead, cells, num, error));
    }
    return PSPEC_OK;
}

static size_t choose_columns(const char **columns, const ps_request *arguments,
                             unsigned dimension) {
    size_t num = 0;
    if (arguments->frequencies.path != NULL) {
        for (unsigned axis = 0; axis < dimension; axis++) {
            columns[num++] = axis_columns[axis];
        }
        columns[num++] = "power";
        columns[num++] = "standard_error";
        return num;
    }
    for (size_t i = 0; i < sizeof bin_columns / sizeof bin_columns[0]; i++) {
        columns[num++] = bin_columns[i];
    }
    return ps_shape_add_columns(columns, num, arguments);
}

static pspec_status add_rows(ps_table *table, const ps_request *arguments, const ps_measured *self,
                             ps_error *error) {
    if (arguments->frequencies.num_shown > 0) {
        PS_TRY(ps_scatter_add_header(table, &arguments->frequencies, self->job, error));
    }
    return arguments->frequencies.path != NULL
               ? add_frequencies(table, self->spectrum, &self->lead, error)
               : add_bins(table, arguments, self->spectrum, &self->lead, error);
}

pspec_status ps_power_table(ps_table **out, const ps_request *arguments, const ps_measured *all,
                            size_t num, ps_error *error) {
    const char *columns[MOST_COLUMNS];
    const unsigned dimension = all[0].spectrum->frequencies.dimension;
    const size_t num_columns = choose_columns(columns, arguments, dimension);
    const ps_job_table kind = {"power", columns, num_columns, add_rows};
    PS_TRY(ps_job_table_make(out, &kind, arguments, all, num, error));
    return ps_power_add_full(*out, arguments, all[0].spectrum, error);
}
