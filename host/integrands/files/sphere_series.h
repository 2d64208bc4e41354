/* A real function of the sphere that has finitely many harmonics, from a file. */
#ifndef PS_INTEGRANDS_FILES_SPHERE_SERIES_H
#define PS_INTEGRANDS_FILES_SPHERE_SERIES_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct ps_sphere_series {
    size_t max_degree;
    /* At index m (2L + 1 - m)/2 + l, m >= 0: a, b, and F_lm, as kernels/integrands/sphere_series.h
     * takes them */
    size_t num_table;
    double *table;  /* [num_table] */
    double *powers; /* [max_degree + 1], sum_m |F_lm|^2 over all orders */
} ps_sphere_series;

/* only_even: other degrees than even ones are refused. */
pspec_status ps_sphere_series_read(ps_sphere_series **out, const char *path, bool only_even,
                                   ps_error *error) PS_MUST_CHECK;
void ps_sphere_series_destroy(ps_sphere_series *series); /* NULL is allowed */

double ps_sphere_series_value(const ps_sphere_series *series, const double *u);
/* sum_l powers[l] P_l(x); nan: they are too many */
double ps_sphere_series_correlation(const ps_sphere_series *series, double x);
double ps_sphere_series_steps(const ps_sphere_series *series); /* the member steps */

#endif
