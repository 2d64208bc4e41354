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
static pspec_status add_rows(ps_table *table, const ps_check *check, size_t first,
                             ps_error *error) {
    const ps_saved_spectrum *const measured = &check->measured;
    for (size_t b = 0; b < measured->num_bins; b++) {
        const ps_comparison *const row = &check->rows[b];
        const ps_saved_bin *const saved = &check->saved.bins[b];
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

static double smallest_p_value(const ps_check *check) {
    double smallest = 1;
    for (size_t b = 0; b < check->saved.num_bins; b++) {
        smallest = fmin(smallest, check->rows[b].adjusted_p_value);
    }
    return smallest;
}

/* One seed, one sampler: the realizations are those that were saved. */
static pspec_status add_seed_note(ps_table *table, const ps_check *check, ps_error *error) {
    const ps_saved_spectrum *const saved = &check->saved;
    const ps_saved_spectrum *const other = &check->measured;
    const bool has_seed = check->job != NULL ? check->own.num_sources > 0 : other->has_seed;
    const uint64_t seed = check->job != NULL ? check->own.seed : other->seed;
    return has_seed && saved->has_seed && seed == saved->seed
               ? ps_table_add_meta(table, "note",
                                   PS_TEXT("the seed is that of the saved spectrum: realizations "
                                           "of the same sampler are the same, not independent"),
                                   error)
               : PSPEC_OK;
}

static pspec_status add_verdict(ps_table *table, const ps_check *check, ps_error *error) {
    enum { TEXT_BYTES = 96 };
    char text[TEXT_BYTES];
    const ps_saved_spectrum *const saved = &check->saved;
    snprintf(text, sizeof text, "%zu of %zu %ss", check->num_different, saved->num_bins,
             ps_check_bin_name(saved));
    PS_TRY(ps_table_add_meta(table, "against", PS_TEXT(check->own.against), error));
    PS_TRY(
        ps_table_add_meta(table, "saved_realizations", PS_INTEGER(saved->num_realizations), error));
    PS_TRY(ps_verdict_add(table, check->own.false_alarm_rate, text, smallest_p_value(check),
                          check->num_different > 0, error));
    return add_seed_note(table, check, error);
}

static pspec_status begin_saved(ps_table *table, const ps_request *arguments, ps_error *error) {
    PS_TRY(ps_lead_add_origin(table, arguments->command_line, error));
    return ps_table_add_meta(table, "measured", PS_TEXT(arguments->files[0]), error);
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

pspec_status ps_check_table(ps_table **out, const ps_check *check, ps_error *error) {
    /* a degree is its own frequency */
    const bool on_sphere = check->saved.on_sphere;
    const size_t first = on_sphere ? 1 : 0;
    const ps_power_job *const job = check->job;
    const char *columns[NUM_COLUMNS];
    memcpy(columns, torus_columns, sizeof columns);
    if (on_sphere) {
        columns[first] = "degree";
    }
    PS_TRY(ps_table_create(out, "check", columns + first, NUM_COLUMNS - first, error));
    PS_TRY(job != NULL ? ps_header_add_job(*out, &check->own, job, true, error)
                       : begin_saved(*out, &check->own, error));
    PS_TRY(add_verdict(*out, check, error));
    PS_TRY(job != NULL ? ps_header_add_job(*out, &check->own, job, false, error)
                       : end_saved(*out, &check->measured, error));
    return add_rows(*out, check, first, error);
}
