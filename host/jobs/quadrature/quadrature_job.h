/* Worst-case error and quadrature spectrum of rules for a BRDF, averaged over realizations: source
 * of point sets -> weights -> c_l0 and C_l^2 by an engine of the sphere -> spectral form, and the
 * kernel form beside it (docs/mathematics/quadrature.md). Several rules go in batches; results have
 * the same bits whatever the batch. */
#ifndef PS_JOBS_QUADRATURE_QUADRATURE_JOB_H
#define PS_JOBS_QUADRATURE_QUADRATURE_JOB_H

#include "jobs/spectrum/power_job.h"
#include "rules/kernel/kernel_system.h"
#include "rules/representer.h"

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
    ps_watch watch;         /* told of realizations and other phases; {0}: nobody */
    void (*tell_plan)(void *, const ps_plan *); /* called before the work begins; may be NULL */
    void (*tell_profile)(void *, const ps_profile_row *, size_t num_rows); /* after it; likewise */
    /* After it, if something was wrong with kept sets (sets/sets.h); likewise */
    void (*tell_trouble)(void *, const char *sentence);
    void *payload;
} ps_quadrature_question;

typedef struct ps_quadrature_degree {
    double a, b;
    ps_mean d2, c2, e2;
} ps_quadrature_degree;

/* Keys of looks: degrees are 0 .. L. */
enum { PS_LOOK_AT_E2 = -1, PS_LOOK_AT_NOTHING = -2 };

/* Squares are averaged: the error is the root of the mean of E^2. */
typedef struct ps_quadrature_result {
    uint64_t num_realizations;
    double mean_points; /* of the sets, as they were given */
    uint64_t smallest_points, largest_points;
    size_t max_degree;
    ps_quadrature_degree *degrees; /* [max_degree + 1] */
    ps_mean squared;               /* E^2, kernel form */
    ps_mean zonal, anisotropic;    /* E_Z^2, E_A^2 up to max_degree */
    ps_mean tail;                  /* E^2 minus both */
    double tail_model, tail_bound; /* means */
    ps_mean weight_sum;
    double numerical_bound;   /* on the error of E^2 */
    double weight_size;       /* largest sum |w| */
    uint64_t num_dropped;     /* points below the horizon, in all sets */
    double largest_condition; /* of kernel matrices; nan without optimal weights */
    bool is_ill_conditioned;
    /* Cholesky, or else conjugate gradients, whose condition is a bound from below */
    bool has_matrices;
    char weights_by[128]; /* how optimal weights were made */
    /* Points less than were given, in all sets, that optimal weights saw */
    uint64_t num_duplicates;
    char engine[160]; /* "(sphere_direct ..)" */
    char device[160];
    const char *precision;
    /* The look with the largest standard error when the realizations ended; its bin is a degree or
     * one of PS_LOOK_AT_.. */
    ps_sequential_look look;
    bool has_look; /* false without question.accuracy.standard_error, and for one realization */
    bool was_replanned;     /* the first run missed the tolerance */
    char degrees_note[192]; /* why the degrees end where they do; "" when L was asked for */
    char skipped[2048];     /* what was not computed, and why */
    double *weights; /* [num_weights] where they were to be kept; 0 for points that were dropped */
    size_t num_weights;
    ps_representer representer;
} ps_quadrature_result;

/* Runs everything; *out is freed by ps_quadrature_free, also after an error. Points below the
 * horizon of a lobe that ends there are PSPEC_ERROR_INPUT with their number; kernel and spectral
 * form that contradict each other PSPEC_ERROR_CHECK. */
pspec_status ps_quadrature_run(ps_quadrature_result *out, const ps_quadrature_question *question,
                               ps_error *error) PS_MUST_CHECK;
void ps_quadrature_free(ps_quadrature_result *result);

/* "E^2", "e_l^2 of degree 3", or "nothing above the tolerance". */
void ps_quadrature_look_name(char *text, size_t size, const ps_sequential_look *look);

#endif
