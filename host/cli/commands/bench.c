/* pointspec bench: run time against error on this device, and its figures for the planner. */
#include "answers/output_check.h"
#include "answers/picture.h"
#include "cli/command.h"
#include "request/options.h"
#include "store/figures_file.h"
#include "verify/bench/bench.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

typedef struct answer {
    const ps_request *arguments;
    const ps_answer_hooks *hooks;
    ps_device *device;
    ps_figures peaks;
    ps_table *table;
    ps_table_stream *stream;
    ps_progress *progress;
} answer;

/* ---- rows ---------------------------------------------------------------------------------- */

static ps_cell number_of(double value) {
    return isnan(value) ? PS_MISSING : PS_NUMBER(value);
}

static pspec_status add_row(ps_table *table, const ps_bench_row *row, ps_error *error) {
    const ps_cell cells[] = {PS_TEXT(row->what->name),
                             PS_TEXT(row->engine->name),
                             PS_NUMBER(row->tolerance),
                             PS_NUMBER(row->seconds),
                             PS_NUMBER(row->error),
                             PS_NUMBER((double)row->what->num_points / row->seconds),
                             number_of(row->fraction_of_peak),
                             PS_TEXT(ps_precision_name(row->precision)),
                             number_of(row->fraction_of_bandwidth),
                             PS_NUMBER(row->predicted_seconds),
                             PS_NUMBER(row->predicted_error),
                             PS_INTEGER(row->is_pareto)};
    return ps_table_add_row(table, cells, error);
}

static pspec_status report(void *payload, const ps_bench_row *rows, size_t num, ps_error *error) {
    answer *const shown = payload;
    for (size_t i = 0; i < num; i++) {
        PS_TRY(add_row(shown->table, &rows[i], error));
    }
    ps_progress_hide(shown->progress);
    return ps_table_stream_update(shown->stream, error);
}

static void advance(void *payload, size_t done, size_t total) {
    const answer *const shown = payload;
    ps_progress_update(shown->progress, done, total);
}

static bool should_stop(void *payload) {
    (void)payload;
    return ps_interrupted != 0;
}

/* ---- headers ------------------------------------------------------------------------------- */

static ps_cell rate(double value) {
    return value > 0 ? PS_NUMBER(value) : PS_MISSING;
}

static pspec_status add_device(const answer *shown, const ps_figures *peaks, ps_error *error) {
    const ps_device_limits *const limits = ps_device_get_limits(shown->device);
    const ps_meta entries[] = {
        {"device", PS_TEXT(limits->name)},
        {"platform", PS_TEXT(limits->platform)},
        {"driver", PS_TEXT(limits->driver)},
        {"compute_units", PS_INTEGER(limits->compute_units)},
        {"peak_flops_single", rate(peaks->flops[PS_SINGLE])},
        {"peak_flops_double", rate(peaks->flops[PS_DOUBLE])},
        {"copied_bytes_per_second", rate(peaks->copied_bytes)},
        {"sent_bytes_per_second", rate(peaks->sent_bytes)},
        {"launches_per_second", rate(peaks->launches)},
    };
    PS_TRY(ps_lead_add_origin(shown->table, shown->arguments->command_line, error));
    return ps_table_add_metas(shown->table, entries, sizeof entries / sizeof entries[0], error);
}

static pspec_status add_explanation(const answer *shown, ps_error *error) {
    const ps_meta entries[] = {
        {"figures", PS_TEXT(ps_device_get_limits(shown->device)->figures->note)},
        {"time", PS_TEXT("of a realization, from points in host memory to powers on the device: "
                         "median of nine runs, three at a time in turn with other rows, with "
                         "--quick of three; setup is not counted")},
        {"error", PS_TEXT("measured against long double sums, in units of --tol; 0: the engine is "
                          "that referee")},
        {"tolerance", PS_TEXT("the tightest of 1e-2 1e-4 ... 1e-12 that leads to this computation; "
                              "what takes longer than 2 s, on the host 0.5 s, is left out")},
        {"fraction_of_peak",
         PS_TEXT("arithmetic that the launches count, of the peak measured "
                 "beside it; fraction_of_bandwidth: points read and powers written "
                 "once, of a copy")},
    };
    return ps_table_add_metas(shown->table, entries, sizeof entries / sizeof entries[0], error);
}

