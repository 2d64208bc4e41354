#include "math/linear/cholesky.h"

#include "base/memory.h"
#include "base/pieces.h"
#include "math/linear/tile_product.h"

#include <math.h>
#include <stdlib.h>

/* Rows of a tile, and columns of a step: ten panels, whose 460 KB stay in the cache of one core
 * while a tile is updated. */
enum { ROWS = PS_TILE_ROWS, COLUMNS = PS_TILE_COLUMNS, PANELS = 10, TILE = PANELS * ROWS };
static const size_t ALIGNMENT = 64; /* of a line of the cache, which is 8 columns of a panel */

/* A step makes TILE columns of the factor, from `begin` on, and takes their products off all that
 * is to the right of them. Its rows lie packed as panels [TILE][ROWS], the first one at row
 * begin. */
typedef struct factor_step {
    size_t n, begin, width; /* width: columns of the step, TILE but for the last */
    size_t num_tiles;       /* of rows below those of the step */
    double *matrix, *panels;
    ps_tile_product take;
} factor_step;

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

static size_t count_tiles(size_t n) {
    return n / TILE + (n % TILE != 0);
}

static double *at(const factor_step *step, size_t row, size_t column) {
    return step->matrix + column * step->n + row;
}

static double *panel_at(const factor_step *step, size_t panel) {
    return step->panels + panel * ROWS * TILE;
}

/* The first of the COLUMNS rows of panels that are the columns from `column` on, counted from
 * begin. */
static const double *rows_at(const factor_step *step, size_t column) {
    return panel_at(step, column / ROWS) + column % ROWS;
}

/* ---- the columns of a step ------------------------------------------------------------------- */

/* Zeros above the diagonal and beyond the matrix. */
static void load_panel(const factor_step *step, size_t panel) {
    double *const packed = panel_at(step, panel);
    const size_t first = panel * ROWS;
    for (size_t k = 0; k < TILE; k++) {
        for (size_t i = 0; i < ROWS; i++) {
            const bool is_there =
                k < step->width && k <= first + i && step->begin + first + i < step->n;
            packed[k * ROWS + i] =
                is_there ? *at(step, step->begin + first + i, step->begin + k) : 0;
        }
    }
}

static void store_panel(const factor_step *step, size_t panel) {
    const double *const packed = panel_at(step, panel);
    const size_t first = panel * ROWS;
    const size_t end = least(ROWS, step->n - step->begin - first);
    for (size_t k = 0; k < step->width; k++) {
        for (size_t i = k > first ? k - first : 0; i < end; i++) {
            *at(step, step->begin + first + i, step->begin + k) = packed[k * ROWS + i];
        }
    }
}

/* Column k of a group by its diagonal entry; the next ones of the group lose their products with
 * it. factors[j]: of the factor's row group + j in this column. Rows of a panel above the diagonal
 * hold nothing that anyone reads. */
static void finish_column(double *columns, size_t k, const double *factors) {
    double *const column = columns + k * ROWS;
    const double pivot = factors[k];
    for (size_t i = 0; i < ROWS; i++) {
        column[i] /= pivot;
    }
    for (size_t j = k + 1; j < COLUMNS; j++) {
        const double factor = factors[j];
        for (size_t i = 0; i < ROWS; i++) {
            columns[j * ROWS + i] -= column[i] * factor;
        }
    }
}

/* Columns group .. group + COLUMNS - 1 of a panel whose rows are all below them. */
static void solve_group(const factor_step *step, size_t panel, size_t group) {
    double *const rows = panel_at(step, panel);
    double *const columns = rows + group * ROWS;
    step->take(group, rows, rows_at(step, group), columns, ROWS);
    for (size_t k = 0; k < COLUMNS && group + k < step->width; k++) {
        finish_column(columns, k, rows_at(step, group) + (group + k) * ROWS);
    }
}

/* The same where the rows of the columns are among those of the panel. False at a pivot that is not
 * above 0. */
static bool factorize_group(const factor_step *step, size_t panel, size_t group, size_t *bad) {
    double *const rows = panel_at(step, panel);
    double *const columns = rows + group * ROWS;
    step->take(group, rows, rows_at(step, group), columns, ROWS);
    for (size_t k = 0; k < COLUMNS && group + k < step->width; k++) {
        double *const factors = columns + k * ROWS + group % ROWS;
        const double pivot = factors[k];
        if (!(pivot > 0) || isinf(pivot)) {
            *bad = step->begin + group + k;
            return false;
        }
        factors[k] = sqrt(pivot);
        finish_column(columns, k, factors);
        factors[k] = sqrt(pivot); /* it was divided by itself */
    }
    return true;
}

static bool factorize_tile(const factor_step *step, size_t *bad) {
    for (size_t panel = 0; panel * ROWS < step->width; panel++) {
        load_panel(step, panel);
        for (size_t group = 0; group < panel * ROWS; group += COLUMNS) {
            solve_group(step, panel, group);
        }
        const size_t end = least(step->width, (panel + 1) * ROWS);
        for (size_t group = panel * ROWS; group < end; group += COLUMNS) {
            if (!factorize_group(step, panel, group, bad)) {
                return false;
            }
        }
        store_panel(step, panel);
    }
    return true;
}

