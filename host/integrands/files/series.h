/* A real function of the torus that has finitely many Fourier coefficients, from a file. */
#ifndef PS_INTEGRANDS_FILES_SERIES_H
#define PS_INTEGRANDS_FILES_SERIES_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct ps_torus_series {
    unsigned dimension;
    double mean, energy; /* f_0; the sum of all other |f_k|^2 */
    double reach;        /* the largest |k_i| */
    double steps;        /* of a value: those of a term whose k is next to the one before are 1 */
    size_t num;          /* of the half lattice: k and -k are one */
    int32_t *k;          /* [num][dimension], ascending */
    uint8_t *first;      /* [num], the first axis on which k is not that of the one before, .. */
    uint8_t *is_next;    /* .. and is it the last, and larger by 1? */
    double *re, *im;     /* [num] */
    double *squares;     /* [num], |f_k|^2 */
    size_t num_table;
    double *table; /* [num_table], as kernels/integrands/torus_series.h takes it */
} ps_torus_series;

pspec_status ps_torus_series_read(ps_torus_series **out, const char *path, unsigned dimension,
                                  ps_error *error) PS_MUST_CHECK;
void ps_torus_series_destroy(ps_torus_series *series); /* NULL is allowed */

double ps_torus_series_value(const ps_torus_series *series, const double *x);
/* sum of |f_k|^2 e^{2 pi i k.x}; nan: they are too many */
double ps_torus_series_correlation(const ps_torus_series *series, const double *x);
double ps_torus_series_power(const ps_torus_series *series, const int32_t *k); /* |f_k|^2 */

/* A real function of the sphere that has finitely many harmonics, from a file. */

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
/* Of F_lm, re, im at index m (2L + 1 - m)/2 + l. */
pspec_status ps_sphere_series_make(ps_sphere_series **out, size_t max_degree, const double *f,
                                   ps_error *error) PS_MUST_CHECK;
/* The same numbers, 0 beyond the largest degree. */
void ps_sphere_series_coefficients(const ps_sphere_series *series, size_t max_degree, double *out);
void ps_sphere_series_destroy(ps_sphere_series *series); /* NULL is allowed */

double ps_sphere_series_value(const ps_sphere_series *series, const double *u);
/* sum_l powers[l] P_l(x); nan: they are too many */
double ps_sphere_series_correlation(const ps_sphere_series *series, double x);
double ps_sphere_series_steps(const ps_sphere_series *series); /* the member steps */

#endif
