/* State of spectra, and answers that are merged by it. */
#include "answers/ranges/ranges.h"
#include "answers/spectra/spectra.h"
#include "base/memory.h"
#include "files/decimal.h"
#include "spectra/spectrum_state.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- what was asked -------------------------------------------------------------------------- */

/* What tables read of a request and sums do not have: the array state_asked. */
enum { PER_RING, STANDARD_ERROR, FLOOR, WANTS_FIT, FIT_EXPONENT, ASKED_SIZE };
static const char asked_name[] = "state_asked";

static pspec_status add_asked(ps_table *table, const ps_request *request, ps_error *error) {
    const size_t shape[] = {ASKED_SIZE};
    ps_npy_array array;
    PS_TRY(ps_npy_make_array(&array, 1, shape, false, error));
    array.data[PER_RING] = (double)request->frequencies.per_ring;
    array.data[STANDARD_ERROR] = request->accuracy.standard_error;
    array.data[FLOOR] = request->accuracy.floor;
    array.data[WANTS_FIT] = request->wants_fit;
    array.data[FIT_EXPONENT] = request->fit_exponent;
    return ps_table_add_array(table, asked_name, true, &array, error);
}

static pspec_status read_asked(ps_request *out, const ps_parts *parts, ps_error *error) {
    const ps_table *const table = parts->tables[0];
    const ps_npy_array *const array = ps_table_find_array(table, asked_name);
    *out = parts->request != NULL ? *parts->request : ps_request_default;
    out->command_line = parts->command_line;
    if (array == NULL || !ps_spectrum_state_is_there(table, 0) || array->is_complex ||
        array->num != ASKED_SIZE ||
        !(array->data[PER_RING] >= 0 && array->data[PER_RING] <= PS_MAX_NUM_FREQUENCIES)) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s has no sums over realizations, which answers are merged by: power, "
                       "angular and pairs have them in -o FILE.npz, but for --scatter",
                       parts->names[0]);
    }
    if (parts->request != NULL) {
        return PSPEC_OK;
    }
    out->wants_state = true;
    out->frequencies.per_ring = (uint64_t)array->data[PER_RING];
    out->accuracy.standard_error = array->data[STANDARD_ERROR];
    out->accuracy.floor = array->data[FLOOR];
    out->wants_fit = array->data[WANTS_FIT] > 0;
    out->fit_exponent = array->data[FIT_EXPONENT];
    out->wants_array = ps_table_find_array(table, "full") != NULL;
    out->wants_errors = ps_table_find_array(table, "full_standard_error") != NULL;
    return PSPEC_OK;
}

/* ---- of jobs --------------------------------------------------------------------------------- */

static pspec_status add_job(ps_table *table, ps_power_job *job, size_t question, ps_error *error) {
    ps_spectrum_sums sums;
    PS_TRY(ps_power_job_sums(job, &sums, error));
    const pspec_status status = ps_spectrum_state_add(table, question, &sums, error);
    ps_spectrum_sums_free(&sums);
    return status;
}

/* Coefficients of single sets, which --scatter shows, are no sums. */
pspec_status ps_spectra_add_state(ps_table *table, const ps_spectra *spectra,
                                  const ps_request *request, ps_error *error) {
    if (!request->wants_state || request->frequencies.num_shown > 0) {
        return PSPEC_OK;
    }
    for (size_t i = 0; i < spectra->list.num; i++) {
        PS_TRY(add_job(table, spectra->jobs[i], i, error));
    }
    return add_asked(table, request, error);
}

/* ---- told by parts --------------------------------------------------------------------------- */

static void append_cell(ps_text *out, const ps_cell *cell) {
    char number[PS_DECIMAL_BYTES];
    if (cell->kind == PS_CELL_TEXT) {
        ps_text_append(out, "%s", cell->text);
    } else if (cell->kind == PS_CELL_INTEGER) {
        ps_text_append(out, "%" PRId64, cell->integer);
    } else {
        number[ps_decimal_format(number, cell->number)] = '\0';
        ps_text_append(out, "%s", number);
    }
}

