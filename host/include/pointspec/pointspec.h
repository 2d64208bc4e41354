/** @file
 * pointspec: power spectra of sampling patterns, averaged over realizations, with standard errors.
 *
 * **Conventions.** Points lie on the torus [0,1)^d, d = 1..6; frequencies are integer vectors k, in
 * cycles per unit cell. With weights w_j (real, of either sign; all 1 when absent)
 *
 *     S(k) = sum_j w_j exp(-2 pi i k.x_j),   W = sum_j w_j,   V = sum_j w_j^2
 *     power, default normalization:    P(k) = N |S(k)|^2 / W^2     (unit weights: |S|^2 / N)
 *     power, effective normalization:  P(k) = |S(k)|^2 / V
 *
 * Weights are not all 0, and |w_j| sum to at most 1e290. Sums over pairs and quadrature, whose results have the units of
 * weights, take sets whose largest |w_j| is between 1e-60 and 1e60, pspec_kernel_sums() between 2^-450 and 2^450. Others are
 * #PSPEC_ERROR_INPUT, as is W = 0, or within 2^-52 sum |w_j| of it, where W divides.
 *
 * White noise has mean power 1 at every k != 0. DC (k = 0) is never part of a radial mean. Ring b
 * holds the frequencies with b^2 - b + 1 <= |k|^2 <= b^2 + b.
 *
 * On the sphere points are unit vectors (lengths may be off by 1e-6; they are divided), and powers are of degrees
 * l = 1..L, means over the 2l + 1 orders of the orthonormal spherical harmonics Y_lm
 *
 *     Q(l) = 4 pi / (2l + 1) sum_m |sum_j w_j Y_lm(u_j)|^2 = sum_ij w_i w_j P_l(u_i.u_j)
 *     power, default normalization:    P(l) = N Q(l) / W^2
 *     power, effective normalization:  P(l) = Q(l) / V
 *
 * White noise has mean power 1 at every l >= 1. On the hemisphere, which is the projective plane, a point stands for
 * its direction and the opposite one, and only even degrees are there.
 *
 * **Objects.** A context holds the device, the callbacks and the sentence of the last error; a plan fixes
 * what is asked and by which engine; patterns (realizations) go through the plan in calls of any size,
 * with the same results to the bit; a spectrum is a snapshot of the averages so far, which can be
 * saved, loaded, and merged with others.
 *
 *     pspec_context_create -> pspec_plan_create -> pspec_plan_run ... -> pspec_spectrum_create
 *
 * **Ownership.** Every create, load and merge has a destroy, which accepts NULL. Destroy plans before
 * their context; a spectrum needs neither plan nor context once it exists. What an object points to
 * belongs to the object. Arguments are only borrowed for the call.
 *
 * **Threads.** One context, and the plans made from it, may be used by one thread at a time; different
 * contexts are independent. A spectrum may be read by any number of threads.
 *
 * **Errors.** Whatever can fail returns a #pspec_status; the sentence that goes with it (what, where,
 * which value, which limit) is pspec_context_message(). Objects arrive through the first argument, which is
 * set to NULL on failure. The library never prints, exits or aborts, has no global state, and leaves
 * the error handler of GSL, which it uses, alone.
 */
#ifndef POINTSPEC_POINTSPEC_H
#define POINTSPEC_POINTSPEC_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Marks what the shared library exports. */
#if defined(__GNUC__)
#define PSPEC_EXPORT __attribute__((visibility("default")))
#else
#define PSPEC_EXPORT
#endif

/** What went wrong. The numbers are never reused. */
typedef enum pspec_status {
    PSPEC_OK = 0,                     /**< nothing */
    PSPEC_ERROR_INVALID_ARGUMENT = 1, /**< a request, option or value that cannot be meant */
    PSPEC_ERROR_INPUT = 2,     /**< points, weights, frequencies or files that cannot be used */
    PSPEC_ERROR_IO = 3,        /**< the system refused to read or write */
    PSPEC_ERROR_MEMORY = 4,    /**< host memory, or the memory limit */
    PSPEC_ERROR_NO_DEVICE = 5, /**< no OpenCL driver, or no device that fits the selector */
    PSPEC_ERROR_DEVICE = 6,    /**< an OpenCL call failed */
    PSPEC_ERROR_BUILD = 7,     /**< a kernel did not compile; the log is in the message */
    PSPEC_ERROR_TOLERANCE = 8, /**< no engine reaches the tolerance asked for */
    PSPEC_ERROR_CANCELLED = 9, /**< the progress callback asked to stop */
    PSPEC_ERROR_CHECK = 10     /**< a check of the results failed */
} pspec_status;

