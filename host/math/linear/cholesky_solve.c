/* Solutions with a Cholesky factor, and the estimate of a condition number that they give. */
#include "math/linear/cholesky.h"

#include "base/memory.h"
#include "base/wide.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Columns taken together, so that the vector is read once for all of them, and numbers side by
 * side. */
enum { COLUMNS = 4, LANES = 8 };
/* Numbers of the factor read between two tellings, some ten milliseconds. */
static const size_t NUMBERS_AT_A_TIME = (size_t)1 << 22;

/* ---- triangles ----------------------------------------------------------------------------- */

PS_WIDE_BODY(size_t, take_columns,
             (size_t num, size_t stride, const double *restrict columns, const double *factors,
              double *restrict vector)) {
    const double a = factors[0];
    const double b = factors[1];
    const double c = factors[2];
    const double d = factors[3];
    for (size_t i = 0; i < num; i++) {
        vector[i] -= (columns[i] * a + columns[stride + i] * b) +
                     (columns[2 * stride + i] * c + columns[3 * stride + i] * d);
    }
    return num;
}

PS_WIDE(size_t, take_columns,
        (size_t num, size_t stride, const double *restrict columns, const double *factors,
         double *restrict vector),
        (num, stride, columns, factors, vector))

/* sums[k]: of column k times the vector. */
PS_WIDE_BODY(size_t, dot_columns,
             (size_t num, size_t stride, const double *columns, const double *vector,
              double *sums)) {
    double lanes[COLUMNS][LANES] = {{0}};
    const size_t whole = num - num % LANES;
    for (size_t i = 0; i < whole; i += LANES) {
        for (size_t k = 0; k < COLUMNS; k++) {
            for (size_t lane = 0; lane < LANES; lane++) {
                lanes[k][lane] += columns[k * stride + i + lane] * vector[i + lane];
            }
        }
    }
    for (size_t k = 0; k < COLUMNS; k++) {
        sums[k] = 0;
        for (size_t lane = 0; lane < LANES; lane++) {
            sums[k] += lanes[k][lane];
        }
        for (size_t i = whole; i < num; i++) {
            sums[k] += columns[k * stride + i] * vector[i];
        }
    }
    return num;
}

PS_WIDE(size_t, dot_columns,
        (size_t num, size_t stride, const double *columns, const double *vector, double *sums),
        (num, stride, columns, vector, sums))

/* Entries of the factor between two tellings of a phase. */
typedef struct telling {
    const ps_watch *watch;
    size_t n, silent, done;
} telling;

static pspec_status tell(telling *progress, size_t num_columns, ps_error *error) {
    progress->done += num_columns;
    progress->silent += num_columns * progress->n;
    if (progress->silent < NUMBERS_AT_A_TIME) {
        return PSPEC_OK;
    }
    progress->silent = 0;
    return ps_watch_tell(progress->watch, "columns of a solution by the Cholesky factor",
                         progress->done, 2 * progress->n, NULL, error);
}

/* L y = vector: whole groups of columns, and then the rest, one by one. */
static pspec_status solve_forward(telling *progress, const double *matrix, double *vector,
                                  ps_error *error) {
    const size_t n = progress->n;
    for (size_t j = 0; j < n;) {
        const size_t end = n - j >= COLUMNS ? j + COLUMNS : n;
        for (size_t k = j; k < end; k++) {
            vector[k] /= matrix[k * n + k];
            for (size_t i = k + 1; i < end; i++) {
                vector[i] -= matrix[k * n + i] * vector[k];
            }
        }
        if (end - j == COLUMNS) {
            take_columns(n - end, n, matrix + j * n + end, vector + j, vector + end);
        }
        PS_TRY(tell(progress, end - j, error));
        j = end;
    }
    return PSPEC_OK;
}

/* L^T x = vector, by the same groups from the last one on. */
static pspec_status solve_backward(telling *progress, const double *matrix, double *vector,
                                   ps_error *error) {
    const size_t n = progress->n;
    for (size_t end = n; end > 0;) {
        const size_t num = end % COLUMNS != 0 ? end % COLUMNS : COLUMNS;
        const size_t begin = end - num;
        double sums[COLUMNS] = {0};
        if (num == COLUMNS) {
            dot_columns(n - end, n, matrix + begin * n + end, vector + end, sums);
        }
        for (size_t k = end; k-- > begin;) {
            double left = vector[k] - sums[k - begin];
            for (size_t i = k + 1; i < end; i++) {
                left -= matrix[k * n + i] * vector[i];
            }
            vector[k] = left / matrix[k * n + k];
        }
        PS_TRY(tell(progress, num, error));
        end = begin;
    }
    return PSPEC_OK;
}

