/* Cholesky factors of large symmetric matrices, by tiles that our own threads share. What a tile
 * becomes does not depend on who made it, nor on the width of the processor's vectors: the same
 * bits on any number of threads and on every processor with fma. No step takes longer than some
 * hundredths of a second without telling the watch. */
#ifndef PS_MATH_LINEAR_CHOLESKY_H
#define PS_MATH_LINEAR_CHOLESKY_H

#include "base/watch.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What a factorization takes beside the matrix. */
uint64_t ps_cholesky_bytes(size_t n);

/* matrix [n][n], column by column (or row by row: it is symmetric). Its lower triangle with the
 * diagonal, entries matrix[j * n + i] with i >= j, becomes the factor; the strict upper triangle is
 * neither read nor written. *is_definite is false, and *bad the row where it was found, when the
 * matrix is not positive definite as far as rounding lets it be seen. most_threads: 0 for as many
 * as there are processors. */
pspec_status ps_cholesky(size_t n, double *matrix, unsigned most_threads, const ps_watch *watch,
                         bool *is_definite, size_t *bad, ps_error *error) PS_MUST_CHECK;

/* Solves with the factor, in place. */
pspec_status ps_cholesky_solve(size_t n, const double *matrix, double *vector,
                               const ps_watch *watch, ps_error *error) PS_MUST_CHECK;

/* Estimate of the condition number in the 1-norm, from the factor and the norm of the matrix
 * itself. */
pspec_status ps_cholesky_condition(size_t n, const double *matrix, double norm,
                                   const ps_watch *watch, double *condition,
                                   ps_error *error) PS_MUST_CHECK;

#endif
