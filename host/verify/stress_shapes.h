/* Point sets that are hard on arithmetic: what `pointspec stress` and the tests of tolerances try
 * engines with.
 *
 * A set depends on nothing but shape, number of points, dimension and seed.
 */
#ifndef PS_VERIFY_STRESS_SHAPES_H
#define PS_VERIFY_STRESS_SHAPES_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

/* Uniform on the multiples of 2^-53 in [0,1): the next of the sequence. */
double ps_stress_uniform(uint64_t *state);

/* Weights; `point` is its number in the set. */
typedef double ps_stress_weight(size_t point, uint64_t *state);

/* A shape on the torus gives one coordinate after the other. */
typedef struct ps_torus_shape {
    const char *name;
    double (*coordinate)(size_t point, size_t num_points, unsigned axis, uint64_t *state);
    ps_stress_weight *weight; /* NULL: unit weights */
} ps_torus_shape;

/* A shape on the sphere gives unit vectors. */
typedef struct ps_vector_shape {
    const char *name;
    void (*place)(size_t point, size_t num_points, uint64_t *state, double u[3]);
    ps_stress_weight *weight; /* NULL: unit weights */
} ps_vector_shape;

/* Both ended by a row without a name. */
extern const ps_torus_shape ps_torus_shapes[];
extern const ps_vector_shape ps_vector_shapes[];

/* NULL when there is none of that name. */
const ps_torus_shape *ps_torus_shape_find(const char *name);
const ps_vector_shape *ps_vector_shape_find(const char *name);

/* Points and weights are freed by ps_stress_pattern_free. */
pspec_status ps_torus_shape_make(const ps_torus_shape *shape, unsigned dimension, size_t num_points,
                                 uint64_t seed, pspec_pattern *out, ps_error *error) PS_MUST_CHECK;
pspec_status ps_vector_shape_make(const ps_vector_shape *shape, size_t num_points, uint64_t seed,
                                  pspec_pattern *out, ps_error *error) PS_MUST_CHECK;
void ps_stress_pattern_free(pspec_pattern *pattern);

#endif