/* ---- the table ----------------------------------------------------------------------------- */

static const ps_field_row own_fields[] = {
    {"compute_units", "", PS_ENTRY, 0, "", "of the device"},
    {"peak_flops_single", "1/s", PS_ENTRY, 0, "", "measured; missing where it was not"},
    {"peak_flops_double", "1/s", PS_ENTRY, 0, "", "measured; missing where it was not"},
    {"copied_bytes_per_second", "bytes/s", PS_ENTRY, 0, "", "measured, on the device"},
    {"sent_bytes_per_second", "bytes/s", PS_ENTRY, 0, "", "measured, to the device"},
    {"launches_per_second", "1/s", PS_ENTRY, 0, "", "measured"},
    {"figures", "", PS_ENTRY, 0, "", "whether the planner has figures of the device, or why not"},
    {"time", "", PS_ENTRY, 0, "", "what seconds are of"},
    {"error", "", PS_ENTRY, 0, "", "what the column of that name is"},
    {"tolerance", "", PS_ENTRY, 0, "", "what the column of that name is"},
    {"fraction_of_peak", "", PS_ENTRY, 0, "", "what the fractions are of"},
    {"case", "", PS_COLUMN, 0, "", "what is run"},
    {"engine", "", PS_COLUMN, 0, "", "by what"},
    {"tolerance", "", PS_COLUMN, 0, "", "the tightest one that leads to this computation"},
    {"seconds_per_realization", "s", PS_COLUMN, 0, "", "the median"},
    {"error", "", PS_COLUMN, 0, "", "measured; 0 where the engine is the referee itself"},
    {"points_per_second", "1/s", PS_COLUMN, 0, "", "points of a realization over its seconds"},
    {"fraction_of_peak", "", PS_COLUMN, 0, "",
     "arithmetic that the launches count, as a share of the peak of fused operations that was "
     "measured beside it; missing on the host"},
    {"precision", "", PS_COLUMN, 0, "", "single, double or extended"},
    {"fraction_of_bandwidth", "", PS_COLUMN, 0, "",
     "bytes of points and powers, once each, as a share of the bandwidth of a copy"},
    {"predicted_seconds", "s", PS_COLUMN, 0, "", "as plan has them"},
    {"predicted_error", "", PS_COLUMN, 0, "", "as plan has it"},
    {"pareto", "", PS_COLUMN, 0, "",
     "1 when no other row of the case is as fast and as exact, else 0"},
    {.name = NULL}};
static const ps_field_row *const fields[] = {ps_fields_asked, ps_fields_device, own_fields, NULL};

static void write_title(ps_text *out, const ps_request *request, const ps_table *table) {
    (void)request;
    ps_text_append(out, "run time against error, %s",
                   ps_cell_text(ps_table_find_meta(table, "device")));
}

static const ps_picture_kind pictures[] = {
    {.make = ps_bench_figure, .by = PS_BY_COMMAND, .write_title = write_title}, {.make = NULL}};

static pspec_status make_table(answer *shown, ps_table_format format, const char *path,
                               ps_error *error) {
    PS_TRY(ps_fields_create_table(&shown->table, "bench", own_fields, error));
    PS_TRY(add_device(shown, &shown->peaks, error));
    PS_TRY(add_explanation(shown, error));
    return ps_table_stream_open(&shown->stream, shown->table, path, format, error);
}

static pspec_status run_cases(answer *shown, const ps_suite_options *options,
                              ps_table_format format, const char *path, ps_error *error) {
    const ps_request *arguments = shown->arguments;
    PS_TRY(ps_device_peaks_measure(shown->device, &shown->peaks, error));
    PS_TRY(make_table(shown, format, path, error));
    shown->progress = ps_progress_begin(arguments, "cases");
    const pspec_status status =
        ps_bench_run(options, shown->device, shown->peaks.copied_bytes, error);
    ps_progress_end(shown->progress);
    PS_TRY(status);
    PS_TRY(ps_table_stream_close(&shown->stream, error));
    return arguments->plot == NULL
               ? PSPEC_OK
               : ps_picture_settle(arguments, ps_picture_is_all(arguments, true), shown->hooks,
                                   ps_picture_draw(pictures, arguments, shown->table, error),
                                   error);
}

