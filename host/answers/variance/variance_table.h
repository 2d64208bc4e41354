/* What variance jobs are asked by a request, and tables and pictures of what they answer. */
#ifndef PS_ANSWERS_VARIANCE_VARIANCE_TABLE_H
#define PS_ANSWERS_VARIANCE_VARIANCE_TABLE_H

#include "answers/figure.h"
#include "jobs/variance/variance_job.h"
#include "request/file_list.h"
#include "fields/table.h"

/* One question for each sampler or set and number of points, as the request counts them. The
 * questions borrow from it, and from here. */
typedef struct ps_variance_list {
    size_t num;
    ps_variance_question *questions; /* [num] */
    ps_sampler_request *requests;    /* [num] */
    ps_file_list *files;             /* [num] */
    ps_made_integrands made;         /* of all of them, unless the request shares them */
} ps_variance_list;

/* Checks that the options fit together. *out is freed by ps_variance_list_free, also after an
 * error. */
pspec_status ps_variance_list_make(ps_variance_list *out, const ps_request *arguments,
                                   ps_error *error) PS_MUST_CHECK;
void ps_variance_list_free(ps_variance_list *list);

/* A row for each integrand of each question; jobs [num] have run. verdict is that on --tail. */
pspec_status ps_variance_table(ps_table **out, const ps_request *request,
                               ps_variance_job *const *jobs, size_t num, const ps_error *verdict,
                               ps_error *error) PS_MUST_CHECK;
/* Variances against N, by the rows of such tables: a panel for each integrand, in which each
 * sampler has a colour. Predictions are lines on a band from lower to upper, measurements are marks
 * with bars of their errors, and white noise is a line of dashes. */
ps_make_figure ps_variance_figure;
/* The exponent that the header has of the curve; nan: it was not asked for. */
ps_uncertain ps_variance_find_slope(const ps_table *table, const char *sampler,
                                    const char *integrand);
void ps_variance_write_title(ps_text *out, const ps_request *request, const ps_table *table);

/* The number of sets of all samplers, or nan; with a text, which may be NULL, that of each. */
double ps_variance_num_sets(const ps_request *request, const ps_table *table, ps_text *each);

#endif
