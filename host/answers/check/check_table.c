#include "answers/check/check_table.h"

#include "answers/spectra/spectrum_header.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const torus_columns[] = {"bin",
                                            "frequency",
                                            "saved",
                                            "saved_error",
                                            "measured",
                                            "measured_error",
                                            "z_score",
                                            "p_value",
                                            "adjusted_p_value",
                                            "detectable_change",
                                            "verdict"};
enum { NUM_COLUMNS = sizeof torus_columns / sizeof torus_columns[0] };

/* first: of the columns above that the table has. */
static pspec_status add_rows(ps_table *table, const ps_check_results *results, size_t first,
                             ps_error *error) {
    const ps_saved_spectrum *const measured = results->measured;
    for (size_t b = 0; b < measured->num_bins; b++) {
        const ps_comparison *const row = &results->rows[b];
        const ps_saved_bin *const saved = &results->saved->bins[b];
        const ps_cell cells[NUM_COLUMNS] = {
            PS_INTEGER(saved->key),
            PS_NUMBER(measured->bins[b].frequency),
            PS_NUMBER(saved->power),
            ps_number_or_missing(saved->standard_error),
            PS_NUMBER(measured->bins[b].power),
            ps_number_or_missing(measured->bins[b].standard_error),
            PS_NUMBER(row->score),
            PS_NUMBER(row->p_value),
            PS_NUMBER(row->adjusted_p_value),
            ps_number_or_missing(row->detectable),
            PS_TEXT(row->differs ? "different" : "same"),
        };
        PS_TRY(ps_table_add_row(table, cells + first, error));
    }
    return PSPEC_OK;
}

static double smallest_p_value(const ps_check_results *results) {
    double smallest = 1;
    for (size_t b = 0; b < results->saved->num_bins; b++) {
        smallest = fmin(smallest, results->rows[b].adjusted_p_value);
    }
    return smallest;
}

/* One seed, one sampler: the realizations are those that were saved. */
static pspec_status add_seed_note(ps_table *table, const ps_request *arguments,
                                  const ps_check_results *results, ps_error *error) {
    const ps_saved_spectrum *const saved = results->saved;
    const ps_saved_spectrum *const other = results->measured;
    const bool has_seed = results->job != NULL ? arguments->num_sources > 0 : other->has_seed;
    const uint64_t seed = results->job != NULL ? arguments->seed : other->seed;
    return has_seed && saved->has_seed && seed == saved->seed
               ? ps_table_add_meta(table, "note",
                                   PS_TEXT("the seed is that of the saved spectrum: realizations "
                                           "of the same sampler are the same, not independent"),
                                   error)
               : PSPEC_OK;
}

static pspec_status add_verdict(ps_table *table, const ps_request *arguments,
                                const ps_check_results *results, ps_error *error) {
    enum { TEXT_BYTES = 96 };
    char text[TEXT_BYTES];
    const ps_saved_spectrum *const saved = results->saved;
    snprintf(text, sizeof text, "%zu of %zu %ss", results->num_different, saved->num_bins,
             ps_check_bin_name(saved));
    PS_TRY(ps_table_add_meta(table, "against", PS_TEXT(arguments->against), error));
    PS_TRY(
        ps_table_add_meta(table, "saved_realizations", PS_INTEGER(saved->num_realizations), error));
    PS_TRY(ps_table_add_meta(table, "false_alarm_rate", PS_NUMBER(arguments->false_alarm_rate),
                             error));
    PS_TRY(ps_table_add_meta(table, "different", PS_TEXT(text), error));
    PS_TRY(
        ps_table_add_meta(table, "adjusted_p_value", PS_NUMBER(smallest_p_value(results)), error));
    PS_TRY(ps_table_add_meta(table, "verdict",
                             PS_TEXT(results->num_different > 0 ? "different" : "same"), error));
    return add_seed_note(table, arguments, results, error);
}

static pspec_status begin_saved(ps_table *table, const ps_request *arguments, ps_error *error) {
    const ps_meta entries[] = {{"pointspec_version", PS_TEXT(pspec_version())},
                               {"schema", PS_INTEGER(PS_TABLE_SCHEMA)},
                               {"command", PS_TEXT(arguments->command_line)},
                               {"measured", PS_TEXT(arguments->files[0])}};
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

static pspec_status end_saved(ps_table *table, const ps_saved_spectrum *measured, ps_error *error) {
    const ps_points_range range = {measured->mean_points, measured->smallest_points,
                                   measured->largest_points};
    const ps_meta entries[] = {
        {"realizations", PS_INTEGER(measured->num_realizations)},
        {measured->on_sphere ? "max_degree" : "max_frequency", PS_INTEGER(measured->max_frequency)},
        {"device", PS_TEXT("none")},
        {"engine", PS_TEXT("none")},
        {"predicted_error", PS_NUMBER(measured->error)},
        {"skipped", PS_TEXT("all spectra: both sides were saved")}};
    PS_TRY(ps_header_add_points(table, &range, range.smallest < range.largest, error));
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

static pspec_status fill(ps_table *table, const ps_request *arguments,
                         const ps_check_results *results, size_t first, ps_error *error) {
    const ps_power_job *const job = results->job;
    PS_TRY(job != NULL ? ps_header_add_job(table, arguments, &job, 1, 0, true, error)
                       : begin_saved(table, arguments, error));
    PS_TRY(add_verdict(table, arguments, results, error));
    PS_TRY(job != NULL ? ps_header_add_job(table, arguments, &job, 1, 0, false, error)
                       : end_saved(table, results->measured, error));
    return add_rows(table, results, first, error);
}

pspec_status ps_check_table(ps_table **out, const ps_request *arguments,
                            const ps_check_results *results, ps_error *error) {
    /* a degree is its own frequency */
    const bool on_sphere = results->saved->on_sphere;
    const size_t first = on_sphere ? 1 : 0;
    const char *columns[NUM_COLUMNS];
    memcpy(columns, torus_columns, sizeof columns);
    if (on_sphere) {
        columns[first] = "degree";
    }
    PS_TRY(ps_table_create(out, "check", columns + first, NUM_COLUMNS - first, error));
    const pspec_status status = fill(*out, arguments, results, first, error);
    if (status != PSPEC_OK) {
        ps_table_destroy(*out);
        *out = NULL;
    }
    return status;
}
