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
 * This header holds the vocabulary that the program and its parts share: statuses, patterns,
 * normalizations. Calls to run the estimator from other programs are not in it yet.
 *
 * Errors. Whatever can fail returns a pspec_status, with a sentence beside it. The library never
 * prints, exits or aborts.
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

#ifdef __cplusplus
}
#endif

#endif
