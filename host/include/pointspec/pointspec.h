/* pointspec: power spectra of sampling patterns, averaged over realizations, with standard errors.
 *
 * Conventions. Points lie on the torus [0,1)^d, d = 1..6; frequencies are integer vectors k, in
 * cycles per unit cell. With weights w_j (real, of either sign; all 1 when absent)
 *
 *     S(k) = sum_j w_j exp(-2 pi i k.x_j),   W = sum_j w_j,   V = sum_j w_j^2
 *     power, default normalization:    P(k) = N |S(k)|^2 / W^2     (unit weights: |S|^2 / N)
 *     power, effective normalization:  P(k) = |S(k)|^2 / V
 *
 * White noise has mean power 1 at every k != 0. DC (k = 0) is never part of a radial mean. Ring b
 * holds the frequencies with b^2 - b + 1 <= |k|^2 <= b^2 + b (docs/conventions.md).
 *
 * Objects. A context holds the device and the sentence of the last error; a plan fixes what is asked and
 * by which engine; patterns (realizations) go through the plan in batches of any size, with the same
 * results to the bit; a spectrum is a snapshot of the averages so far.
 *
 *     pspec_context_create -> pspec_plan_create -> pspec_plan_run ... -> pspec_spectrum_create
 *
 * Every create has a destroy, which accepts NULL. Destroy spectra and plans before their context.
 *
 * Threads. One context, and the plans made from it, may be used by one thread at a time; different
 * contexts are independent.
 *
 * Errors. Whatever can fail returns a pspec_status; the sentence that goes with it (what, where, which
 * value, which limit) is pspec_context_message(). The library never prints, exits or aborts.
 */
#ifndef POINTSPEC_POINTSPEC_H
#define POINTSPEC_POINTSPEC_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define PSPEC_EXPORT __attribute__((visibility("default")))
#else
#define PSPEC_EXPORT
#endif

/* What went wrong. The numbers are never reused. */
typedef enum pspec_status {
    PSPEC_OK = 0,
    PSPEC_ERROR_INVALID_ARGUMENT = 1, /* a request, option or value that cannot be meant */
    PSPEC_ERROR_INPUT = 2,            /* points, weights or frequencies that cannot be used */
    PSPEC_ERROR_IO = 3,               /* the system refused to read or write */
    PSPEC_ERROR_MEMORY = 4,           /* host memory, or the memory limit */
    PSPEC_ERROR_NO_DEVICE = 5,        /* no OpenCL driver, or no device that fits the selector */
    PSPEC_ERROR_DEVICE = 6,           /* an OpenCL call failed */
    PSPEC_ERROR_BUILD = 7,            /* a kernel did not compile; the log is in the message */
    PSPEC_ERROR_TOLERANCE = 8,        /* no engine reaches the tolerance asked for */
    PSPEC_ERROR_CANCELLED = 9,        /* the progress callback asked to stop */
    PSPEC_ERROR_CHECK = 10            /* a check of the results failed */
} pspec_status;

/* "1.2.3"; static storage. */
PSPEC_EXPORT const char *pspec_version(void);

/* A point set that the caller keeps: a view, never copied as a whole.
 * points: [num_points][dimension], row by row, each coordinate in [0,1).
 * weights: [num_points], real, of either sign; NULL means all 1. */
typedef struct pspec_pattern {
    unsigned dimension;
    size_t num_points;
    const double *points;
    const double *weights;
} pspec_pattern;

/* See the conventions above. */
typedef enum pspec_normalization {
    PSPEC_NORMALIZATION_POWER = 0,    /* P = N |S|^2 / W^2 */
    PSPEC_NORMALIZATION_EFFECTIVE = 1 /* P = |S|^2 / V */
} pspec_normalization;

typedef struct pspec_context pspec_context;
typedef struct pspec_plan pspec_plan;
typedef struct pspec_spectrum pspec_spectrum;

/* ---- context ------------------------------------------------------------------------------- */

/* A context that has opened nothing yet, or NULL when there is no memory for it. */
PSPEC_EXPORT pspec_context *pspec_context_create(void);
PSPEC_EXPORT void pspec_context_destroy(pspec_context *context);

/* The sentence of the last call that failed; "" before. Valid until the next call. */
PSPEC_EXPORT const char *pspec_context_message(const pspec_context *context);

/* Which OpenCL device to use: an index, "cpu", "gpu", "accelerator" or a part of a name; NULL: the first
 * GPU, else the first CPU. To be called before the first plan; nothing is opened until a plan needs
 * a device. */
PSPEC_EXPORT pspec_status pspec_context_set_device(pspec_context *context, const char *selector);