pspec_status ps_cholesky_solve(size_t n, const double *matrix, double *vector,
                               const ps_watch *watch, ps_error *error) {
    telling progress = {.watch = watch, .n = n};
    PS_TRY(solve_forward(&progress, matrix, vector, error));
    return solve_backward(&progress, matrix, vector, error);
}

/* ---- condition ------------------------------------------------------------------------------- */

/* The 1-norm of the inverse from below by N. J. Higham (1988), as LAPACK estimates it: some five
 * solutions. */
typedef struct estimate {
    size_t n;
    const double *matrix;
    const ps_watch *watch;
    double *x;         /* [n] */
    signed char *sign; /* [n]: of the last solution */
    double norm;
} estimate;

static double sum_sizes(const estimate *inverse) {
    double sum = 0;
    for (size_t i = 0; i < inverse->n; i++) {
        sum += fabs(inverse->x[i]);
    }
    return sum;
}

static size_t find_largest(const estimate *inverse) {
    size_t largest = 0;
    for (size_t i = 1; i < inverse->n; i++) {
        largest = fabs(inverse->x[i]) > fabs(inverse->x[largest]) ? i : largest;
    }
    return largest;
}

/* x becomes its own signs. Returns whether they are those of the last time. */
static bool take_signs(estimate *inverse) {
    bool are_same = true;
    for (size_t i = 0; i < inverse->n; i++) {
        const signed char sign = inverse->x[i] >= 0 ? 1 : -1;
        are_same = are_same && sign == inverse->sign[i];
        inverse->sign[i] = sign;
        inverse->x[i] = sign;
    }
    return are_same;
}

static pspec_status solve(const estimate *inverse, ps_error *error) {
    return ps_cholesky_solve(inverse->n, inverse->matrix, inverse->x, inverse->watch, error);
}

/* Goes from a column of the inverse to the one that its signs point to, while they become
 * larger. */
static pspec_status climb(estimate *inverse, ps_error *error) {
    enum { MOST_STEPS = 4 };
    size_t column = inverse->n;
    for (int i = 0; i < MOST_STEPS; i++) {
        PS_TRY(solve(inverse, error));
        const size_t next = find_largest(inverse);
        if (column < inverse->n && fabs(inverse->x[next]) <= fabs(inverse->x[column])) {
            return PSPEC_OK;
        }
        column = next;
        memset(inverse->x, 0, inverse->n * sizeof *inverse->x);
        inverse->x[column] = 1;
        PS_TRY(solve(inverse, error));
        const double norm = sum_sizes(inverse);
        const bool is_better = norm > inverse->norm;
        inverse->norm = fmax(inverse->norm, norm);
        if (take_signs(inverse) || !is_better) {
            return PSPEC_OK;
        }
    }
    return PSPEC_OK;
}

/* A vector of alternating signs finds what the climb may have missed. */
static pspec_status try_alternating(estimate *inverse, ps_error *error) {
    const double steps = inverse->n > 1 ? (double)(inverse->n - 1) : 1;
    for (size_t i = 0; i < inverse->n; i++) {
        inverse->x[i] = (i % 2 == 0 ? 1 : -1) * (1 + (double)i / steps);
    }
    PS_TRY(solve(inverse, error));
    inverse->norm = fmax(inverse->norm, 2 * sum_sizes(inverse) / (3 * (double)inverse->n));
    return PSPEC_OK;
}

static pspec_status estimate_inverse(estimate *inverse, ps_error *error) {
    for (size_t i = 0; i < inverse->n; i++) {
        inverse->x[i] = 1 / (double)inverse->n;
    }
    PS_TRY(solve(inverse, error));
    inverse->norm = sum_sizes(inverse);
    if (inverse->n == 1) {
        return PSPEC_OK;
    }
    take_signs(inverse);
    PS_TRY(climb(inverse, error));
    return try_alternating(inverse, error);
}

pspec_status ps_cholesky_condition(size_t n, const double *matrix, double norm,
                                   const ps_watch *watch, double *condition, ps_error *error) {
    estimate inverse = {.n = n, .matrix = matrix, .watch = watch};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, PS_NEW(&inverse.x, n, "a condition number", error));
    PS_TRY_OUT(status, PS_NEW(&inverse.sign, n, "a condition number", error));
    PS_TRY_OUT(status, estimate_inverse(&inverse, error));
    *condition = norm * inverse.norm;
out:
    free(inverse.x);
    free(inverse.sign);
    return status;
}
