#include "answers/check/saved_spectrum.h"

#include "base/memory.h"
#include "files/input_file.h"
#include "frequencies/frequencies.h"
#include "request/file_list.h"
#include "spectra/compare.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Whole numbers up to here are exact in a double. */
#define MOST_EXACT ((uint64_t)1 << 53)

/* Powers and their errors whose squares, of up to 2^53 realizations, are numbers. */
#define MOST_POWER 1e140

typedef struct reader {
    ps_saved_spectrum *out;
    const ps_table *table;
    const char *name;
    ps_error *error;
} reader;

static pspec_status fail_damaged(const reader *source, const char *what) {
    return ps_fail(source->error, PSPEC_ERROR_INPUT, "\"%s\": %s", source->name, what);
}

/* ---- single values ----------------------------------------------------------------------- */

static bool take_whole(ps_cell cell, uint64_t least, uint64_t most, uint64_t *out) {
    const double value = ps_cell_number(cell);
    const bool is_good = value >= (double)least && value <= (double)most && value == floor(value);
    *out = is_good ? (uint64_t)value : 0;
    return is_good;
}

/* A value of the header, the first of several. */
static ps_cell entry(const reader *source, const char *key) {
    return ps_table_find_meta(source->table, key);
}

static pspec_status need_whole(const reader *source, const char *key, uint64_t most,
                               uint64_t *out) {
    return take_whole(entry(source, key), 1, most, out)
               ? PSPEC_OK
               : ps_fail(source->error, PSPEC_ERROR_INPUT,
                         "\"%s\": \"%s\" of its header is not a whole number from 1 to %llu",
                         source->name, key, (unsigned long long)most);
}

static bool begins_with(ps_cell cell, const char *beginning) {
    return cell.kind == PS_CELL_TEXT && strncmp(cell.text, beginning, strlen(beginning)) == 0;
}

/* ---- header ------------------------------------------------------------------------------ */

/* One number, or the mean of several with the smallest and the largest. */
static pspec_status read_points(const reader *source) {
    ps_saved_spectrum *const out = source->out;
    if (entry(source, "points_smallest").kind == PS_CELL_MISSING) {
        PS_TRY(need_whole(source, "points", MOST_EXACT, &out->smallest_points));
        out->largest_points = out->smallest_points;
        out->mean_points = (double)out->smallest_points;
        return PSPEC_OK;
    }
    PS_TRY(need_whole(source, "points_smallest", MOST_EXACT, &out->smallest_points));
    PS_TRY(need_whole(source, "points_largest", MOST_EXACT, &out->largest_points));
    out->mean_points = ps_cell_number(entry(source, "points"));
    return out->mean_points >= (double)out->smallest_points &&
                   out->mean_points <= (double)out->largest_points
               ? PSPEC_OK
               : fail_damaged(source, "\"points\" of its header is not in their range");
}

static pspec_status read_normalization(const reader *source) {
    static const struct {
        const char *beginning;
        pspec_normalization normalization;
    } words[] = {{"effective", PSPEC_NORMALIZATION_EFFECTIVE},
                 {"integral", PSPEC_NORMALIZATION_INTEGRAL},
                 {"power", PSPEC_NORMALIZATION_POWER}};
    const ps_cell value = entry(source, "normalization");
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (begins_with(value, words[i].beginning)) {
            source->out->normalization = words[i].normalization;
            return PSPEC_OK;
        }
    }
    return fail_damaged(source,
                        "\"normalization\" of its header is none of power, effective, integral");
}

/* Tables of rings by rounding say nothing. */
static pspec_status read_bins(const reader *source) {
    const ps_cell value = entry(source, "bins");
    ps_saved_spectrum *const out = source->out;
    if (value.kind == PS_CELL_MISSING) {
        return PSPEC_OK;
    }
    if (value.kind != PS_CELL_TEXT ||
        ps_bin_rule_parse(&out->bin_rule, "bins", value.text, NULL) != PSPEC_OK) {
        return fail_damaged(source, "\"bins\" of its header is none of " PS_BIN_RULES);
    }
    ps_bin_rule_resolve(&out->bin_rule, out->dimension, out->smallest_points);
    return PSPEC_OK;
}

static pspec_status read_domain(const reader *source) {
    ps_saved_spectrum *const out = source->out;
    uint64_t number = 0;
    if (out->on_sphere) {
        out->on_hemisphere = begins_with(entry(source, "domain"), "hemisphere");
        out->dimension = PS_SPHERE_DIMENSION;
        PS_TRY(need_whole(source, "max_degree", PS_MAX_DEGREE, &number));
    } else {
        PS_TRY(need_whole(source, "dimension", PS_MAX_DIMENSION, &number));
        out->dimension = (unsigned)number;
        PS_TRY(need_whole(source, "max_frequency", PS_MAX_FREQUENCY, &number));
        PS_TRY(read_bins(source));
    }
    out->max_frequency = (int32_t)number;
    return PSPEC_OK;
}

