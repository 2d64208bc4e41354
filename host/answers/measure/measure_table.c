/* The table of measures: a row for each measure of every question; curves as arrays. */
#include "answers/measure/measure.h"

#include "answers/spectra/spectrum_header.h"

#include <math.h>

/* ---- arrays ---------------------------------------------------------------------------------- */

enum { CURVE_NUMBERS = 3 }; /* where, value, standard error */

typedef const ps_mean *curve_of(const ps_measure_result *result);

static const ps_mean *correlation_of(const ps_measure_result *result) {
    return result->correlation;
}

static const ps_mean *number_variance_of(const ps_measure_result *result) {
    return result->number_variance;
}

/* Steps from 0 to `last` times the reach; a value is in the middle of one, or at its end. */
static pspec_status add_curves(ps_table *table, const ps_measures_asked *self, const char *name,
                               curve_of *of, size_t num, double last, double within,
                               ps_error *error) {
    const size_t shape[] = {self->list.num, num, CURVE_NUMBERS};
    const bool is_one = self->list.num == 1;
    ps_npy_array array;
    PS_TRY(ps_npy_make_array(&array, is_one ? 2 : 3, shape + is_one, false, error));
    for (size_t q = 0; q < self->list.num; q++) {
        const ps_mean *const curve = of(&self->results[q]);
        for (size_t i = 0; i < num; i++) {
            double *const numbers = array.data + (q * num + i) * CURVE_NUMBERS;
            numbers[0] = self->results[q].reach * last * ((double)i + within) / (double)num;
            numbers[1] = curve[i].mean;
            numbers[2] = curve[i].standard_error;
        }
    }
    return ps_table_add_array(table, name, false, &array, error);
}

static pspec_status add_arrays(ps_table *table, const ps_measures_asked *self, ps_error *error) {
    const double middle = 0.5;
    if (isnan(self->results[0].reach)) {
        return PSPEC_OK; /* nothing that was named looks at pairs */
    }
    PS_TRY(
        add_curves(table, self, "pair_correlation", correlation_of, NEAR_BINS, 1, middle, error));
    return self->questions[0].spectrum.on_sphere
               ? PSPEC_OK
               : add_curves(table, self, "number_variance", number_variance_of, NEAR_WINDOWS,
                            middle, 1, error);
}

/* ---- rows ------------------------------------------------------------------------------------ */

static const char *const columns[] = {"measure", "value", "standard_error"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };

static pspec_status add_rows(ps_table *table, const ps_lead *lead, const ps_measure_result *result,
                             ps_error *error) {
    for (size_t i = 0; i < PS_NUM_MEASURES; i++) {
        const ps_mean *const value = &result->values[i];
        const ps_cell cells[NUM_COLUMNS] = {
            PS_TEXT(ps_measure_rows[i].name), ps_number_or_missing(value->mean),
            isnan(value->mean) ? PS_MISSING : ps_number_or_missing(value->standard_error)};
        if ((result->known >> i & 1) != 0) {
            PS_TRY(ps_lead_add_row(table, lead, cells, NUM_COLUMNS, error));
        }
    }
    return PSPEC_OK;
}

/* ---- header ---------------------------------------------------------------------------------- */

static void append_left_out(ps_text *out, const ps_measure_result *result) {
    for (size_t i = 0; i < PS_NUM_MEASURES; i++) {
        if ((result->left_out >> i & 1) != 0) {
            ps_text_append(out, "%s%s", out->length == 0 ? "" : ", ", ps_measure_rows[i].name);
        }
    }
    ps_text_append(
        out, out->length == 0 ? "none" : ": sets are too large to have them unasked (--measures)");
}

static pspec_status add_skipped(ps_table *table, const ps_measure_result *result, ps_error *error) {
    ps_text text = {0};
    append_left_out(&text, result);
    pspec_status status = ps_text_check(&text, error);
    if (status == PSPEC_OK) {
        status = ps_table_add_meta(table, "skipped", PS_TEXT(ps_text_string(&text)), error);
    }
    ps_text_free(&text);
    return status;
}

