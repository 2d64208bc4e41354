/* pointspec stress: the numerical stability suite on this device. */
#include "answers/output_check.h"
#include "cli/command.h"
#include "verify/stress.h"

#include <stdio.h>

typedef struct answer {
    const ps_request *arguments;
    ps_device *device; /* NULL: for what the host computes alone */
    ps_table *table;
    ps_table_stream *stream;
    ps_progress *progress;
} answer;

/* ---- rows ---------------------------------------------------------------------------------- */

static pspec_status report(void *payload, const ps_stress_row *row, ps_error *error) {
    answer *const shown = payload;
    char verdict[sizeof row->reason + 32];
    ps_stress_verdict_text(row, verdict, sizeof verdict);
    const ps_cell cells[] = {
        PS_TEXT(row->what->name), PS_TEXT(row->engine),  PS_TEXT(ps_precision_name(row->precision)),
        PS_NUMBER(row->error),    PS_NUMBER(row->bound), PS_TEXT(verdict)};
    PS_TRY(ps_table_add_row(shown->table, cells, error));
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

/* ---- the table ----------------------------------------------------------------------------- */

static pspec_status add_header(const answer *shown, ps_error *error) {
    const ps_request *const arguments = shown->arguments;
    const ps_device_limits *const limits = ps_device_get_limits(shown->device);
    const ps_meta entries[] = {
        {"device", PS_TEXT(limits != NULL ? limits->name : "none")},
        {"platform", PS_TEXT(limits != NULL ? limits->platform : "none")},
        {"driver", PS_TEXT(limits != NULL ? limits->driver : "none")},
        {"error_units", PS_TEXT("of S and c_lm: white noise; of pair sums and distances: (sum "
                                "|w|)^2; of the host: as its bound")},
    };
    PS_TRY(ps_lead_add_origin(shown->table, arguments->command_line, error));
    return ps_table_add_metas(shown->table, entries, sizeof entries / sizeof entries[0], error);
}

static const ps_field_row own_fields[] = {
    {"error_units", "", PS_ENTRY, 0, "", "what error and bound are relative to"},
    {"case", "", PS_COLUMN, 0, "", "what is tried"},
    {"engine", "", PS_COLUMN, 0, "", "by what"},
    {"precision", "", PS_COLUMN, 0, "", "single or double"},
    {"error", "", PS_COLUMN, 0, "",
     "root mean square error of S or c_lm, relative to white noise; of pair sums and sums of "
     "distances the largest one, over (sum |w|)^2; of the host as its bound"},
    {"bound", "", PS_COLUMN, 0, "", "what the engine promises for such points"},
    {"verdict", "", PS_COLUMN, 0, "",
     "pass; fail; fail: and why, when the device or its compiler gave an error; skipped: and why, "
     "when the device has no double precision or too little memory"},
    {.name = NULL}};
static const ps_field_row *const fields[] = {ps_fields_asked, ps_fields_device, own_fields, NULL};

static pspec_status make_table(answer *shown, ps_table_format format, const char *path,
                               ps_error *error) {
    PS_TRY(ps_fields_create_table(&shown->table, "stress", own_fields, error));
    PS_TRY(add_header(shown, error));
    return ps_table_stream_open(&shown->stream, shown->table, path, format, error);
}

/* ---- the command --------------------------------------------------------------------------- */

/* What computes wrongly failed a check; what did not compute failed. */
static pspec_status conclude(const ps_stress_totals *totals, ps_error *error) {
    const ps_stress_row *const first = &totals->first_failure;
    const bool is_refused = first->reason[0] != '\0';
    if (totals->num_failed == 0) {
        return PSPEC_OK;
    }
    return ps_fail(error, is_refused ? PSPEC_ERROR_DEVICE : PSPEC_ERROR_CHECK,
                   "%zu of %zu checks failed, the first of them %s by %s in %s precision: %s",
                   totals->num_failed, totals->num_failed + totals->num_passed, first->what->name,
                   first->engine, ps_precision_name(first->precision),
                   is_refused ? first->reason : "the device or its driver computes wrongly");
}

static pspec_status check_words(const ps_request *arguments, const ps_suite_options *options,
                                ps_error *error) {
    PS_TRY(ps_request_check_no_files(arguments, "", error));
    return ps_suite_check(&ps_stress_suite, options, error);
}

static pspec_status run(ps_answer *out, const ps_request *arguments, const ps_answer_hooks *hooks,
                        ps_error *error) {
    (void)out, (void)hooks;
    const char *const path = arguments->output;
    answer shown = {.arguments = arguments};
    const ps_suite_options options = {.case_name = arguments->case_name,
                                      .engine = arguments->limits.constraints.engine,
                                      .precision = arguments->limits.constraints.precision,
                                      .quick = arguments->quick,
                                      .should_stop = should_stop,
                                      .report = report,
                                      .advance = advance,
                                      .payload = &shown};
    ps_table_format format = PS_FORMAT_CSV;
    ps_stress_totals totals;
    pspec_status status = PSPEC_OK;
    PS_TRY(check_words(arguments, &options, error));
    PS_TRY(ps_table_choose_format(&format, arguments->format, path, error));
    PS_TRY(ps_outputs_check(arguments, true, error));
    if (ps_stress_needs_device(&options)) {
        PS_TRY(ps_device_open(&shown.device, arguments->limits.device, false, error));
    }
    PS_TRY_OUT(status, make_table(&shown, format, path, error));
    shown.progress = ps_progress_begin(arguments, "cases");
    status = ps_stress_run(&options, shown.device, &totals, error);
    ps_progress_end(shown.progress);
    if (status == PSPEC_OK) {
        PS_TRY_OUT(status, ps_table_stream_close(&shown.stream, error));
        status = conclude(&totals, error);
    }
out:
    ps_table_stream_discard(&shown.stream);
    ps_table_destroy(shown.table);
    ps_device_close(shown.device);
    return status;
}

const ps_command ps_command_stress = {
    .name = "stress",
    .purpose = "numerical stability suite: an acceptance test of this device and its driver",
    .usage = "stress [options]",
    .description =
        "Runs cases that are hard on arithmetic (large frequencies, tiny powers, ten million "
        "points, duplicates, poles, high degrees, weights from 1e-12 to 1e12, ...) by every engine "
        "in every precision and compares with long double sums; --engine and --precision choose "
        "some of the rows. A row passes when its error is at most its bound, the engine's own "
        "error formula. Exits with 3 when one fails: then the device or its driver computes "
        "wrongly.",
    .takes = PS_COMMAND_BIT(stress),
    .fields = fields,
    .has_words = true,
    .has_late_rows = true,
    .examples = {"pointspec stress --quick --engine pairs_direct -o stress.csv",
                 "pointspec stress --case frequencies-1e6 --format json"},
    .run = run,
};
