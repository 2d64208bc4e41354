/* Is the spectrum of a sampler, or of files, the saved one? Or are realizations homogeneous? */
#include "answers/check/check_question.h"
#include "answers/check/check_table.h"
#include "answers/compare.h"
#include "answers/homogeneity/homogeneity.h"
#include "answers/spectra/spectra.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The saved spectrum, and the measured one. */
typedef struct checked {
    ps_saved_spectrum saved;
    ps_request own; /* what is asked of the measured side */
    ps_question_list list;
    ps_power_job *job;
    ps_comparison *rows; /* [saved.num_bins] */
    /* Where that is asked instead, and the others are not there; else NULL. */
    ps_homogeneity *homogeneity;
} checked;

static pspec_status check_domain(const ps_request *request, ps_error *error) {
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        if (request->is_given[id] && ps_check_is_of_spectrum((ps_option_id)id)) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                           "%s does not go with %s: the saved spectrum says it",
                           ps_option_show(request, (ps_option_id)id).text,
                           ps_option_show(request, PS_OPTION_AGAINST).text);
        }
    }
    return PSPEC_OK;
}

static pspec_status check_question(const ps_request *request, ps_error *error) {
    if (request->homogeneous) {
        return ps_homogeneity_check(request, error);
    }
    if (request->against == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--against FILE, the saved spectrum, or --homogeneous is needed");
    }
    PS_TRY(check_domain(request, error));
    PS_TRY(ps_request_check_one_count(request, "and a saved spectrum is of one", error));
    return request->num_sources <= 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "one sampler is compared with one saved spectrum, but %zu were given",
                         request->num_sources);
}

static void discard(void *computed) {
    checked *const check = computed;
    if (check == NULL) {
        return;
    }
    ps_homogeneity_discard(check->homogeneity);
    ps_power_job_destroy(check->job);
    ps_questions_free(&check->list);
    ps_saved_spectrum_free(&check->saved);
    free(check->rows);
    free(check);
}

/* Reads the saved spectrum and finds out what it asks of the measured side. *out is for discard,
 * also after an error. */
static pspec_status ask(checked **out, const ps_request *request, ps_error *error) {
    PS_TRY(check_question(request, error));
    PS_TRY(PS_NEW(out, 1, "a check", error));
    checked *const check = *out;
    PS_TRY(ps_saved_spectrum_read(&check->saved, request->against, error));
    check->own = ps_check_request(request, &check->saved);
    return ps_check_question_make(&check->list, &check->own, &check->saved, error);
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    checked *check = NULL;
    if (request->homogeneous) {
        return ps_homogeneity_plan(planner, request, error);
    }
    pspec_status status = ask(&check, request, error);
    if (status == PSPEC_OK) {
        status = ps_spectra_plan_list(planner, &check->own, &check->list, error);
    }
    discard(check);
    return status;
}

/* ---- the answer -------------------------------------------------------------------------- */

typedef struct range_text {
    char text[48];
} range_text;

/* "64", or "61 to 69" */
static range_text show_range(uint64_t smallest, uint64_t largest) {
    range_text out;
    if (smallest == largest) {
        snprintf(out.text, sizeof out.text, "%llu", (unsigned long long)smallest);
    } else {
        snprintf(out.text, sizeof out.text, "%llu to %llu", (unsigned long long)smallest,
                 (unsigned long long)largest);
    }
    return out;
}

/* Sets of a sampler whose numbers of points vary have the same spectrum wherever in their range. */
static pspec_status check_points(const ps_saved_spectrum *saved, const ps_spectrum *measured,
                                 const char *path, ps_error *error) {
    return saved->smallest_points <= measured->largest_points &&
                   measured->smallest_points <= saved->largest_points
               ? PSPEC_OK
               : ps_fail(
                     error, PSPEC_ERROR_INPUT,
                     "these sets have %s points, those of \"%s\" have %s; spectra change with the "
                     "number of points (-n says how files without it are cut)",
                     show_range(measured->smallest_points, measured->largest_points).text, path,
                     show_range(saved->smallest_points, saved->largest_points).text);
}

/* Do the rows of the file tell of these frequencies? Its digits are all there, but the order of a
 * sum may be another. */