/** The version of the library, "1.2.3"; static storage. */
PSPEC_EXPORT const char *pspec_version(void);

/** A point set that the caller keeps: a view. */
typedef struct pspec_pattern {
    unsigned dimension; /**< d, that of the plan; 3 on the sphere */
    size_t num_points;  /**< N, at least 1 */
    const double
        *points; /**< [num_points][dimension], row by row, each coordinate in [0,1), or unit
                                vectors */
    const double *weights; /**< [num_points], real, finite, of either sign; NULL: all 1 */
} pspec_pattern;

/** Which power; see the conventions at the beginning. */
typedef enum pspec_normalization {
    PSPEC_NORMALIZATION_POWER = 0,     /**< P = N |S|^2 / W^2; needs W != 0 */
    PSPEC_NORMALIZATION_EFFECTIVE = 1, /**< P = |S|^2 / V */
    PSPEC_NORMALIZATION_PAIRS = 2 /**< on the sphere Q(l) itself, weights 1/N where there are none;
                                     the tolerance then is of Q(l), see pspec_plan_create_angular() */
} pspec_normalization;

typedef struct pspec_context pspec_context;   /**< device, callbacks, limits, last error */
typedef struct pspec_plan pspec_plan;         /**< a question, its engine, and the sums so far */
typedef struct pspec_spectrum pspec_spectrum; /**< averages over realizations */

/** @name Context
 * @{ */

/** A context that has opened nothing yet, or NULL when there is no memory for it. */
PSPEC_EXPORT pspec_context *pspec_context_create(void);
/** Closes the device. The context's plans must be gone. NULL is allowed. */
PSPEC_EXPORT void pspec_context_destroy(pspec_context *context);

/** The sentence of the last call that failed; "" before. Valid until the next call with this context or
 * its plans. Of NULL: that there is no context. */
PSPEC_EXPORT const char *pspec_context_message(const pspec_context *context);

/** Which OpenCL device to use: an index, "cpu", "gpu", "accelerator" or a part of a name (copied);
 * NULL: the first GPU, else the first CPU. Nothing is opened until a plan needs a device; once one is
 * open the choice is made, and a call is #PSPEC_ERROR_INVALID_ARGUMENT. */
PSPEC_EXPORT pspec_status pspec_context_set_device(pspec_context *context, const char *selector);

/** The most memory in bytes that a plan may take, on host and device together, as the planner counts it;
 * 0, the default: no limit of yours. Plans made later obey it: with smaller batches, then another engine, else
 * they fail with #PSPEC_ERROR_MEMORY. What memory is free (also by limits of cgroups and of the process) makes batches
 * smaller, or a plan fails; the engine, and with it the bits of results, depends on this limit alone. */
PSPEC_EXPORT void pspec_context_set_memory_limit(pspec_context *context, uint64_t bytes);

/** What is being done, and how far it is. */
typedef struct pspec_progress_report {
    /** What is counted: "realizations" that are in the averages of a plan, or the name of another long phase, such as
     * "weights: iterations of conjugate gradients". */
    const char *phase;
    uint64_t done;      /**< so many of them */
    uint64_t total;     /**< of so many; 0: not known */
    const char *detail; /**< a few words more, such as "residual 1e-07", or NULL */
} pspec_progress_report;

/** Is told how far the work is; texts are gone when it returns. Non-zero cancels the call that is running, within a
 * second. */
typedef int (*pspec_progress)(const pspec_progress_report *report, void *payload);

/** Calls progress after every batch, now and then inside a long one, and in every other phase that takes long, in the
 * thread that made the call; NULL: no longer. A callback must not use the context or its plans. */
PSPEC_EXPORT void pspec_context_set_progress(pspec_context *context, pspec_progress progress,
                                             void *payload);

/** One sentence about what is being done, without a newline; gone when the callback returns. */
typedef void (*pspec_log)(const char *sentence, void *payload);

/** Calls log for every device that is opened, plan that is chosen, engine that is made anew and batch
 * that is made smaller; NULL: no longer. Sentences are for people: they may change between versions.
 * Plans keep the callback that was set when they were made. */
PSPEC_EXPORT void pspec_context_set_log(pspec_context *context, pspec_log log, void *payload);

