/** @file
 * What everything else has to do with: statuses, the version, patterns. Included by pointspec.h.
 */
#ifndef POINTSPEC_COMMON_H
#define POINTSPEC_COMMON_H

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
    PSPEC_ERROR_NO_DEVICE = 5, /**< no OpenCL driver that starts, or none that has a device */
    PSPEC_ERROR_DEVICE = 6,    /**< an OpenCL call failed */
    PSPEC_ERROR_BUILD = 7,     /**< a kernel did not compile; the log is in the message */
    PSPEC_ERROR_TOLERANCE = 8, /**< no engine reaches the tolerance asked for */
    PSPEC_ERROR_CANCELLED = 9, /**< the progress callback asked to stop */
    PSPEC_ERROR_CHECK = 10     /**< a check of the results failed */
} pspec_status;

/** The version of the library, "1.2.3"; static storage. */
PSPEC_EXPORT const char *pspec_version(void);

/** A point set of the caller, as a pspec_give() shows it. Made by the library alone, which passes
 * it with only zeros for the callback to fill: members are added at its end, 0 in them means what
 * there was without them, and programs that know fewer of them stay right. */
typedef struct pspec_pattern {
    unsigned dimension; /**< d, or 3 on the sphere */
    size_t num_points;  /**< N, at least 1 */
    /** [num_points][dimension], row by row, each coordinate in [0,1), or unit vectors */
    const double *points;
    const double *weights; /**< [num_points], real, finite, of either sign; NULL: all 1 */
} pspec_pattern;

#ifdef __cplusplus
}
#endif

#endif
