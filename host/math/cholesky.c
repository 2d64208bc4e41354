#include "math/cholesky.h"

#include "base/memory.h"
#include "base/workers.h"

#include <cblas.h>
#include <stdlib.h>

/* LAPACK as OpenBLAS has it: Fortran, with the length of each text behind the arguments. */
void dpotrf_(const char *uplo, const int *n, double *a, const int *lda, int *info, size_t length);
void dpocon_(const char *uplo, const int *n, const double *a, const int *lda, const double *norm,
             double *reciprocal, double *work, int *integers, int *info, size_t length);

/* Rows of a tile: products of this size run at the full speed of one core (measured: 128 is 8 % slower), and 4096 rows
 * still make 120 of them. */
enum { TILE = 256 };
/* Rows and columns of what is updated at a time: products twice as wide copy half as much before they begin (measured by
 * bench_weights cholesky: 5 % of the processor time). */
enum { UPDATE = 512 };

/* One step: the tiles of a column, or those to the right of it. */
typedef struct step {
    size_t n, begin; /* begin: the first row of the diagonal tile */
    double *matrix;
} step;

static size_t count_rows(size_t n, size_t begin, size_t most) {
    return n - begin < most ? n - begin : most;
}

static double *at(const step *of, size_t row, size_t column) {
    return of->matrix + column * of->n + row;
}

/* Tiles below the diagonal one, by its inverse from the right. */
static void do_column(void *payload, unsigned index, unsigned count) {
    const step *const of = payload;
    const int n = (int)of->n;
    size_t i = 0;
    for (size_t row = of->begin + TILE; row < of->n; row += TILE) {
        if (i++ % count == index) {
            cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit,
                        (int)count_rows(of->n, row, TILE), TILE, 1, at(of, of->begin, of->begin), n,
                        at(of, row, of->begin), n);
        }
    }
}

/* Takes the products of the column off the numbers from (row, column) on. */
static void update(const step *of, size_t row, size_t column) {
    const int n = (int)of->n;
    const int rows = (int)count_rows(of->n, row, UPDATE);
    const double *const left = at(of, row, of->begin);
    if (row == column) {
        cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, rows, TILE, -1, left, n, 1,
                    at(of, row, column), n);
    } else {
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, rows, UPDATE, TILE, -1, left, n,
                    at(of, column, of->begin), n, 1, at(of, row, column), n);
    }
}

static void do_rest(void *payload, unsigned index, unsigned count) {
    const step *const of = payload;
    size_t i = 0;
    for (size_t column = of->begin + TILE; column < of->n; column += UPDATE) {
        for (size_t row = column; row < of->n; row += UPDATE) {
            if (i++ % count == index) {
                update(of, row, column);
            }
        }
    }
}

typedef struct sharing {
    void (*task)(void *payload, unsigned index, unsigned count);
    step *of;
    unsigned count;
} sharing;

static void do_share(void *payload, unsigned index) {
    const sharing *const all = payload;
    all->task(all->of, index, all->count);
}

static void share(ps_workers *workers, void (*task)(void *, unsigned, unsigned), step *of) {
    sharing all = {task, of, ps_workers_count(workers)};
    ps_workers_run(workers, do_share, &all);
}

static bool factorize(ps_workers *workers, step *of, size_t *bad) {
    const int n = (int)of->n;
    for (of->begin = 0; of->begin < of->n; of->begin += TILE) {
        const int rows = (int)count_rows(of->n, of->begin, TILE);
        int info = 0;
        dpotrf_("L", &rows, at(of, of->begin, of->begin), &n, &info, 1);
        if (info != 0) {
            *bad = of->begin + (size_t)(info > 0 ? info - 1 : 0);
            return false;
        }
        share(workers, do_column, of);
        share(workers, do_rest, of);
    }
    return true;
}

void ps_cholesky(size_t n, double *matrix, bool *is_definite, size_t *bad) {
    enum { MOST_THREADS = 64, WORTH_THREADS = 512 };
    ps_workers *const workers = n >= WORTH_THREADS ? ps_workers_create(MOST_THREADS) : NULL;
    const int threads = openblas_get_num_threads();
    step of = {.n = n, .matrix = matrix};
    openblas_set_num_threads(1);
    *is_definite = factorize(workers, &of, bad);
    openblas_set_num_threads(threads);
    ps_workers_destroy(workers);
}

void ps_cholesky_solve(size_t n, const double *matrix, double *vector) {
    const int threads = openblas_get_num_threads();
    openblas_set_num_threads(1);
    cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, (int)n, matrix, (int)n,
                vector, 1);
    cblas_dtrsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, (int)n, matrix, (int)n, vector,
                1);
    openblas_set_num_threads(threads);
}

pspec_status ps_cholesky_condition(size_t n, const double *matrix, double norm, double *condition,
                                   ps_error *error) {
    enum { WORK = 3 };
    void *work = NULL;
    void *integers = NULL;
    double reciprocal = 0;
    int info = 0;
    const int size = (int)n;
    pspec_status status = PSPEC_OK;
    const int threads = openblas_get_num_threads();
    PS_TRY_OUT(status, ps_allocate(&work, WORK * n, sizeof(double), "a condition number", error));
    PS_TRY_OUT(status, ps_allocate(&integers, n, sizeof(int), "a condition number", error));
    openblas_set_num_threads(1);
    dpocon_("L", &size, matrix, &size, &norm, &reciprocal, work, integers, &info, 1);
    openblas_set_num_threads(threads);
    *condition = 1 / reciprocal;
out:
    free(work);
    free(integers);
    return status;
}