/* The same subset is drawn again only with the same seed. */
static pspec_status read_subset(const reader *source) {
    ps_saved_spectrum *const out = source->out;
    out->has_seed = take_whole(entry(source, "seed"), 0, MOST_EXACT, &out->seed);
    if (entry(source, "per_ring").kind == PS_CELL_MISSING) {
        return PSPEC_OK;
    }
    PS_TRY(need_whole(source, "per_ring", PS_MAX_NUM_FREQUENCIES, &out->per_ring));
    return out->has_seed
               ? PSPEC_OK
               : fail_damaged(source,
                              "\"seed\" of its header, which the random subset of every ring "
                              "depends on, is not a whole number from 0 to 2^53");
}

static pspec_status read_header(const reader *source) {
    const double error = ps_cell_number(entry(source, "predicted_error"));
    PS_TRY(need_whole(source, "realizations", MOST_EXACT, &source->out->num_realizations));
    PS_TRY(read_points(source));
    PS_TRY(read_normalization(source));
    PS_TRY(read_domain(source));
    if (!(error >= 0 && isfinite(error))) {
        return fail_damaged(source, "\"predicted_error\" of its header is not a number from 0 on");
    }
    source->out->error = error;
    return read_subset(source);
}

/* ---- rows -------------------------------------------------------------------------------- */

/* Columns, those that are not there beyond all. */
typedef struct layout {
    size_t key, frequency, count, power, standard_error;
} layout;

static bool find_column(const reader *source, const char *name, size_t *column) {
    *column = SIZE_MAX;
    return ps_table_find_column(source->table, name, column);
}

static pspec_status find_layout(const reader *source, layout *out) {
    const bool on_sphere = source->out->on_sphere;
    size_t other = 0;
    if (find_column(source, "sampler", &other) || find_column(source, "points", &other)) {
        return fail_damaged(source, "this is the table of several samplers or numbers of points; "
                                    "save one of them alone");
    }
    if (find_column(source, "k1", &other)) {
        return fail_damaged(source,
                            "this is a list of frequencies, and rings are compared; save one "
                            "without --frequencies");
    }
    (void)find_column(source, "count", &out->count);
    return find_column(source, on_sphere ? "degree" : "bin", &out->key) &&
                   find_column(source, "power", &out->power) &&
                   find_column(source, "standard_error", &out->standard_error) &&
                   (find_column(source, "frequency", &out->frequency) || on_sphere)
               ? PSPEC_OK
               : fail_damaged(source, "its columns are not those of pointspec power or angular");
}

static ps_cell cell_of(const reader *source, size_t row, size_t column) {
    return column < SIZE_MAX ? ps_table_cell(source->table, row, column) : PS_MISSING;
}

/* Missing where there is one realization, and only there. */
static bool take_standard_error(const ps_saved_spectrum *out, ps_cell cell, double *value) {
    *value = ps_cell_number(cell);
    return out->num_realizations == 1 || (*value >= 0 && *value <= MOST_POWER);
}

static bool take_row(const reader *source, const layout *at, size_t row) {
    ps_saved_spectrum *const out = source->out;
    ps_saved_bin *const bin = &out->bins[row];
    /* Degree 1, or any bin: boxes that are no cubes have frequencies below 1/2. */
    const int64_t first = out->on_sphere ? 1 : 0;
    const uint64_t least = (uint64_t)(row == 0 ? first : out->bins[row - 1].key + 1);
    uint64_t key = 0;
    if (!take_whole(cell_of(source, row, at->key), least, MOST_EXACT, &key) ||
        (at->count < SIZE_MAX &&
         !take_whole(cell_of(source, row, at->count), 1, MOST_EXACT, &bin->count)) ||
        !take_standard_error(out, cell_of(source, row, at->standard_error), &bin->standard_error)) {
        return false;
    }
    bin->key = (int64_t)key;
    bin->power = ps_cell_number(cell_of(source, row, at->power));
    bin->frequency = at->frequency < SIZE_MAX ? ps_cell_number(cell_of(source, row, at->frequency))
                                              : (double)key;
    return bin->power >= 0 && bin->power <= MOST_POWER && !isnan(bin->frequency);
}

