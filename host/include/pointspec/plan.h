/** @file
 * Plans, through which patterns go, on the torus and on the sphere. Included by pointspec.h.
 */
#ifndef POINTSPEC_PLAN_H
#define POINTSPEC_PLAN_H

#include "pointspec/context.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pspec_plan pspec_plan; /**< a question, its engine, and the sums so far */

/** @name Plan
 * @{ */

/** What to compute. Begin with #PSPEC_POWER_REQUEST_INIT and set what differs. */
typedef struct pspec_power_request {
    size_t struct_size;        /**< set by #PSPEC_POWER_REQUEST_INIT; lets the struct grow */
    unsigned dimension;        /**< of the points, 1 to 6; default 2 */
    size_t num_points;         /**< of the largest pattern expected; more are taken; default 1024 */
    uint64_t num_realizations; /**< patterns that are expected; default 0: not known */
    int32_t max_frequency;     /**< K: all |k_i| <= K; unless there is a list */
    const int32_t *frequencies; /**< [num_frequencies][dimension], |k_i| <= 2^28, or NULL; copied */
    size_t num_frequencies;     /**< of the list */
    /** how frequencies are put into bins: "round" (rings of width 1 about whole numbers), "floor",
     * "width=P/Q", "relative=P/Q" (times N^(1/d), N being num_points, which every pattern must
     * have), "shells" (|k|^2 = n); NULL, the default: "round" */
    const char *bins;
    /** leave out frequencies of bins that are not complete in the box, |k|^2 > K^2 + K by rounding:
     * 21 % less in 2-D */
    int rings_only;
    pspec_normalization normalization; /**< which power */
    double tolerance;      /**< numerical error of S relative to white noise; default 1e-6 */
    double floor;          /**< smallest power that must be right to 10 %; default 0: none */
    const char *engine;    /**< "torus_nufft", "torus_direct", "host_direct", or NULL: the best */
    const char *precision; /**< "single", "double", "extended", or NULL: likewise */
    int no_self_check;     /**< do not recompute a few entries of the first pattern */
    /** S >= 2: of every ring or shell with more than S frequencies of the half lattice only S,
     * drawn at random without replacement; needs K <= 2000, not a list; implies rings_only.
     * Default 0: all */
    uint64_t per_ring;
    /** what is drawn depends on it, on d, S and the ring alone; default 1 */
    uint64_t per_ring_seed;
} pspec_power_request;

/** The defaults of a #pspec_power_request. */
#define PSPEC_POWER_REQUEST_INIT                                                                   \
    {                                                                                              \
        sizeof(pspec_power_request), 2, 1024, 0, 0, 0, 0, 0, 0, PSPEC_NORMALIZATION_POWER, 1e-6,   \
            0, 0, 0, 0, 0, 1                                                                       \
    }

/** Chooses the engine and allocates what it needs; opens the context's device if that may be
 * needed.
 *
 * The engine's error e satisfies sqrt(mean over k != 0 of |dS(k)|^2) = e sqrt(V) <= tolerance
 * sqrt(V). #PSPEC_ERROR_TOLERANCE: no engine reaches it. #PSPEC_ERROR_MEMORY: none fits the
 * memory. The choice depends on the request, the device and the limit alone; nothing is timed. It
 * is the choice of the program for the same question, and so are the bits of the averages.
 *
 * Powers are known only once they are measured, and patterns may have more points than the request
 * said. Where e then exceeds the tolerance, the plan chooses once more, for these, and runs the
 * patterns again, of which it keeps copies for that: at most 64 MiB, and at most a quarter of a
 * memory limit. That happens when a spectrum is asked for; later patterns go to the new engine. */
PSPEC_EXPORT pspec_status pspec_plan_create(pspec_plan **out, pspec_context *context,
                                            const pspec_power_request *request);
/** What to compute on the sphere. Begin with #PSPEC_ANGULAR_REQUEST_INIT and set what differs. */
typedef struct pspec_angular_request {
    size_t struct_size; /**< set by #PSPEC_ANGULAR_REQUEST_INIT; lets the struct grow */
    size_t num_points;  /**< of the largest pattern expected; more are taken; default 1024 */
    /** patterns that are expected; default 0: not known. 1: kernels for one, where the last digits
     * may differ from those for several */
    uint64_t num_realizations;
    int32_t max_degree;                /**< L: degrees 1..L, at most 32768 */
    int hemisphere;                    /**< even degrees only */
    pspec_normalization normalization; /**< which power */
    /** numerical error of the coefficients relative to white noise; default 1e-6 */
    double tolerance;
    double floor; /**< smallest power that must be right to 10 %; default 0: none */
    /** "sphere_grid", "sphere_nufft", "sphere_direct", "host_direct", NULL: the best */
    const char *engine;
    const char *precision; /**< "single", "double", "extended", or NULL: likewise */
    int no_self_check;     /**< do not recompute a few degrees of the first pattern */
    int want_c2;           /**< for pspec_plan_c2() */
} pspec_angular_request;

