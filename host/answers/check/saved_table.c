/* Tables of pointspec power and angular as JSON, read back. */
#include "answers/check/saved_spectrum.h"
#include "base/memory.h"
#include "frequencies/frequencies.h"
#include "tables/table.h"

#include <cJSON.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Whole numbers up to here are exact in a double, which cJSON keeps numbers in. */
#define MOST_EXACT ((uint64_t)1 << 53)

/* Powers and their errors whose squares, of up to 2^53 realizations, are numbers. */
#define MOST_POWER 1e140

typedef struct reader {
    ps_saved_spectrum *out;
    const cJSON *root, *meta;
    const char *name;
    ps_error *error;
} reader;

static pspec_status fail_damaged(const reader *source, const char *what) {
    return ps_fail(source->error, PSPEC_ERROR_INPUT, "\"%s\": %s", source->name, what);
}

/* ---- single values ----------------------------------------------------------------------- */

static bool take_whole(const cJSON *item, uint64_t least, uint64_t most, uint64_t *out) {
    const bool is_good = cJSON_IsNumber(item) && item->valuedouble >= (double)least &&
                         item->valuedouble <= (double)most &&
                         item->valuedouble == floor(item->valuedouble);
    *out = is_good ? (uint64_t)item->valuedouble : 0;
    return is_good;
}

/* A value of the header, the first where there is an array of them. */
static const cJSON *entry(const reader *source, const char *key) {
    const cJSON *const item = cJSON_GetObjectItemCaseSensitive(source->meta, key);
    return cJSON_IsArray(item) ? item->child : item;
}

static pspec_status need_whole(const reader *source, const char *key, uint64_t most,
                               uint64_t *out) {
    return take_whole(entry(source, key), 1, most, out)
               ? PSPEC_OK
               : ps_fail(source->error, PSPEC_ERROR_INPUT,
                         "\"%s\": \"%s\" of \"meta\" is not a whole number from 1 to %llu",
                         source->name, key, (unsigned long long)most);
}

static bool begins_with(const cJSON *item, const char *beginning) {
    return cJSON_IsString(item) && strncmp(item->valuestring, beginning, strlen(beginning)) == 0;
}

/* ---- header ------------------------------------------------------------------------------ */

/* Before the range had keys of its own: "mean 1023.5, from 1000 to 1040". */
static bool take_old_range(ps_saved_spectrum *out, const cJSON *item) {
    unsigned long long smallest = 0;
    unsigned long long largest = 0;
    const bool is_read =
        cJSON_IsString(item) && sscanf(item->valuestring, "mean %lf, from %llu to %llu",
                                       &out->mean_points, &smallest, &largest) == 3;
    out->smallest_points = smallest;
    out->largest_points = largest;
    return is_read && smallest > 0 && largest <= MOST_EXACT;
}

/* One number, or the mean of several with the smallest and the largest. */
static pspec_status read_points(const reader *source) {
    const cJSON *const item = entry(source, "points");
    const cJSON *const smallest = entry(source, "points_smallest");
    ps_saved_spectrum *const out = source->out;
    if (smallest == NULL && !cJSON_IsString(item)) {
        PS_TRY(need_whole(source, "points", MOST_EXACT, &out->smallest_points));
        out->largest_points = out->smallest_points;
        out->mean_points = (double)out->smallest_points;
        return PSPEC_OK;
    }
    if (smallest != NULL) {
        PS_TRY(need_whole(source, "points_smallest", MOST_EXACT, &out->smallest_points));
        PS_TRY(need_whole(source, "points_largest", MOST_EXACT, &out->largest_points));
        out->mean_points = cJSON_IsNumber(item) ? item->valuedouble : 0;
    } else if (!take_old_range(out, item)) {
        out->mean_points = 0;
    }
    return out->mean_points >= (double)out->smallest_points &&
                   out->mean_points <= (double)out->largest_points && out->mean_points > 0
               ? PSPEC_OK
               : fail_damaged(source, "\"points\" of \"meta\" is not in their range");
}

/* Before the normalization of integrals had a name, power was that where N differed. */
static bool is_of_integrals(const cJSON *item) {
    static const char *const old[] = {"power: N |S|^2 / (sum w)^2", "power: N Q(l) / (sum w)^2"};
    return cJSON_IsString(item) &&
           (strcmp(item->valuestring, old[0]) == 0 || strcmp(item->valuestring, old[1]) == 0);
}

static pspec_status read_normalization(const reader *source) {
    static const struct {
        const char *beginning;
        pspec_normalization normalization;
    } words[] = {{"effective", PSPEC_NORMALIZATION_EFFECTIVE},
                 {"integral", PSPEC_NORMALIZATION_INTEGRAL},
                 {"power", PSPEC_NORMALIZATION_POWER}};
    const cJSON *const item = entry(source, "normalization");
    ps_saved_spectrum *const out = source->out;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (begins_with(item, words[i].beginning)) {
            const bool is_old = is_of_integrals(item) && out->smallest_points < out->largest_points;
            out->normalization = is_old ? PSPEC_NORMALIZATION_INTEGRAL : words[i].normalization;
            return PSPEC_OK;
        }
    }
    return fail_damaged(source,
                        "\"normalization\" of \"meta\" is none of power, effective, integral");
}

