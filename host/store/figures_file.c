#include "store/figures_file.h"

#include "base/process/proc_files.h"
#include "base/workers.h"
#include "device/precision.h"
#include "store/cache_trust.h"
#include "store/result_cache.h"
#include "fields/table.h"

#include "pointspec_version.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What devices can be: from a slow simulator to a rack, and nothing that a planner could stumble
 * over. */
static const double least_rate = 1e3, least_launches = 1, most_rate = 1e18;
static const double least_scale = 1e-3, most_scale = 1e3;

/* Rows are engines, and kinds of the host's work behind this. */
static const char host[] = "host:";
static const char *const columns[] = {"name", "single", "double", "extended"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };

/* Entries of the header that are rates, where they stand, and from where on they can be. */
typedef struct rate {
    const char *key;
    double *value;
    double least;
} rate;
enum { NUM_RATES = 5 };

static void list_rates(rate rates[NUM_RATES], ps_figures *figures) {
    const rate all[NUM_RATES] = {{"flops_single", &figures->flops[PS_SINGLE], least_rate},
                                 {"flops_double", &figures->flops[PS_DOUBLE], least_rate},
                                 {"copied_bytes", &figures->copied_bytes, least_rate},
                                 {"sent_bytes", &figures->sent_bytes, least_rate},
                                 {"launches", &figures->launches, least_launches}};
    memcpy(rates, all, sizeof all);
}

/* ---- where --------------------------------------------------------------------------------- */

void ps_host_describe(ps_device_limits *out) {
    *out = (ps_device_limits){0};
    if (!ps_proc_text("/proc/cpuinfo", "model name", out->name, sizeof out->name)) {
        snprintf(out->name, sizeof out->name, "unknown");
    }
    snprintf(out->platform, sizeof out->platform, "host");
    snprintf(out->driver, sizeof out->driver, "%u threads", ps_workers_most());
}

static pspec_status make_key(ps_text *key, const ps_device_limits *limits, ps_error *error) {
    ps_text_append(key, "figures %s\n%s\n%s\n%s\n", PS_VERSION, limits->name, limits->platform,
                   limits->driver);
    return ps_text_check(key, error);
}

static pspec_status name_folder(ps_text *path, const char *folder, ps_error *error) {
    ps_text_append(path, "%s/devices", folder);
    return ps_text_check(path, error);
}

/* Neither the folder nor the one in it may be another user's. */
static pspec_status open_cache(ps_cache **out, const char *folder, ps_error *error) {
    ps_text path = {0};
    pspec_status status = name_folder(&path, folder, error);
    if (status == PSPEC_OK) {
        status = ps_cache_open(out, ps_text_string(&path), INT64_MAX, error);
    }
    if (status == PSPEC_OK) {
        status = ps_cache_check_folder(folder, error);
    }
    ps_text_free(&path);
    return status;
}

pspec_status ps_figures_make_folder(const char *folder, ps_error *error) {
    ps_cache *cache = NULL;
    const pspec_status status = open_cache(&cache, folder, error);
    ps_cache_close(cache);
    return status;
}

pspec_status ps_figures_path(ps_text *path, const char *folder, const ps_device_limits *limits,
                             ps_error *error) {
    ps_text key = {0};
    pspec_status status = make_key(&key, limits, error);
    if (status == PSPEC_OK) {
        status = name_folder(path, folder, error);
    }
    if (status == PSPEC_OK) {
        status = ps_cache_append_name(path, key.data, key.length, error);
    }
    ps_text_free(&key);
    return status;
}

/* ---- writing ------------------------------------------------------------------------------- */

static ps_cell positive(double value) {
    return value > 0 ? PS_NUMBER(value) : PS_MISSING;
}