/* ---- calibration --------------------------------------------------------------------------- */

static pspec_status add_figures(answer *shown, const ps_figures *figures, const char *path,
                                ps_error *error) {
    static const char *const columns[] = {"engine", "precision", "seconds_over_predicted"};
    PS_TRY(ps_table_create(&shown->table, "bench", columns, sizeof columns / sizeof columns[0],
                           error));
    PS_TRY(add_device(shown, figures, error));
    PS_TRY(ps_table_add_meta(shown->table, "date", PS_TEXT(figures->date), error));
    PS_TRY(ps_table_add_meta(shown->table, "file", PS_TEXT(path), error));
    for (size_t i = 0; i < figures->num_engines; i++) {
        const ps_engine_figure *row = &figures->engines[i];
        for (int precision = PS_SINGLE; precision <= PS_EXTENDED; precision++) {
            const ps_cell cells[] = {PS_TEXT(row->engine),
                                     PS_TEXT(ps_precision_name((ps_precision)precision)),
                                     PS_NUMBER(row->scales[precision])};
            if (row->scales[precision] > 0) {
                PS_TRY(ps_table_add_row(shown->table, cells, error));
            }
        }
    }
    return PSPEC_OK;
}

static pspec_status add_host_figures(answer *shown, const ps_figures *host, ps_error *error) {
    for (size_t i = 0; i < host->num_host; i++) {
        char name[64];
        snprintf(name, sizeof name, "host %s", host->host[i].sampler);
        const ps_cell cells[] = {PS_TEXT(name), PS_MISSING, PS_NUMBER(host->host[i].scale)};
        PS_TRY(ps_table_add_row(shown->table, cells, error));
    }
    return PSPEC_OK;
}

static void say_date(ps_figures *figures) {
    const time_t now = time(NULL);
    struct tm parts;
    if (gmtime_r(&now, &parts) == NULL ||
        strftime(figures->date, sizeof figures->date, "%Y-%m-%dT%H:%M:%SZ", &parts) == 0) {
        snprintf(figures->date, sizeof figures->date, "a day unknown");
    }
}

/* Measures, keeps, and shows what was kept. */
static pspec_status calibrate(answer *shown, const ps_suite_options *options,
                              ps_table_format format, const char *path, ps_error *error) {
    const char *const folder = shown->arguments->limits.cache_folder;
    const ps_device_limits *const limits = ps_device_get_limits(shown->device);
    ps_figures figures;
    ps_figures host;
    ps_device_limits processors;
    ps_text file = {0};
    PS_TRY(ps_figures_make_folder(folder, error)); /* before the work */
    shown->progress = ps_progress_begin(shown->arguments, "cases");
    pspec_status status = ps_bench_calibrate(options, shown->device, &figures, error);
    if (status == PSPEC_OK) {
        status = ps_bench_calibrate_host(options, &host, error);
    }
    ps_progress_end(shown->progress);
    PS_TRY(status);
    say_date(&figures);
    say_date(&host);
    PS_TRY(ps_figures_write(folder, &figures, limits, error));
    ps_host_describe(&processors);
    PS_TRY(ps_figures_write(folder, &host, &processors, error));
    PS_TRY_OUT(status, ps_figures_path(&file, folder, limits, error));
    PS_TRY_OUT(status, add_figures(shown, &figures, ps_text_string(&file), error));
    PS_TRY_OUT(status, add_host_figures(shown, &host, error));
    status = ps_table_write(shown->table, path, format, error);
out:
    ps_text_free(&file);
    return status;
}

/* ---- the command --------------------------------------------------------------------------- */

static pspec_status check_calibration(const ps_request *arguments, ps_error *error) {
    PS_TRY(ps_option_pairs_check(arguments, PS_COMMAND_bench, error));
    return arguments->limits.cache_folder != NULL
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "there is no folder to keep the figures in: set POINTSPEC_CACHE_DIR");
}

