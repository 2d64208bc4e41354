#include "spectra/sums.h"

#include "accumulate/blocks.h"
#include "base/memory.h"

#define PRECISION 64
#include "shared/pair.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void ps_sums_add(ps_sums *sums, double x) {
    pair_add(&sums->sum, &sums->sum_low, x);
    pair_add_square(&sums->square, &sums->square_low, x);
}

/* (high, low) of the exact product of two doubles. */
static void multiply(double a, double b, double *high, double *low) {
    *high = a * b;
    *low = fma(a, b, -*high);
}

/* (*high, *low) += factor (high2, low2) */
static void add_scaled(double *high, double *low, double high2, double low2, double factor) {
    double product = 0;
    double product_low = 0;
    multiply(high2, factor, &product, &product_low);
    pair_add(high, low, product);
    *low += product_low + low2 * factor;
}

void ps_sums_merge(ps_sums *sums, const ps_sums *other, double factor) {
    double square = 0;
    double square_low = 0;
    add_scaled(&sums->sum, &sums->sum_low, other->sum, other->sum_low, factor);
    multiply(factor, factor, &square, &square_low);
    add_scaled(&sums->square, &sums->square_low, other->square, other->square_low, square);
    sums->square_low += other->square * square_low;
}

/* Sums of squares of 128 equal numbers are off by up to 2^-38.8 in pairs of single precision
 * (measured, 400000 numbers); what differs by less, 2e-6 of the mean, is taken for
 * equal, as ps_sums_finish does in double precision. */
void ps_sums_drop_rounding(ps_sums *sums, uint64_t count) {
    const double rounding = 0x1p-38;
    const double n = (double)count;
    const double sum = sums->sum + sums->sum_low;
    const double square = sums->square + sums->square_low;
    if (fabs(n * square - sum * sum) <= rounding * sum * sum) {
        const double product = sum * sum;
        sums->square = product / n;
        sums->square_low = (fma(-sums->square, n, product) + fma(sum, sum, -product)) / n;
    }
}

/* The same sum with a low part below the last digit of the high one. */
static void normalize(double *high, double *low) {
    const double sum = *high + *low;
    *low -= sum - *high;
    *high = sum;
}

void ps_sums_finish(const ps_sums *sums, uint64_t count, double *mean, double *standard_error) {
    const double n = (double)count;
    ps_sums whole = *sums;
    normalize(&whole.sum, &whole.sum_low);
    normalize(&whole.square, &whole.square_low);
    *mean = whole.sum / n;
    *standard_error = NAN;
    if (count < 2) {
        return;
    }
    /* n sum x^2 - (sum x)^2 in pairs: about 100 bits, so the difference keeps its digits. */
    double left = 0;
    double left_low = 0;
    double right = 0;
    double right_low = 0;
    multiply(n, whole.square, &left, &left_low);
    left_low += n * whole.square_low;
    multiply(whole.sum, whole.sum, &right, &right_low);
    right_low += 2 * whole.sum * whole.sum_low;
    const double difference = (left - right) + (left_low - right_low);
    /* n equal numbers leave at most 0.1 n^2 eps^2 of rounding here (measured, n = 2 .. 1e7). */
    const double rounding = n * n * DBL_EPSILON * DBL_EPSILON / 4 * left;
    /* written so that nan stays nan */
    const double variance = difference <= rounding ? 0 : difference / n / (n - 1);
    *standard_error = sqrt(variance / n);
}

/* ---- sums over realizations ---------------------------------------------------------------- */

static pspec_status allocate(ps_running_sums *self, unsigned levels, ps_error *error) {
    ps_sums *rows = NULL;
    PS_TRY(PS_NEW(&rows, (1 + (size_t)levels) * self->num, "sums over realizations", error));
    if (self->rows != NULL && self->num > 0) {
        memcpy(rows, self->rows, (1 + (size_t)self->levels) * self->num * sizeof *rows);
    }
    free(self->rows);
    self->rows = rows;
    self->levels = levels;
    return PSPEC_OK;
}

pspec_status ps_running_sums_create(ps_running_sums *out, size_t num, uint64_t expected,
                                    bool mean_only, ps_error *error) {
    *out = (ps_running_sums){.num = num, .mean_only = mean_only};
    return allocate(out, sum_levels(expected), error);
}

void ps_running_sums_free(ps_running_sums *sums) {
    free(sums->rows);
    sums->rows = NULL;
}

pspec_status ps_running_sums_reserve(ps_running_sums *sums, uint64_t count, ps_error *error) {
    const unsigned levels = sum_levels(count);
    return levels > sums->levels ? allocate(sums, levels, error) : PSPEC_OK;
}

static ps_sums no_sums(const ps_running_sums *sums) {
    return sums->mean_only ? PS_SUMS_MEAN_ONLY : (ps_sums){0};
}

