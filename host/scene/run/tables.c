/* The tables of a scene: of every result the rows of all its questions, and a summary with a row
 * for each. */
#include "base/memory.h"
#include "scene/run/run.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void ps_run_label(const ps_run_result *result, size_t number, ps_text *out) {
    const ps_scene_result *const asked = result->asked;
    bool is_first = true;
    for (size_t i = 0; i < asked->num_entries; i++) {
        if (ps_run_varies(&asked->entries[i])) {
            ps_text_append(out, "%s%s", is_first ? "" : ", ",
                           ps_scene_value_of(asked, number, i)->label);
            is_first = false;
        }
    }
    for (size_t i = 0; i < asked->num_entries && is_first; i++) {
        const int option = asked->entries[i].option;
        const ps_scene_value *const value = &asked->entries[i].values[0];
        const bool is_one =
            asked->entries[i].num_more == 0 &&
            (option != PS_OPTION_SAMPLER || value->set != NULL || value->num_texts == 1);
        if (is_one &&
            (option == PS_OPTION_SAMPLER || option == PS_SCENE_FILES || option == PS_OPTION_BRDF)) {
            ps_text_append(out, "%s", value->label);
            is_first = false;
        }
    }
    ps_text_append(out, "%s", is_first ? asked->kind->name : "");
}

/* ---- what all tables have ---------------------------------------------------------------- */

static pspec_status begin(ps_table **out, const ps_run *run, const ps_run_result *result,
                          const char *const *columns, size_t num_columns, ps_error *error) {
    const ps_scene *const scene = run->scene;
    PS_TRY(ps_table_create(out, result->asked->kind->name, columns, num_columns, error));
    PS_TRY(ps_lead_add_origin(*out, NULL, error));
    PS_TRY(
        ps_table_add_meta(*out, "scene", PS_TEXT(scene->title != NULL ? scene->title : ""), error));
    return ps_table_add_meta(*out, "result", PS_TEXT(result->asked->name), error);
}

/* Values that vary come first; whole numbers stay numbers. */
static ps_cell value_cell(const ps_scene_value *value) {
    char *end = NULL;
    errno = 0;
    const long long whole = strtoll(value->label, &end, 10);
    return *end == '\0' && errno == 0 ? PS_INTEGER(whole) : PS_TEXT(value->label);
}

static size_t count_varying(const ps_run_result *result) {
    size_t num = 0;
    for (size_t i = 0; i < result->asked->num_entries; i++) {
        num += ps_run_varies(&result->asked->entries[i]);
    }
    return num;
}

/* beside: a table whose own columns come behind, NULL: none. One that has the name of a key says
 * more than the key, as numbers of points do that were made instead of asked for. */
static bool is_first_column(const ps_scene_entry *entry, const ps_table *beside) {
    size_t column = 0;
    return ps_run_varies(entry) &&
           (beside == NULL || !ps_table_find_column(beside, ps_scene_key(entry), &column));
}

static size_t put_values(const ps_run_result *result, size_t number, const ps_table *beside,
                         ps_cell *cells) {
    size_t num = 0;
    for (size_t i = 0; i < result->asked->num_entries; i++) {
        if (is_first_column(&result->asked->entries[i], beside)) {
            cells[num++] = value_cell(ps_scene_value_of(result->asked, number, i));
        }
    }
    return num;
}

static size_t put_names(const ps_run_result *result, const ps_table *beside, const char **columns) {
    size_t num = 0;
    for (size_t i = 0; i < result->asked->num_entries; i++) {
        if (is_first_column(&result->asked->entries[i], beside)) {
            columns[num++] = ps_scene_key(&result->asked->entries[i]);
        }
    }
    return num;
}

/* ---- all rows ---------------------------------------------------------------------------- */

/* The header of every question, after its command line. */
static pspec_status add_header(ps_table *table, const ps_table *answer, ps_error *error) {
    for (size_t i = 0; i < ps_table_num_meta(answer); i++) {
        const char *key = NULL;
        const ps_cell value = ps_table_meta(answer, i, &key);
        if (strcmp(key, "pointspec_version") != 0 && strcmp(key, "schema") != 0) {
            PS_TRY(ps_table_add_meta(table, key, value, error));
        }
    }
    return PSPEC_OK;
}

