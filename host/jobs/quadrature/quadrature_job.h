/* Worst-case error and quadrature spectrum of rules for a BRDF, averaged over realizations: source
 * of point sets -> weights -> c_l0 and C_l^2 by an engine of the sphere -> spectral form, and the
 * kernel form beside it (docs/mathematics/quadrature.md). Several rules go in batches; results have
 * the same bits whatever the batch. */
#ifndef PS_JOBS_QUADRATURE_QUADRATURE_JOB_H
#define PS_JOBS_QUADRATURE_QUADRATURE_JOB_H

#include "jobs/quadrature/quadrature_rules.h"
#include "jobs/rows/row_stream.h"
#include "jobs/runner.h"
#include "spectra/sums.h"

typedef struct ps_quadrature_degree {
    double a, b;
    ps_mean d2, c2, e2;
} ps_quadrature_degree;

/* Keys of looks: degrees are 0 .. L. */
enum { PS_LOOK_AT_E2 = -1, PS_LOOK_AT_NOTHING = -2 };

/* Squares are averaged: the error is the root of the mean of E^2. */
typedef struct ps_quadrature_result {
    uint64_t num_realizations;
    ps_quadrature_degree *degrees; /* [setup.max_degree + 1] */
    ps_mean squared;               /* E^2, kernel form */
    ps_mean zonal, anisotropic;    /* E_Z^2, E_A^2 up to max_degree */
    ps_mean tail;                  /* E^2 minus both */
    double tail_model, tail_bound; /* means */
    ps_mean weight_sum;
    double numerical_bound; /* on the error of E^2 */
    double weight_size;     /* largest sum |w| */
    ps_rule_facts facts;
    /* The look with the largest standard error when the realizations ended; its bin is a degree or
     * one of PS_LOOK_AT_.. */
    ps_sequential_look look;
    bool has_look;   /* false without question.accuracy.standard_error, and for one realization */
    double *weights; /* [num_weights] where they were to be kept; 0 for points that were dropped */
    size_t num_weights;
} ps_quadrature_result;

/* What job.sums has for each degree. */
enum { PS_RULE_D2, PS_RULE_C2, PS_RULE_E2, PS_RULE_SUMS };

typedef struct ps_rule_sums {
    ps_sums squared, zonal, anisotropic, tail, weight_sum;
} ps_rule_sums;

struct ps_quadrature_job {
    const ps_quadrature_question *question;
    /* Known after create */
    ps_rules rules;
    ps_rule_shape shape;
    ps_quadrature_setup setup;
    /* Known after run */
    ps_runner runner;
    ps_quadrature_result result;
    ps_text description; /* of the engine, "(sphere_direct ..)" */
    /* While it runs */
    double *block;        /* what the next four lie in */
    double *coefficients; /* [ps_num_coefficients(L)], unless sums are over pairs */
    double *c_l0, *c2;    /* [L + 1] */
    ps_sums *sums;        /* [L + 1][PS_RULE_SUMS] */
    ps_row_stream stream; /* of rules */
    char *rows;           /* those of the batch, of which the first has the number */
    uint64_t first;
    size_t num_told; /* rules of the batch whose spectrum is there */
    pspec_status told_status;
    ps_error *error;     /* of what is told */
    uint64_t num_summed; /* that the estimator has had, whole batches */
    ps_rule_sums of_rules;
};

/* Opens the source, of files reads the first two sets, opens the device unless no engine that may
 * be chosen needs it, and plans. The question must outlive the job. Nothing feasible is no error
 * before it runs. */
pspec_status ps_quadrature_job_create(ps_quadrature_job **out,
                                      const ps_quadrature_question *question,
                                      ps_error *error) PS_MUST_CHECK;
void ps_quadrature_job_destroy(ps_quadrature_job *job); /* NULL is allowed */
/* For who shows the plan: shares of skips, and distances, better than from counts. Before run. */
pspec_status ps_quadrature_job_rate(ps_quadrature_job *job, ps_error *error) PS_MUST_CHECK;
/* Points below the horizon of a lobe that ends there are PSPEC_ERROR_INPUT with their number;
 * kernel and spectral form that contradict each other PSPEC_ERROR_CHECK. */
pspec_status ps_quadrature_job_run(ps_quadrature_job *job, ps_error *error) PS_MUST_CHECK;
/* Gives the memory back that only realizations need; after run. */
void ps_quadrature_job_release(ps_quadrature_job *job);

/* ---- rows of rules (quadrature_rows.c) ------------------------------------------------------- */

size_t ps_quadrature_row_bytes(const ps_quadrature_job *job);
/* As the row stream and the estimator call them, of a job. */
pspec_status ps_quadrature_make_rows(void *payload, uint64_t first, size_t most, void *rows,
                                     size_t *num, ps_error *error) PS_MUST_CHECK;
void ps_quadrature_hear(void *payload, const double *zonal, const double *c2);
/* The next row of all. */
void ps_quadrature_take_row(ps_quadrature_job *job, const void *rule);

/* ---- the parts of it that are in quadrature_collect.c ---------------------------------------- */

/* Makes the result of the sums of all rules. PSPEC_ERROR_CHECK: the spectral form and the kernel
 * form are further apart than the rest of the spectrum allows. */
pspec_status ps_quadrature_collect(ps_quadrature_job *job, ps_error *error) PS_MUST_CHECK;

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

/* "E^2", "e_l^2 of degree 3", or "nothing above the tolerance". */
void ps_quadrature_look_name(char *text, size_t size, const ps_sequential_look *look);

/* ---- how long it takes beside its engine, phase by phase ------------------------------------- */

/* Returns by what the seconds of its engines are to be multiplied, as ps_power_job_phases. */
double ps_quadrature_job_phases(const ps_quadrature_job *job, ps_phases *phases);

/* Adds what the coefficients of a lobe take, made for so many degrees. */
void ps_phases_lobe(ps_phases *phases, const ps_representer *representer);

/* Adds kappa of sets of so many points and of so many terms, or so many distances of each set in
 * powers of 2 s - 2, to the phase of that name (ps_cost_rule_seconds). */
void ps_phases_kappa(ps_phases *phases, const char *name, double points, double terms, double sets);
void ps_phases_distances(ps_phases *phases, const char *name, double smoothness, double distances,
                         double sets);
/* Adds so many solutions with the kernel matrix of each set, by a factor or without. */
void ps_phases_kernel_system(ps_phases *phases, const char *name, double smoothness, double points,
                             double solutions, bool is_dense, const ps_device *device, double sets);

#endif