/* Carries whole block number `block` of number i up. */
static void carry(ps_running_sums *self, uint64_t block, size_t i) {
    ps_sums *row = &self->rows[i];
    ps_sums merged = *row;
    for (row += self->num; block & 1; block /= 2, row += self->num) {
        ps_sums_merge(&merged, row, 1);
    }
    *row = merged;
}

void ps_running_sums_add(ps_running_sums *sums, const double *values, const uint32_t *places) {
    const bool is_first = sums->count % SUM_BLOCK == 0;
    const bool is_last = (sums->count + 1) % SUM_BLOCK == 0;
    for (size_t i = 0; i < sums->num; i++) {
        const double value = values[places != NULL ? places[i] : i];
        ps_sums *open = &sums->rows[i];
        *open = is_first ? no_sums(sums) : *open;
        if (sums->mean_only) {
            pair_add(&open->sum, &open->sum_low, value);
        } else {
            ps_sums_add(open, value);
        }
        if (is_last) {
            carry(sums, sums->count / SUM_BLOCK, i);
        }
    }
    sums->count++;
}

bool ps_running_has_row(uint64_t count, unsigned row) {
    return row == 0 ? count % SUM_BLOCK > 0 : count / SUM_BLOCK >> (row - 1) & 1;
}

ps_sums ps_running_sums_get(const ps_running_sums *sums, size_t i) {
    ps_sums all = no_sums(sums);
    for (unsigned row = 0; row <= sums->levels; row++) {
        if (ps_running_has_row(sums->count, row)) {
            ps_sums_merge(&all, &sums->rows[row * sums->num + i], 1);
        }
    }
    return all;
}

pspec_status ps_running_sums_walk(ps_running_sums *sums, ps_snapshot *snapshot, const char *name,
                                  ps_error *error) {
    enum { NUMBERS = sizeof(ps_sums) / sizeof(double) };
    PS_TRY(ps_snapshot_counts(snapshot, name, &sums->count, 1, error));
    PS_TRY(ps_running_sums_reserve(sums, sums->count, error));
    for (unsigned row = 0; row <= sums->levels; row++) {
        char of_row[64];
        snprintf(of_row, sizeof of_row, "%s_%u", name, row);
        if (ps_running_has_row(sums->count, row)) {
            PS_TRY(ps_snapshot_doubles(snapshot, of_row, (double *)(sums->rows + row * sums->num),
                                       NUMBERS * sums->num, error));
        }
    }
    return PSPEC_OK;
}

/* ---- blocks -------------------------------------------------------------------------------- */

static void halve_number(ps_block_sums *blocks) {
    const size_t half = PS_MOST_BLOCKS / 2;
    for (size_t i = 0; i < half; i++) {
        blocks->sums[i] = blocks->sums[2 * i] + blocks->sums[2 * i + 1];
    }
    for (size_t i = half; i < PS_MOST_BLOCKS; i++) {
        blocks->sums[i] = 0;
    }
    blocks->length *= 2;
}

void ps_block_sums_add(ps_block_sums *blocks, double x) {
    blocks->length = blocks->length > 0 ? blocks->length : 1;
    if (blocks->count == blocks->length * PS_MOST_BLOCKS) {
        halve_number(blocks);
    }
    blocks->sums[blocks->count / blocks->length] += x;
    blocks->count++;
}

size_t ps_block_sums_deviations(const ps_block_sums *blocks, double *out) {
    const double count = (double)blocks->count;
    const size_t num =
        blocks->count > blocks->length ? (size_t)((blocks->count - 1) / blocks->length + 1) : 0;
    long double sum = 0;
    for (size_t i = 0; i < num; i++) {
        sum += blocks->sums[i];
    }
    for (size_t i = 0; i < PS_MOST_BLOCKS; i++) {
        const double last = count - (double)(blocks->length * (num - 1));
        const double length = i + 1 < num ? (double)blocks->length : last;
        const double off = i < num ? blocks->sums[i] - (double)sum * length / count : 0;
        out[i] = num > 0 ? off / count * sqrt((double)num / ((double)num - 1)) : 0;
    }
    return num;
}

pspec_status ps_block_sums_walk(ps_block_sums *blocks, ps_snapshot *snapshot, const char *name,
                                ps_error *error) {
    char of_sums[64];
    uint64_t counts[] = {blocks->count, blocks->length};
    PS_TRY(ps_snapshot_counts(snapshot, name, counts, 2, error));
    snprintf(of_sums, sizeof of_sums, "%s_sums", name);
    blocks->count = counts[0];
    blocks->length = counts[1];
    return ps_snapshot_doubles(snapshot, of_sums, blocks->sums, PS_MOST_BLOCKS, error);
}
