/* Cholesky factors: against the definition, the same bits on any number of threads and with any
 * vectors, what is not definite, condition numbers, and how soon an interrupt is heard. */
#include "harness.h"

#include "base/clock.h"
#include "math/linear/cholesky.h"
#include "math/linear/tile_product.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Numbers in (-1, 1), the same every time. */
static double next_number(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(int64_t)*state * 0x1p-63;
}

/* 1 on the diagonal, less and less beside it, and a little of everything; NAN where nothing may be
 * read. */
static double *make_matrix(size_t n) {
    double *const matrix = calloc(n * n, sizeof *matrix);
    uint64_t seed = n;
    assert_non_null(matrix);
    for (size_t j = 0; j < n; j++) {
        for (size_t i = 0; i < n; i++) {
            const double near = 0.3 * exp(-(double)(i - j)) + 1e-3 * next_number(&seed) / (double)n;
            matrix[j * n + i] = i < j ? NAN : i == j ? 1 : near;
        }
    }
    return matrix;
}

static double *copy_of(size_t n, const double *matrix) {
    double *const copy = calloc(n * n, sizeof *copy);
    assert_non_null(copy);
    memcpy(copy, matrix, n * n * sizeof *copy);
    return copy;
}

static void factorize(size_t n, double *matrix, unsigned most_threads) {
    bool is_definite = false;
    size_t bad = 0;
    assert_ok(ps_cholesky(n, matrix, most_threads, NULL, &is_definite, &bad, error));
    assert_true(is_definite);
}

static double entry_of_product(size_t n, const double *factor, size_t i, size_t j) {
    double sum = 0;
    for (size_t k = 0; k <= j; k++) {
        sum += factor[k * n + i] * factor[k * n + j];
    }
    return sum;
}

static const double ROUNDINGS = 8 * 0x1p-52; /* of sums whose terms are below 1 */

/* Sizes on both sides of panels, tiles and two tiles. */
static void definition(void **state) {
    static const size_t sizes[] = {1, 2, 7, 8, 23, 24, 25, 239, 240, 241, 250, 263, 480, 481, 741};
    (void)state;
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        const size_t n = sizes[s];
        double *const matrix = make_matrix(n);
        double *const factor = copy_of(n, matrix);
        factorize(n, factor, 0);
        for (size_t j = 0; j < n; j++) {
            for (size_t i = 0; i < n; i++) {
                if (i < j) {
                    assert_true(isnan(factor[j * n + i]));
                } else {
                    assert_true(fabs(entry_of_product(n, factor, i, j) - matrix[j * n + i]) <=
                                ROUNDINGS);
                }
            }
        }
        free(matrix);
        free(factor);
    }
}

static void solutions(void **state) {
    static const size_t sizes[] = {1, 3, 4, 5, 29, 246, 500};
    (void)state;
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        const size_t n = sizes[s];
        double *const matrix = make_matrix(n);
        double *const factor = copy_of(n, matrix);
        double *const x = calloc(n, sizeof *x);
        double *const right = calloc(n, sizeof *right);
        for (size_t j = 0; j < n; j++) {
            for (size_t i = 0; i < n; i++) {
                right[i] += (i < j ? matrix[i * n + j] : matrix[j * n + i]) * (double)(j % 5);
            }
        }
        factorize(n, factor, 0);
        memcpy(x, right, n * sizeof *x);
        assert_ok(ps_cholesky_solve(n, factor, x, NULL, error));
        for (size_t i = 0; i < n; i++) {
            assert_true(fabs(x[i] - (double)(i % 5)) <= 1e-13);
        }
        free(matrix), free(factor), free(x), free(right);
    }
}

/* Five tiles: shared by one thread, and by as many as there are. */
static void same_bits_on_threads(void **state) {
    enum { NUM = 1111, MOST = 64 };
    double *const alone = make_matrix(NUM);
    double *const shared = copy_of(NUM, alone);
    (void)state;
    factorize(NUM, alone, 1);
    factorize(NUM, shared, MOST);
    assert_memory_equal(alone, shared, NUM * NUM * sizeof *alone);
    free(alone);
    free(shared);
}

/* Vectors of 512 and 256 bits make the same; what any processor can do differs by roundings at
 * most. */