/** @} */
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
    int exact_shells;           /**< bins are shells |k|^2 = n instead of rings of width 1 */
    int rings_only;             /**< leave out frequencies with |k|^2 > K^2 + K: 21 % less in 2-D */
    pspec_normalization normalization; /**< which power */
    double tolerance;      /**< numerical error of S relative to white noise; default 1e-6 */
    double floor;          /**< smallest power that must be right to 10 %; default 0: none */
    const char *engine;    /**< "torus_nufft", "torus_direct", "host_direct", or NULL: the best */
    const char *precision; /**< "single", "double", "extended", or NULL: likewise */
    int no_self_check;     /**< do not recompute a few entries of the first pattern */
    uint64_t per_ring; /**< S >= 2: of every ring or shell with more than S frequencies of the half
                          lattice only S, drawn at random without replacement; needs K <= 2000, not a
                          list; implies rings_only. Default 0: all */
    uint64_t
        per_ring_seed; /**< what is drawn depends on it, on d, S and the ring alone; default 1 */
} pspec_power_request;

/** The defaults of a #pspec_power_request. */
#define PSPEC_POWER_REQUEST_INIT                                                                   \
    {                                                                                              \
        sizeof(pspec_power_request), 2, 1024, 0, 0, 0, 0, 0, 0, PSPEC_NORMALIZATION_POWER, 1e-6,   \
            0, 0, 0, 0, 0, 1                                                                       \
    }

/** Chooses the engine and allocates what it needs; opens the context's device if that may be needed.
 *
 * The engine's error e satisfies sqrt(mean over k != 0 of |dS(k)|^2) = e sqrt(V) <= tolerance sqrt(V).
 * #PSPEC_ERROR_TOLERANCE: no engine reaches it. #PSPEC_ERROR_MEMORY: none fits the memory. The choice
 * depends on the request, the device and the limit alone; nothing is timed. It is the choice of the program for the same
 * question, and so are the bits of the averages.
 *
 * Powers are known only once they are measured. When they are so large that e exceeds the tolerance, the plan chooses
 * once more, for these powers, and runs the patterns again, of which it keeps copies for that: at most 64 MiB, and at
 * most a quarter of a memory limit. That happens when a spectrum is asked for; later patterns go to the new engine. */
PSPEC_EXPORT pspec_status pspec_plan_create(pspec_plan **out, pspec_context *context,
                                            const pspec_power_request *request);
/** What to compute on the sphere. Begin with #PSPEC_ANGULAR_REQUEST_INIT and set what differs. */
typedef struct pspec_angular_request {
    size_t struct_size;        /**< set by #PSPEC_ANGULAR_REQUEST_INIT; lets the struct grow */
    size_t num_points;         /**< of the largest pattern expected; more are taken; default 1024 */
    uint64_t num_realizations; /**< patterns that are expected; default 0: not known */
    int32_t max_degree;        /**< L: degrees 1..L, at most 32768 */
    int hemisphere;            /**< even degrees only */
    pspec_normalization normalization; /**< which power */
    double
        tolerance; /**< numerical error of the coefficients relative to white noise; default 1e-6 */
    double floor;  /**< smallest power that must be right to 10 %; default 0: none */
    const char *
        engine; /**< "sphere_grid", "sphere_nufft", "sphere_direct", "host_direct", NULL: the best */
    const char *precision; /**< "single", "double", "extended", or NULL: likewise */
    int no_self_check;     /**< do not recompute a few degrees of the first pattern */
    int want_c2;           /**< for pspec_plan_c2() */
} pspec_angular_request;

/** The defaults of a #pspec_angular_request. */
#define PSPEC_ANGULAR_REQUEST_INIT                                                                 \
    { sizeof(pspec_angular_request), 1024, 0, 0, 0, PSPEC_NORMALIZATION_POWER, 1e-6, 0, 0, 0, 0, 0 }

/** The plan of an angular power spectrum; as pspec_plan_create() otherwise.
 *
 * The engine's error e satisfies sqrt(4 pi mean |dc_lm|^2) = e sqrt(V) <= tolerance sqrt(V), mean over the
 * degrees and orders. Spectra have a bin for every degree: bin and frequency are l, normalized_frequency is
 * l / sqrt(N), count is 2l + 1, anisotropy_db is nan.
 *
 * With #PSPEC_NORMALIZATION_PAIRS powers are Q(l) = sum_ij w_i w_j P_l(u_i.u_j), and the tolerance is
 * |dQ(l)| <= tolerance (sum |w|)^2. */