/* That of a question, whose entries end with `skipped`. */
static ps_cell find_entry(const ps_table *table, const char *key, size_t question, size_t index) {
    const char *name = NULL;
    size_t at = 0;
    for (size_t i = 0; i < ps_table_num_meta(table) && at <= question; i++) {
        const ps_cell cell = ps_table_meta(table, i, &name);
        if (at == question && strcmp(name, key) == 0 && index-- == 0) {
            return cell;
        }
        at += strcmp(name, "skipped") == 0;
    }
    return PS_MISSING;
}

/* What all parts tell, or each of it once: "1; 2". */
static pspec_status tell_entry(ps_table *told, const ps_parts *parts, const char *key,
                               size_t question, size_t index, bool *is_there, ps_error *error) {
    ps_text text = {0};
    ps_cell first = PS_MISSING;
    size_t num = 0;
    for (size_t p = 0; p < parts->num; p++) {
        const ps_cell cell = find_entry(parts->tables[p], key, question, index);
        bool is_new = cell.kind != PS_CELL_MISSING;
        *is_there = *is_there || is_new;
        for (size_t before = 0; is_new && before < p; before++) {
            const ps_cell other = find_entry(parts->tables[before], key, question, index);
            is_new = !ps_cells_are_same(&cell, &other);
        }
        if (is_new) {
            ps_text_append(&text, "%s", num > 0 ? "; " : "");
            append_cell(&text, &cell);
            first = num++ == 0 ? cell : first;
        }
    }
    pspec_status status = ps_text_check(&text, error);
    if (status == PSPEC_OK && num > 0) {
        status =
            ps_table_add_meta(told, key, num > 1 ? PS_TEXT(ps_text_string(&text)) : first, error);
    }
    ps_text_free(&text);
    return status;
}

static pspec_status tell_key(ps_table *told, const ps_parts *parts, const char *key,
                             size_t question, ps_error *error) {
    bool is_there = true;
    for (size_t index = 0; is_there; index++) {
        is_there = false;
        PS_TRY(tell_entry(told, parts, key, question, index, &is_there, error));
    }
    return PSPEC_OK;
}

static pspec_status tell(ps_table **out, const ps_parts *parts, size_t question, ps_error *error) {
    PS_TRY(ps_table_create(out, "", NULL, 0, error));
    ps_parts told_of = *parts;
    told_of.num = parts->request != NULL ? 1 : parts->num; /* else they are of one job */
    for (const char *const *key = ps_told_keys; *key != NULL; key++) {
        if (strcmp(*key, "merged") != 0) {
            PS_TRY(tell_key(*out, &told_of, *key, question, error));
        }
    }
    return question == 0 && parts->request == NULL ? ps_ranges_tell(*out, parts, error) : PSPEC_OK;
}

/* ---- merging --------------------------------------------------------------------------------- */

/* What is merged of a question, and the table is made of. */
typedef struct merged {
    ps_spectrum_sums sums;
    ps_bins bins;
    ps_spectrum spectrum;
    ps_mean *c2;
    ps_sequential_look look;
} merged;

static void discard(merged *self) {
    ps_spectrum_free(&self->spectrum);
    ps_spectrum_sums_free(&self->sums);
    ps_bins_free(&self->bins);
    free(self->c2);
}

/* Of ranges: where they are all of a job, for whose powers, which are known no sooner, it would
 * have been planned once more, PSPEC_ERROR_TOLERANCE. */
static pspec_status close_ranges(ps_spectrum_sums *sums, ps_error *error) {
    ps_spectrum_sums_close(sums);
    return sums->num_all > 0 || sums->error <= sums->tolerance
               ? PSPEC_OK
               : ps_range_refuse_powers(sums->error, sums->tolerance, error);
}

