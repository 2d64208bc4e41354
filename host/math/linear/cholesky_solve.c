/* Solutions with a Cholesky factor, and the estimate of a condition number that they give. */
#include "math/linear/cholesky.h"

#include "base/memory.h"
#include "base/wide.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Columns taken together, so that the vector is read once for all of them, and numbers side by side. */
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

static pspec_status tell(telling *of, size_t num_columns, ps_error *error) {
    of->done += num_columns;
    of->silent += num_columns * of->n;
    if (of->silent < NUMBERS_AT_A_TIME) {
        return PSPEC_OK;
    }
    of->silent = 0;
    return ps_watch_tell(of->watch, "columns of a solution by the Cholesky factor", of->done,
                         2 * of->n, NULL, error);
}

/* L y = vector: whole groups of columns, and then the rest, one by one. */
static pspec_status solve_forward(telling *of, const double *matrix, double *vector,
                                  ps_error *error) {
    const size_t n = of->n;
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
        PS_TRY(tell(of, end - j, error));
        j = end;
    }
    return PSPEC_OK;
}

/* L^T x = vector, by the same groups from the last one on. */
static pspec_status solve_backward(telling *of, const double *matrix, double *vector,
                                   ps_error *error) {
    const size_t n = of->n;
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
        PS_TRY(tell(of, num, error));
        end = begin;
    }
    return PSPEC_OK;
}

pspec_status ps_cholesky_solve(size_t n, const double *matrix, double *vector,
                               const ps_watch *watch, ps_error *error) {
    telling of = {.watch = watch, .n = n};
    PS_TRY(solve_forward(&of, matrix, vector, error));
    return solve_backward(&of, matrix, vector, error);
}

/* ---- condition ------------------------------------------------------------------------------- */

/* The 1-norm of the inverse from below by N. J. Higham (1988), as LAPACK estimates it: some five solutions. */
typedef struct estimate {
    size_t n;
    const double *matrix;
    const ps_watch *watch;
    double *x;         /* [n] */
    signed char *sign; /* [n]: of the last solution */
    double norm;
} estimate;

static double sum_sizes(const estimate *of) {
    double sum = 0;
    for (size_t i = 0; i < of->n; i++) {
        sum += fabs(of->x[i]);
    }
    return sum;
}

static size_t find_largest(const estimate *of) {
    size_t largest = 0;
    for (size_t i = 1; i < of->n; i++) {
        largest = fabs(of->x[i]) > fabs(of->x[largest]) ? i : largest;
    }
    return largest;
}

/* x becomes its own signs. Returns whether they are those of the last time. */
static bool take_signs(estimate *of) {
    bool are_same = true;
    for (size_t i = 0; i < of->n; i++) {
        const signed char sign = of->x[i] >= 0 ? 1 : -1;
        are_same = are_same && sign == of->sign[i];
        of->sign[i] = sign;
        of->x[i] = sign;
    }
    return are_same;
}

static pspec_status solve(const estimate *of, ps_error *error) {
    return ps_cholesky_solve(of->n, of->matrix, of->x, of->watch, error);
}

/* Goes from a column of the inverse to the one that its signs point to, while they become larger. */
static pspec_status climb(estimate *of, ps_error *error) {
    enum { MOST_STEPS = 4 };
    size_t column = of->n;
    for (int i = 0; i < MOST_STEPS; i++) {
        PS_TRY(solve(of, error));
        const size_t next = find_largest(of);
        if (column < of->n && fabs(of->x[next]) <= fabs(of->x[column])) {
            return PSPEC_OK;
        }
        column = next;
        memset(of->x, 0, of->n * sizeof *of->x);
        of->x[column] = 1;
        PS_TRY(solve(of, error));
        const double norm = sum_sizes(of);
        const bool is_better = norm > of->norm;
        of->norm = fmax(of->norm, norm);
        if (take_signs(of) || !is_better) {
            return PSPEC_OK;
        }
    }
    return PSPEC_OK;
}

/* A vector of alternating signs finds what the climb may have missed. */
static pspec_status try_alternating(estimate *of, ps_error *error) {
    const double steps = of->n > 1 ? (double)(of->n - 1) : 1;
    for (size_t i = 0; i < of->n; i++) {
        of->x[i] = (i % 2 == 0 ? 1 : -1) * (1 + (double)i / steps);
    }
    PS_TRY(solve(of, error));
    of->norm = fmax(of->norm, 2 * sum_sizes(of) / (3 * (double)of->n));
    return PSPEC_OK;
}

static pspec_status estimate_inverse(estimate *of, ps_error *error) {
    for (size_t i = 0; i < of->n; i++) {
        of->x[i] = 1 / (double)of->n;
    }
    PS_TRY(solve(of, error));
    of->norm = sum_sizes(of);
    if (of->n == 1) {
        return PSPEC_OK;
    }
    take_signs(of);
    PS_TRY(climb(of, error));
    return try_alternating(of, error);
}

pspec_status ps_cholesky_condition(size_t n, const double *matrix, double norm,
                                   const ps_watch *watch, double *condition, ps_error *error) {
    void *x = NULL;
    void *sign = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, ps_allocate(&x, n, sizeof(double), "a condition number", error));
    PS_TRY_OUT(status, ps_allocate(&sign, n, 1, "a condition number", error));
    estimate of = {.n = n, .matrix = matrix, .watch = watch, .x = x, .sign = sign};
    PS_TRY_OUT(status, estimate_inverse(&of, error));
    *condition = norm * of.norm;
out:
    free(x);
    free(sign);
    return status;
}
