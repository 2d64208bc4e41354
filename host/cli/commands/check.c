/* pointspec check: is this sampler's spectrum the saved one? */
#include "report/check_table.h"
#include "cli/command.h"
#include "cli/jobs.h"
#include "cli/output_check.h"
#include "questions/check_question.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Beside those of the question. */
static const ps_option_id options[] = {PS_OPTION_DEVICE,  PS_OPTION_OUTPUT, PS_OPTION_FORMAT,
                                       PS_OPTION_PROFILE, PS_OPTION_QUIET,  PS_OPTION_VERBOSE,
                                       PS_OPTION_HELP,    PS_NUM_OPTIONS};

pspec_status ps_check_check(const ps_request *arguments, ps_error *error) {
    if (arguments->against == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--against FILE is needed: the saved spectrum");
    }
    return arguments->num_samplers <= 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "one sampler is compared with one saved spectrum, but %zu were given",
                         arguments->num_samplers);
}

static pspec_status check_output(const ps_request *arguments, ps_table_format *format,
                                 ps_error *error) {
    PS_TRY(ps_table_choose_format(format, arguments->format, arguments->output, error));
    if (*format == PS_FORMAT_NPY) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "verdicts are no numbers: .csv and .json, not .npy");
    }
    return ps_outputs_check(arguments, true, error);
}

/* ---- the answer -------------------------------------------------------------------------- */

static pspec_status check_points(const ps_saved_spectrum *saved, const ps_spectrum *measured,
                                 const char *path, ps_error *error) {
    return saved->smallest_points <= measured->largest_points &&
                   measured->smallest_points <= saved->largest_points
               ? PSPEC_OK
               : ps_fail(
                     error, PSPEC_ERROR_INPUT,
                     "these sets have %.17g points%s, those of \"%s\" have %.17g; spectra change "
                     "with the number of points (-n says how files without it are cut)",
                     measured->mean_points,
                     measured->smallest_points == measured->largest_points ? "" : " on average",
                     path, saved->mean_points);
}

static pspec_status check_bins(const ps_saved_spectrum *saved, const ps_spectrum *measured,
                               const char *path, ps_error *error) {
    const char *const name = ps_check_bin_name(saved);
    for (size_t b = 0; b < measured->num_bins; b++) {
        if (b >= saved->num_bins || saved->bins[b].key != measured->bins[b].key) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "\"%s\" lacks %s %lld, or what comes before it is out of place", path,
                           name, (long long)measured->bins[b].key);
        }
    }
    return saved->num_bins == measured->num_bins
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "\"%s\" has %zu %ss, but up to %d there are %zu",
                         path, saved->num_bins, name, (int)saved->max_frequency,
                         measured->num_bins);
}

/* N V / W^2 is taken to be that of the measured sets on both sides. */
static void make_sides(ps_compared *saved_side, ps_compared *measured_side,
                       const ps_saved_spectrum *saved, const ps_power_job *job) {
    const ps_spectrum *const measured = ps_power_job_spectrum(job);
    const double modes = ps_compared_modes(&measured->frequencies);
    const bool is_effective = saved->normalization == PSPEC_NORMALIZATION_EFFECTIVE;
    const double unit = is_effective ? 1 : measured->mean_points / measured->sample_size.mean;
    for (size_t b = 0; b < measured->num_bins; b++) {
        const ps_saved_bin *const x = &saved->bins[b];
        const ps_spectrum_bin *const y = &measured->bins[b];
        const double share = (double)y->num_computed / modes;
        const double error = ps_power_job_accuracy(job)->error;
        saved_side[b] = (ps_compared){x->power, x->standard_error,
                                      ps_compared_error(x->power, saved->error, share, unit)};
        measured_side[b] = (ps_compared){y->power, y->standard_error,
                                         ps_compared_error(y->power, error, share, unit)};
    }
}

static pspec_status compare(ps_comparison *rows, const ps_request *arguments,
                            const ps_saved_spectrum *saved, const ps_power_job *job,
                            ps_error *error) {
    void *memory = NULL;
    const size_t num = saved->num_bins;
    PS_TRY(ps_allocate(&memory, num, 2 * sizeof(ps_compared), "bins to compare", error));
    ps_compared *const sides = memory;
    make_sides(sides, sides + num, saved, job);
    const pspec_status status = ps_compare(rows, num, sides, saved->num_realizations, sides + num,
                                           ps_power_job_spectrum(job)->num_realizations,
                                           arguments->false_alarm_rate, error);
    free(memory);
    return status;
}

/* The bins that differ most. */
static void append_worst(ps_text *text, const ps_check_results *results) {
    enum { MOST_NAMED = 3 };
    const ps_spectrum *const measured = ps_power_job_spectrum(results->job);
    size_t named[MOST_NAMED];
    size_t num = 0;
    while (num < MOST_NAMED && num < results->num_different) {
        size_t worst = SIZE_MAX;
        for (size_t b = 0; b < measured->num_bins; b++) {
            bool is_new = results->rows[b].differs;
            for (size_t i = 0; i < num; i++) {
                is_new = is_new && named[i] != b;
            }
            if (is_new && (worst == SIZE_MAX ||
                           fabs(results->rows[b].score) > fabs(results->rows[worst].score))) {
                worst = b;
            }
        }
        ps_text_append(text, "%s %s %lld (power %.4g, saved %.4g, z = %.3g)", num > 0 ? "," : "",
                       ps_check_bin_name(results->saved), (long long)measured->bins[worst].key,
                       measured->bins[worst].power, results->saved->bins[worst].power,
                       results->rows[worst].score);
        named[num++] = worst;
    }
    ps_text_append(text, "%s", num < results->num_different ? ", ..." : "");
}