static pspec_status check_words(const ps_request *arguments, const ps_suite_options *options,
                                const ps_answer_hooks *hooks, ps_error *error) {
    PS_TRY(ps_request_check_no_files(arguments, "; --scenes is for scenes", error));
    PS_TRY(ps_picture_check(arguments, ps_picture_is_all(arguments, true), hooks, error));
    if (arguments->calibrate) {
        PS_TRY(check_calibration(arguments, error));
    }
    return ps_suite_check(&ps_bench_suite, options, error);
}

/* The table is there also when answers differ. */
static pspec_status run_scenes(const ps_request *arguments, ps_error *error) {
    const char *const path = arguments->output;
    ps_table *table = NULL;
    ps_table_format format = PS_FORMAT_CSV;
    ps_error unwritten = {0};
    if (arguments->num_files == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--scenes needs scenes, as in --scenes docs/scenes/diffuse.yaml");
    }
    PS_TRY(ps_option_pairs_check(arguments, PS_COMMAND_bench, error));
    PS_TRY(ps_table_choose_format(&format, arguments->format, path, error));
    PS_TRY(ps_outputs_check(arguments, true, error));
    pspec_status status = ps_bench_scenes(&table, arguments, error);
    if ((status == PSPEC_OK || status == PSPEC_ERROR_CHECK) &&
        ps_table_write(table, path, format, &unwritten) != PSPEC_OK) {
        *error = unwritten;
        status = unwritten.status;
    }
    ps_table_destroy(table);
    return status;
}

static pspec_status run(ps_answer *out, const ps_request *arguments, const ps_answer_hooks *hooks,
                        ps_error *error) {
    (void)out;
    if (arguments->scenes) {
        return run_scenes(arguments, error);
    }
    const char *const path = arguments->output;
    answer shown = {.arguments = arguments, .hooks = hooks};
    const ps_suite_options options = {.case_name = arguments->case_name,
                                      .engine = arguments->limits.constraints.engine,
                                      .precision = arguments->limits.constraints.precision,
                                      .quick = arguments->quick,
                                      .should_stop = should_stop,
                                      .report_rows = report,
                                      .advance = advance,
                                      .payload = &shown};
    ps_table_format format = PS_FORMAT_CSV;
    PS_TRY(check_words(arguments, &options, hooks, error));
    PS_TRY(ps_table_choose_format(&format, arguments->format, path, error));
    PS_TRY(ps_outputs_check(arguments, true, error));
    PS_TRY(ps_figures_open_device(&shown.device, arguments->limits.device, false,
                                  arguments->limits.cache_folder, error));
    const pspec_status status = arguments->calibrate
                                    ? calibrate(&shown, &options, format, path, error)
                                    : run_cases(&shown, &options, format, path, error);
    ps_table_stream_discard(&shown.stream);
    ps_table_destroy(shown.table);
    ps_device_close(shown.device);
    return status;
}

const ps_command ps_command_bench = {
    .name = "bench",
    .purpose = "run time against error on this device; its figures for the planner",
    .usage = "bench [options] | bench --scenes [options] SCENE.yaml...",
    .description =
        "Runs every engine in every precision at tolerances from 1e-2 to 1e-12 on cases of the "
        "torus, the sphere, the hemisphere and pair sums, and prints the time of a realization "
        "beside the error that long double sums find. pareto is 1 where nothing else of the case "
        "is as fast and as exact. --calibrate measures instead how far this device is from the "
        "planner's cost model and keeps that below POINTSPEC_CACHE_DIR (else "
        "XDG_CACHE_HOME/pointspec, else ~/.cache/pointspec): plan says its seconds with it from "
        "then "
        "on. --scenes runs scenes with and without skips instead, without the cache of results, "
        "and "
        "compares time and answers; exit status 3 when they differ. Wants a quiet machine; a plain "
        "run takes about three minutes.",
    .takes = PS_COMMAND_BIT(bench),
    .fields = fields,
    .has_words = true,
    .has_late_rows = true,
    .examples = {"pointspec bench --case plane-many --precision single --quick -o bench.csv --plot "
                 "bench.svg",
                 "pointspec bench --case pairs --engine pairs_direct --precision single --quick "
                 "--format json"},
    .run = run,
};