PSPEC_EXPORT pspec_status pspec_plan_create_angular(pspec_plan **out, pspec_context *context,
                                                    const pspec_angular_request *request);
/** NULL is allowed. */
PSPEC_EXPORT void pspec_plan_destroy(pspec_plan *plan);

/** "(torus_direct precision=single ...)"; belongs to the plan, until it chooses another engine or is reset. */
PSPEC_EXPORT const char *pspec_plan_text(const pspec_plan *plan);

/** Adds realizations, in order. Averages depend, to the bit, on the realizations and their order alone,
 * not on how they were divided into calls.
 *
 * Small calls cost little: patterns are checked at once and copied (at most 64 MiB), and the engine runs
 * when there is a batch of them or a spectrum is asked for; whole batches of a call run at once. Nothing is
 * borrowed after the call, and nothing allocated, unless a pattern has
 * more points than the request said.
 *
 * #PSPEC_ERROR_INPUT names the pattern (sets count from 1, since the plan began) and the point. After
 * any error but #PSPEC_ERROR_INVALID_ARGUMENT the plan takes no more: destroy it or begin again with pspec_plan_reset(). */
PSPEC_EXPORT pspec_status pspec_plan_run(pspec_plan *plan, const pspec_pattern *patterns,
                                         size_t num_patterns);

/** Coefficients of one pattern on the sphere, for plans of pspec_plan_create_angular():
 *
 *     c_lm = sum_j w_j Y_lm(u_j),   l = 0..L, m = 0..l,   c_{l,-m} = (-1)^m conj c_lm
 *
 * with weights as they are, orthonormal harmonics with the Condon-Shortley phase, as (L + 1)(L + 2) / 2 pairs of real and
 * imaginary part, that of (l, m) at index m (2 L + 1 - m) / 2 + l: the order of healpy, whose a_lm is the conjugate. On the
 * hemisphere odd degrees are 0, and L is the last even degree. With hemispherical != 0 the harmonics are those of the
 * hemisphere, orthonormal there (P_l^m(2 z - 1) instead of P_l^m(z)), and points must have z >= 0. Averages do not
 * change. #PSPEC_ERROR_INPUT names a point that cannot be used; #PSPEC_ERROR_MEMORY comes where the coefficients, with what
 * the plan has, take more than the memory limit of the context; the progress callback can cancel, as in
 * pspec_plan_run(). None of them harms the plan. */
PSPEC_EXPORT pspec_status pspec_plan_coefficients(pspec_plan *plan, const pspec_pattern *pattern,
                                                  int hemispherical, double *coefficients);

/** A mean over realizations. */
typedef struct pspec_mean {
    double mean;           /**< over the realizations */
    double standard_error; /**< of the mean; nan for one realization */
} pspec_mean;

/** The part of pair sums that depends on the azimuth about the z axis, averaged over the realizations so far,
 *
 *     C_l^2 = 2 sum_{m > 0} |c_lm|^2 = (2l + 1) / (4 pi) Q(l) - c_l0^2,
 *
 * c2[0] of l = 1 or, on the hemisphere, 2, and so on: one for each bin of the plan's spectrum, with room from the caller. Right to
 * (2l + 1) / (4 pi) times the tolerance of Q(l). #PSPEC_ERROR_INVALID_ARGUMENT unless the request had
 * #PSPEC_NORMALIZATION_PAIRS and want_c2; #PSPEC_ERROR_INPUT when there are no realizations yet. */
PSPEC_EXPORT pspec_status pspec_plan_c2(pspec_plan *plan, pspec_mean *c2);

/** Forgets all realizations, and a failure: the plan is as good as new, for another average. Allocates
 * nothing and takes microseconds, unless large powers had made the plan choose another engine: then the first is made
 * anew. */
PSPEC_EXPORT pspec_status pspec_plan_reset(pspec_plan *plan);

/** @} */
/** @name Kernel interpolation on the sphere
 * @{ */

/** A function on the sphere through given values at points: of all functions f of the Sobolev space H^s with them the one
 * of the smallest norm,
 *
 *     f^(u) = sum_i alpha_i K(u, u_i),   K alpha = f,   K(u, v) = c - |u - v|^(2s-2),   c = 2^(2s-1) / s
 */
typedef struct pspec_interpolant pspec_interpolant;