static pspec_status add_rows(ps_table *table, const ps_figures *figures, ps_error *error) {
    for (size_t i = 0; i < figures->num_engines; i++) {
        const ps_engine_figure *const row = &figures->engines[i];
        const ps_cell cells[NUM_COLUMNS] = {PS_TEXT(row->engine), positive(row->scales[PS_SINGLE]),
                                            positive(row->scales[PS_DOUBLE]),
                                            positive(row->scales[PS_EXTENDED])};
        PS_TRY(ps_table_add_row(table, cells, error));
    }
    for (size_t i = 0; i < figures->num_host; i++) {
        char name[sizeof host + sizeof figures->host[i].sampler];
        snprintf(name, sizeof name, "%s%s", host, figures->host[i].sampler);
        const ps_cell cells[NUM_COLUMNS] = {PS_TEXT(name), positive(figures->host[i].scale)};
        PS_TRY(ps_table_add_row(table, cells, error));
    }
    return PSPEC_OK;
}

static pspec_status make_table(ps_table **out, const ps_figures *figures, ps_error *error) {
    ps_figures copy = *figures;
    rate rates[NUM_RATES];
    list_rates(rates, &copy);
    PS_TRY(ps_table_create(out, "figures", columns, NUM_COLUMNS, error));
    PS_TRY(ps_table_add_meta(*out, "date", PS_TEXT(figures->date), error));
    for (size_t i = 0; i < NUM_RATES; i++) {
        PS_TRY(ps_table_add_meta(*out, rates[i].key, positive(*rates[i].value), error));
    }
    return add_rows(*out, figures, error);
}

pspec_status ps_figures_write(const char *folder, const ps_figures *figures,
                              const ps_device_limits *limits, ps_error *error) {
    ps_table *table = NULL;
    ps_cache *cache = NULL;
    ps_npz *npz = NULL;
    ps_text key = {0};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, make_table(&table, figures, error));
    PS_TRY_OUT(status, make_key(&key, limits, error));
    PS_TRY_OUT(status, open_cache(&cache, folder, error));
    PS_TRY_OUT(status, ps_cache_begin(cache, key.data, key.length, &npz, error));
    PS_TRY_OUT(status, ps_table_add_to_npz(table, npz, error));
    status = ps_cache_end(cache, &npz, error);
out:
    ps_npz_discard(&npz);
    ps_cache_close(cache);
    ps_table_destroy(table);
    ps_text_free(&key);
    return status;
}

/* ---- reading ------------------------------------------------------------------------------- */

/* Missing: 0, that nobody measured it. */
static bool take(ps_cell cell, double least, double most, double *out) {
    *out = cell.kind == PS_CELL_MISSING ? 0 : ps_cell_number(cell);
    return cell.kind == PS_CELL_MISSING || (*out >= least && *out <= most);
}

static bool take_row(ps_figures *figures, const ps_table *table, size_t row) {
    const ps_cell name = ps_table_cell(table, row, 0);
    const size_t length = sizeof host - 1;
    if (name.kind != PS_CELL_TEXT || name.text[0] == '\0') {
        return false;
    }
    if (strncmp(name.text, host, length) == 0) {
        ps_host_figure *const kind = ps_figures_host_row(figures, name.text + length);
        return kind != NULL &&
               take(ps_table_cell(table, row, 1), least_scale, most_scale, &kind->scale) &&
               kind->scale > 0;
    }
    ps_engine_figure *const engine = ps_figures_row(figures, name.text);
    bool is_good = engine != NULL;
    for (size_t i = 0; is_good && i < PS_FIGURES_PRECISIONS; i++) {
        is_good =
            take(ps_table_cell(table, row, 1 + i), least_scale, most_scale, &engine->scales[i]);
    }
    return is_good;
}