static pspec_status merge_sums(merged *self, const ps_parts *parts, size_t question,
                               ps_error *error) {
    PS_TRY(ps_spectrum_state_read(&self->sums, &self->bins, parts->tables[0], question,
                                  parts->names[0], error));
    for (size_t p = 1; p < parts->num; p++) {
        ps_spectrum_sums other;
        ps_bins bins;
        PS_TRY(ps_spectrum_state_read(&other, &bins, parts->tables[p], question, parts->names[p],
                                      error));
        const bool are_ranges = self->sums.num_all > 0 && other.num_all > 0;
        const pspec_status status =
            are_ranges ? ps_spectrum_sums_join(&self->sums, &other, parts->names + p - 1, error)
                       : ps_spectrum_sums_merge(&self->sums, &other, parts->names[p], error);
        ps_spectrum_sums_free(&other);
        ps_bins_free(&bins);
        PS_TRY(status);
    }
    return self->sums.num_all > 0 ? close_ranges(&self->sums, error) : PSPEC_OK;
}

static pspec_status look_at_errors(merged *self, const ps_request *request, ps_error *error) {
    ps_mean *means = NULL;
    PS_TRY(PS_NEW(&means, self->sums.num_bins, "means of bins", error));
    ps_spectrum_sums_bins(&self->sums, means);
    self->look = ps_sequential_find(&self->bins, means, request->accuracy.floor,
                                    self->sums.totals.num_realizations);
    free(means);
    return PSPEC_OK;
}

static pspec_status finish(merged *self, ps_measured *out, const ps_request *request,
                           ps_error *error) {
    const ps_spectrum_sums *const sums = &self->sums;
    const bool has_look = request->accuracy.standard_error > 0 && sums->totals.num_realizations > 1;
    PS_TRY(ps_spectrum_sums_finish(sums, &self->bins, &self->spectrum, error));
    if (sums->c2 != NULL) {
        PS_TRY(PS_NEW(&self->c2, sums->frequencies.num, "C_l^2", error));
        ps_spectrum_sums_c2(sums, self->c2);
    }
    if (has_look) {
        PS_TRY(look_at_errors(self, request, error));
    }
    out->spectrum = &self->spectrum;
    out->c2 = self->c2;
    out->are_pair_sums = sums->normalization == PSPEC_NORMALIZATION_PAIRS;
    out->is_one_for_all = sums->num_equal > 0;
    out->error = sums->error;
    out->self_check = sums->self_check;
    out->length_error = sums->length_error;
    out->look = has_look ? &self->look : NULL;
    if (sums->num_all > 0) {
        out->range.first = ps_spectrum_sums_first(sums);
        out->range.end = ps_spectrum_sums_end(sums);
        out->num_all = sums->num_all;
    }
    return PSPEC_OK;
}

/* The cells before those of a row, which begins a question. */
static ps_lead find_lead(const ps_table *table, size_t row) {
    static const char *const names[] = {"sampler", "points"};
    ps_lead out = {0};
    for (size_t column = 0; column < ps_table_num_columns(table) && row < ps_table_num_rows(table);
         column++) {
        const char *const name = ps_table_column_name(table, column);
        if (strcmp(name, names[0]) != 0 && strcmp(name, names[1]) != 0) {
            break;
        }
        out.names[out.num] = name;
        out.cells[out.num++] = ps_table_cell(table, row, column);
    }
    return out;
}

static pspec_status compare_leads(const ps_parts *parts, const ps_lead *lead, size_t row,
                                  ps_error *error) {
    for (size_t p = 1; p < parts->num; p++) {
        const ps_lead other = find_lead(parts->tables[p], row);
        bool is_one = other.num == lead->num;
        for (size_t i = 0; is_one && i < lead->num; i++) {
            is_one = ps_cells_are_same(&lead->cells[i], &other.cells[i]);
        }
        if (!is_one) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s has other samplers or numbers of points, or in another order",
                           parts->names[p]);
        }
    }
    return PSPEC_OK;
}

