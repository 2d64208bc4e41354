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

/* Of a set the point that is made, of which coordinates come axis by axis. */
typedef struct ps_stress_spot {
    size_t point, num_points;
    unsigned axis;
    uint64_t *state;
} ps_stress_spot;

/* Of the torus a shape gives one coordinate after the other, of the sphere unit vectors. */
typedef struct ps_stress_shape {
    const char *name;
    double (*coordinate)(const ps_stress_spot *at); /* NULL: of the sphere */
    void (*place)(const ps_stress_spot *at, double u[3]);
    double (*weight)(const ps_stress_spot *at); /* NULL: unit weights */
} ps_stress_shape;

/* Both ended by a row without a name. */
extern const ps_stress_shape ps_torus_shapes[], ps_vector_shapes[];

/* NULL when there is none of that name. */
const ps_stress_shape *ps_stress_shape_find(const ps_stress_shape *shapes, const char *name);

/* Freed by ps_stress_pattern_free. The dimension of vectors is 3. */
pspec_status ps_stress_shape_make(const ps_stress_shape *shape, unsigned dimension,
                                  size_t num_points, uint64_t seed, pspec_pattern *out,
                                  ps_error *error) PS_MUST_CHECK;
void ps_stress_pattern_free(pspec_pattern *pattern);

#endif