static pspec_status judge(const ps_request *arguments, const ps_check_results *results,
                          ps_error *error) {
    ps_text worst = {0};
    if (results->num_different == 0) {
        return PSPEC_OK;
    }
    append_worst(&worst, results);
    pspec_status status = ps_text_check(&worst, error);
    if (status == PSPEC_OK) {
        status = ps_fail(error, PSPEC_ERROR_CHECK,
                         "not the spectrum of \"%s\": %zu of %zu %ss differ at a false alarm rate "
                         "of %g:%s",
                         arguments->against, results->num_different, results->saved->num_bins,
                         ps_check_bin_name(results->saved), arguments->false_alarm_rate,
                         ps_text_string(&worst));
    }
    ps_text_free(&worst);
    return status;
}

/* The table is there whatever the verdict. */
static pspec_status answer(ps_table **out, ps_error *verdict, const ps_request *arguments,
                           const ps_saved_spectrum *saved, const ps_power_job *job,
                           ps_error *error) {
    const ps_spectrum *const measured = ps_power_job_spectrum(job);
    void *memory = NULL;
    PS_TRY(check_points(saved, measured, arguments->against, error));
    PS_TRY(check_bins(saved, measured, arguments->against, error));
    PS_TRY(ps_allocate(&memory, saved->num_bins, sizeof(ps_comparison), "compared bins", error));
    ps_check_results results = {saved, job, memory, 0};
    pspec_status status = compare(memory, arguments, saved, job, error);
    for (size_t b = 0; status == PSPEC_OK && b < saved->num_bins; b++) {
        results.num_different += results.rows[b].differs;
    }
    if (status == PSPEC_OK) {
        status = ps_check_table(out, arguments, &results, error);
    }
    if (status == PSPEC_OK) {
        status = judge(arguments, &results, error);
    }
    if (status == PSPEC_ERROR_CHECK) {
        *verdict = *error;
        *error = (ps_error){0};
        status = PSPEC_OK;
    }
    free(memory);
    return status;
}

/* ---- all --------------------------------------------------------------------------------- */

static pspec_status answer_saved(ps_table **out, ps_error *verdict, const ps_request *arguments,
                                 const ps_answer_hooks *hooks, const ps_saved_spectrum *saved,
                                 ps_error *error) {
    const ps_request own = ps_check_request(arguments, saved);
    ps_question_list list;
    ps_power_job *job = NULL;
    PS_TRY(ps_check_question_make(&list, &own, saved, error));
    pspec_status status = ps_jobs_run_one(&own, &list.questions[0], hooks, &job, error);
    if (status == PSPEC_OK) {
        status = answer(out, verdict, &own, saved, job, error);
    }
    ps_power_job_destroy(job);
    return status;
}

static pspec_status find_answer(ps_table **out, ps_error *verdict, const ps_request *arguments,
                                const ps_answer_hooks *hooks, ps_error *error) {
    ps_saved_spectrum saved;
    PS_TRY(ps_check_check(arguments, error));
    PS_TRY(ps_saved_spectrum_read(&saved, arguments->against, error));
    const pspec_status status = answer_saved(out, verdict, arguments, hooks, &saved, error);
    ps_saved_spectrum_free(&saved);
    return status;
}

pspec_status ps_check_answer(ps_table **out, const ps_request *request,
                             const ps_answer_hooks *hooks, ps_error *error) {
    ps_error verdict = {0}; /* the table has it too */
    return find_answer(out, &verdict, request, hooks, error);
}

static pspec_status run(const ps_request *arguments, ps_error *error) {
    ps_error verdict = {0};
    ps_table *table = NULL;
    ps_table_format format = PS_FORMAT_CSV;
    PS_TRY(ps_check_check(arguments, error));
    PS_TRY(check_output(arguments, &format, error));
    ps_progress *const progress = ps_progress_begin(arguments, "realizations");
    const ps_answer_hooks hooks = {.watch = {ps_progress_tell, progress}};
    pspec_status status = find_answer(&table, &verdict, arguments, &hooks, error);
    ps_progress_end(progress);
    if (status == PSPEC_OK) {
        status = ps_table_write(table, arguments->output != NULL ? arguments->output : "-", format,
                                error);
    }
    ps_table_destroy(table);
    if (status == PSPEC_OK && verdict.status != PSPEC_OK) {
        *error = verdict;
        return verdict.status;
    }
    return status;
}

const ps_command ps_command_check = {
    .name = "check",
    .summary = "is this the spectrum that was saved, statistically?",
    .usage = "check --against FILE [options] FILE... | check --against FILE --sampler NAME",
    .description =
        "Measures the spectrum that the saved one is of (domain, dimension, K or L, rings or "
        "shells, "
        "normalization and number of points are taken from it) and compares the powers of all "
        "rings "
        "or degrees, with the standard errors of both sides. Exit status 0: nothing differs; 3: "
        "some do, the table and the message say which. For samplers that have not changed that "
        "happens with the probability of --false-alarm-rate at most, for all rings together. The "
        "saved spectrum is a table of power or angular as JSON, or a file of pspec_spectrum_save. "
        "A sampler gets as many points and realizations as were saved and the seed after the saved "
        "one, unless others are given.",
    .result = &ps_result_check,
    .options = options,
    .examples =
        {"pointspec power --sampler jittered -n 256 -m 64 -o saved.json && pointspec check "
         "--against saved.json --sampler jittered -m 16",
         "pointspec sample --sampler jittered -n 256 -m 16 -s 7 | pointspec check --against "
         "saved.json -"},
    .formats = "csv|json",
    .run = run,
};