static pspec_status add_rows(ps_table *table, const ps_run_result *result, size_t number,
                             ps_cell *cells, ps_error *error) {
    const ps_table *const answer = result->questions[number].answer.table;
    const size_t num = put_values(result, number, answer, cells);
    for (size_t row = 0; row < ps_table_num_rows(answer); row++) {
        for (size_t column = 0; column < ps_table_num_columns(answer); column++) {
            cells[num + column] = ps_table_cell(answer, row, column);
        }
        PS_TRY(ps_table_add_row(table, cells, error));
    }
    return PSPEC_OK;
}

/* names and cells: [columns], memory for both. */
static pspec_status fill_table(const ps_run *run, ps_run_result *result, const char **names,
                               ps_cell *cells, ps_error *error) {
    const ps_table *const first = result->questions[0].answer.table;
    const size_t num = put_names(result, first, names);
    for (size_t i = 0; i < ps_table_num_columns(first); i++) {
        names[num + i] = ps_table_column_name(first, i);
    }
    PS_TRY(begin(&result->table, run, result, names, num + ps_table_num_columns(first), error));
    for (size_t q = 0; q < result->num; q++) {
        PS_TRY(add_header(result->table, result->questions[q].answer.table, error));
    }
    for (size_t q = 0; q < result->num; q++) {
        PS_TRY(add_rows(result->table, result, q, cells, error));
    }
    return PSPEC_OK;
}

static bool have_same_columns(const ps_table *a, const ps_table *b) {
    const size_t num = ps_table_num_columns(a);
    bool is_same = num == ps_table_num_columns(b);
    for (size_t i = 0; is_same && i < num; i++) {
        is_same = strcmp(ps_table_column_name(a, i), ps_table_column_name(b, i)) == 0;
    }
    return is_same;
}

/* Spectra on the torus and on the sphere have other columns, and so may files with other domains.
 */
static pspec_status check_columns(const ps_run *run, const ps_run_result *result, ps_error *error) {
    const ps_table *const first = result->questions[0].answer.table;
    for (size_t q = 1; q < result->num; q++) {
        if (!have_same_columns(result->questions[q].answer.table, first)) {
            (void)ps_fail(error, PSPEC_ERROR_INPUT,
                          "its questions have tables with other columns; let them be results of "
                          "their own");
            return ps_scene_blame(run->scene, result->asked, error);
        }
    }
    return PSPEC_OK;
}

static pspec_status make_table(const ps_run *run, ps_run_result *result, ps_error *error) {
    void *names = NULL;
    void *cells = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY(check_columns(run, result, error));
    const size_t num =
        count_varying(result) + ps_table_num_columns(result->questions[0].answer.table);
    PS_TRY_OUT(status, ps_allocate(&names, num, sizeof(char *), "names of columns", error));
    PS_TRY_OUT(status, ps_allocate(&cells, num, sizeof(ps_cell), "a row", error));
    status = fill_table(run, result, names, cells, error);
out:
    free(names);
    free(cells);
    return status;
}

/* ---- summaries --------------------------------------------------------------------------- */

enum { MOST_KEYS = 16, MOST_SUMMARY_COLUMNS = PS_NUM_OPTIONS + 1 + MOST_KEYS };

/* Entries that no answer has, as the range of N where all sets have one N, are no columns. */
static bool has_answers_with(const ps_run_result *result, const char *wanted) {
    for (size_t q = 0; q < result->num; q++) {
        const ps_table *const answer = result->questions[q].answer.table;
        for (size_t i = 0; i < ps_table_num_meta(answer); i++) {
            const char *key = NULL;
            (void)ps_table_meta(answer, i, &key);
            if (strcmp(key, wanted) == 0) {
                return true;
            }
        }
    }
    return false;
}

static size_t put_keys(const ps_run_result *result, const char **names, size_t num) {
    const char *const *const keys = result->asked->kind->summary;
    for (size_t k = 0; keys[k] != NULL; k++) {
        bool is_known = false; /* points may vary, and then come first already */
        for (size_t i = 0; i < num; i++) {
            is_known = is_known || strcmp(names[i], keys[k]) == 0;
        }
        if (!is_known && has_answers_with(result, keys[k])) {
            names[num++] = keys[k];
        }
    }
    return num;
}

static bool are_same(ps_cell a, ps_cell b) {
    return a.kind == b.kind && a.number == b.number && a.integer == b.integer &&
           (a.kind != PS_CELL_TEXT || strcmp(a.text, b.text) == 0);
}

