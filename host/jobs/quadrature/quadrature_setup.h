/* What a quadrature job is to do, before it does anything: degrees, engine, what is skipped. */
#ifndef PS_JOBS_QUADRATURE_QUADRATURE_SETUP_H
#define PS_JOBS_QUADRATURE_QUADRATURE_SETUP_H

#include "base/watch.h"
#include "frequencies/frequencies.h"
#include "plan/needs.h"
#include "plan/phases.h"
#include "points/points.h"
#include "points/weights_spec.h"
#include "rules/horizon.h"
#include "rules/kernel/kernel_system.h"
#include "rules/worst_case_error.h"

typedef struct ps_quadrature_job ps_quadrature_job;

/* Who hears of rules of a job, and takes what it made of each in the order of realizations; {0}:
 * nobody. */
typedef struct ps_rule_observer {
    /* All that was heard is void: it comes again. */
    void (*begin)(void *payload, const ps_quadrature_job *job);
    /* Number `rule` from 0, its points and weights, and its d_l^2 and C_l^2, [max_degree + 1]:
     * fills row[row_bytes], a multiple of 8. */
    pspec_status (*hear)(void *payload, uint64_t rule, const pspec_pattern *pattern,
                         const ps_degree_error *degrees, size_t max_degree, void *row,
                         ps_error *error);
    /* The row of the next rule, which another member of a team may have made. */
    void (*take)(void *payload, const void *row);
    size_t row_bytes;
    /* What it has of those that it heard of, to a checkpoint or from one; NULL: nothing */
    ps_snapshot_walk *walk;
    /* That was the last; devices of the job are closed after it. */
    void (*end)(void *payload);
    /* Adds what its work will take to the plan of the job. */
    void (*add_phases)(void *payload, const ps_quadrature_job *job, ps_phases *phases);
    void *payload;
} ps_rule_observer;

typedef struct ps_quadrature_question {
    const ps_brdf *brdf;
    double smoothness;
    ps_weights_spec weights;
    bool keeps_weights; /* those of the rule are in the result; several rules are an error */
    const ps_sampler_request
        *sampler;              /* NULL: files; resolved, morphed to the BRDF if that is wanted */
    uint64_t num_realizations; /* of the sampler */
    const char *const *paths;
    size_t num_paths;
    ps_point_options point_options;
    /* Points of files for a lobe that ends there; else they are refused */
    bool drops_below_horizon;
    /* Of a normal that is not the axis of the lobe: what is below it counts for nothing. NULL: the
     * axis is the normal. Weights are not optimal then, and are not kept. */
    const ps_horizon *horizon;
    /* 0: where the bound of what is beyond meets the tolerance, at most ceil(4 sqrt N) */
    size_t max_degree;
    /* The tolerance is of E^2, in units of c (sum |w|)^2, c = 2^(2s-1)/s: |dQ(l)| <= tolerance (sum
     * |w|)^2. The standard error is that of the means of E^2 and of every e_l^2 above the
     * tolerance. Without skips all realizations are done, all degrees to ceil(4 sqrt N), in double
     * precision. There is no floor. */
    ps_accuracy_spec accuracy;
    ps_limits_spec limits;
    size_t batch; /* rules at a time, the results the same; 0: what the plan and memory say */
    bool may_lack_device;   /* to be planned only: without a device, with the host's engines */
    ps_device *open_device; /* borrowed; NULL: the one that limits.device selects is opened */
    ps_rule_observer observer;
    ps_watch watch; /* told of realizations and other phases; {0}: nobody */
} ps_quadrature_question;

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
/* For who shows the shares of skips: that of degrees becomes what planning for all of them says. */
pspec_status ps_quadrature_setup_rate(ps_quadrature_setup *setup,
                                      const ps_quadrature_question *question,
                                      ps_error *error) PS_MUST_CHECK;
void ps_quadrature_setup_free(ps_quadrature_setup *setup);

#endif