static size_t count_questions(const ps_table *table) {
    size_t num = 0;
    while (ps_spectrum_state_is_there(table, num)) {
        num++;
    }
    return num;
}

/* Merges and finishes all questions, and completes the request by what their sums have. */
static pspec_status merge_all(merged *each, ps_measured *all, const ps_parts *parts, size_t num,
                              ps_request *request, ps_error *error) {
    size_t row = 0;
    for (size_t i = 0; i < num; i++) {
        PS_TRY(merge_sums(&each[i], parts, i, error));
        const ps_frequencies *const set = &each[i].sums.frequencies;
        const bool is_list = set->kind == PS_FREQUENCIES_LIST && set->rings == NULL;
        request->normalization = each[i].sums.normalization;
        request->frequencies.path = is_list ? "" : NULL;
        PS_TRY(finish(&each[i], &all[i], request, error));
        PS_TRY(tell(&all[i].told, parts, i, error));
        all[i].lead = find_lead(parts->tables[0], row);
        PS_TRY(compare_leads(parts, &all[i].lead, row, error));
        row += is_list ? set->num : each[i].spectrum.num_bins;
    }
    return PSPEC_OK;
}

/* For the picture of a job. */
static pspec_status copy_first_set(ps_table *table, const ps_parts *parts, ps_error *error) {
    static const char name[] = "first_set";
    const ps_npy_array *const set =
        parts->request != NULL ? ps_table_find_array(parts->tables[0], name) : NULL;
    ps_npy_array copy;
    if (set == NULL) {
        return PSPEC_OK;
    }
    PS_TRY(ps_npy_make_array(&copy, set->rank, set->shape, false, error));
    memcpy(copy.data, set->data, set->num * sizeof *copy.data);
    return ps_table_add_array(table, name, false, &copy, error);
}

static pspec_status tabulate(ps_answer *out, merged *each, ps_measured *all, const ps_parts *parts,
                             size_t num, const ps_spectra_table *kind, ps_error *error) {
    ps_request request;
    PS_TRY(read_asked(&request, parts, error));
    PS_TRY(merge_all(each, all, parts, num, &request, error));
    PS_TRY(ps_spectra_make_table(&out->table, kind, &request, all, num, error));
    PS_TRY(copy_first_set(out->table, parts, error));
    for (size_t i = 0; i < num && request.wants_state; i++) {
        PS_TRY(ps_spectrum_state_add(out->table, i, &each[i].sums, error));
    }
    return request.wants_state ? add_asked(out->table, &request, error) : PSPEC_OK;
}

static pspec_status merge_in_order(ps_answer *out, const ps_parts *parts,
                                   const ps_spectra_table *kind, ps_error *error) {
    const size_t num = count_questions(parts->tables[0]);
    merged *each = NULL;
    ps_measured *all = NULL;
    pspec_status status = PSPEC_OK;
    for (size_t p = 1; p < parts->num; p++) {
        const size_t other = count_questions(parts->tables[p]);
        if (other != num) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s has the sums of %zu questions instead of %zu", parts->names[p],
                           other, num);
        }
    }
    PS_TRY_OUT(status, PS_NEW(&each, num, "merged sums", error));
    PS_TRY_OUT(status, PS_NEW(&all, num, "merged answers", error));
    status = tabulate(out, each, all, parts, num, kind, error);
out:
    for (size_t i = 0; each != NULL && i < num; i++) {
        discard(&each[i]);
    }
    ps_measured_free(all, num);
    free(each);
    return status;
}

pspec_status ps_spectra_merge(ps_answer *out, const ps_parts *parts, const ps_spectra_table *kind,
                              ps_error *error) {
    ps_pool memory = {0};
    ps_parts sorted;
    pspec_status status = ps_ranges_sort(&sorted, &memory, parts, error);
    if (status == PSPEC_OK) {
        status = merge_in_order(out, &sorted, kind, error);
    }
    ps_pool_free(&memory);
    return status;
}