/* The entry of a header. A question of several samplers and N has one for each of them: where they
 * differ, this is the least and the largest number, as after -n, and no text. */
static ps_cell sum_up(const ps_table *answer, const char *wanted, ps_text *range) {
    const ps_cell first = ps_table_find_meta(answer, wanted);
    double least = INFINITY;
    double most = -INFINITY;
    bool is_one = true;
    for (size_t i = 0; i < ps_table_num_meta(answer); i++) {
        const char *key = NULL;
        const ps_cell cell = ps_table_meta(answer, i, &key);
        if (strcmp(key, wanted) == 0) {
            is_one = is_one && are_same(cell, first);
            least = fmin(least, ps_cell_number(cell));
            most = fmax(most, ps_cell_number(cell));
        }
    }
    if (is_one || !(least < most)) {
        return is_one ? first : PS_MISSING;
    }
    ps_text_append(range, "%.10g..%.10g", least, most);
    return PS_TEXT(ps_text_string(range));
}

/* Points that vary are what the answer says: the mean where they differ from set to set. */
static pspec_status add_summary_row(const ps_run_result *result, size_t number, size_t num_values,
                                    const char *const *names, size_t num, ps_cell *cells,
                                    ps_error *error) {
    const ps_table *const answer = result->questions[number].answer.table;
    ps_text ranges[MOST_SUMMARY_COLUMNS] = {{0}};
    (void)put_values(result, number, NULL, cells);
    for (size_t i = 0; i < num; i++) {
        const bool is_said =
            i < num_values && strcmp(names[i], ps_options[PS_OPTION_POINTS].name) != 0;
        cells[i] = is_said ? cells[i] : sum_up(answer, names[i], &ranges[i]);
    }
    pspec_status status = PSPEC_OK;
    for (size_t i = 0; status == PSPEC_OK && i < num; i++) {
        status = ps_text_check(&ranges[i], error);
    }
    if (status == PSPEC_OK) {
        status = ps_table_add_row(result->summary, cells, error);
    }
    for (size_t i = 0; i < num; i++) {
        ps_text_free(&ranges[i]);
    }
    return status;
}

static pspec_status make_summary(const ps_run *run, ps_run_result *result, ps_error *error) {
    const char *names[MOST_SUMMARY_COLUMNS];
    ps_cell cells[MOST_SUMMARY_COLUMNS];
    const size_t num_values = put_names(result, NULL, names);
    const size_t num = put_keys(result, names, num_values);
    PS_TRY(begin(&result->summary, run, result, names, num, error));
    for (size_t q = 0; q < result->num; q++) {
        PS_TRY(add_summary_row(result, q, num_values, names, num, cells, error));
    }
    return PSPEC_OK;
}

pspec_status ps_run_make_tables(const ps_run *run, ps_run_result *result, ps_error *error) {
    PS_TRY(make_table(run, result, error));
    return make_summary(run, result, error);
}

/* ---- overview ---------------------------------------------------------------------------- */

static pspec_status add_result(ps_table *table, const ps_run_result *result, ps_error *error) {
    double seconds = 0;
    size_t num_cached = 0;
    for (size_t q = 0; q < result->num; q++) {
        seconds += result->questions[q].seconds;
        num_cached += result->questions[q].is_cached;
    }
    const ps_cell cells[] = {PS_TEXT(result->asked->name), PS_TEXT(result->asked->kind->name),
                             PS_INTEGER(result->num), PS_INTEGER(num_cached), PS_NUMBER(seconds)};
    return ps_table_add_row(table, cells, error);
}

pspec_status ps_run_overview(ps_table **out, const ps_run *run, ps_error *error) {
    static const char *const columns[] = {"result", "kind", "questions", "cached", "seconds"};
    const char *const page =
        run->is_page_alone ? run->arguments->output : ps_run_find_file(run, "index.html")->path;
    PS_TRY(ps_table_create(out, "run", columns, sizeof columns / sizeof columns[0], error));
    PS_TRY(ps_table_add_meta(*out, "page", PS_TEXT(page), error));
    PS_TRY(ps_table_add_meta(*out, "seconds", PS_NUMBER(run->seconds), error));
    for (size_t i = 0; i < run->num_results; i++) {
        PS_TRY(add_result(*out, &run->results[i], error));
    }
    return PSPEC_OK;
}