/** Interpolates values [num_points] at unit vectors points [num_points][3] (lengths may be off by 1e-6; they are divided),
 * 1 < smoothness < 2. By Cholesky and a step of refinement in 8 num_points^2 bytes, or where these are more than the memory
 * limit of the context (without one: half of the machine's memory) by conjugate gradients on the device; the progress
 * callback is then told of their steps, the total being 0, and can cancel them. A copy is made of everything.
 *
 * Equal points are one: the first value counts. #PSPEC_ERROR_INPUT names points so near each other that K is singular in
 * double precision. */
PSPEC_EXPORT pspec_status pspec_interpolant_create(pspec_interpolant **out, pspec_context *context,
                                                   size_t num_points, const double *points,
                                                   const double *values, double smoothness);
/** NULL is allowed. */
PSPEC_EXPORT void pspec_interpolant_destroy(pspec_interpolant *interpolant);

/** f^ at unit vectors at [num][3], O(num num_points), to values [num]; allocates nothing. */
PSPEC_EXPORT void pspec_interpolant_evaluate(const pspec_interpolant *interpolant, size_t num,
                                             const double *at, double *values);

/** The norm of f^ in H^s, sqrt(f . alpha): no function with these values has a smaller one. */
PSPEC_EXPORT double pspec_interpolant_norm(const pspec_interpolant *interpolant);

/** Bounds [num] at unit vectors at [num][3]: |f(u) - f^(u)| <= bounds(u) |f| for every f of H^s with these values, where
 * bounds(u)^2 = c - k(u) . K^-1 k(u), k_i(u) = K(u, u_i). A solution of the system for each of them: O(num num_points^2). */
PSPEC_EXPORT pspec_status pspec_interpolant_bound(pspec_interpolant *interpolant, size_t num,
                                                  const double *at, double *bounds);

/** The condition number of K in the 1-norm, estimated; a bound from below where it was solved by conjugate gradients. Above
 * 4.5e11 fewer than four digits of alpha are right, since points lie together. */
PSPEC_EXPORT double pspec_interpolant_condition(const pspec_interpolant *interpolant);

/** @} */
/** @name Spectrum
 * @{ */

/** The mean over a ring or shell. */
typedef struct pspec_bin {
    int64_t bin;                 /**< ring number b, |k|^2 of a shell, or degree l */
    double frequency;            /**< mean |k|, cycles per unit cell */
    double normalized_frequency; /**< the same divided by N^(1/d), N the mean number of points */
    uint64_t count;              /**< frequencies of both signs */
    double power;                /**< mean of P over the bin and the realizations */
    double standard_error; /**< over realizations, and of the choice where only a random subset
                                    was computed; nan for one realization and all computed */
    double anisotropy_db;  /**< 10 log10(variance in the bin / power^2); nan: not defined */
    uint64_t num_computed; /**< of count, those that were computed: fewer with per_ring */
} pspec_bin;

/** A snapshot of the averages; the plan goes on. #PSPEC_ERROR_INPUT when there are no realizations yet.
 * Where the powers that were measured make the numerical error larger than the plan's tolerance, another engine runs the
 * patterns again (see pspec_plan_create()), which takes as long as they took; a failure in between is as one of
 * pspec_plan_run(). #PSPEC_ERROR_TOLERANCE when no engine that the request leaves reaches it, or the patterns were too
 * many to be kept: make a plan of higher precision then. #PSPEC_ERROR_CHECK when the powers are not finite numbers. The first
 * two do not harm the plan. */
PSPEC_EXPORT pspec_status pspec_spectrum_create(pspec_spectrum **out, pspec_plan *plan);
/** NULL is allowed. */
PSPEC_EXPORT void pspec_spectrum_destroy(pspec_spectrum *spectrum);

/** Writes the sums over realizations, from which every number of the spectrum follows, into a file that
 * appears when it is complete. The format is in the documentation (docs/user/spectrum_file.md). The context is for
 * the sentence of an error. */
PSPEC_EXPORT pspec_status pspec_spectrum_save(const pspec_spectrum *spectrum,
                                              pspec_context *context, const char *path);

/** Reads what pspec_spectrum_save() wrote: the same spectrum, to the bit, on every machine. A file that is
 * none, truncated, damaged (it has a checksum) or of another version is #PSPEC_ERROR_INPUT. */
PSPEC_EXPORT pspec_status pspec_spectrum_load(pspec_spectrum **out, pspec_context *context,
                                              const char *path);

