/* --rank: which sampler has the least variance, and how much more the others have, for each
 * integrand and number of points. */
#include "answers/spectra/spectrum_header.h"
#include "answers/variance/parts.h"
#include "base/text.h"
#include "jobs/variance/rates.h"
#include "request/options.h"

#include <math.h>

/* Rows of one integrand and one N. */
typedef struct field {
    ps_variance_job *const *jobs;
    size_t first, step, num; /* jobs of the samplers */
    size_t integrand;
} field;

/* Questions are sampler by sampler, and of a sampler N by N. */
static field make_field(const ps_request *request, ps_variance_job *const *jobs, size_t question,
                        size_t integrand) {
    return (field){.jobs = jobs,
                   .first = question % request->num_counts,
                   .step = request->num_counts,
                   .num = request->num_sources,
                   .integrand = integrand};
}

static const ps_variance_job *job_of(const field *self, size_t sampler) {
    return self->jobs[self->first + sampler * self->step];
}

static double variance_of(const field *self, size_t sampler) {
    return ps_variance_job_rows(job_of(self, sampler))[self->integrand].prediction.variance;
}

/* 0: the least variance; of two that are the same the first one. */
static size_t find_rank(const field *self, size_t sampler) {
    const double own = variance_of(self, sampler);
    size_t rank = 0;
    for (size_t i = 0; i < self->num; i++) {
        const double other = variance_of(self, i);
        rank += other < own || (other == own && i < sampler);
    }
    return rank;
}

static size_t find_sampler(const field *self, size_t rank) {
    size_t sampler = 0;
    while (find_rank(self, sampler) != rank) {
        sampler++;
    }
    return sampler;
}

/* ---- two of them --------------------------------------------------------------------------- */

/* Of a to b: their ratio with its error, and how many errors its logarithm is from 0; nan: none. */
typedef struct comparison {
    double factor, error, score;
} comparison;

static comparison compare_logs(const ps_log_variance *a, const ps_log_variance *b) {
    const ps_log_variance ratio = ps_log_variances_difference(a, b);
    const double factors[] = {1};
    const ps_uncertain found = ps_log_variances_combine(&ratio, factors, 1);
    const double factor = isfinite(found.value) ? exp(found.value) : NAN;
    return (comparison){factor, factor * found.error,
                        found.error > 0 ? found.value / found.error : NAN};
}

static comparison compare(const field *self, size_t a, size_t b) {
    ps_log_variance logs[2];
    ps_variance_job_log(job_of(self, a), self->integrand, false, &logs[0]);
    ps_variance_job_log(job_of(self, b), self->integrand, false, &logs[1]);
    return compare_logs(&logs[0], &logs[1]);
}

/* White noise to a. */
static comparison compare_white(const field *self, size_t a) {
    const ps_block_sums none = {0};
    const double white = ps_variance_job_rows(job_of(self, a))[self->integrand].prediction.white;
    ps_log_variance logs[2];
    ps_log_variance_make(&logs[0], 1, (ps_mean){white, 0}, &none);
    ps_variance_job_log(job_of(self, a), self->integrand, false, &logs[1]);
    return compare_logs(&logs[0], &logs[1]);
}

/* ---- rows ---------------------------------------------------------------------------------- */

static void fill(ps_cell *cells, const ps_request *request, ps_variance_job *const *jobs,
                 size_t question, size_t integrand) {
    const field rows = make_field(request, jobs, question, integrand);
    const size_t sampler = question / request->num_counts;
    const size_t best = find_sampler(&rows, 0);
    const comparison found = compare(&rows, sampler, best);
    cells[0] = PS_INTEGER(find_rank(&rows, sampler) + 1);
    cells[1] = ps_number_or_missing(found.factor);
    cells[2] = ps_number_or_missing(found.error);
    cells[3] = ps_number_or_missing(found.score);
    cells[4] = ps_number_or_missing(compare_white(&rows, sampler).score);
}

static bool is_wanted(const ps_request *request) {
    return request->wants_ranking;
}