pspec_status ps_figures_take(ps_figures *figures, const ps_table *table, ps_error *error) {
    const ps_cell date = ps_table_find_meta(table, "date");
    rate rates[NUM_RATES];
    *figures = (ps_figures){0};
    list_rates(rates, figures);
    bool is_good = ps_table_num_columns(table) == NUM_COLUMNS && date.kind == PS_CELL_TEXT &&
                   strlen(date.text) < sizeof figures->date;
    for (size_t i = 0; is_good && i < NUM_RATES; i++) {
        is_good = take(ps_table_find_meta(table, rates[i].key), rates[i].least, most_rate,
                       rates[i].value);
    }
    for (size_t i = 0; is_good && i < ps_table_num_rows(table); i++) {
        is_good = take_row(figures, table, i);
    }
    if (!is_good) {
        *figures = (ps_figures){0};
        return ps_fail(error, PSPEC_ERROR_INPUT, "a figure is none that a device can have");
    }
    memcpy(figures->date, date.text, strlen(date.text) + 1);
    figures->is_measured = true;
    return PSPEC_OK;
}

static pspec_status take_file(ps_figures *figures, const ps_npz_file *file, ps_error *error) {
    const ps_npz_array *const stored = ps_npz_find(file, PS_NPZ_DIGEST);
    ps_table *table = NULL;
    uint64_t digest = 0;
    PS_TRY(ps_table_take_npz(&table, file, error));
    const pspec_status status = ps_figures_take(figures, table, error);
    ps_table_destroy(table);
    PS_TRY(status);
    memcpy(&digest, stored->data, sizeof digest);
    snprintf(figures->note, sizeof figures->note, "measured on %s (%016" PRIx64 ")", figures->date,
             digest);
    return PSPEC_OK;
}

/* figures->is_measured: false, and PSPEC_OK, where there are none. No folder is made. */
static pspec_status read_figures(ps_figures *figures, const char *folder,
                                 const ps_device_limits *limits, ps_error *error) {
    ps_text path = {0};
    ps_text key = {0};
    ps_cache *cache = NULL;
    ps_npz_file *file = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, name_folder(&path, folder, error));
    if (access(ps_text_string(&path), F_OK) != 0) {
        goto out;
    }
    PS_TRY_OUT(status, make_key(&key, limits, error));
    PS_TRY_OUT(status, open_cache(&cache, folder, error));
    PS_TRY_OUT(status, ps_cache_find(cache, key.data, key.length, &file, error));
    if (file != NULL) {
        status = take_file(figures, file, error);
    }
out:
    ps_npz_free(file);
    ps_cache_close(cache);
    ps_text_free(&key);
    ps_text_free(&path);
    return status;
}

static void say_builtin(ps_figures *figures, const char *why) {
    *figures = (ps_figures){0};
    snprintf(figures->note, sizeof figures->note, "built-in: %.*s", (int)sizeof figures->note - 16,
             why);
}

pspec_status ps_figures_read(ps_figures *figures, const char *folder,
                             const ps_device_limits *limits, ps_error *error) {
    ps_error own = {0};
    say_builtin(figures, "none were looked for");
    if (folder == NULL) {
        return PSPEC_OK;
    }
    const pspec_status status = read_figures(figures, folder, limits, &own);
    if (status != PSPEC_OK) {
        say_builtin(figures, own.message);
    } else if (!figures->is_measured) {
        say_builtin(figures, "this device was not measured (pointspec bench --calibrate)");
    }
    return status == PSPEC_ERROR_MEMORY || status == PSPEC_ERROR_CANCELLED
               ? ps_fail(error, status, "%s", own.message)
               : PSPEC_OK;
}

pspec_status ps_figures_open_device(ps_device **out, const char *selector, bool with_profile,
                                    const char *folder, ps_error *error) {
    ps_figures figures;
    PS_TRY(ps_device_open(out, selector, with_profile, error));
    pspec_status status = ps_figures_read(&figures, folder, ps_device_get_limits(*out), error);
    if (status == PSPEC_OK) {
        status = ps_device_set_figures(*out, &figures, error);
    }
    if (status != PSPEC_OK) {
        ps_device_close(*out);
        *out = NULL;
    }
    return status;
}