/* Tables of rings by rounding say nothing. */
static pspec_status read_bins(const reader *source) {
    const cJSON *const item = entry(source, "bins");
    ps_saved_spectrum *const out = source->out;
    if (item == NULL || cJSON_IsNull(item)) {
        return PSPEC_OK;
    }
    if (!cJSON_IsString(item) ||
        ps_bin_rule_parse(&out->bin_rule, "bins", item->valuestring, NULL) != PSPEC_OK) {
        return fail_damaged(source, "\"bins\" of \"meta\" is none of " PS_BIN_RULES);
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
    if (entry(source, "per_ring") == NULL) {
        return PSPEC_OK;
    }
    PS_TRY(need_whole(source, "per_ring", PS_MAX_NUM_FREQUENCIES, &out->per_ring));
    return out->has_seed
               ? PSPEC_OK
               : fail_damaged(source, "\"seed\" of \"meta\", which the random subset of every ring "
                                      "depends on, is not a whole number from 0 to 2^53");
}

static pspec_status read_header(const reader *source) {
    const cJSON *const error = entry(source, "predicted_error");
    PS_TRY(need_whole(source, "realizations", MOST_EXACT, &source->out->num_realizations));
    PS_TRY(read_points(source));
    PS_TRY(read_normalization(source));
    PS_TRY(read_domain(source));
    if (!cJSON_IsNumber(error) || !(error->valuedouble >= 0 && isfinite(error->valuedouble))) {
        return fail_damaged(source, "\"predicted_error\" of \"meta\" is not a number from 0 on");
    }
    source->out->error = error->valuedouble;
    return read_subset(source);
}

/* ---- rows -------------------------------------------------------------------------------- */

/* What its rows have. */
typedef struct layout {
    const char *key;
    bool has_frequency, has_count;
    int num;
} layout;

static bool has_column(const cJSON *columns, const char *name) {
    const cJSON *column = NULL;
    cJSON_ArrayForEach(column, columns) {
        if (cJSON_IsString(column) && strcmp(column->valuestring, name) == 0) {
            return true;
        }
    }
    return false;
}

static pspec_status find_layout(const reader *source, layout *out) {
    const cJSON *const columns = cJSON_GetObjectItemCaseSensitive(source->root, "columns");
    if (has_column(columns, "sampler") || has_column(columns, "points")) {
        return fail_damaged(source, "this is the table of several samplers or numbers of points; "
                                    "save one of them alone");
    }
    if (has_column(columns, "k1")) {
        return fail_damaged(source,
                            "this is a list of frequencies, and rings are compared; save one "
                            "without --frequencies");
    }
    *out = (layout){.key = source->out->on_sphere ? "degree" : "bin",
                    .has_frequency = has_column(columns, "frequency"),
                    .has_count = has_column(columns, "count"),
                    .num = cJSON_GetArraySize(columns)};
    return has_column(columns, out->key) && has_column(columns, "power") &&
                   has_column(columns, "standard_error") &&
                   (source->out->on_sphere || out->has_frequency)
               ? PSPEC_OK
               : fail_damaged(source, "\"columns\" are not those of pointspec power or angular");
}

/* null where there is one realization, and only there. */
static bool take_standard_error(const ps_saved_spectrum *out, const cJSON *item, double *value) {
    *value = cJSON_IsNumber(item) ? item->valuedouble : NAN;
    return out->num_realizations == 1 || (*value >= 0 && *value <= MOST_POWER);
}

static const cJSON *cell_of(const cJSON *row, const char *name) {
    return cJSON_GetObjectItemCaseSensitive(row, name);
}

static bool take_row(ps_saved_spectrum *out, const layout *rows, const cJSON *row) {
    ps_saved_bin *const bin = &out->bins[out->num_bins];
    /* Degree 1, or any bin: boxes that are no cubes have frequencies below 1/2. */
    const int64_t first = out->on_sphere ? 1 : 0;
    const uint64_t least =
        (uint64_t)(out->num_bins == 0 ? first : out->bins[out->num_bins - 1].key + 1);
    const cJSON *const number = cell_of(row, rows->key);
    const cJSON *const power = cell_of(row, "power");
    const cJSON *const where = rows->has_frequency ? cell_of(row, "frequency") : number;
    uint64_t key = 0;
    if (!cJSON_IsObject(row) || cJSON_GetArraySize(row) != rows->num ||
        !take_whole(number, least, MOST_EXACT, &key) || !cJSON_IsNumber(power) ||
        !(power->valuedouble >= 0 && power->valuedouble <= MOST_POWER) || !cJSON_IsNumber(where) ||
        (rows->has_count && !take_whole(cell_of(row, "count"), 1, MOST_EXACT, &bin->count)) ||
        !take_standard_error(out, cell_of(row, "standard_error"), &bin->standard_error)) {
        return false;
    }
    bin->key = (int64_t)key;
    bin->power = power->valuedouble;
    bin->frequency = where->valuedouble;
    out->num_bins++;
    return true;
}

static pspec_status read_rows(const reader *source) {
    const cJSON *const rows = cJSON_GetObjectItemCaseSensitive(source->root, "rows");
    const cJSON *row = NULL;
    ps_saved_spectrum *const out = source->out;
    layout all = {0};
    PS_TRY(find_layout(source, &all));
    if (!cJSON_IsArray(rows) || rows->child == NULL) {
        return fail_damaged(source, "there are no \"rows\"");
    }
    PS_TRY(PS_NEW(&out->bins, (size_t)cJSON_GetArraySize(rows), "saved bins", source->error));
    cJSON_ArrayForEach(row, rows) {
        if (!take_row(out, &all, row)) {
            return ps_fail(source->error, PSPEC_ERROR_INPUT,
                           "\"%s\": row %zu is not what pointspec power or angular writes",
                           source->name, out->num_bins + 1);
        }
    }
    return PSPEC_OK;
}

/* ---- all --------------------------------------------------------------------------------- */

static pspec_status read_root(reader *source) {
    const cJSON *const schema = cJSON_GetObjectItemCaseSensitive(source->root, "schema");
    const cJSON *const command = cJSON_GetObjectItemCaseSensitive(source->root, "command");
    source->meta = cJSON_GetObjectItemCaseSensitive(source->root, "meta");
    if (!cJSON_IsNumber(schema) || schema->valuedouble != PS_TABLE_SCHEMA ||
        !cJSON_IsString(command) || !cJSON_IsObject(source->meta)) {
        return fail_damaged(source, "this is no table of this version of pointspec "
                                    "(\"schema\": 3): save the spectrum again");
    }
    source->out->on_sphere = strcmp(command->valuestring, "angular") == 0;
    if (!source->out->on_sphere && strcmp(command->valuestring, "power") != 0) {
        return fail_damaged(source,
                            "this is the table of another command; those of pointspec power "
                            "and angular are compared");
    }
    PS_TRY(read_header(source));
    return read_rows(source);
}

/* cJSON tells where it stopped, but not why: that may have been a lack of memory, too. */
static pspec_status fail_parse(const char *text, const char *end, const char *name,
                               ps_error *error) {
    return end != NULL ? ps_fail(error, PSPEC_ERROR_INPUT, "\"%s\" is damaged: no JSON at byte %zu",
                                 name, (size_t)(end - text) + 1)
                       : ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for \"%s\"", name);
}

