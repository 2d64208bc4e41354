/* --rank: which sampler has the least variance, and how much more the others have, for each
 * integrand and number of points. */
#include "answers/spectra/spectrum_header.h"
#include "answers/variance/parts.h"
#include "answers/variance/ranked_pair.h"
#include "answers/variance/tail_verdict.h"
#include "base/memory.h"
#include "base/text.h"
#include "request/options.h"

#include <math.h>
#include <stdlib.h>

static size_t find_first(const ps_ranked *self) {
    size_t first = 0;
    for (size_t i = 1; i < self->num; i++) {
        first = ps_ranked_compare(self, i, first).log < 0 ? i : first;
    }
    return first;
}

/* 1 and how many are told apart as having less. */
static size_t find_rank(const ps_ranked *self, size_t sampler) {
    size_t rank = 1;
    for (size_t i = 0; i < self->num; i++) {
        if (i != sampler) {
            const ps_ranked_pair found = ps_ranked_compare(self, sampler, i);
            rank += found.is_told && found.log > 0;
        }
    }
    return rank;
}

/* ---- rows ---------------------------------------------------------------------------------- */

static const char *const by_names[] = {
    [PS_BY_PREDICTED] = "predicted", [PS_BY_PAIRS] = "pairs", [PS_BY_MEASURED] = "measured"};

