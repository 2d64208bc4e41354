/* Cholesky factors of large symmetric matrices: OpenBLAS works on tiles, each on one thread, and the tiles of a step are
 * shared among our own threads. What a tile becomes does not depend on who made it: the same bits on any number of
 * threads. While a factor is made, OpenBLAS is told to use one thread, which is put back afterwards; it is a setting of
 * the process. */
#ifndef PS_MATH_CHOLESKY_H
#define PS_MATH_CHOLESKY_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* The largest matrix whose indices LAPACK takes. */
enum { PS_MOST_CHOLESKY = 46340 };

/* matrix [n][n], column by column (or row by row: it is symmetric), n <= PS_MOST_CHOLESKY. Its lower triangle with the
 * diagonal, entries matrix[j * n + i] with i >= j, becomes the factor; the strict upper triangle is neither read nor
 * written. *is_definite is false, and *bad the row where it was found, when the matrix is not positive definite as
 * far as rounding lets it be seen. */
void ps_cholesky(size_t n, double *matrix, bool *is_definite, size_t *bad);

/* Solves with the factor, in place. */
void ps_cholesky_solve(size_t n, const double *matrix, double *vector);

/* Estimate of the condition number in the 1-norm, from the factor and the norm of the matrix itself. */
pspec_status ps_cholesky_condition(size_t n, const double *matrix, double norm, double *condition,
                                   ps_error *error) PS_MUST_CHECK;

#endif