/* ---- plan ---------------------------------------------------------------------------------- */

/* What to compute. Begin with PSPEC_POWER_REQUEST_INIT and set what differs. */
typedef struct pspec_power_request {
    size_t struct_size;         /* set by PSPEC_POWER_REQUEST_INIT; lets the struct grow */
    unsigned dimension;         /* of the points, 1 to 6; default 2 */
    size_t num_points;          /* of the largest pattern that is expected; more are taken, too */
    uint64_t num_realizations;  /* patterns that are expected, 0 when that is not known */
    int32_t max_frequency;      /* K: all |k_i| <= K; unless there is a list */
    const int32_t *frequencies; /* [num_frequencies][dimension], or NULL; copied */
    size_t num_frequencies;
    int exact_shells; /* bins are shells |k|^2 = n instead of rings of width 1 */
    int rings_only;   /* leave out frequencies with |k|^2 > K^2 + K: 21 % less in 2-D */
    pspec_normalization normalization;
    double tolerance;      /* numerical error of S relative to white noise; default 1e-6 */
    double floor;          /* smallest power that must be right to 10 %, 0: none */
    const char *engine;    /* "torus_direct", "host_direct", or NULL: the planner chooses */
    const char *precision; /* "single", "double", "extended", or NULL: likewise */
    int no_self_check;     /* do not recompute a few entries of the first pattern */
} pspec_power_request;

#define PSPEC_POWER_REQUEST_INIT                                                                   \
    {                                                                                              \
        sizeof(pspec_power_request), 2, 1024, 0, 0, 0, 0, 0, 0, PSPEC_NORMALIZATION_POWER, 1e-6,   \
            0, 0, 0, 0                                                                             \
    }

/* Chooses the engine and allocates what it needs. PSPEC_ERROR_TOLERANCE: no engine reaches it. */
PSPEC_EXPORT pspec_status pspec_plan_create(pspec_plan **out, pspec_context *context,
                                            const pspec_power_request *request);
PSPEC_EXPORT void pspec_plan_destroy(pspec_plan *plan);

/* "(torus_direct precision=single ...)"; belongs to the plan. */
PSPEC_EXPORT const char *pspec_plan_text(const pspec_plan *plan);

/* Adds realizations, in order. After an error the plan's averages are not to be used. */
PSPEC_EXPORT pspec_status pspec_plan_run(pspec_plan *plan, const pspec_pattern *patterns,
                                         size_t num_patterns);

/* ---- spectrum ------------------------------------------------------------------------------ */

typedef struct pspec_bin {
    int64_t bin;                 /* ring number b, or |k|^2 of a shell */
    double frequency;            /* mean |k|, cycles per unit cell */
    double normalized_frequency; /* the same divided by N^(1/d) */
    uint64_t count;              /* frequencies of both signs */
    double power;
    double standard_error; /* over realizations; nan when there was only one */
    double anisotropy_db;  /* 10 log10(variance in the ring / power^2); nan: not defined */
} pspec_bin;

/* A snapshot of the averages. PSPEC_ERROR_TOLERANCE when the powers that were measured make the
 * numerical error larger than the plan's tolerance: make a plan of higher precision then. */
PSPEC_EXPORT pspec_status pspec_spectrum_create(pspec_spectrum **out, pspec_plan *plan);
PSPEC_EXPORT void pspec_spectrum_destroy(pspec_spectrum *spectrum);

PSPEC_EXPORT uint64_t pspec_spectrum_num_realizations(const pspec_spectrum *spectrum);
/* Bound on the numerical error of S, in units of sqrt(sum w^2), root mean square over frequencies. */
PSPEC_EXPORT double pspec_spectrum_error(const pspec_spectrum *spectrum);

/* Bins in ascending order; none for a list of frequencies. Belongs to the spectrum. */
PSPEC_EXPORT const pspec_bin *pspec_spectrum_bins(const pspec_spectrum *spectrum, size_t *num_bins);

/* The frequencies: the list as it was given, or the half lattice of the grid (first non-zero component
 * positive, lexicographic order, DC left out; P(-k) = P(k)). [*num_frequencies][dimension]. */
PSPEC_EXPORT const int32_t *pspec_spectrum_frequencies(const pspec_spectrum *spectrum,
                                                       size_t *num_frequencies);
/* [num_frequencies] each, in the order of the frequencies. Belong to the spectrum. */
PSPEC_EXPORT const double *pspec_spectrum_powers(const pspec_spectrum *spectrum);
PSPEC_EXPORT const double *pspec_spectrum_standard_errors(const pspec_spectrum *spectrum);

#ifdef __cplusplus
}
#endif

#endif
