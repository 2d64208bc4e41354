/* What a quadrature job is to do, before it does anything: degrees, engine, what is skipped. */
#ifndef PS_JOBS_QUADRATURE_QUADRATURE_SETUP_H
#define PS_JOBS_QUADRATURE_QUADRATURE_SETUP_H

#include "jobs/quadrature/quadrature_job.h"
#include "plan/needs.h"

/* What is known of the rules before the first is computed with. */
typedef struct ps_rule_shape {
    size_t num_points;  /* of the first, or that a sampler is asked for */
    size_t most_points; /* of any, as far as it is known */
    uint64_t num_sets;  /* 0: several, of which nobody has counted how many */
} ps_rule_shape;

typedef struct ps_quadrature_setup {
    ps_representer representer;
    ps_frequencies frequencies;
    ps_problem problem;
    ps_device *device; /* NULL: none is needed */
    bool owns_device;
    ps_plan plan;
    ps_needs needs;
    uint64_t num_sets;             /* that there are; 0: unknown */
    uint64_t num_realizations;     /* that are computed of them, at most; 0: unknown */
    uint64_t planned_realizations; /* that a standard error is expected to take of them */
    /* C_l^2 = (2l+1)/(4 pi) Q(l) - c_l0^2 in batches by any engine; else from the c_lm of one rule
     * at a time, which loses no digits where C_l^2 is next to nothing */
    bool by_pairs;
    size_t max_degree;
    size_t most_degree;     /* that would be there if no degree were skipped */
    double beyond_bound;    /* of what those in between are of E^2 */
    double num_distances;   /* of pairs of points of the first set; 0: it was not looked at */
    char degrees_note[192]; /* why it ends there; "" when L was asked for */
    char weights_note[256]; /* how optimal weights will be made; "" without */
} ps_quadrature_setup;

/* What can be wrong without a set having been read, which takes long: names, files that are not
 * there, the device that was asked for. First of all; *out must not be moved; freed by
 * ps_quadrature_setup_free, also after an error. */
pspec_status ps_quadrature_setup_begin(ps_quadrature_setup *out,
                                       const ps_quadrature_question *question,
                                       ps_error *error) PS_MUST_CHECK;
/* Opens the device unless no engine that may be chosen needs it, and plans. Nothing feasible is no
 * error here (ps_plan_require). */
pspec_status ps_quadrature_setup_make(ps_quadrature_setup *out,
                                      const ps_quadrature_question *question,
                                      const ps_rule_shape *shape, ps_error *error) PS_MUST_CHECK;
/* Plans once more, for the powers that the problem has by now; held: bytes that the estimator of
 * the plan before has. */
pspec_status ps_quadrature_setup_plan_again(ps_quadrature_setup *setup,
                                            const ps_quadrature_question *question, uint64_t held,
                                            ps_error *error) PS_MUST_CHECK;
/* Both from the question alone, for `plan`: of files the first two sets are read. */
pspec_status ps_quadrature_setup_ask(ps_quadrature_setup *out,
                                     const ps_quadrature_question *question,
                                     ps_error *error) PS_MUST_CHECK;
void ps_quadrature_setup_free(ps_quadrature_setup *setup);

#endif
