#include "answers/variance/variance_table.h"

#include "answers/lead.h"
#include "answers/spectra/spectrum_header.h"
#include "answers/variance/parts.h"
#include "answers/variance/tail_verdict.h"
#include "base/memory.h"
#include "math/random/distributions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Those of parts follow. */
static const char *const columns[] = {"points",         "predicted", "predicted_error",
                                      "lower",          "upper",     "measured",
                                      "measured_error", "z_score",   "white"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };
enum { MOST_COLUMNS = NUM_COLUMNS + PS_MOST_PARTS_COLUMNS };
_Static_assert((int)MOST_COLUMNS <= (int)PS_MOST_COLUMNS_AFTER_LEAD, "rows have room for all");

static size_t choose_columns(const char *out[MOST_COLUMNS], const ps_request *request) {
    memcpy(out, columns, sizeof columns);
    return ps_variance_parts_columns(out, NUM_COLUMNS, request);
}

/* What a row is of, besides its number of points, which every row has. */
static ps_lead make_lead(const ps_request *request, size_t question, size_t integrand) {
    ps_lead lead = {0};
    if (request->num_sources > 1) {
        lead.names[lead.num] = "sampler";
        lead.cells[lead.num++] = PS_TEXT(ps_request_name(request, question));
    }
    if (request->num_integrands > 1) {
        lead.names[lead.num] = "integrand";
        lead.cells[lead.num++] = PS_TEXT(request->integrands[integrand]);
    }
    return lead;
}

/* A whole number unless sets differ. */
static ps_cell points_cell(const ps_spectrum *spectrum) {
    return spectrum->smallest_points == spectrum->largest_points
               ? PS_INTEGER((long long)spectrum->largest_points)
               : PS_NUMBER(spectrum->mean_points);
}

static pspec_status add_row(ps_table *table, const ps_request *request, const ps_lead *lead,
                            ps_variance_job *const *jobs, size_t question, size_t integrand,
                            ps_error *error) {
    const ps_variance_job *const job = jobs[question];
    const ps_variance_row *const row = &job->rows[integrand];
    ps_cell cells[MOST_COLUMNS] = {
        points_cell(&job->spectrum->spectrum),
        ps_number_or_missing(row->prediction.variance),
        ps_number_or_missing(row->prediction.standard_error),
        ps_number_or_missing(row->prediction.lower),
        ps_number_or_missing(row->prediction.upper),
        ps_number_or_missing(row->measured),
        ps_number_or_missing(row->measured_error),
        ps_number_or_missing(row->z_score),
        ps_number_or_missing(row->prediction.white),
    };
    const size_t num =
        ps_variance_parts_cells(cells, NUM_COLUMNS, request, jobs, question, integrand);
    return ps_lead_add_row(table, lead, cells, num, error);
}

/* ---- header -------------------------------------------------------------------------------- */

