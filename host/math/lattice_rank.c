#include "math/lattice_rank.h"

#include "base/memory.h"
#include "math/pi.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

ps_lattice_bounds ps_lattice_estimate(unsigned dimension, int64_t max_norm2) {
    const double half_dimension = dimension / 2.0;
    const double unit_ball = pow(PS_PI, half_dimension) / tgamma(half_dimension + 1);
    const double radius = sqrt((double)max_norm2);
    const double half_diagonal = sqrt((double)dimension) / 2;
    return (ps_lattice_bounds){unit_ball * pow(fmax(radius - half_diagonal, 0), dimension),
                               unit_ball * pow(radius + half_diagonal, dimension)};
}

/* The last entry of the convolution below, which is the largest; false when it does not fit. */
static bool largest_fits(const uint64_t *in, int64_t max_norm2) {
    uint64_t sum = in[max_norm2];
    for (int64_t x = 1; x * x <= max_norm2; x++) {
        const uint64_t term = in[max_norm2 - x * x];
        if (term > UINT64_MAX / 2 || sum > UINT64_MAX - 2 * term) {
            return false;
        }
        sum += 2 * term;
    }
    return true;
}

/* One axis more: out[n] = sum of in[n - x^2] over all integers x. This is the product with the
 * theta series 1 + 2 q + 2 q^4 + ..., of sums of coefficients. */
static void add_axis(uint64_t *out, const uint64_t *in, int64_t max_norm2) {
    for (int64_t n = 0; n <= max_norm2; n++) {
        out[n] = in[n];
    }
    for (int64_t x = 1; x * x <= max_norm2; x++) {
        for (int64_t n = x * x; n <= max_norm2; n++) {
            out[n] += 2 * in[n - x * x];
        }
    }
}

static pspec_status fail_countless(const ps_lattice *lattice, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "in dimension %u there are more than 2^64 - 1 frequencies with |k|^2 <= "
                   "%lld: more than can be counted",
                   lattice->dimension, (long long)lattice->max_norm2);
}

static pspec_status fill(ps_lattice *lattice, ps_error *error) {
    for (int64_t n = 0; n <= lattice->max_norm2; n++) {
        lattice->within[0][n] = 1;
    }
    for (unsigned j = 1; j <= lattice->dimension; j++) {
        if (!largest_fits(lattice->within[j - 1], lattice->max_norm2)) {
            return fail_countless(lattice, error);
        }
        add_axis(lattice->within[j], lattice->within[j - 1], lattice->max_norm2);
    }
    return PSPEC_OK;
}

pspec_status ps_lattice_create(ps_lattice *out, unsigned dimension, int64_t max_norm2,
                               ps_error *error) {
    uint64_t *block = NULL;
    const size_t row = (size_t)max_norm2 + 1;
    *out = (ps_lattice){.dimension = dimension, .max_norm2 = max_norm2};
    if (ps_lattice_estimate(dimension, max_norm2).least > (double)UINT64_MAX) {
        return fail_countless(out, error);
    }
    PS_TRY(ps_allocate_for(&block, row, (dimension + 1) * sizeof(uint64_t), "counts of frequencies",
                           error));
    for (unsigned j = 0; j <= dimension; j++) {
        out->within[j] = block + j * row;
    }
    const pspec_status status = fill(out, error);
    if (status != PSPEC_OK) {
        ps_lattice_free(out);
    }
    return status;
}

void ps_lattice_free(ps_lattice *lattice) {
    free(lattice->within[0]);
    *lattice = (ps_lattice){0};
}

/* Points of Z^j with low <= |k|^2 <= high; low may be negative, and high, too: then there are
 * none. */
static uint64_t count(const uint64_t *within, int64_t low, int64_t high) {
    if (high < 0) {
        return 0;
    }
    return within[high] - (low > 0 ? within[low - 1] : 0);
}

uint64_t ps_lattice_count(const ps_lattice *lattice, int64_t low, int64_t high) {
    return count(lattice->within[lattice->dimension], low, high);
}

double ps_lattice_mean_norm(const ps_lattice *lattice, int64_t low, int64_t high) {
    long double sum = 0;
    for (int64_t n = low; n <= high; n++) {
        sum += sqrtl((long double)n) * (long double)ps_lattice_count(lattice, n, n);
    }
    return (double)(sum / (long double)ps_lattice_count(lattice, low, high));
}

/* Axis by axis: the first component x leaves a point of rank r in a shell of the other axes. The
 * points with x < 0 are taken as mirror images, so that the search begins in the middle, x = 0. */
void ps_lattice_unrank(const ps_lattice *lattice, int64_t low, int64_t high, uint64_t rank,
                       int32_t *k) {
    int32_t sign = 1;
    for (unsigned axis = 0; axis < lattice->dimension; axis++) {
        const uint64_t *const within = lattice->within[lattice->dimension - axis];
        const uint64_t *const rest = lattice->within[lattice->dimension - axis - 1];
        const uint64_t total = count(within, low, high);
        uint64_t here = count(rest, low, high);
        const uint64_t num_negative = (total - here) / 2;
        int64_t x = 0;
        if (rank < num_negative) {
            rank = total - 1 - rank;
            sign = -sign;
        }
        for (rank -= num_negative; rank >= here; here = count(rest, low - x * x, high - x * x)) {
            rank -= here;
            x++;
        }
        k[axis] = sign * (int32_t)x;
        low -= x * x;
        high -= x * x;
    }
}