/** The spectrum of the realizations of spectra[0], then those of spectra[1], and so on.
 *
 * Guaranteed: the result is what one plan would have given for all of them, but for the last digits of
 * the sums over realizations. These have about 106 bits (48 for single frequencies in single
 * precision), so that means over bins and their standard errors are the same doubles but for rare
 * last bits; powers of single frequencies in single precision agree to 1e-13. The error is the largest
 * of theirs.
 *
 * #PSPEC_ERROR_INPUT with the difference, when dimension, frequencies (with per_ring: what was drawn),
 * bins or normalization differ.
 * Numbers of points, engines, precisions and tolerances may differ. */
PSPEC_EXPORT pspec_status pspec_spectrum_merge(pspec_spectrum **out, pspec_context *context,
                                               const pspec_spectrum *const *spectra,
                                               size_t num_spectra);

/** What pspec_spectrum_compare() says about one bin. */
typedef struct pspec_bin_comparison {
    double z_score; /**< normal score of measured over saved; positive: more than saved; +-infinity
                       where neither side scatters */
    double p_value; /**< probability of a score as far from 0, of this bin alone */
    double adjusted_p_value;  /**< the same for all bins together: Holm's correction */
    double detectable_change; /**< relative change of power that would be found with probability
                                 0.9; nan: not known */
    int differs;              /**< adjusted_p_value <= false_alarm_rate */
} pspec_bin_comparison;

/** Is `measured` the spectrum of the sampler that `saved` is of? Compares the powers of all bins.
 *
 * Where both are averages over independent realizations of one sampler (M_1 and M_2 of them), any bin differs
 * with probability false_alarm_rate (above 0 and below 1) at most. Powers of bins are taken as gamma variables of one
 * relative scatter cv, so that their ratio has the F distribution with 2 M_2 / cv^2 and 2 M_1 / cv^2
 * degrees of freedom; cv^2 comes from the standard errors of both sides together,
 *
 *     cv^2 = sum_i (M_i - 1) M_i (standard_error_i / power_i)^2 / (M_1 + M_2 - 2)
 *
 * or from those of the mean of both powers if that is more, and the score z_score is judged by Student's distribution with
 * (M_1 + M_2 - 2) / (1 + cv^2) degrees of freedom. Bins that agree within the numerical errors of both are
 * equal; others are compared as if the errors had driven them apart. So deterministic sets (standard
 * error 0) are compared exactly. The documentation (docs/user/gate.md) has measured rates.
 *
 * bins: [number of bins of saved], or NULL; *num_different, unless NULL: how many differ. That some differ is no
 * error.
 *
 * #PSPEC_ERROR_INPUT with the difference, when the spectra are answers to different questions (dimension, frequencies,
 * bins, normalization, or numbers of points, whose ranges must overlap), are sums over pairs, have no bins, or are
 * of one realization each and not equal: nothing tells the scatter then. Seeds must differ, or equality says
 * nothing: realizations of one seed are equal. */
PSPEC_EXPORT pspec_status pspec_spectrum_compare(const pspec_spectrum *saved,
                                                 const pspec_spectrum *measured,
                                                 pspec_context *context, double false_alarm_rate,
                                                 pspec_bin_comparison *bins, size_t *num_different);

/** d; 3 on the sphere. */
PSPEC_EXPORT unsigned pspec_spectrum_dimension(const pspec_spectrum *spectrum);
/** M. */
PSPEC_EXPORT uint64_t pspec_spectrum_num_realizations(const pspec_spectrum *spectrum);
/** N, mean over the realizations. */
PSPEC_EXPORT double pspec_spectrum_mean_points(const pspec_spectrum *spectrum);
/** Bound on the numerical error of S, in units of sqrt(V), root mean square over frequencies. A power is
 * off by at most about 2 sqrt(P) e + e^2, in units of the effective power. */
PSPEC_EXPORT double pspec_spectrum_error(const pspec_spectrum *spectrum);

/** Bins in ascending order, [*num_bins]; none for a list of frequencies. Belongs to the spectrum. */
PSPEC_EXPORT const pspec_bin *pspec_spectrum_bins(const pspec_spectrum *spectrum, size_t *num_bins);

/** Numbers of a frequency: d, or 1 for the degrees of the sphere. */
PSPEC_EXPORT unsigned pspec_spectrum_components(const pspec_spectrum *spectrum);
/** The frequencies: the list as it was given, or the half lattice of the grid (first non-zero component
 * positive, lexicographic order, DC left out; P(-k) = P(k)), or with per_ring what was drawn of it, ring by
 * ring, unless that is everything. [*num_frequencies][components]. On the sphere the degrees. Belongs to the spectrum. */