static void products_agree(void **state) {
    enum { NUM = 37, STRIDE = 29, SIZE = NUM * PS_TILE_ROWS, OUT = PS_TILE_COLUMNS * STRIDE };
    double left[SIZE];
    double right[SIZE];
    double first[OUT];
    ps_tile_product products[PS_TILE_PRODUCTS];
    uint64_t seed = 3;
    (void)state;
    for (size_t i = 0; i < SIZE; i++) {
        left[i] = next_number(&seed);
        right[i] = next_number(&seed);
    }
    const size_t num = ps_tile_products(products);
    print_message("%zu ways to take products\n", num);
    for (size_t p = 0; p < num; p++) {
        double to[OUT];
        for (size_t i = 0; i < OUT; i++) {
            to[i] = (double)i;
        }
        products[p](NUM, left, right, to, STRIDE);
        for (size_t i = 0; i < OUT; i++) {
            double sum = i % STRIDE < PS_TILE_ROWS ? 0 : NAN;
            for (size_t k = 0; k < NUM && !isnan(sum); k++) {
                sum += left[k * PS_TILE_ROWS + i % STRIDE] * right[k * PS_TILE_ROWS + i / STRIDE];
            }
            assert_true(isnan(sum) ? to[i] == (double)i : fabs(to[i] - ((double)i - sum)) <= 1e-12);
        }
        if (p == 0) {
            memcpy(first, to, sizeof first);
        } else if (p + 1 < num) {
            assert_memory_equal(first, to, sizeof first);
        }
    }
}

/* The first row that makes it so is named, in the first tile and later ones. */
static void not_definite(void **state) {
    static const size_t rows[] = {0, 30, 239, 240, 500, 599};
    enum { NUM = 600 };
    (void)state;
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
        double *const matrix = make_matrix(NUM);
        bool is_definite = true;
        size_t bad = 0;
        matrix[rows[r] * NUM + rows[r]] = r % 2 == 0 ? -1 : 0;
        assert_ok(ps_cholesky(NUM, matrix, 0, NULL, &is_definite, &bad, error));
        assert_false(is_definite);
        assert_int_equal(bad, rows[r]);
        free(matrix);
    }
}

/* Second differences, n = 600: the inverse is known, min(i, j) (n + 1 - max(i, j)) / (n + 1), and
 * its 1-norm is that of a column in the middle, (n + 1)^2 / 8 about; the matrix's is 4. */
static void condition_of_differences(void **state) {
    enum { NUM = 601 };
    double *const matrix = calloc((size_t)NUM * NUM, sizeof *matrix);
    double condition = 0;
    (void)state;
    assert_non_null(matrix);
    for (size_t j = 0; j < NUM; j++) {
        matrix[j * NUM + j] = 2;
        if (j + 1 < NUM) {
            matrix[j * NUM + j + 1] = -1;
        }
    }
    factorize(NUM, matrix, 0);
    assert_ok(ps_cholesky_condition(NUM, matrix, 4, NULL, &condition, error));
    const double exact = 4 * (NUM + 1.0) * (NUM + 1.0) / 8;
    print_message("condition %.9g of %.9g\n", condition, exact);
    assert_true(fabs(condition / exact - 1) <= 1e-9);
    free(matrix);
}

typedef struct listener {
    double last, longest; /* seconds between two tellings */
    uint64_t calls, until, done, total;
} listener;

static int listen(const ps_watch_report *report, void *payload) {
    listener *const self = payload;
    const double now = ps_clock_seconds();
    assert_true(self->calls == 0 || report->done >= self->done);
    assert_true(report->done <= report->total);
    self->longest = self->calls > 0 ? fmax(self->longest, now - self->last) : 0;
    self->last = now;
    self->done = report->done;
    self->total = report->total;
    return ++self->calls > self->until;
}

/* It is told often, however large the first steps are, and stops at once when it is asked to. */
static void told_and_stopped(void **state) {
    enum { NUM = 3000, UNTIL = 20 };
    double *const matrix = make_matrix(NUM);
    double *const again = copy_of(NUM, matrix);
    double *const x = calloc(NUM, sizeof *x);
    listener whole = {.until = UINT64_MAX};
    listener some = {.until = UNTIL};
    bool is_definite = false;
    size_t bad = 0;
    ps_error refusal = {0};
    const ps_watch watch = {listen, &whole};
    const ps_watch stopping = {listen, &some};
    (void)state;
    assert_ok(ps_cholesky(NUM, matrix, 0, &watch, &is_definite, &bad, error));
    print_message("%llu tellings, at most %.3g s apart\n", (unsigned long long)whole.calls,
                  whole.longest);
    assert_true(whole.calls >= 25);
    assert_int_equal(ps_cholesky(NUM, again, 0, &stopping, &is_definite, &bad, &refusal),
                     PSPEC_ERROR_CANCELLED);
    assert_int_equal(some.calls, UNTIL + 1);
    assert_non_null(strstr(refusal.message, "interrupted after "));
    assert_non_null(strstr(refusal.message, " tiles of the Cholesky factor"));
    some = (listener){.until = 0};
    assert_int_equal(ps_cholesky_solve(NUM, matrix, x, &stopping, &refusal), PSPEC_ERROR_CANCELLED);
    assert_int_equal(some.calls, 1);
    free(matrix), free(again), free(x);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(definition),           cmocka_unit_test(solutions),
        cmocka_unit_test(same_bits_on_threads), cmocka_unit_test(products_agree),
        cmocka_unit_test(not_definite),         cmocka_unit_test(condition_of_differences),
        cmocka_unit_test(told_and_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
