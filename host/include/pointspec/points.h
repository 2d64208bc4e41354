/** @file
 * Points of samplers, and point files. Included by pointspec.h.
 */
#ifndef POINTSPEC_POINTS_H
#define POINTSPEC_POINTS_H

#include "pointspec/answer.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A sampler with its parameters, number of points, dimension and seed. */
typedef struct pspec_sampler pspec_sampler;

/** @name Points
 *
 * Samplers and their parameters are those of the manual page of pointspec-sample; their equations
 * are in docs/mathematics/samplers.md. Options are given as to pspec_answer().
 * @{ */

/** Where points lie. The numbers are never reused. */
typedef enum pspec_domain {
    PSPEC_DOMAIN_TORUS = 0,     /**< [0,1)^d */
    PSPEC_DOMAIN_SPHERE = 1,    /**< unit vectors */
    PSPEC_DOMAIN_HEMISPHERE = 2 /**< unit vectors with z >= 0 */
} pspec_domain;

/** What points a sampler makes. */
typedef struct pspec_sampler_shape {
    pspec_domain domain; /**< where they lie */
    unsigned dimension;  /**< numbers of a point: d, or 3 */
    /** Of a realization; samplers of lattices may make another number than was asked for. Where it
     * changes from realization to realization, about their mean. */
    size_t num_points;
    /** That a realization needs room for: num_points unless their number changes. */
    size_t most_points;
} pspec_sampler_shape;

/** A sampler by the options of pointspec sample: "sampler", "points", "dimension", "seed",
 * "homogenize". #PSPEC_ERROR_INVALID_ARGUMENT names what cannot be meant. Needs no device. */
PSPEC_EXPORT pspec_status pspec_sampler_create(pspec_sampler **out, pspec_context *context,
                                               const pspec_option *options, size_t num_options);
/** NULL is allowed. */
PSPEC_EXPORT void pspec_sampler_destroy(pspec_sampler *sampler);

/** What points it makes. */
PSPEC_EXPORT pspec_sampler_shape pspec_sampler_get_shape(const pspec_sampler *sampler);

/** Writes realization number `realization`, from 0 on, to points[*num_points][dimension] with room
 * for most_points from the caller: doubles of [0,1), or unit vectors. num_points may be NULL where
 * the number does not change from realization to realization. It all depends on nothing but the
 * options and that number, and is to the bit what pspec_sample() and pspec_answer() have. The
 * context is for the sentence of an error, and for its progress callback, which may cancel while
 * many points are made (#PSPEC_ERROR_CANCELLED): what points has then is not defined. */
PSPEC_EXPORT pspec_status pspec_sampler_generate(const pspec_sampler *sampler,
                                                 pspec_context *context, uint64_t realization,
                                                 double *points, size_t *num_points);

/** Writes realizations of a sampler into the file "output", byte for byte as pointspec sample:
 * options of pspec_sampler_create(), "realizations" and "format"; "plot" names a picture of the
 * first realization, which without "output" and "format" is all that is made. What the format cannot keep is
 * told to the callback for warnings. #PSPEC_ERROR_IO where the file cannot be written,
 * #PSPEC_ERROR_MEMORY where a realization does not fit the limit of the context,
 * #PSPEC_ERROR_CANCELLED by the progress callback: there is no file then. */
PSPEC_EXPORT pspec_status pspec_sample(pspec_context *context, const pspec_option *options,
                                       size_t num_options);

/** Writes the sets of point files, each a value of the option "files", into the file "output" in
 * another format, byte for byte as pointspec convert, whose options it takes. Files may be larger
 * than memory. What the format cannot keep is refused, or told to the callback for warnings. Errors
 * as of pspec_sample(); #PSPEC_ERROR_INPUT names file, line and value that cannot be used. */
PSPEC_EXPORT pspec_status pspec_convert(pspec_context *context, const pspec_option *options,
                                        size_t num_options);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