PSPEC_EXPORT const int32_t *pspec_spectrum_frequencies(const pspec_spectrum *spectrum,
                                                       size_t *num_frequencies);
/** Mean powers, [num_frequencies], in the order of the frequencies. Belong to the spectrum. */
PSPEC_EXPORT const double *pspec_spectrum_powers(const pspec_spectrum *spectrum);
/** Their standard errors over realizations, [num_frequencies]; nan for one realization. */
PSPEC_EXPORT const double *pspec_spectrum_standard_errors(const pspec_spectrum *spectrum);

/** @} */
/** @name Quadrature of shading integrals
 *
 * Directions u_j with weights w_j, W = sum_j w_j, are a rule for int f phat dS, where phat = p / int p dS is a lobe of reflection about
 * the z axis. For all light f of the unit ball of the Sobolev space H^s, 1 < s < 2, its worst-case error E is
 *
 *     E^2 = sum_ij w_i w_j K(u_i, u_j) - 2 sum_j w_j kappa(u_j) + kappa_0                      (kernel form)
 *         = sum_l a_l (d_l^2 + C_l^2),   d_l = b_l - c_l0,   C_l^2 = 2 sum_{m > 0} |c_lm|^2    (spectral form)
 *
 * with K(u,v) = c - |u-v|^(2s-2) = sum_l a_l (2l+1)/(4 pi) P_l(u.v), c = 2^(2s-1)/s, b_l = int phat Y_l0 dS, c_lm = sum_j w_j Y_lm(u_j),
 * kappa = sum_l a_l b_l Y_l0, kappa_0 = sum_l a_l b_l^2. Lobes are named as on the command line: "diffuse", "glossy:n=30",
 * "glossy:n=2,cut=none", "phong:n=8", "zonal:file=NAME".
 * @{ */

/** What to compute of rules. Begin with #PSPEC_QUADRATURE_REQUEST_INIT and set what differs. */
typedef struct pspec_quadrature_request {
    size_t struct_size;  /**< set by #PSPEC_QUADRATURE_REQUEST_INIT; lets the struct grow */
    const char *brdf;    /**< the lobe; default "diffuse" */
    double smoothness;   /**< s, above 1 and below 2; default 1.5 */
    int32_t max_degree;  /**< L; default 0: where the bound of the rest meets the tolerance, at most
                           ceil(4 sqrt N) */
    int optimal_weights; /**< those that make E smallest, instead of the patterns' own */
    int drop_below_horizon; /**< leave points with z < 0 out where the lobe ends there; else they are an
                               error */
    double tolerance; /**< of E^2 in the spectral form, in units of c (sum |w|)^2; default 1e-10 */
    const char *engine;    /**< of the sphere or of pairs, or NULL: the best */
    const char *precision; /**< "single", "double", "extended", or NULL: likewise */
    int no_skip;           /**< compute also degrees and realizations that cannot matter */
} pspec_quadrature_request;

/** The defaults of a #pspec_quadrature_request. */
#define PSPEC_QUADRATURE_REQUEST_INIT                                                              \
    { sizeof(pspec_quadrature_request), "diffuse", 1.5, 0, 0, 0, 1e-10, 0, 0, 0 }

/** One degree of the spectral form. */
typedef struct pspec_quadrature_degree {
    int32_t degree; /**< l */
    double a;       /**< a_l of the space */
    double b;       /**< b_l of the lobe */
    pspec_mean d2;  /**< d_l^2 */
    pspec_mean c2;  /**< C_l^2 */
    pspec_mean e2;  /**< a_l (d_l^2 + C_l^2), the share of E^2 */
} pspec_quadrature_degree;

/** The error of rules, as means over realizations. Squares are averaged: E is the root of the mean of E^2. */
typedef struct pspec_worst_case_error {
    uint64_t num_realizations; /**< that were computed: one where all are known to be alike */
    pspec_mean squared;        /**< E^2, kernel form: all degrees */
    pspec_mean zonal;          /**< sum_{l <= L} a_l d_l^2 */
    pspec_mean anisotropic;    /**< sum_{l <= L} a_l C_l^2 */
    pspec_mean tail;           /**< E^2 minus both */
    double tail_model; /**< what independent points of the lobe's density have there in the mean */
    double
        tail_bound; /**< ((sum |w|) sqrt(tau_L) + sqrt(rest of kappa_0))^2, which it cannot exceed */
    double numerical_bound; /**< on the numerical error of E^2 */
    pspec_mean weight_sum;  /**< W */
    double
        condition; /**< with optimal weights the largest condition number of a kernel matrix; else nan */
    int is_ill_conditioned;  /**< points lie too near each other for weights of four digits */
    uint64_t num_dropped;    /**< points below the horizon that were left out, of all patterns */
    uint64_t num_duplicates; /**< points equal to others, of all patterns, with optimal weights */
} pspec_worst_case_error;

