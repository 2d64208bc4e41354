#include "math/sobolev.h"

#include "base/wide.h"
#include "math/neumaier.h"
#include "math/pi.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

pspec_status ps_sobolev_check(double smoothness, ps_error *error) {
    if (smoothness > 1 && smoothness < 2) {
        return PSPEC_OK;
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "smoothness %g is not between 1 and 2: functions of H^s have values at points "
                   "for s > 1 only, and |u-v|^(2s-2) is a reproducing kernel for s < 2 only",
                   smoothness);
}

double ps_sobolev_constant(double smoothness) {
    return exp2(2 * smoothness - 1) / smoothness;
}

/* a_0 is of another branch: (K1) goes on from l = 1. */
void ps_sobolev_eigenvalues(double smoothness, size_t max_degree, double *eigenvalues) {
    const double s = smoothness;
    eigenvalues[0] = PS_FOUR_PI * exp2(2 * s - 2) / s;
    if (max_degree >= 1) {
        eigenvalues[1] = eigenvalues[0] * (s - 1) / (s + 1);
    }
    for (size_t l = 1; l < max_degree; l++) {
        const double next = (double)(l + 1);
        eigenvalues[l + 1] = eigenvalues[l] * (next - s) / (next + s);
    }
}

double ps_sobolev_tail(double smoothness, size_t max_degree, double next_eigenvalue) {
    const double next = (double)max_degree + 1;
    return next * (next + smoothness) * next_eigenvalue / (PS_FOUR_PI * (smoothness - 1));
}

static double square_distance(const double u[3], const double v[3]) {
    const double x = u[0] - v[0];
    const double y = u[1] - v[1];
    const double z = u[2] - v[2];
    return x * x + y * y + z * z;
}

/* s = 3/2, the paper's own, needs no power. */
static double distance_of_square(double smoothness, double square) {
    return smoothness == 1.5 ? sqrt(square) : pow(square, smoothness - 1);
}

double ps_sobolev_distance(double smoothness, const double u[3], const double v[3]) {
    return distance_of_square(smoothness, square_distance(u, v));
}

/* ---- sums ---------------------------------------------------------------------------------- */

enum { LANES = 8 }; /* a chunk is a whole number of them */

void ps_sobolev_chunk_fill(ps_sobolev_chunk *chunk, size_t num, const double *points,
                           const double *weights) {
    chunk->num = num;
    for (size_t j = 0; j < PS_SOBOLEV_CHUNK; j++) {
        const bool is_point = j < num;
        chunk->x[j] = is_point ? points[3 * j] : 0;
        chunk->y[j] = is_point ? points[3 * j + 1] : 0;
        chunk->z[j] = is_point ? points[3 * j + 2] : 0;
        chunk->weights[j] = !is_point ? 0 : weights != NULL ? weights[j] : 1;
    }
}

/* |u-v_j|^2 of the chunk, or |u-v_j| itself. */
PS_WIDE_BODY(size_t, fill_squares,
             (const double *u, const ps_sobolev_chunk *chunk, bool is_root, double *out)) {
    double values[PS_SOBOLEV_CHUNK]; /* the function's own: it overlaps nothing */
    for (size_t j = 0; j < PS_SOBOLEV_CHUNK; j++) {
        const double x = u[0] - chunk->x[j];
        const double y = u[1] - chunk->y[j];
        const double z = u[2] - chunk->z[j];
        values[j] = x * x + y * y + z * z;
    }
    for (size_t j = 0; is_root && j < PS_SOBOLEV_CHUNK; j++) {
        values[j] = sqrt(values[j]);
    }
    memcpy(out, values, sizeof values);
    return chunk->num;
}

PS_WIDE(size_t, fill_squares,
        (const double *u, const ps_sobolev_chunk *chunk, bool is_root, double *out),
        (u, chunk, is_root, out))

void ps_sobolev_chunk_distances(double smoothness, const double u[3], const ps_sobolev_chunk *chunk,
                                double values[PS_SOBOLEV_CHUNK]) {
    const bool is_root = smoothness == 1.5;
    fill_squares(u, chunk, is_root, values);
    if (!is_root) {
        ps_powers(smoothness - 1, values);
    }
}

static double sum_lanes(const double weights[PS_SOBOLEV_CHUNK],
                        const double values[PS_SOBOLEV_CHUNK]) {
    double sums[LANES] = {0};
    for (size_t j = 0; j < PS_SOBOLEV_CHUNK; j += LANES) {
        for (size_t lane = 0; lane < LANES; lane++) {
            sums[lane] += weights[j + lane] * values[j + lane];
        }
    }
    for (size_t step = LANES / 2; step > 0; step /= 2) {
        for (size_t lane = 0; lane < step; lane++) {
            sums[lane] += sums[lane + step];
        }
    }
    return sums[0];
}

double ps_sobolev_chunk_sum(double smoothness, const double u[3], const ps_sobolev_chunk *chunk) {
    double values[PS_SOBOLEV_CHUNK];
    ps_sobolev_chunk_distances(smoothness, u, chunk, values);
    return sum_lanes(chunk->weights, values);
}

void ps_sobolev_distance_sums(double smoothness, const double u[3], size_t num,
                              const double *points, size_t num_sums, const double *weights,
                              double *sums) {
    ps_neumaier own[PS_SOBOLEV_MOST_SUMS] = {{0, 0}};
    for (size_t begin = 0; begin < num; begin += PS_SOBOLEV_CHUNK) {
        const size_t left = num - begin;
        const size_t size = left < PS_SOBOLEV_CHUNK ? left : PS_SOBOLEV_CHUNK;
        ps_sobolev_chunk chunk;
        double values[PS_SOBOLEV_CHUNK];
        ps_sobolev_chunk_fill(&chunk, size, points + 3 * begin,
                              weights != NULL ? weights + begin : NULL);
        ps_sobolev_chunk_distances(smoothness, u, &chunk, values);
        for (size_t k = 0; k < num_sums; k++) {
            if (k > 0) {
                memcpy(chunk.weights, weights + k * num + begin, size * sizeof *weights);
            }
            ps_neumaier_add(&own[k], sum_lanes(chunk.weights, values));
        }
    }
    for (size_t k = 0; k < num_sums; k++) {
        sums[k] = ps_neumaier_value(&own[k]);
    }
}

double ps_sobolev_distance_sum(double smoothness, const double u[3], size_t num,
                               const double *points, const double *weights) {
    double sum = 0;
    ps_sobolev_distance_sums(smoothness, u, num, points, 1, weights, &sum);
    return sum;
}
