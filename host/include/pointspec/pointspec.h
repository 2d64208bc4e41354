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
    PSPEC_NORMALIZATION_POWER = 0,    /**< P = N |S|^2 / W^2; needs W != 0 */
    PSPEC_NORMALIZATION_EFFECTIVE = 1 /**< P = |S|^2 / V */
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
 * 0, the default: what the machine and the device have. Plans made later obey it: with smaller
 * batches, then another engine, else they fail with #PSPEC_ERROR_MEMORY. Results are those without it unless
 * the engine is another one. */
PSPEC_EXPORT void pspec_context_set_memory_limit(pspec_context *context, uint64_t bytes);

/** How far a plan is: realizations that are in its averages, of those that the request expects (0: not
 * known). Non-zero cancels the call that is running. */
typedef int (*pspec_progress)(uint64_t done, uint64_t total, void *payload);

/** Calls progress after every batch, and now and then inside a long one, in the thread that runs the
 * plan; NULL: no longer. A callback must not use the context or its plans. */
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
 * depends on the request, the device and the limit alone; nothing is timed. */
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
    const char *engine;    /**< "sphere_direct", "host_direct", or NULL: the best */
    const char *precision; /**< "single", "double", "extended", or NULL: likewise */
    int no_self_check;     /**< do not recompute a few degrees of the first pattern */
} pspec_angular_request;

/** The defaults of a #pspec_angular_request. */
#define PSPEC_ANGULAR_REQUEST_INIT                                                                 \
    { sizeof(pspec_angular_request), 1024, 0, 0, 0, PSPEC_NORMALIZATION_POWER, 1e-6, 0, 0, 0, 0 }

/** The plan of an angular power spectrum; as pspec_plan_create() otherwise.
 *
 * The engine's error e satisfies sqrt(4 pi mean |dc_lm|^2) = e sqrt(V) <= tolerance sqrt(V), mean over the
 * degrees and orders. Spectra have a bin for every degree: bin and frequency are l, normalized_frequency is
 * l / sqrt(N), count is 2l + 1, anisotropy_db is nan. */
PSPEC_EXPORT pspec_status pspec_plan_create_angular(pspec_plan **out, pspec_context *context,
                                                    const pspec_angular_request *request);
/** NULL is allowed. */
PSPEC_EXPORT void pspec_plan_destroy(pspec_plan *plan);

/** "(torus_direct precision=single ...)"; belongs to the plan. */
PSPEC_EXPORT const char *pspec_plan_text(const pspec_plan *plan);

/** Adds realizations, in order. Averages depend, to the bit, on the realizations and their order alone,
 * not on how they were divided into calls.
 *
 * Small calls cost little: patterns are checked at once and copied (at most 64 MiB), and the engine runs
 * when there is a batch of them or a spectrum is asked for. A call that brings whole batches has them
 * run without copying. Nothing is borrowed after the call, and nothing allocated, unless a pattern has
 * more points than the request said.
 *
 * #PSPEC_ERROR_INPUT names the pattern (sets count from 1, since the plan began) and the point. After
 * any error but #PSPEC_ERROR_INVALID_ARGUMENT the plan takes no more: destroy it or begin again with pspec_plan_reset(). */
PSPEC_EXPORT pspec_status pspec_plan_run(pspec_plan *plan, const pspec_pattern *patterns,
                                         size_t num_patterns);

/** Forgets all realizations, and a failure: the plan is as good as new, for another average. Allocates
 * nothing and takes microseconds. */
PSPEC_EXPORT pspec_status pspec_plan_reset(pspec_plan *plan);

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
 * #PSPEC_ERROR_TOLERANCE when the powers that were measured make the numerical error larger than the
 * plan's tolerance: make a plan of higher precision then. Neither harms the plan. */
PSPEC_EXPORT pspec_status pspec_spectrum_create(pspec_spectrum **out, pspec_plan *plan);
/** NULL is allowed. */
PSPEC_EXPORT void pspec_spectrum_destroy(pspec_spectrum *spectrum);

/** Writes the sums over realizations, from which every number of the spectrum follows, into a file that
 * appears when it is complete. The format is in the documentation (spectrum_file.md). The context is for
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

#ifdef __cplusplus
}
#endif

#endif
