
#include "answers/spectra/spectrum_header.h"
#include "answers/variance/parts.h"
#include "base/memory.h"
#include "base/text.h"
#include "jobs/variance/rates.h"
#include "request/options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Questions are sampler by sampler, and of a sampler N by N. */
typedef struct view {
    const ps_request *request;
    ps_variance_job *const *jobs;
    size_t num_counts;
    ps_log_variance *logs[2]; /* [num_counts] each: of a sampler, and of another */
    ps_crossing *crossings;   /* [num_counts] */
    ps_text text;             /* of a sentence */
} view;

/* ---- rows ---------------------------------------------------------------------------------- */

static void fill(ps_cell *cells, const ps_request *request, ps_variance_job *const *jobs,
                 size_t question, size_t integrand) {
    ps_log_variance logs[2];
    ps_uncertain rate = PS_UNCERTAIN_NONE;
    if (question % request->num_counts > 0) {
        for (size_t i = 0; i < 2; i++) {
            ps_variance_job_log(jobs[question - 1 + i], integrand, PS_VARIANCE_PREDICTED, &logs[i]);
        }
        rate = logs[0].points < logs[1].points ? ps_rate_between(&logs[0], &logs[1]) : rate;
    }
    cells[0] = ps_number_or_missing(rate.value);
    cells[1] = ps_number_or_missing(rate.error);
}

static bool is_wanted(const ps_request *request) {
    return request->wants_rates;
}

static pspec_status check(const ps_request *request, ps_error *error) {
    return request->num_sources > 0 && request->num_counts > 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s is how variances of a sampler fall as N grows, which takes several "
                         "numbers of points, as in %s 64..1024",
                         ps_option_show(request, PS_OPTION_RATES).text,
                         ps_option_show(request, PS_OPTION_POINTS).text);
}

/* ---- what is looked at ----------------------------------------------------------------------- */

static pspec_status open(view *self, const ps_request *request, ps_variance_job *const *jobs,
                         ps_error *error) {
    const size_t num = request->num_counts;
    *self = (view){.request = request, .jobs = jobs, .num_counts = num};
    PS_TRY(PS_NEW(&self->logs[0], num, "rates", error));
    PS_TRY(PS_NEW(&self->logs[1], num, "rates", error));
    return PS_NEW(&self->crossings, num, "rates", error);
}

static void release(view *self) {
    free(self->logs[0]);
    free(self->logs[1]);
    free(self->crossings);
    ps_text_free(&self->text);
}

static int compare_points(const void *a, const void *b) {
    const double x = ((const ps_log_variance *)a)->points;
    const double y = ((const ps_log_variance *)b)->points;
    return (x > y) - (x < y);
}

/* Of the N of the window, ascending. */
static size_t gather(const view *self, ps_log_variance *logs, size_t sampler, size_t integrand,
                     ps_variance_number number) {
    const double *const window = self->request->rates;
    size_t num = 0;
    for (size_t i = 0; i < self->num_counts; i++) {
        ps_log_variance *const one = &logs[num];
        ps_variance_job_log(self->jobs[sampler * self->num_counts + i], integrand, number, one);
        num += one->points >= window[0] && one->points <= window[1];
    }
    qsort(logs, num, sizeof *logs, compare_points);
    return num;
}

/* ---- exponents ------------------------------------------------------------------------------- */

static ps_cell number_if(pspec_status status, double number) {
    return status == PSPEC_OK ? ps_number_or_missing(number) : PS_MISSING;
}

static void write_rate(ps_text *out, const char *what, const ps_rate *rate,
                       const ps_error *reason) {
    if (reason->status != PSPEC_OK) {
        ps_text_append(out, "%s none: %s", what, reason->message);
        return;
    }
    ps_text_append(out, "%s N^%.4g with the standard error %.2g, from N = %.10g to %.10g", what,
                   -rate->rate.value, rate->rate.error, rate->from, rate->to);
}

