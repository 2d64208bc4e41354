/* The table and the picture of quadrature jobs that have run. */
#ifndef PS_ANSWERS_QUADRATURE_QUADRATURE_TABLE_H
#define PS_ANSWERS_QUADRATURE_QUADRATURE_TABLE_H

#include "answers/quadrature/quadrature_question.h"
#include "tables/table.h"

/* results[list->num] */
pspec_status ps_quadrature_table(ps_table **out, const ps_request *arguments,
                                 const ps_quadrature_list *list,
                                 const ps_quadrature_result *results,
                                 ps_error *error) PS_MUST_CHECK;

/* d_l^2, C_l^2 and e_l^2 against the degree, to arguments->plot. */
pspec_status ps_quadrature_plot(const ps_request *arguments, const ps_quadrature_list *list,
                                const ps_quadrature_result *results, ps_error *error) PS_MUST_CHECK;
/* Of several numbers of points instead: E against N, a line for each sampler, with its slope. */
pspec_status ps_quadrature_plot_errors(const ps_request *arguments, const char *x_label,
                                       const char *y_label, const ps_quadrature_result *results,
                                       ps_error *error) PS_MUST_CHECK;

/* E, the root of the mean of E^2. */
double ps_quadrature_error(const ps_quadrature_result *result);

#endif