static pspec_status add_spectrum(ps_table *table, const ps_measure_result *result,
                                 ps_error *error) {
    const ps_power_job *const job = result->spectrum;
    if (job == NULL) {
        return PSPEC_OK;
    }
    const ps_frequencies *const set = &job->spectrum.frequencies;
    const bool on_sphere = set->kind == PS_FREQUENCIES_DEGREES;
    const ps_meta entries[] = {
        {on_sphere ? "max_degree" : "max_frequency",
         PS_INTEGER(on_sphere ? set->max_frequency : ps_frequencies_reach(set))},
        {"engine", PS_TEXT(ps_text_string(&job->description))},
        {"predicted_error", PS_NUMBER(job->runner.accuracy.error)}};
    PS_TRY(ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error));
    return result->no_exponent.status == PSPEC_OK
               ? PSPEC_OK
               : ps_table_add_meta(table, "low_exponent_note", PS_TEXT(result->no_exponent.message),
                                   error);
}

static pspec_status add_one(ps_table *table, const ps_request *request,
                            const ps_measures_asked *self, size_t i, ps_error *error) {
    const ps_power_question *const question = &self->questions[i].spectrum;
    const ps_measure_result *const result = &self->results[i];
    const ps_points_range range = {result->mean_points, result->smallest_points,
                                   result->largest_points};
    const ps_lead lead = ps_lead_make(request, i);
    PS_TRY(ps_lead_add_source(table, request, i, error));
    if (question->sampler == NULL) {
        PS_TRY(ps_header_add_files(table, question->paths, question->num_paths,
                                   result->num_realizations, ", one average", error));
        PS_TRY(ps_header_add_lift(table, &question->point_options, error));
    }
    PS_TRY(ps_header_add_points(table, &range, range.smallest != range.largest, error));
    PS_TRY(ps_table_add_meta(table, "realizations", PS_INTEGER(result->num_realizations), error));
    PS_TRY(ps_table_add_meta(
        table, question->on_sphere ? "domain" : "dimension",
        question->on_sphere ? PS_TEXT("sphere") : PS_INTEGER(result->dimension), error));
    PS_TRY(add_spectrum(table, result, error));
    PS_TRY(add_skipped(table, result, error));
    return add_rows(table, &lead, result, error);
}

pspec_status ps_measure_tabulate(ps_answer *out, const void *computed, const ps_request *request,
                                 ps_error *error) {
    const ps_measures_asked *const self = computed;
    const ps_lead first = ps_lead_make(request, 0);
    PS_TRY(ps_lead_create_table(&out->table, "measure", &first, columns, NUM_COLUMNS, error));
    PS_TRY(ps_lead_add_origin(out->table, request->command_line, error));
    const ps_meta entries[] = {{"seed", PS_INTEGER(request->seed)},
                               {"device", PS_TEXT(ps_device_get_limits(self->device)->name)}};
    PS_TRY(ps_table_add_metas(out->table, entries, sizeof entries / sizeof entries[0], error));
    for (size_t i = 0; i < self->list.num; i++) {
        PS_TRY(add_one(out->table, request, self, i, error));
    }
    return add_arrays(out->table, self, error);
}

/* ---- what it declares ------------------------------------------------------------------------ */

const ps_field_row ps_fields_measure[] = {
    {"low_exponent_note", "", PS_ENTRIES, 0, "no exponent", "why there is none"},
    {"measure", "", PS_COLUMN, 0, "", "its name, as --measures takes it"},
    {"value", "", PS_COLUMN, 0, "",
     "mean over realizations, of measures of spectra that of the mean spectrum"},
    {"standard_error", "", PS_COLUMN, 0, "", "its standard error over realizations"},
    {"pair_correlation", "", PS_ARRAY, 0, "NPZ",
     "r, g and its standard error of 200 bins of distances, float64 [200][3], of several questions "
     "one such array each; r in units of N^(-1/d), on the sphere a chord in units of sqrt(4 pi/N)"},
    {"number_variance", "", PS_ARRAY, 0, "NPZ, on the torus",
     "R, variance of the number of points in a ball of radius R anywhere, and its standard error, "
     "float64 [16][3]"},
    {.name = NULL}};