/* What a line does not say: one false alarm for all samplers together. */
static void write_change(ps_text *out, const ps_request *request, const ps_rate *rate) {
    const double p_value = ps_uncertain_p_value(&rate->change, 0);
    if ((double)request->num_sources * p_value <= request->false_alarm_rate) {
        ps_text_append(out,
                       "; this is no one power: whenever N doubles, r of N^-r %s by %.2g with the "
                       "standard error %.1g",
                       rate->change.value > 0 ? "grows" : "shrinks", fabs(rate->change.value),
                       rate->change.error);
    }
}

static pspec_status add_exponents(view *self, ps_table *table, size_t sampler, size_t integrand,
                                  ps_error *error) {
    const ps_request *const request = self->request;
    ps_rate rates[2] = {{0}};
    ps_error reasons[2] = {{0}};
    for (size_t i = 0; i < 2; i++) {
        const size_t num = gather(self, self->logs[i], sampler, integrand,
                                  i == 1 ? PS_VARIANCE_MEASURED : PS_VARIANCE_PREDICTED);
        reasons[i].status = ps_rate_fit(&rates[i], self->logs[i], num, &reasons[i]);
        if (reasons[i].status == PSPEC_ERROR_MEMORY) {
            *error = reasons[i];
            return reasons[i].status;
        }
    }
    ps_text_free(&self->text);
    ps_text_append(&self->text, "%s, %s: ", ps_request_source_name(request, sampler),
                   request->integrands[integrand]);
    write_rate(&self->text, "predicted", &rates[0], &reasons[0]);
    if (reasons[0].status == PSPEC_OK) {
        write_change(&self->text, request, &rates[0]);
    }
    if (request->num_shifts > 0) {
        write_rate(&self->text, "; measured", &rates[1], &reasons[1]);
    }
    PS_TRY(ps_text_check(&self->text, error));
    const double white = (rates[0].rate.value - 1) / rates[0].rate.error;
    const ps_meta entries[] = {
        {"rates", PS_TEXT(ps_text_string(&self->text))},
        {"rate_sampler", PS_TEXT(ps_request_source_name(request, sampler))},
        {"rate_integrand", PS_TEXT(request->integrands[integrand])},
        {"rate", number_if(reasons[0].status, rates[0].rate.value)},
        {"rate_error", number_if(reasons[0].status, rates[0].rate.error)},
        {"rate_from", number_if(reasons[0].status, rates[0].from)},
        {"rate_to", number_if(reasons[0].status, rates[0].to)},
        {"rate_change", number_if(reasons[0].status, rates[0].change.value)},
        {"rate_change_error", number_if(reasons[0].status, rates[0].change.error)},
        {"rate_white_score", number_if(reasons[0].status, white)},
        {"measured_rate", number_if(reasons[1].status, rates[1].rate.value)},
        {"measured_rate_error", number_if(reasons[1].status, rates[1].rate.error)},
    };
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

/* ---- crossings ------------------------------------------------------------------------------- */

/* Two samplers of one integrand. */
typedef struct pair {
    const char *a, *b, *integrand;
    size_t num;
    double from, to;
} pair;

static pspec_status add_crossing(view *self, ps_table *table, const pair *two,
                                 const ps_crossing *crossing, ps_error *error) {
    const double points = crossing != NULL ? crossing->points.value : NAN;
    const double points_error = crossing != NULL ? crossing->points.error : NAN;
    PS_TRY(ps_text_check(&self->text, error));
    const ps_meta entries[] = {
        {"crossing", PS_TEXT(ps_text_string(&self->text))},
        {"crossing_first", PS_TEXT(two->a)},
        {"crossing_second", PS_TEXT(two->b)},
        {"crossing_integrand", PS_TEXT(two->integrand)},
        {"crossing_points", ps_number_or_missing(points)},
        {"crossing_points_error", ps_number_or_missing(points_error)},
    };
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

static void write_none(ps_text *out, const pair *two, const ps_crossings *found) {
    const bool is_a = found->num_a > 0;
    const size_t num = found->num_a + found->num_b;
    if (num == 0) {
        ps_text_append(out, "none from N = %.10g to %.10g: %s and %s are told apart at no N",
                       two->from, two->to, two->a, two->b);
        return;
    }
    ps_text_append(out, "none from N = %.10g to %.10g: %s has less variance than %s at ", two->from,
                   two->to, is_a ? two->a : two->b, is_a ? two->b : two->a);
    if (num == two->num) {
        ps_text_append(out, "every N");
    } else {
        ps_text_append(out, "%zu of %zu N, and at the others they are not told apart", num,
                       two->num);
    }
}

static pspec_status add_crossings(view *self, ps_table *table, const pair *two,
                                  const ps_crossings *found, ps_error *error) {
    for (size_t i = 0; i < found->num; i++) {
        const ps_crossing *const one = &found->found[i];
        const int digits = one->points.error < 10;
        ps_text_free(&self->text);
        ps_text_append(&self->text,
                       "%s: %s has less variance from N = %.*f on, with the standard error %.*f, "
                       "and %s before",
                       two->integrand, one->is_a_below ? two->b : two->a, digits, one->points.value,
                       digits, one->points.error, one->is_a_below ? two->a : two->b);
        PS_TRY(add_crossing(self, table, two, one, error));
    }
    if (found->num > 0) {
        return PSPEC_OK;
    }
    ps_text_free(&self->text);
    ps_text_append(&self->text, "%s: ", two->integrand);
    write_none(&self->text, two, found);
    return add_crossing(self, table, two, NULL, error);
}

/* Any two samplers are compared at every N. */
static double rate_of_test(const ps_request *request) {
    const double num = (double)request->num_sources;
    return request->false_alarm_rate / (num * (num - 1) / 2 * (double)request->num_counts);
}

static pspec_status add_pair(view *self, ps_table *table, size_t a, size_t b, size_t integrand,
                             ps_error *error) {
    const ps_request *const request = self->request;
    pair two = {.a = ps_request_source_name(request, a),
                .b = ps_request_source_name(request, b),
                .integrand = request->integrands[integrand]};
    ps_crossings found = {0};
    two.num = gather(self, self->logs[0], a, integrand, PS_VARIANCE_PREDICTED);
    if (gather(self, self->logs[1], b, integrand, PS_VARIANCE_PREDICTED) != two.num ||
        !ps_crossings_have_same_points(self->logs[0], self->logs[1], two.num) || two.num == 0) {
        ps_text_free(&self->text);
        ps_text_append(&self->text, "%s: none: %s and %s do not have the same numbers of points",
                       two.integrand, two.a, two.b);
        return add_crossing(self, table, &two, NULL, error);
    }
    two.from = self->logs[0][0].points;
    two.to = self->logs[0][two.num - 1].points;
    PS_TRY(ps_crossings_find(&found, self->crossings, self->logs[0], self->logs[1], two.num,
                             rate_of_test(request), error));
    return add_crossings(self, table, &two, &found, error);
}

static pspec_status add_integrand(view *self, ps_table *table, size_t integrand, ps_error *error) {
    const size_t num = self->request->num_sources;
    for (size_t a = 0; a < num; a++) {
        PS_TRY(add_exponents(self, table, a, integrand, error));
    }
    for (size_t a = 0; a < num; a++) {
        for (size_t b = a + 1; b < num; b++) {
            PS_TRY(add_pair(self, table, a, b, integrand, error));
        }
    }
    return PSPEC_OK;
}

static pspec_status add_all(ps_table *table, const ps_request *request,
                            ps_variance_job *const *jobs, ps_error *error) {
    view self;
    pspec_status status = open(&self, request, jobs, error);
    for (size_t i = 0; status == PSPEC_OK && i < request->num_integrands; i++) {
        status = add_integrand(&self, table, i, error);
    }
    release(&self);
    return status;
}

const ps_variance_part ps_variance_part_rates = {
    .columns = {"rate_here", "rate_here_error"},
    .is_wanted = is_wanted,
    .with_errors = PS_OPTION_RATES,
    .check = check,
    .fill = fill,
    .add_all = add_all,
};