static void fill(ps_cell *cells, const ps_request *request, ps_variance_job *const *jobs,
                 size_t question, size_t integrand) {
    const ps_ranked rows = ps_ranked_make(request, jobs, question, integrand);
    const size_t sampler = question / request->num_counts;
    const size_t first = find_first(&rows);
    const ps_ranked_pair found = ps_ranked_compare(&rows, sampler, first);
    const ps_ranked_pair white = ps_ranked_compare(&rows, rows.num, sampler);
    size_t num = 0;
    cells[num++] = PS_INTEGER(find_rank(&rows, sampler));
    cells[num++] = ps_number_or_missing(found.factor);
    cells[num++] = ps_number_or_missing(found.error);
    cells[num++] = PS_TEXT(by_names[found.by]);
    cells[num++] = ps_number_or_missing(found.score);
    cells[num++] = ps_number_or_missing(sampler == first ? NAN : found.p_value);
    cells[num++] = ps_number_or_missing(white.score);
    cells[num++] = ps_number_or_missing(white.p_value);
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

/* What would say whether it is. */
static pspec_status write_cure(ps_text *out, const ps_ranked *rows, size_t sampler,
                               const ps_ranked_pair *found, ps_error *error) {
    const ps_variance_job *const job = ps_ranked_job(rows, sampler);
    const bool is_on_torus = job->integrands[rows->integrand]->place.where == PS_SAMPLES_TORUS;
    const ps_option_id option = is_on_torus ? PS_OPTION_MAX_FREQUENCY : PS_OPTION_MAX_DEGREE;
    double cutoff = 0;
    PS_TRY(ps_variance_find_cutoff(&cutoff, rows->request, job, rows->integrand, found->energy,
                                   error));
    ps_text_append(out, ", told apart only if what lies beyond the cut-off is like white noise; ");
    if (isfinite(cutoff)) {
        ps_text_append(out, "-%c %.0f would settle it", ps_options[option].letter, cutoff);
    } else {
        ps_text_append(out, "trials (--%s) would settle it", ps_options[PS_OPTION_SHIFTS].name);
    }
    return PSPEC_OK;
}

/* " (measured, standard error 0.1, between 0.9 and 3: not told apart)" */
static void write_error(ps_text *out, const ps_ranked_pair *found) {
    const double one = 1.0005; /* with four digits a range beyond it is seen */
    const bool is_wide = found->largest > one * found->least;
    const bool has_range = (found->error == 0 && is_wide) || found->is_told_if_white;
    const bool is_told = found->is_told || found->is_told_if_white;
    if (found->error > 0) {
        ps_text_append(out, " (%sstandard error %.2g%s",
                       found->by == PS_BY_MEASURED ? "measured, " : "", found->error,
                       has_range ? ", " : "");
    }
    if (has_range) {
        ps_text_append(out, "%sbetween %.4g and %.4g", found->error > 0 ? "" : " (", found->least,
                       found->largest);
    }
    if (found->error > 0 || has_range) {
        ps_text_append(out, is_told ? ")" : ": not told apart)");
    } else {
        ps_text_append(out, is_told ? "" : " (not told apart)");
    }
}

/* What `sampler`, num for white noise, has beside the first one; found: its factor. */
static pspec_status write_more(ps_text *out, const ps_ranked *rows, size_t sampler, size_t first,
                               const ps_ranked_pair *found, ps_error *error) {
    const char *const name =
        sampler == rows->num ? "white noise" : ps_request_source_name(rows->request, sampler);
    if (isnan(found->factor)) {
        ps_text_append(out, "; %s cannot be compared, since a variance is 0", name);
    } else if (found->log == 0 && found->error == 0) {
        ps_text_append(out, "; %s has the same", name);
    } else if (isnan(found->error)) {
        ps_text_append(out, "; %s has %.4g times as much, from too few sets for an error", name,
                       found->factor);
    } else {
        ps_text_append(out, "; %s has %.4g times as much", name, found->factor);
        if (found->by == PS_BY_PAIRS) {
            ps_text_append(out, ", by sums over pairs of points");
        } else {
            write_error(out, found);
        }
        PS_TRY(found->is_told_if_white
                   ? write_cure(out, rows, sampler < rows->num ? sampler : first, found, error)
                   : PSPEC_OK);
    }
    return PSPEC_OK;
}

static ps_cell points_of(const ps_ranked *rows, size_t sampler) {
    const ps_power_job *const job = ps_ranked_job(rows, sampler)->spectrum;
    return job->question->sampler != NULL
               ? PS_INTEGER(ps_request_points(rows->request, rows->first))
               : PS_NUMBER(job->spectrum.mean_points);
}

/* The N that was asked for, or that the sets of files have: of all rows, or from .. to. */
static void write_points(ps_text *out, const ps_ranked *rows) {
    double least = (double)ps_request_points(rows->request, rows->first);
    double most = least;
    for (size_t i = 0; ps_request_has_files(rows->request) && i < rows->num; i++) {
        const double own = ps_ranked_job(rows, i)->spectrum->spectrum.mean_points;
        least = i == 0 ? own : fmin(least, own);
        most = i == 0 ? own : fmax(most, own);
    }
    ps_text_append(out, "N = %.10g", least);
    if (most > least) {
        ps_text_append(out, " to %.10g", most);
    }
}

/* In the order of a sentence. */
typedef struct place {
    size_t sampler, rank; /* 0: the first one */
    double log;           /* of its factor */
} place;

static int by_rank(const void *a, const void *b) {
    const place *const x = a;
    const place *const y = b;
    return x->rank != y->rank ? (x->rank > y->rank) - (x->rank < y->rank)
           : x->log != y->log ? (x->log > y->log) - (x->log < y->log)
                              : (x->sampler > y->sampler) - (x->sampler < y->sampler);
}

static void sort(place *places, const ps_ranked *rows) {
    const size_t first = find_first(rows);
    for (size_t i = 0; i < rows->num; i++) {
        places[i] =
            (place){i, i == first ? 0 : find_rank(rows, i), ps_ranked_compare(rows, i, first).log};
    }
    qsort(places, rows->num, sizeof *places, by_rank);
}

static pspec_status write_sentence(ps_text *out, const ps_ranked *rows, const place *places,
                                   ps_error *error) {
    const ps_request *const request = rows->request;
    const size_t first = places[0].sampler;
    const ps_ranked_pair white = ps_ranked_compare(rows, rows->num, first);
    ps_text_append(out, "%s, ", request->integrands[rows->integrand]);
    write_points(out, rows);
    ps_text_append(out, ": %s has the least variance", ps_request_source_name(request, first));
    for (size_t i = 1; i < rows->num; i++) {
        const ps_ranked_pair found = ps_ranked_compare(rows, places[i].sampler, first);
        PS_TRY(write_more(out, rows, places[i].sampler, first, &found, error));
    }
    if (ps_integrand_is_predicted(ps_ranked_job(rows, first)->integrands[rows->integrand])) {
        PS_TRY(write_more(out, rows, rows->num, first, &white, error));
    }
    return ps_text_check(out, error);
}

static pspec_status add_sentence(ps_table *table, const ps_ranked *rows, const ps_text *text,
                                 size_t first, ps_error *error) {
    const ps_request *const request = rows->request;
    const ps_meta entries[] = {
        {"ranking", PS_TEXT(ps_text_string(text))},
        {"ranking_integrand", PS_TEXT(request->integrands[rows->integrand])},
        {"ranking_points", points_of(rows, first)},
        {"ranking_first", PS_TEXT(ps_request_source_name(request, first))},
    };
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

static pspec_status add_ranking(ps_table *table, const ps_ranked *rows, ps_error *error) {
    place *places = NULL;
    ps_text text = {0};
    PS_TRY(PS_NEW(&places, rows->num, "a ranking", error));
    sort(places, rows);
    pspec_status status = write_sentence(&text, rows, places, error);
    if (status == PSPEC_OK) {
        status = add_sentence(table, rows, &text, places[0].sampler, error);
    }
    ps_text_free(&text);
    free(places);
    return status;
}

static pspec_status add_all(ps_table *table, const ps_request *request,
                            ps_variance_job *const *jobs, ps_error *error) {
    for (size_t i = 0; i < request->num_integrands; i++) {
        for (size_t k = 0; k < request->num_counts; k++) {
            const ps_ranked rows = ps_ranked_make(request, jobs, k, i);
            PS_TRY(add_ranking(table, &rows, error));
        }
    }
    return PSPEC_OK;
}

const ps_variance_part ps_variance_part_rank = {
    .columns = {"rank", "factor", "factor_error", "factor_by", "factor_score", "factor_p_value",
                "white_score", "white_p_value"},
    .is_wanted = is_wanted,
    .with_errors = PS_OPTION_RANK,
    .check = check,
    .fill = fill,
    .add_all = add_all,
};
