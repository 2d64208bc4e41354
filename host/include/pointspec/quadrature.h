/** @file
 * Quadrature of shading integrals, sums of kernels, lobes. Included by pointspec.h.
 */
#ifndef POINTSPEC_QUADRATURE_H
#define POINTSPEC_QUADRATURE_H

#include "pointspec/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/** @name Quadrature of shading integrals
 *
 * Directions u_j with weights w_j, W = sum_j w_j, are a rule for int f phat dS, where phat = p /
 * int p dS is a lobe of reflection about the z axis. For all light f of the unit ball of the
 * Sobolev space H^s, 1 < s < 2, its worst-case error E is
 *
 *     E^2 = sum_ij w_i w_j K(u_i, u_j) - 2 sum_j w_j kappa(u_j) + kappa_0         (kernel)
 *         = sum_l a_l (d_l^2 + C_l^2),   d_l = b_l - c_l0,   C_l^2 = 2 sum_{m > 0} |c_lm|^2 (spectral)
 *
 * with K(u,v) = c - |u-v|^(2s-2) = sum_l a_l (2l+1)/(4 pi) P_l(u.v), c = 2^(2s-1)/s, b_l = int phat
 * Y_l0 dS, c_lm = sum_j w_j Y_lm(u_j), kappa = sum_l a_l b_l Y_l0, kappa_0 = sum_l a_l b_l^2. Lobes
 * are named as on the command line: "diffuse", "glossy:n=30", "glossy:n=2,cut=none", "phong:n=8",
 * "zonal:file=NAME".
 * @{ */

/** What to compute of rules. Begin with #PSPEC_QUADRATURE_REQUEST_INIT and set what differs. */
typedef struct pspec_quadrature_request {
    size_t struct_size;  /**< set by #PSPEC_QUADRATURE_REQUEST_INIT; lets the struct grow */
    const char *brdf;    /**< the lobe; default "diffuse" */
    double smoothness;   /**< s, above 1 and below 2; default 1.5 */
    int32_t max_degree;  /**< L; default 0: where the bound of the rest meets the tolerance, at most
                           ceil(4 sqrt N) */
    int optimal_weights; /**< those that make E smallest, instead of the patterns' own */
    /** leave points with z < 0 out where the lobe ends there; else they are an error */
    int drop_below_horizon;
    double tolerance; /**< of E^2 in the spectral form, in units of c (sum |w|)^2; default 1e-10 */
    const char *engine;    /**< of the sphere or of pairs, or NULL: the best */
    const char *precision; /**< "single", "double", "extended", or NULL: likewise */
    int no_skip;           /**< compute also degrees and realizations that cannot matter */
    int weight_sum_one;    /**< optimal weights among those with sum w = 1 */
    /** keep the weights for pspec_quadrature_weights(); there must be one pattern */
    int keep_weights;
    /** no more patterns than make the relative standard error of E^2 and of every e_l^2 above the
     * tolerance this small, at least 16; default 0: all */
    double standard_error;
} pspec_quadrature_request;

/** The defaults of a #pspec_quadrature_request. */
#define PSPEC_QUADRATURE_REQUEST_INIT                                                              \
    { sizeof(pspec_quadrature_request), "diffuse", 1.5, 0, 0, 0, 1e-10, 0, 0, 0, 0, 0, 0 }

/** One degree of the spectral form. */
typedef struct pspec_quadrature_degree {
    int32_t degree; /**< l */
    double a;       /**< a_l of the space */
    double b;       /**< b_l of the lobe */
    pspec_mean d2;  /**< d_l^2 */
    pspec_mean c2;  /**< C_l^2 */
    pspec_mean e2;  /**< a_l (d_l^2 + C_l^2), the share of E^2 */
} pspec_quadrature_degree;

/** The error of rules, as means over realizations. Squares are averaged: E is the root of the mean
 * of E^2. */
typedef struct pspec_worst_case_error {
    uint64_t num_realizations; /**< that were computed: one where all are known to be alike */
    pspec_mean squared;        /**< E^2, kernel form: all degrees */
    pspec_mean zonal;          /**< sum_{l <= L} a_l d_l^2 */
    pspec_mean anisotropic;    /**< sum_{l <= L} a_l C_l^2 */
    pspec_mean tail;           /**< E^2 minus both */
    double tail_model; /**< what independent points of the lobe's density have there in the mean */
    /** ((sum |w|) sqrt(tau_L) + sqrt(rest of kappa_0))^2, which it cannot exceed */
    double tail_bound;
    double numerical_bound; /**< on the numerical error of E^2 */
    pspec_mean weight_sum;  /**< W */
    /** with optimal weights the largest condition number of a kernel matrix; else nan */
    double condition;
    int is_ill_conditioned;  /**< points lie too near each other for weights of four digits */
    uint64_t num_dropped;    /**< points below the horizon that were left out, of all patterns */
    uint64_t num_duplicates; /**< points equal to others, of all patterns, with optimal weights */
} pspec_worst_case_error;

typedef struct pspec_quadrature pspec_quadrature; /**< the analysis of rules */

/** Analyses num_patterns rules, at least one, realizations of one another: patterns of dimension 3
 * with unit vectors; weights as they are, 1/N where there are none. The context gives device,
 * memory limit and progress, and is for the sentence of an error.
 *
 * #PSPEC_ERROR_INVALID_ARGUMENT: a lobe, an s outside (1, 2), an engine that cannot be meant.
 * #PSPEC_ERROR_INPUT: a pattern and its point, below the horizon of a lobe that ends there, or no
 * unit vector; weights that are all 0, or not finite. #PSPEC_ERROR_TOLERANCE, #PSPEC_ERROR_MEMORY
 * as pspec_plan_create(). #PSPEC_ERROR_CHECK: the two forms of E^2 contradict each other. */
PSPEC_EXPORT pspec_status pspec_quadrature_create(pspec_quadrature **out, pspec_context *context,
                                                  const pspec_quadrature_request *request,
                                                  const pspec_pattern *patterns,
                                                  size_t num_patterns);
/** NULL is allowed. */
PSPEC_EXPORT void pspec_quadrature_destroy(pspec_quadrature *quadrature);

/** Belongs to the analysis. */
PSPEC_EXPORT const pspec_worst_case_error *
pspec_quadrature_error(const pspec_quadrature *quadrature);
/** l = 0 .. L, [*num_degrees] = L + 1. Belong to the analysis. */
PSPEC_EXPORT const pspec_quadrature_degree *
pspec_quadrature_degrees(const pspec_quadrature *quadrature, size_t *num_degrees);
/** The weights of the rule, with request.keep_weights, in the order of the pattern's points; 0 for
 * those that were left out. NULL, and *num_weights = 0, where they were not kept. Belong to the
 * analysis. */
PSPEC_EXPORT const double *pspec_quadrature_weights(const pspec_quadrature *quadrature,
                                                    size_t *num_weights);
/** "(sphere_direct precision=double ...)", what made c_lm or Q(l); belongs to the analysis. */
PSPEC_EXPORT const char *pspec_quadrature_text(const pspec_quadrature *quadrature);

/** A kernel that depends on the angle between two points alone. */
typedef struct pspec_kernel {
    const double *coefficients; /**< k_l: K = sum_l k_l P_l(u.v), or NULL for the power */
    size_t num_coefficients;    /**< of the list: degrees 0 .. num_coefficients - 1 */
    double power; /**< K = |u - v|^(2 power), above 0 and at most 1; s - 1 for the space H^s */
} pspec_kernel;

/** sums[k] = sum_ij w_i w_j K_k(u_i, u_j) over all pairs of a pattern on the sphere, i = j
 * included, with weights as they are, or 1/N, for num_kernels kernels from one histogram of the
 * distances; bounds[k] on the error of each. Both have room for num_kernels numbers, from the
 * caller. The bounds are at most the tolerance times (sum |w|)^2, or #PSPEC_ERROR_TOLERANCE says
 * that this cannot be. Needs a device, in double precision below a tolerance of about 1e-5; memory
 * is not limited. The progress callback is asked several times a second and may cancel.
 * #PSPEC_ERROR_INPUT names a point that cannot be used. */
PSPEC_EXPORT pspec_status pspec_kernel_sums(pspec_context *context, const pspec_pattern *pattern,
                                            const pspec_kernel *kernels, size_t num_kernels,
                                            double tolerance, double *sums, double *bounds);

/** The coefficients of a lobe, b[max_degree + 1] with room from the caller: b_l = int phat Y_l0 dS,
 * or with hemispherical != 0 those of the harmonics sqrt((2l+1)/(2 pi)) P_l(2z - 1) of the
 * hemisphere. Relative error 3e-12, or absolute 1e-17. #PSPEC_ERROR_INVALID_ARGUMENT: no such lobe,
 * n out of range, or a lobe that goes below the horizon with hemispherical harmonics. */
PSPEC_EXPORT pspec_status pspec_brdf_coefficients(pspec_context *context, const char *brdf,
                                                  int hemispherical, int32_t max_degree, double *b);

/** The worst-case error of shading integrals as inner products of harmonics up to and including
 * degree L, for L = 0 .. max_degree:
 *
 *     spherical:      E(L)^2 = sum_{l > L} a_l b_l^2
 *     hemispherical:  E(L)^2 = sum_l a_l (b_l - b'_l)^2,  b'_l those of what degrees <= L sum to
 *
 * errors and bounds (on the error of errors) have room for max_degree + 1 numbers each, from the
 * caller. points, of the same size or NULL, become the number of spherical Fibonacci points with
 * equal weights, morphed to the lobe, that have the same error: nan where that is more than 32768,
 * where E(L) is 0, and where no rule has the lobe's density. max_degree is at most 10000, or 500
 * for hemispherical harmonics. The progress callback may cancel, while points are looked for. */
PSPEC_EXPORT pspec_status pspec_truncation(pspec_context *context, const char *brdf,
                                           double smoothness, int hemispherical, int32_t max_degree,
                                           double *errors, double *bounds, double *points);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