/** The defaults of a #pspec_angular_request. */
#define PSPEC_ANGULAR_REQUEST_INIT                                                                 \
    { sizeof(pspec_angular_request), 1024, 0, 0, 0, PSPEC_NORMALIZATION_POWER, 1e-6, 0, 0, 0, 0, 0 }

/** The plan of an angular power spectrum; as pspec_plan_create() otherwise.
 *
 * The engine's error e satisfies sqrt(4 pi mean |dc_lm|^2) = e sqrt(V) <= tolerance sqrt(V), mean
 * over the degrees and orders. Spectra have a bin for every degree: bin and frequency are l,
 * normalized_frequency is l / sqrt(N), count is 2l + 1, anisotropy_db is nan.
 *
 * With #PSPEC_NORMALIZATION_PAIRS powers are Q(l) = sum_ij w_i w_j P_l(u_i.u_j), and the tolerance
 * is |dQ(l)| <= tolerance (sum |w|)^2. */
PSPEC_EXPORT pspec_status pspec_plan_create_angular(pspec_plan **out, pspec_context *context,
                                                    const pspec_angular_request *request);
/** NULL is allowed. */
PSPEC_EXPORT void pspec_plan_destroy(pspec_plan *plan);

/** "(torus_direct precision=single ...)"; belongs to the plan, until it chooses another engine or
 * is reset. */
PSPEC_EXPORT const char *pspec_plan_text(const pspec_plan *plan);

/** Adds realizations, in order. Averages depend, to the bit, on the realizations and their order
 * alone, not on how they were divided into calls.
 *
 * Small calls cost little: patterns are checked at once and copied (at most 64 MiB), and the engine
 * runs when there is a batch of them or a spectrum is asked for; whole batches of a call run at
 * once. Nothing is borrowed after the call, and nothing allocated, unless there are more patterns,
 * or larger ones, than the request said. Weights take memory, too: where the context has a limit
 * and the first pattern has weights, the plan is made anew for them, and #PSPEC_ERROR_MEMORY says
 * that they do not fit.
 *
 * #PSPEC_ERROR_INPUT names the pattern (sets count from 1, since the plan began) and the point.
 * After any error but #PSPEC_ERROR_INVALID_ARGUMENT the plan takes no more: destroy it or begin
 * again with pspec_plan_reset(). */
PSPEC_EXPORT pspec_status pspec_plan_run(pspec_plan *plan, const pspec_pattern *patterns,
                                         size_t num_patterns);

/** Coefficients of one pattern. For plans of pspec_plan_create()
 *
 *     S(k) = sum_j w_j exp(-2 pi i k.x_j)
 *
 * of the frequencies of the plan, in the order of pspec_spectrum_frequencies(), as pairs of real
 * and imaginary part, by the engines torus_direct and host_direct, one of which the request must
 * name (#PSPEC_ERROR_INVALID_ARGUMENT otherwise); hemispherical must be 0. For plans of
 * pspec_plan_create_angular():
 *
 *     c_lm = sum_j w_j Y_lm(u_j),   l = 0..L, m = 0..l,   c_{l,-m} = (-1)^m conj c_lm
 *
 * with weights as they are, orthonormal harmonics with the Condon-Shortley phase, as (L + 1)(L + 2)
 * / 2 pairs of real and imaginary part, that of (l, m) at index m (2 L + 1 - m) / 2 + l: the order
 * of healpy, whose a_lm is the conjugate. On the hemisphere odd degrees are 0, and L is the last
 * even degree. With hemispherical != 0 the harmonics are those of the hemisphere, orthonormal there
 * (P_l^m(2 z - 1) instead of P_l^m(z)), and points must have z >= 0. Averages do not change.
 * #PSPEC_ERROR_INPUT names a point that cannot be used; #PSPEC_ERROR_MEMORY comes where the
 * coefficients, with what the plan has, take more than the memory limit of the context; the
 * progress callback can cancel, as in pspec_plan_run(). None of them harms the plan. */
PSPEC_EXPORT pspec_status pspec_plan_coefficients(pspec_plan *plan, const pspec_pattern *pattern,
                                                  int hemispherical, double *coefficients);

/** The part of pair sums that depends on the azimuth about the z axis, averaged over the
 * realizations so far,
 *
 *     C_l^2 = 2 sum_{m > 0} |c_lm|^2 = (2l + 1) / (4 pi) Q(l) - c_l0^2,
 *
 * c2[0] of l = 1 or, on the hemisphere, 2, and so on: one for each bin of the plan's spectrum, with
 * room from the caller. Right to (2l + 1) / (4 pi) times the tolerance of Q(l).
 * #PSPEC_ERROR_INVALID_ARGUMENT unless the request had #PSPEC_NORMALIZATION_PAIRS and want_c2;
 * #PSPEC_ERROR_INPUT when there are no realizations yet. */
PSPEC_EXPORT pspec_status pspec_plan_c2(pspec_plan *plan, pspec_mean *c2);

/** Forgets all realizations, and a failure: the plan is as good as new, for another average.
 * Allocates nothing and takes microseconds, unless large powers had made the plan choose another
 * engine: then the first is made anew. */
PSPEC_EXPORT pspec_status pspec_plan_reset(pspec_plan *plan);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