static const char *skip_blanks(const char *at, const char *end) {
    while (at < end && strchr(" \t\r\n", *at) != NULL && *at != '\0') {
        at++;
    }
    return at;
}

/* The text of a saved table. */
typedef struct saved_text {
    const char *begin, *end, *name;
    ps_error *error;
} saved_text;

static pspec_status fail_at(const saved_text *text, const char *at, const char *what) {
    return ps_fail(text->error, PSPEC_ERROR_INPUT, "\"%s\" is damaged: %s at byte %zu", text->name,
                   what, (size_t)(at - text->begin) + 1);
}

/* One line of JSON Lines, an object; *at: its beginning, then its end. */
static pspec_status take_line(cJSON *rows, const saved_text *text, const char **at) {
    const char *next = NULL;
    cJSON *const row = cJSON_ParseWithLengthOpts(*at, (size_t)(text->end - *at), &next, false);
    if (row == NULL && next == NULL) {
        return fail_parse(text->begin, NULL, text->name, text->error);
    }
    if (!cJSON_IsObject(row) || !cJSON_AddItemToArray(rows, row)) {
        cJSON_Delete(row);
        return fail_at(text, *at, "no row of JSON Lines");
    }
    *at = next;
    return PSPEC_OK;
}

/* Nothing follows a table; lines, each a row, follow the head of JSON Lines. */
static pspec_status take_rest(cJSON *root, const saved_text *text, const char *at) {
    at = skip_blanks(at, text->end);
    if (cJSON_GetObjectItemCaseSensitive(root, "rows") != NULL) {
        return at == text->end ? PSPEC_OK : fail_at(text, at, "there is more behind the table,");
    }
    cJSON *const rows = cJSON_AddArrayToObject(root, "rows");
    if (rows == NULL) {
        return fail_parse(text->begin, NULL, text->name, text->error);
    }
    for (; at < text->end; at = skip_blanks(at, text->end)) {
        PS_TRY(take_line(rows, text, &at));
    }
    return PSPEC_OK;
}

pspec_status ps_saved_table_parse(ps_saved_spectrum *out, const char *text, size_t num_bytes,
                                  const char *name, ps_error *error) {
    const char *end = NULL;
    cJSON *const root = cJSON_ParseWithLengthOpts(text, num_bytes, &end, false);
    const saved_text whole = {text, text + num_bytes, name, error};
    reader source = {.out = out, .root = root, .name = name, .error = error};
    pspec_status status =
        root != NULL ? take_rest(root, &whole, end) : fail_parse(text, end, name, error);
    if (status == PSPEC_OK) {
        status = read_root(&source);
    }
    cJSON_Delete(root);
    return status;
}