static pspec_status check_frequency(const ps_saved_bin *saved, const ps_spectrum_bin *measured,
                                    const char *path, const char *name, ps_error *error) {
    const double rounding = 1e-9;
    if (fabs(saved->frequency - measured->frequency) > rounding * measured->frequency) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "\"%s\": %s %lld has the frequency %.10g, which cannot be: it is %.10g",
                       path, name, (long long)saved->key, saved->frequency, measured->frequency);
    }
    return saved->count == 0 || saved->count == measured->count
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "\"%s\": %s %lld has the count %llu, which cannot be: there are %llu "
                         "frequencies",
                         path, name, (long long)saved->key, (unsigned long long)saved->count,
                         (unsigned long long)measured->count);
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
        PS_TRY(check_frequency(&saved->bins[b], &measured->bins[b], path, name, error));
    }
    return saved->num_bins == measured->num_bins
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "\"%s\" has %zu %ss, but up to %d there are %zu",
                         path, saved->num_bins, name, (int)saved->max_frequency,
                         measured->num_bins);
}

/* The unit is taken to be that of the measured sets on both sides. */
static void make_sides(ps_compared *saved_side, ps_compared *measured_side,
                       const ps_saved_spectrum *saved, const ps_power_job *job) {
    const ps_spectrum *const measured = ps_power_job_spectrum(job);
    const double modes = ps_compared_modes(&measured->frequencies);
    const double unit = ps_compared_unit(saved->normalization, measured->mean_points,
                                         measured->sample_size.mean, measured->smallest_points);
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

static pspec_status compare(ps_comparison *rows, const ps_request *request,
                            const ps_saved_spectrum *saved, const ps_power_job *job,
                            ps_error *error) {
    ps_compared *sides = NULL;
    const size_t num = saved->num_bins;
    PS_TRY(ps_allocate_for(&sides, num, 2 * sizeof(ps_compared), "bins to compare", error));
    make_sides(sides, sides + num, saved, job);
    const pspec_status status =
        ps_compare(rows, num, sides, saved->num_realizations, sides + num,
                   ps_power_job_spectrum(job)->num_realizations, request->false_alarm_rate, error);
    free(sides);
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

static pspec_status judge(const ps_request *request, const ps_check_results *results,
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
                         request->against, results->num_different, results->saved->num_bins,
                         ps_check_bin_name(results->saved), request->false_alarm_rate,
                         ps_text_string(&worst));
    }
    ps_text_free(&worst);
    return status;
}

/* ---- the kind of answer ---------------------------------------------------------------------- */

static pspec_status compute_homogeneity(void **out, const ps_request *request,
                                        const ps_answer_hooks *hooks, ps_error *error) {
    checked *check = NULL;
    PS_TRY(PS_NEW(&check, 1, "a check", error));
    *out = check;
    return ps_homogeneity_compute(&check->homogeneity, request, hooks, error);
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    checked *check = NULL;
    if (request->homogeneous) {
        return compute_homogeneity(out, request, hooks, error);
    }
    const pspec_status asked = ask(&check, request, error);
    *out = check;
    PS_TRY(asked);
    PS_TRY(ps_spectra_run_one(&check->job, &check->list.questions[0], hooks, error));
    const ps_saved_spectrum *const saved = &check->saved;
    const ps_spectrum *const measured = ps_power_job_spectrum(check->job);
    PS_TRY(check_points(saved, measured, request->against, error));
    PS_TRY(check_bins(saved, measured, request->against, error));
    PS_TRY(PS_NEW(&check->rows, saved->num_bins, "compared bins", error));
    return compare(check->rows, request, saved, check->job, error);
}

/* The table is there whatever the verdict. */
static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    const checked *const check = computed;
    ps_check_results results = {&check->saved, check->job, check->rows, 0};
    if (check->homogeneity != NULL) {
        return ps_homogeneity_tabulate(out, check->homogeneity, error);
    }
    for (size_t b = 0; b < check->saved.num_bins; b++) {
        results.num_different += results.rows[b].differs;
    }
    PS_TRY(ps_check_table(&out->table, &check->own, &results, error));
    const pspec_status status = judge(request, &results, error);
    if (status != PSPEC_ERROR_CHECK) {
        return status;
    }
    out->verdict = *error;
    *error = (ps_error){0};
    return PSPEC_OK;
}

static const char *const summary[] = {
    "points",    "points_smallest",  "points_largest", "realizations",
    "different", "adjusted_p_value", "verdict",        NULL};
/* A table of rings has bins, one of degrees has degrees. */
static const ps_line_kind lines[] = {
    {"-scores", "difference", "bin", "z_score", "ring", "in standard errors", false, false},
    {.suffix = NULL}};

const ps_kind ps_kind_check = {
    .name = "check",
    .bit = PS_VERB_BIT(check),
    .samples = PS_DOMAIN_ANY,
    .counted = "realizations",
    .has_verdict = true,
    .leaves_default = ps_check_is_of_spectrum,
    .check_arguments = check_question,
    .check_question = check_question,
    .plan = plan,
    .compute = compute,
    .tabulate = tabulate,
    .discard = discard,
    .summary = summary,
    .lines = lines,
    .compare = ps_compare_verdicts,
};