static pspec_status check(const ps_request *request, ps_error *error) {
    return request->num_sources > 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s compares samplers and sets, which takes two of them",
                         ps_option_show(request, PS_OPTION_RANK).text);
}

/* ---- sentences ----------------------------------------------------------------------------- */

static void write_more(ps_text *out, const char *name, const comparison *found) {
    if (isnan(found->factor)) {
        ps_text_append(out, "; %s cannot be compared, since a variance is 0", name);
    } else if (isnan(found->error)) {
        ps_text_append(out, "; %s has %.4g times as much, from too few sets for an error", name,
                       found->factor);
    } else if (found->error == 0) {
        ps_text_append(out, "; %s has %.4g times as much, exactly", name, found->factor);
    } else {
        ps_text_append(out, "; %s has %.4g times as much (standard error %.2g, %.3g from 1%s)",
                       name, found->factor, found->error, fabs(found->score),
                       fabs(found->score) < PS_RATES_TOLD_APART ? ": not told apart" : "");
    }
}

static ps_cell points_of(const ps_request *request, const field *rows, size_t sampler) {
    const ps_power_job *const job = ps_variance_job_spectrum(job_of(rows, sampler));
    return ps_power_job_sampler(job) != NULL ? PS_INTEGER(ps_request_points(request, rows->first))
                                             : PS_NUMBER(ps_power_job_spectrum(job)->mean_points);
}

/* The N that was asked for, or that the sets of files have: of all rows, or from .. to. */
static void write_points(ps_text *out, const ps_request *request, const field *rows) {
    double least = (double)ps_request_points(request, rows->first);
    double most = least;
    for (size_t i = 0; ps_request_has_files(request) && i < rows->num; i++) {
        const double own =
            ps_power_job_spectrum(ps_variance_job_spectrum(job_of(rows, i)))->mean_points;
        least = i == 0 ? own : fmin(least, own);
        most = i == 0 ? own : fmax(most, own);
    }
    ps_text_append(out, "N = %.10g", least);
    if (most > least) {
        ps_text_append(out, " to %.10g", most);
    }
}

static pspec_status add_sentence(ps_table *table, const ps_request *request, const field *rows,
                                 ps_text *text, ps_error *error) {
    const size_t best = find_sampler(rows, 0);
    const comparison white = compare_white(rows, best);
    ps_text_append(text, "%s, ", request->integrands[rows->integrand]);
    write_points(text, request, rows);
    ps_text_append(text, ": %s has the least variance", ps_request_source_name(request, best));
    for (size_t rank = 1; rank < rows->num; rank++) {
        const size_t sampler = find_sampler(rows, rank);
        const comparison found = compare(rows, sampler, best);
        write_more(text, ps_request_source_name(request, sampler), &found);
    }
    write_more(text, "white noise", &white);
    PS_TRY(ps_text_check(text, error));
    const ps_meta entries[] = {
        {"ranking", PS_TEXT(ps_text_string(text))},
        {"ranking_integrand", PS_TEXT(request->integrands[rows->integrand])},
        {"ranking_points", points_of(request, rows, best)},
        {"ranking_first", PS_TEXT(ps_request_source_name(request, best))},
    };
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

static pspec_status add_all(ps_table *table, const ps_request *request,
                            ps_variance_job *const *jobs, ps_error *error) {
    for (size_t i = 0; i < request->num_integrands; i++) {
        for (size_t k = 0; k < request->num_counts; k++) {
            const field rows = make_field(request, jobs, k, i);
            ps_text text = {0};
            const pspec_status status = add_sentence(table, request, &rows, &text, error);
            ps_text_free(&text);
            PS_TRY(status);
        }
    }
    return PSPEC_OK;
}

const ps_variance_part ps_variance_part_rank = {
    .columns = {"rank", "factor", "factor_error", "factor_score", "white_score"},
    .is_wanted = is_wanted,
    .with_errors = PS_OPTION_RANK,
    .check = check,
    .fill = fill,
    .add_all = add_all,
};