/* What all jobs have in common. */
static pspec_status begin(ps_table *table, const ps_request *request, const ps_variance_job *first,
                          ps_error *error) {
    const ps_variance_trials trials = first->trials;
    const ps_meta entries[] = {
        {"normalization", PS_TEXT("mean(N) mean(|S|^2 / W^2), whose weighted sum is a variance")},
        {"seed", PS_INTEGER(request->seed)},
        {"trials", PS_TEXT(request->num_shifts == 0 ? "none"
                           : request->in_place      ? "sets where they are"
                                                    : "sets moved at random, one for each trial")},
        {"shifts",
         PS_INTEGER(ps_request_has_samplers(request) ? request->num_shifts : trials.num_shifts)},
        {"predicted_error_is",
         PS_TEXT("below, a bound on the numerical error of S; as a column, the "
                 "standard error of the prediction")},
        {"measured_error_is",
         PS_TEXT("a standard error, also in z_score; student_95 of them hold 95 % of normal "
                 "numbers, but squares of few estimates are skewed, and 85 to 91 % of those of 20 "
                 "sets")},
    };
    PS_TRY(ps_lead_add_origin(table, request->command_line, error));
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

/* Of files: how many sets are measured, beside those that predict, and what their weights cost. */
static pspec_status add_files(ps_table *table, const ps_variance_job *job, ps_error *error) {
    const ps_meta entries[] = {
        {"measured_sets", PS_INTEGER(job->trials.num_sets)},
        {"white_power", PS_NUMBER(job->beyond.white)},
    };
    return job->spectrum->question->sampler != NULL
               ? PSPEC_OK
               : ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

/* How many standard errors hold 95 % of normal numbers, from as many as are measured. */
static pspec_status add_quantile(ps_table *table, const ps_variance_job *job, ps_error *error) {
    const double outside = 0.05;
    const ps_variance_trials trials = job->trials;
    const uint64_t num = trials.is_one_set ? trials.num_shifts : trials.num_sets;
    const double quantile = num > 1 ? ps_student_score(outside, (double)num - 1) : NAN;
    return trials.num_shifts == 0
               ? PSPEC_OK
               : ps_table_add_meta(table, "student_95", ps_number_or_missing(quantile), error);
}

/* Of a single set. */
static pspec_status add_pairwise(ps_table *table, const ps_variance_row *row, ps_error *error) {
    return isnan(row->pairwise)
               ? PSPEC_OK
               : ps_table_add_meta(table, "pairwise_variance", PS_NUMBER(row->pairwise), error);
}

/* What the bracket takes for the power beyond the cut-off. */
static pspec_status add_most_power(ps_table *table, const ps_variance_job *job, ps_error *error) {
    const ps_power_beyond *const beyond = &job->beyond;
    const ps_meta entries[] = {
        {"most_power", PS_NUMBER(beyond->most)},
        {"most_power_is",
         PS_TEXT(beyond->is_known  ? "a bound"
                 : beyond->matters ? "assumed: the largest that was measured, at least 1"
                                   : "assumed; nothing depends on it, for "
                                     "the integrands end before the cut-off")},
    };
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

/* What was asked for besides. */
static pspec_status add_choices(ps_table *table, const ps_request *request,
                                ps_variance_job *const *jobs, size_t num, const ps_error *verdict,
                                ps_error *error) {
    const ps_meta tails[] = {
        {"tail", PS_NUMBER(request->tail)},
        {"tail_largest", PS_NUMBER(ps_variance_largest_tail(request, jobs, num))},
        {"tail_verdict", PS_TEXT(verdict->status == PSPEC_OK ? "reached" : verdict->message)},
    };
    if (request->frequencies.bins.kind == PS_BINS_SHELLS) {
        PS_TRY(
            ps_table_add_meta(table, "sum", PS_TEXT("over exact shells, |k|^2 <= K^2 + K"), error));
    }
    if (request->wants_ranking || request->wants_rates) { /* for all that a sentence is about */
        PS_TRY(ps_table_add_meta(table, "false_alarm_rate", PS_NUMBER(request->false_alarm_rate),
                                 error));
    }
    PS_TRY(ps_variance_parts_add_about(table, request, error));
    return request->tail > 0
               ? ps_table_add_metas(table, tails, sizeof tails / sizeof tails[0], error)
               : PSPEC_OK;
}

static pspec_status fill(ps_table *table, const ps_request *request, ps_variance_job *const *jobs,
                         const ps_measured *spectra, size_t num, ps_error *error) {
    for (size_t i = 0; i < request->num_integrands; i++) {
        PS_TRY(
            ps_header_add_integrand(table, request->integrands[i], jobs[0]->integrands[i], error));
    }
    for (size_t i = 0; i < num; i++) {
        PS_TRY(ps_header_add(table, request, spectra, num, i, error));
        PS_TRY(add_files(table, jobs[i], error));
        PS_TRY(add_quantile(table, jobs[i], error));
        PS_TRY(add_most_power(table, jobs[i], error));
        PS_TRY(ps_variance_parts_add_question(table, request, jobs[i], error));
        for (size_t k = 0; k < request->num_integrands; k++) {
            const ps_lead lead = make_lead(request, i, k);
            PS_TRY(add_pairwise(table, &jobs[i]->rows[k], error));
            PS_TRY(add_row(table, request, &lead, jobs, i, k, error));
        }
    }
    return ps_variance_parts_add_all(table, request, jobs, error);
}

static pspec_status measure(ps_measured **out, const ps_request *request,
                            ps_variance_job *const *jobs, size_t num, ps_error *error) {
    const ps_power_job **spectra = NULL;
    PS_TRY(PS_NEW(&spectra, num, "jobs", error));
    for (size_t i = 0; i < num; i++) {
        spectra[i] = jobs[i]->spectrum;
    }
    const pspec_status status = ps_measured_of_jobs(out, request, spectra, num, error);
    free(spectra);
    return status;
}

pspec_status ps_variance_table(ps_table **out, const ps_request *request,
                               ps_variance_job *const *jobs, size_t num, const ps_error *verdict,
                               ps_error *error) {
    const char *names[MOST_COLUMNS];
    const size_t num_columns = choose_columns(names, request);
    const ps_lead first = make_lead(request, 0, 0);
    ps_request own = *request; /* what headers say of powers is said of these */
    own.normalization = PSPEC_NORMALIZATION_INTEGRAL;
    ps_measured *spectra = NULL;
    PS_TRY(ps_lead_create_table(out, "variance", &first, names, num_columns, error));
    PS_TRY(begin(*out, request, jobs[0], error));
    PS_TRY(add_choices(*out, request, jobs, num, verdict, error));
    pspec_status status = measure(&spectra, &own, jobs, num, error);
    if (status == PSPEC_OK) {
        status = fill(*out, &own, jobs, spectra, num, error);
    }
    ps_measured_free(spectra, num);
    return status;
}

double ps_variance_num_sets(const ps_request *request, const ps_table *table, ps_text *each) {
    double all = ps_cell_number(ps_table_find_meta(table, "realizations"));
    const char *key = NULL;
    size_t found = 0;
    for (size_t i = 0; i < ps_table_num_meta(table); i++) {
        const double sets = ps_cell_number(ps_table_meta(table, i, &key));
        if (strcmp(key, "realizations") == 0 && found++ % request->num_counts == 0) {
            all = sets == all ? all : NAN;
            if (each != NULL) {
                ps_text_append(each, "%s%.0f of %s", found > 1 ? ", " : ", M = ", sets,
                               ps_request_name(request, found - 1));
            }
        }
    }
    return all;
}
