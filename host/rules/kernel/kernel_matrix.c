/* The kernel matrix in memory: filling it, its norm, and residuals. */
#include "rules/kernel/kernel_private.h"

#include "base/pieces.h"
#include "base/wide.h"
#include "math/sobolev.h"

#include <math.h>

/* ---- filling ------------------------------------------------------------------------------- */

/* A tile is all distances of COLUMNS points from a chunk of points. It is written to both
 * triangles, where either way runs along memory: one number at a time into columns 8 n bytes apart
 * took five times as long. */
enum { ROWS = PS_SOBOLEV_CHUNK, COLUMNS = 32 };

static size_t count_of(size_t n, size_t begin, size_t most) {
    return n - begin < most ? n - begin : most;
}

/* The tile of a chunk of rows and of columns that are not beyond it; entries of the chunk with
 * itself come twice. */
static void fill_tile(const ps_kernel_system *system, const ps_sobolev_chunk *chunk, size_t row,
                      size_t column) {
    const size_t n = system->num;
    const size_t num_columns = count_of(n, column, COLUMNS);
    double tile[COLUMNS][ROWS];
    for (size_t j = 0; j < num_columns; j++) {
        ps_sobolev_chunk_distances(system->smoothness, system->points + 3 * (column + j), chunk,
                                   tile[j]);
        double *const lower = system->matrix + (column + j) * n + row;
        for (size_t i = 0; i < chunk->num; i++) {
            tile[j][i] = system->constant - tile[j][i];
            lower[i] = tile[j][i];
        }
    }
    for (size_t i = 0; i < chunk->num; i++) {
        double *const upper = system->matrix + (row + i) * n + column;
        for (size_t j = 0; j < num_columns; j++) {
            upper[j] = tile[j][i];
        }
    }
}

/* Chunks of rows dealt out from the last one on, which has the most columns; tiles of several rows
 * never meet. */
static void fill_rows(void *payload, size_t i) {
    const ps_kernel_system *const system = payload;
    const size_t num_chunks = (system->num + ROWS - 1) / ROWS;
    const size_t row = (num_chunks - 1 - i) * ROWS;
    ps_sobolev_chunk chunk;
    ps_sobolev_chunk_fill(&chunk, count_of(system->num, row, ROWS), system->points + 3 * row, NULL);
    for (size_t column = 0; column < row + chunk.num; column += COLUMNS) {
        fill_tile(system, &chunk, row, column);
    }
}

pspec_status ps_kernel_matrix_fill(ps_kernel_system *system, ps_error *error) {
    return ps_pieces_share(system->options.watch, "blocks of rows of the kernel matrix",
                           system->num * system->num, (system->num + ROWS - 1) / ROWS, fill_rows,
                           system, error);
}

/* ---- norm ---------------------------------------------------------------------------------- */

enum { LANES = 8, BLOCK = 64 };

/* No entry is below 0: c = 2^(2s-2) (2/s) is more than the largest distance. */
static double sum_column(size_t num, const double *column) {
    double sums[LANES] = {0};
    size_t i = 0;
    for (; i + LANES <= num; i += LANES) {
        for (size_t lane = 0; lane < LANES; lane++) {
            sums[lane] += column[i + lane];
        }
    }
    double sum = 0;
    for (; i < num; i++) {
        sum += column[i];
    }
    for (size_t lane = 0; lane < LANES; lane++) {
        sum += sums[lane];
    }
    return sum;
}

/* rows: of sums of columns. */
static void sum_columns(void *payload, size_t block) {
    const ps_kernel_system *const system = payload;
    const size_t n = system->num;
    const size_t end = block * BLOCK + count_of(n, block * BLOCK, BLOCK);
    for (size_t j = block * BLOCK; j < end; j++) {
        system->rows[j] = sum_column(n, system->matrix + j * n);
    }
}

static size_t count_blocks(const ps_kernel_system *system) {
    return (system->num + BLOCK - 1) / BLOCK;
}

pspec_status ps_kernel_matrix_norm(ps_kernel_system *system, ps_error *error) {
    PS_TRY(ps_pieces_share(system->options.watch, "blocks of columns of the kernel matrix's norm",
                           system->num * system->num, count_blocks(system), sum_columns, system,
                           error));
    system->norm = 0;
    for (size_t j = 0; j < system->num; j++) {
        system->norm = fmax(system->norm, system->rows[j]);
    }
    return PSPEC_OK;
}

/* ---- residuals ----------------------------------------------------------------------------- */

/* Sums of K_ij x_j to some 70 bits without a rounding that matters: K = k + K', k a multiple of
 * 2^-18, and x = h + l, h a multiple of 2^-20 of a power of two above max |x|. Products k h are
 * whole numbers of 40 bits: MOST_EXACT of them add up without any rounding, and what is left, k l +
 * K' x, is a millionth of it. All of it in vectors, which long double is not.
 */
enum { MOST_EXACT = 4096 };
static const double ROUND_ENTRY = 0x1.8p34;  /* 1.5 2^52 2^-18 */
static const double ROUND_NUMBER = 0x1.8p32; /* 1.5 2^52 2^-20 */

typedef struct residual_work {
    const ps_kernel_system *system;
    const double *right, *x, *high, *low;
    double *residual;
} residual_work;