/* A tile of the rows below. */
static void solve_tile(void *payload, size_t i) {
    const factor_step *const step = payload;
    const size_t end = (i + 2) * PANELS;
    for (size_t panel = (i + 1) * PANELS; panel < end && step->begin + panel * ROWS < step->n;
         panel++) {
        load_panel(step, panel);
        for (size_t group = 0; group < step->width; group += COLUMNS) {
            solve_group(step, panel, group);
        }
        store_panel(step, panel);
    }
}

/* ---- what is to the right of them ------------------------------------------------------------ */

/* Rows of a panel by COLUMNS columns, both counted from begin, where they meet the diagonal or the
 * end of the matrix. */
static void update_edge(const factor_step *step, size_t panel, size_t column) {
    double sums[COLUMNS * ROWS] = {0};
    step->take(TILE, panel_at(step, panel), rows_at(step, column), sums, ROWS);
    for (size_t j = 0; j < COLUMNS && step->begin + column + j < step->n; j++) {
        for (size_t i = 0; i < ROWS; i++) {
            const size_t row = panel * ROWS + i;
            if (row >= column + j && step->begin + row < step->n) {
                *at(step, step->begin + row, step->begin + column + j) += sums[j * ROWS + i];
            }
        }
    }
}

static void update_columns(const factor_step *step, size_t column, size_t first, size_t end) {
    for (size_t panel = first; panel < end && step->begin + panel * ROWS < step->n; panel++) {
        const size_t row = panel * ROWS;
        if (row + ROWS <= column) {
            continue; /* above the diagonal */
        }
        if (row + 1 >= column + COLUMNS && step->begin + row + ROWS <= step->n) {
            step->take(TILE, panel_at(step, panel), rows_at(step, column),
                       at(step, step->begin + row, step->begin + column), step->n);
        } else {
            update_edge(step, panel, column);
        }
    }
}

/* Tile i of the lower triangle, counted down one column of tiles after the other. */
static void update_tile(void *payload, size_t i) {
    const factor_step *const step = payload;
    size_t left = 0;
    for (; i >= step->num_tiles - left; left++) {
        i -= step->num_tiles - left;
    }
    const size_t first = (left + 1 + i) * PANELS;
    const size_t end = least((left + 2) * TILE, step->n - step->begin);
    for (size_t column = (left + 1) * TILE; column < end; column += COLUMNS) {
        update_columns(step, column, first, first + PANELS);
    }
}

/* ---- the whole ------------------------------------------------------------------------------- */

static size_t count_updates(size_t num_tiles) {
    return num_tiles * (num_tiles + 1) / 2;
}

static uint64_t count_all(size_t n) {
    uint64_t total = 0;
    for (size_t below = 0; below < count_tiles(n); below++) {
        total += 1 + below + count_updates(below);
    }
    return total;
}

static pspec_status factorize(factor_step *step, ps_pieces *pieces, bool *is_definite, size_t *bad,
                              ps_error *error) {
    *is_definite = true;
    for (step->begin = 0; step->begin < step->n; step->begin += TILE) {
        step->width = least(TILE, step->n - step->begin);
        step->num_tiles = count_tiles(step->n - step->begin) - 1;
        if (!factorize_tile(step, bad)) {
            *is_definite = false;
            return PSPEC_OK;
        }
        pieces->done++;
        PS_TRY(ps_pieces_do(pieces, step->num_tiles, solve_tile, step, error));
        PS_TRY(ps_pieces_do(pieces, count_updates(step->num_tiles), update_tile, step, error));
    }
    return PSPEC_OK;
}

uint64_t ps_cholesky_bytes(size_t n) {
    return (uint64_t)count_tiles(n) * TILE * TILE * sizeof(double) + ALIGNMENT;
}

pspec_status ps_cholesky(size_t n, double *matrix, unsigned most_threads, const ps_watch *watch,
                         bool *is_definite, size_t *bad, ps_error *error) {
    enum { MOST_THREADS = 64, WORTH_THREADS = 2 * TILE };
    /* A piece has 28 million operations: 10 ms where vectors have 512 bits, 0.2 s with those of
     * 128. */
    enum { TILES_AT_A_TIME = 16 };
    void *memory = NULL;
    PS_TRY(ps_allocate(&memory, ps_cholesky_bytes(n), 1, "columns of a Cholesky factor", error));
    const size_t behind = (uintptr_t)memory % ALIGNMENT;
    ps_workers *const workers =
        n >= WORTH_THREADS ? ps_workers_create(most_threads > 0 ? most_threads : MOST_THREADS)
                           : NULL;
    factor_step step = {
        .n = n,
        .matrix = matrix,
        .panels = (double *)(void *)((char *)memory + (behind > 0 ? ALIGNMENT - behind : 0)),
        .take = ps_tile_product_best()};
    ps_pieces pieces = {.workers = workers,
                        .each = TILES_AT_A_TIME,
                        .watch = watch,
                        .phase = "tiles of the Cholesky factor",
                        .total = count_all(n)};
    const pspec_status status = factorize(&step, &pieces, is_definite, bad, error);
    ps_workers_destroy(workers);
    free(memory);
    return status;
}