static pspec_status read_rows(const reader *source) {
    const size_t num = ps_table_num_rows(source->table);
    ps_saved_spectrum *const out = source->out;
    layout at;
    PS_TRY(find_layout(source, &at));
    if (num == 0) {
        return fail_damaged(source, "there are no rows");
    }
    PS_TRY(PS_NEW(&out->bins, num, "saved bins", source->error));
    out->num_bins = num;
    for (size_t row = 0; row < num; row++) {
        if (!take_row(source, &at, row)) {
            return ps_fail(source->error, PSPEC_ERROR_INPUT,
                           "\"%s\": row %zu is not what pointspec power or angular writes",
                           source->name, row + 1);
        }
    }
    return PSPEC_OK;
}

/* ---- all --------------------------------------------------------------------------------- */

pspec_status ps_saved_table_take(ps_saved_spectrum *out, const ps_table *table, const char *name,
                                 ps_error *error) {
    const reader source = {out, table, name, error};
    const char *const command = ps_table_command(table);
    out->on_sphere = strcmp(command, "angular") == 0;
    if (!out->on_sphere && strcmp(command, "power") != 0) {
        return fail_damaged(&source,
                            "this is the table of another command; those of pointspec power "
                            "and angular are compared");
    }
    PS_TRY(read_header(&source));
    return read_rows(&source);
}

/* ---- files ------------------------------------------------------------------------------- */

/* What a table says by its columns and numbers of points: weights are taken to be equal. */
static void complete(ps_saved_spectrum *out) {
    const ps_frequencies set = {.kind =
                                    out->on_sphere ? PS_FREQUENCIES_DEGREES : PS_FREQUENCIES_BOX,
                                .dimension = out->dimension,
                                .max_frequency = out->max_frequency,
                                .degree_step = out->on_hemisphere ? 2 : 1};
    const uint64_t most = out->per_ring > 0 ? 2 * out->per_ring : UINT64_MAX;
    out->sample_size = out->mean_points;
    /* a subset has those of its rings */
    out->modes = out->per_ring > 0 ? 0 : ps_compared_modes(&set);
    for (size_t b = 0; b < out->num_bins; b++) {
        ps_saved_bin *const bin = &out->bins[b];
        bin->num_computed = bin->count < most ? bin->count : most;
        out->modes += out->per_ring > 0 ? (double)bin->num_computed : 0;
    }
}

static pspec_status read_table(ps_saved_spectrum *out, const char *path, ps_error *error) {
    ps_table *table = NULL;
    PS_TRY(ps_table_read_npz(&table, path, error));
    const pspec_status status = ps_saved_table_take(out, table, path, error);
    ps_table_destroy(table);
    if (status == PSPEC_OK) {
        complete(out);
    }
    return status;
}

/* ---- which ------------------------------------------------------------------------------- */

/* A stream would lose what is looked at, and points may come by one. */
pspec_status ps_saved_spectrum_find(bool *is_one, const char *path, ps_error *error) {
    struct stat facts;
    ps_error reason = {0};
    *is_one = false;
    if (strcmp(path, "-") == 0) {
        return PSPEC_OK;
    }
    if (stat(path, &facts) != 0) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot read %s: %s", path, strerror(errno));
    }
    PS_TRY(ps_table_is_npz(is_one, path, error));
    const pspec_status status = *is_one ? PSPEC_OK : ps_saved_result_find(is_one, path, &reason);
    return status == PSPEC_OK || status == PSPEC_ERROR_INPUT
               ? PSPEC_OK
               : ps_fail(error, status, "%s", reason.message);
}

/* What cannot be read is told as such. */
static pspec_status refuse_other(const char *path, ps_error *error) {
    ps_input input = {0};
    const pspec_status status = ps_input_open(&input, path, error);
    ps_input_close(&input);
    return status != PSPEC_OK ? status
                              : ps_fail(error, PSPEC_ERROR_INPUT,
                                        "\"%s\" is no saved spectrum: pointspec power and angular "
                                        "save one with -o FILE.npz",
                                        path);
}

pspec_status ps_saved_spectrum_read(ps_saved_spectrum *out, const char *path, ps_error *error) {
    *out = (ps_saved_spectrum){0};
    if (strcmp(path, "-") == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "a saved spectrum is a file, and standard input is none");
    }
    bool is_one = false;
    PS_TRY(ps_table_is_npz(&is_one, path, error));
    const pspec_status status = is_one ? read_table(out, path, error) : refuse_other(path, error);
    if (status != PSPEC_OK) {
        ps_saved_spectrum_free(out);
    }
    return status;
}

void ps_saved_spectrum_free(ps_saved_spectrum *saved) {
    free(saved->bins);
    *saved = (ps_saved_spectrum){0};
}