static void split_numbers(size_t num, const double *x, double *high, double *low) {
    double largest = 0;
    int exponent = 0;
    for (size_t i = 0; i < num; i++) {
        largest = fmax(largest, fabs(x[i]));
    }
    frexp(largest, &exponent);
    const double round = ldexp(ROUND_NUMBER, exponent);
    for (size_t i = 0; i < num; i++) {
        high[i] = (x[i] + round) - round;
        low[i] = x[i] - high[i];
    }
}

/* Whole columns for a block of rows: exact and rest are added to. */
PS_WIDE_BODY(size_t, add_columns,
             (size_t num, size_t stride, const double *columns, const double *high,
              const double *low, double *exact, double *rest)) {
    double exact_sums[BLOCK] = {0}; /* the function's own: they overlap nothing */
    double rest_sums[BLOCK] = {0};
    for (size_t j = 0; j < num; j++) {
        const double *const column = columns + j * stride;
        const double h = high[j];
        const double l = low[j];
        const double x = h + l;
        for (size_t i = 0; i < BLOCK; i++) {
            const double k = (column[i] + ROUND_ENTRY) - ROUND_ENTRY;
            exact_sums[i] += k * h;
            rest_sums[i] += k * l + (column[i] - k) * x;
        }
    }
    for (size_t i = 0; i < BLOCK; i++) {
        exact[i] = exact_sums[i];
        rest[i] = rest_sums[i];
    }
    return num;
}

PS_WIDE(size_t, add_columns,
        (size_t num, size_t stride, const double *columns, const double *high, const double *low,
         double *exact, double *rest),
        (num, stride, columns, high, low, exact, rest))

/* One column, or a part of it, times numbers: num is a multiple of LANES. */
PS_WIDE_BODY(size_t, dot_lanes,
             (size_t num, const double *column, const double *high, const double *low,
              double *exact, double *rest)) {
    double exact_sums[LANES] = {0};
    double rest_sums[LANES] = {0};
    for (size_t j = 0; j < num; j += LANES) {
        for (size_t i = 0; i < LANES; i++) {
            const double k = (column[j + i] + ROUND_ENTRY) - ROUND_ENTRY;
            exact_sums[i] += k * high[j + i];
            rest_sums[i] += k * low[j + i] + (column[j + i] - k) * (high[j + i] + low[j + i]);
        }
    }
    for (size_t i = 0; i < LANES; i++) {
        exact[i] = exact_sums[i];
        rest[i] = rest_sums[i];
    }
    return num;
}

PS_WIDE(size_t, dot_lanes,
        (size_t num, const double *column, const double *high, const double *low, double *exact,
         double *rest),
        (num, column, high, low, exact, rest))

static long double dot_column(const residual_work *work, size_t num, const double *column) {
    const size_t whole = num - num % LANES;
    long double sum = 0;
    for (size_t begin = 0; begin < whole; begin += MOST_EXACT) {
        double exact[LANES];
        double rest[LANES];
        dot_lanes(count_of(whole, begin, MOST_EXACT), column + begin, work->high + begin,
                  work->low + begin, exact, rest);
        for (size_t i = 0; i < LANES; i++) {
            sum += (long double)exact[i] + rest[i];
        }
    }
    for (size_t j = whole; j < num; j++) {
        sum += (long double)column[j] * work->x[j];
    }
    return sum;
}

/* What later columns than those of the block have for its rows. */
static void take_columns(const residual_work *work, size_t begin, long double *sums) {
    const size_t n = work->system->num;
    for (size_t column = begin + BLOCK; column < n; column += MOST_EXACT) {
        double exact[BLOCK];
        double rest[BLOCK];
        add_columns(count_of(n, column, MOST_EXACT), n, work->system->matrix + column * n + begin,
                    work->high + column, work->low + column, exact, rest);
        for (size_t i = 0; i < BLOCK; i++) {
            sums[i] -= (long double)exact[i] + rest[i];
        }
    }
}

/* K is in the strict upper triangle only: its column i is the part of row i before the diagonal,
 * and what is behind it comes from later columns. */
static void residual_of_block(void *payload, size_t block) {
    const residual_work *const work = payload;
    const ps_kernel_system *const system = work->system;
    const size_t n = system->num;
    const size_t begin = block * BLOCK;
    const size_t num = count_of(n, begin, BLOCK);
    const double *const matrix = system->matrix;
    long double sums[BLOCK] = {0};
    for (size_t i = 0; i < num; i++) {
        const size_t row = begin + i;
        sums[i] = work->right[row] - (long double)system->constant * work->x[row] -
                  dot_column(work, row, matrix + row * n);
        for (size_t column = row + 1; column < begin + num; column++) {
            sums[i] -= (long double)matrix[column * n + row] * work->x[column];
        }
    }
    take_columns(work, begin, sums);
    for (size_t i = 0; i < num; i++) {
        work->residual[begin + i] = (double)sums[i];
    }
}

pspec_status ps_kernel_matrix_residual(ps_kernel_system *system, const double *right,
                                       const double *x, double *residual, ps_error *error) {
    const size_t n = system->num;
    double *const high = system->rows + 2 * n;
    double *const low = system->rows + 3 * n;
    residual_work work = {system, right, x, high, low, residual};
    split_numbers(n, x, high, low);
    return ps_pieces_share(system->options.watch, "blocks of rows of a residual", n * n,
                           count_blocks(system), residual_of_block, &work, error);
}
