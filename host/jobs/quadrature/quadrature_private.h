/* Inside of a quadrature job, for quadrature_job.c, quadrature_collect.c and tests. */
#ifndef PS_JOBS_QUADRATURE_QUADRATURE_PRIVATE_H
#define PS_JOBS_QUADRATURE_QUADRATURE_PRIVATE_H

#include "jobs/quadrature/quadrature_job.h"
#include "jobs/quadrature/quadrature_rules.h"
#include "jobs/runner.h"
#include "spectra/sums.h"

/* What job.sums has for each degree. */
enum { PS_RULE_D2, PS_RULE_C2, PS_RULE_E2, PS_RULE_SUMS };

typedef struct ps_rule_sums {
    ps_sums squared, zonal, anisotropic, tail, weight_sum;
} ps_rule_sums;

typedef struct ps_quadrature_job {
    const ps_quadrature_question *question;
    ps_quadrature_result *out;
    ps_rules rules;
    ps_rule_shape shape;
    ps_quadrature_setup setup;
    ps_runner runner;
    double *block;        /* what the next four lie in */
    double *coefficients; /* [ps_num_coefficients(L)], unless sums are over pairs */
    double *c_l0, *c2;    /* [L + 1] */
    ps_sums *sums;        /* [L + 1][PS_RULE_SUMS] */
    ps_degree_error *degrees;
    size_t num_told; /* rules of the batch whose spectrum is there */
    pspec_status told_status;
    ps_error *error; /* of what is told */
    ps_rule_sums of_rules;
} ps_quadrature_job;

/* Makes job->out of the sums of all rules. PSPEC_ERROR_CHECK: the spectral form and the kernel form
 * are further apart than the rest of the spectrum allows. */
pspec_status ps_quadrature_collect(ps_quadrature_job *job, ps_error *error) PS_MUST_CHECK;

/* ---- when there are enough realizations for the standard error that was asked for ------------ */

/* What is looked at after so many realizations, the numbers above which it must be `least`: E^2
 * itself, and e_l^2 of the degrees that matter. Means over the same realizations. */
typedef struct ps_quadrature_sums {
    size_t num_degrees;
    const ps_sums *degrees; /* [num_degrees][stride] */
    size_t stride;
    const ps_sums *squared; /* E^2 */
} ps_quadrature_sums;

ps_sequential_look ps_quadrature_look(const ps_quadrature_sums *sums, double least,
                                      uint64_t num_realizations);

#endif
