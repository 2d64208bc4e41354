/* Samplers of the unit torus [0,1)^d: one table, one file per sampler.
 *
 * A sampler writes one realization at a time. Realization r depends on nothing but
 * (sampler, parameters, number of points, dimension, seed, r), through the counter-based generator
 * of math/random.h; so any batch, thread or rank makes the same points.
 * This layer is a leaf: it may use math/ and base/ only.
 */
#ifndef PS_SAMPLERS_SAMPLER_H
#define PS_SAMPLERS_SAMPLER_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PS_MAX_DIMENSION = 6, PS_MAX_SAMPLER_PARAMETERS = 4, PS_MAX_SAMPLER_VALUE = 64 };

/* One key that a sampler understands in NAME:key=value. */
typedef struct ps_sampler_parameter {
    const char *key;
    const char *default_value;
    const char *meaning; /* one line, for help */
} ps_sampler_parameter;

typedef struct ps_sampler ps_sampler;

/* What to sample. values[i] belongs to sampler->parameters[i]. */
typedef struct ps_sampler_request {
    const ps_sampler *sampler;
    size_t num_points;
    unsigned dimension;
    uint64_t seed;
    bool homogenize; /* add one uniform random vector mod 1 to every point of a realization */
    char values[PS_MAX_SAMPLER_PARAMETERS][PS_MAX_SAMPLER_VALUE];
} ps_sampler_request;

struct ps_sampler {
    const char *name;
    const char *summary;        /* one line, for help */
    const char *aliases[4];     /* names that other tools use, NULL-terminated */
    unsigned maximum_dimension; /* 1 is always the minimum unless minimum_dimension says more */
    unsigned minimum_dimension;
    ps_sampler_parameter parameters[PS_MAX_SAMPLER_PARAMETERS + 1]; /* ended by key == NULL */

    /* Every realization the same points, before homogenize (may depend on the parameters). */
    bool (*is_deterministic)(const ps_sampler_request *);
    /* What the header of a result should say of this request, or NULL. The member may be NULL. */
    const char *(*note)(const ps_sampler_request *);
    /* Are number of points, dimension and parameter values admissible? NULL: always. */
    pspec_status (*check)(const ps_sampler_request *, ps_error *);
    /* Writes realization r: points [num_points][dimension], each in [0,1). */
    pspec_status (*generate)(const ps_sampler_request *, uint64_t realization, double *points,
                             ps_error *);
};

/* All samplers, ended by NULL. */
extern const ps_sampler *const ps_samplers[];

/* Parses "NAME[:key=value,...]" into request->sampler and request->values (defaults filled in).
 * Unknown names and keys are PSPEC_ERROR_INVALID_ARGUMENT and name the nearest known one. */
pspec_status ps_sampler_parse(ps_sampler_request *request, const char *text,
                              ps_error *error) PS_MUST_CHECK;

/* Checks the whole request (dimension, number of points, values); call it before sampling. */
pspec_status ps_sampler_check(const ps_sampler_request *request, ps_error *error) PS_MUST_CHECK;

/* Writes realization r of the request, random shift included when it is homogenized. */
pspec_status ps_sampler_generate(const ps_sampler_request *request, uint64_t realization,
                                 double *points, ps_error *error) PS_MUST_CHECK;

/* The sampler's note on this request, NULL when there is nothing to say. Static storage. */
const char *ps_sampler_note(const ps_sampler_request *request);

/* True when all realizations have the same power spectrum: deterministic points, shifted or not
 * (a shift of the torus leaves P unchanged, mathematics.md 1.1). */
bool ps_sampler_has_constant_power(const ps_sampler_request *request);

#endif
