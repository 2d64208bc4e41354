/* What is measured of point sets: one row a measure, in the order of tables. Formulas and their
 * sources: docs/user/measure.md.
 */
#ifndef PS_JOBS_MEASURE_MEASURES_H
#define PS_JOBS_MEASURE_MEASURES_H

#include "jobs/measure/discrepancy.h"
#include "jobs/measure/near.h"
#include "spectra/shape/shape.h"

#include <stdbool.h>

/* A set, and what devices have found of it. */
typedef struct ps_measured_set {
    const double *points; /* [num][dimension] */
    size_t num;
    unsigned dimension;
    bool on_sphere;
    /* looked at where a measure needs it that is wanted */
    const ps_near *near;
    ps_discrepancies discrepancies;
    double mean_chord; /* of all ordered pairs */
} ps_measured_set;

typedef enum ps_measure_needs {
    PS_MEASURE_NEEDS_POINTS = 0,
    PS_MEASURE_NEEDS_NEAR = 1,
    PS_MEASURE_NEEDS_DISCREPANCY = 2,
    PS_MEASURE_NEEDS_CHORDS = 4,
    PS_MEASURE_NEEDS_CELLS = 8, /* which the measure makes itself */
    PS_MEASURE_NEEDS_SPECTRUM = 16,
    PS_MEASURE_NEEDS_WINDOWS = 32 /* of near pairs */
} ps_measure_needs;

typedef struct ps_measure_row {
    const char *name;
    bool on_torus, on_sphere;
    unsigned least_dimension, most_dimension; /* of the torus; 0: any */
    unsigned needs;                           /* of ps_measure_needs */
    /* Points beyond which a set is not measured unless the measure is asked for by name; 0: it
     * takes little time for every point */
    size_t most_points;
    /* Of one set; nan: it has none. NULL: of the spectrum. */
    pspec_status (*of_set)(const ps_measured_set *set, double *value, ps_error *error);
    /* Of the mean spectrum, with its standard error; nan: unknown. Powers of bins are others while
     * it looks. */
    ps_mean (*of_spectrum)(ps_spectrum *spectrum, const ps_shape *shape);
} ps_measure_row;

enum { PS_MEASURE_COINCIDENT_POINTS = 2, PS_NUM_MEASURES = 15 };
extern const ps_measure_row ps_measure_rows[PS_NUM_MEASURES];

/* A set of measures, by their numbers. */
typedef uint32_t ps_measure_set;

/* Those of a list of names with commas; NULL: all of them. PSPEC_ERROR_INVALID_ARGUMENT with the
 * nearest name. */
pspec_status ps_measures_parse(ps_measure_set *out, const char *names,
                               ps_error *error) PS_MUST_CHECK;
/* Is the measure one of points there? */
bool ps_measure_is_of(const ps_measure_row *measure, unsigned dimension, bool on_sphere);

/* The smallest distance of N points is at most this: of the densest lattice packing of d dimensions
 * on the torus, by Fejes Toth's bound on the sphere. */
double ps_measure_largest_distance(size_t num, unsigned dimension, bool on_sphere);

#endif