typedef struct pspec_quadrature pspec_quadrature; /**< the analysis of rules */

/** Analyses num_patterns rules, at least one, realizations of one another: patterns of dimension 3 with unit vectors; weights as
 * they are, 1/N where there are none. The context gives device, memory limit and progress, and is for the sentence of
 * an error.
 *
 * #PSPEC_ERROR_INVALID_ARGUMENT: a lobe, an s outside (1, 2), an engine that cannot be meant. #PSPEC_ERROR_INPUT: a
 * pattern and its point, below the horizon of a lobe that ends there, or no unit vector; weights that are all 0, or not
 * finite. #PSPEC_ERROR_TOLERANCE, #PSPEC_ERROR_MEMORY as pspec_plan_create(). #PSPEC_ERROR_CHECK: the two forms of E^2
 * contradict each other. */
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
/** "(sphere_direct precision=double ...)", what made c_lm or Q(l); belongs to the analysis. */
PSPEC_EXPORT const char *pspec_quadrature_text(const pspec_quadrature *quadrature);

/** A kernel that depends on the angle between two points alone. */
typedef struct pspec_kernel {
    const double *coefficients; /**< k_l: K = sum_l k_l P_l(u.v), or NULL for the power */
    size_t num_coefficients;    /**< of the list: degrees 0 .. num_coefficients - 1 */
    double power; /**< K = |u - v|^(2 power), above 0 and at most 1; s - 1 for the space H^s */
} pspec_kernel;

/** sums[k] = sum_ij w_i w_j K_k(u_i, u_j) over all pairs of a pattern on the sphere, i = j included, with weights as they are, or 1/N, for
 * num_kernels kernels from one histogram of the distances; bounds[k] on the error of each. Both have room for num_kernels numbers, from the
 * caller. The bounds are at most the tolerance times (sum |w|)^2, or #PSPEC_ERROR_TOLERANCE says that this cannot be. Needs a
 * device, in double precision below a tolerance of about 1e-5; memory is not limited. #PSPEC_ERROR_INPUT names a point
 * that cannot be used. */
PSPEC_EXPORT pspec_status pspec_kernel_sums(pspec_context *context, const pspec_pattern *pattern,
                                            const pspec_kernel *kernels, size_t num_kernels,
                                            double tolerance, double *sums, double *bounds);

/** The coefficients of a lobe, b[max_degree + 1] with room from the caller: b_l = int phat Y_l0 dS, or with hemispherical != 0
 * those of the harmonics sqrt((2l+1)/(2 pi)) P_l(2z - 1) of the hemisphere. Relative error 3e-12, or absolute 1e-17.
 * #PSPEC_ERROR_INVALID_ARGUMENT: no such lobe, n out of range, or a lobe that goes below the horizon with hemispherical
 * harmonics. */
PSPEC_EXPORT pspec_status pspec_brdf_coefficients(pspec_context *context, const char *brdf,
                                                  int hemispherical, int32_t max_degree, double *b);

/** The worst-case error of shading integrals as inner products of harmonics up to and including degree L, for L = 0 .. max_degree:
 *
 *     spherical:      E(L)^2 = sum_{l > L} a_l b_l^2
 *     hemispherical:  E(L)^2 = sum_l a_l (b_l - b'_l)^2,   b'_l the spherical coefficients of what degrees <= L sum to
 *
 * errors and bounds (on the error of errors) have room for max_degree + 1 numbers each, from the caller. points, of the same size or
 * NULL, become the number of spherical Fibonacci points with equal weights, morphed to the lobe, that have the same error: nan where
 * that is more than 32768, where E(L) is 0, and where no rule has the lobe's density. max_degree is at most 10000, or 500 for
 * hemispherical harmonics. The progress callback may cancel, while points are looked for. */
PSPEC_EXPORT pspec_status pspec_truncation(pspec_context *context, const char *brdf,
                                           double smoothness, int hemispherical, int32_t max_degree,
                                           double *errors, double *bounds, double *points);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
