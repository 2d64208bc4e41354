#include "samplers/forces/step.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PRECISION 64
#include "shared/turn.h"
#include "shared/two_to.h"

/* Where the smoothing Gaussian ends, in standard deviations. */
enum { SMOOTH_END = 4 };
/* Points nearer than this to half a period away have no force: beyond, an image of the point may be
 * as near. */
static const double FARTHEST = 0.49;
static const double PI = 3.14159265358979323846;

static double turn_cosine(double turns) {
    const double whole = 18446744073709551616.0; /* 2^64 */
    realv cosine;
    realv sine;
    turn_cosine_sine((word)((turns - floor(turns)) * whole), &cosine, &sine);
    return cosine;
}

/* J1(t) / t = (1/pi) int_0^pi cos(t cos a) sin^2 a da, by sums at the middles of n equal parts,
 * whose error is J_2n(t): nothing where 2n is beyond t by some of its cube roots. */
double ps_step_bessel(double turns) {
    const size_t half = 16 + (size_t)ceil(PI * turns);
    double sum = 0;
    for (size_t k = 0; k < half; k++) { /* the other half is the same */
        const double cosine = turn_cosine(((double)k + 0.5) / (4 * (double)half));
        sum += turn_cosine(turns * cosine) * (1 - cosine * cosine);
    }
    return sum / (double)half;
}

/* 1 - 2 (pi x0^2 / N) J1(t) / t, t = 2 pi x0 r, with the largest step that can be:
 * pi x0^2 = N. */
static void find_target(ps_step_curves *c) {
    const double edge = sqrt((double)c->num_points / PI);
    for (size_t b = 0; b < c->num_bins; b++) {
        const double r = ((double)b + 0.5) / (2 * (double)c->num_bins);
        c->target[b] = 1 - 2 * ps_step_bessel(edge * r);
    }
}

static void find_weights(ps_step_curves *c, unsigned bins) {
    const double exponent = -TWO_TO_LOG2E / (2.0 * bins * bins);
    for (size_t k = 0; k <= c->smooth_end; k++) {
        c->weights[k] = two_to(exponent * (double)k * (double)k);
    }
}

/* Bins that are not there have no weight. */
static double smooth(const ps_step_curves *c, size_t b) {
    const size_t first = b < c->smooth_end ? 0 : b - c->smooth_end;
    const size_t end = c->num_bins - b <= c->smooth_end ? c->num_bins : b + c->smooth_end + 1;
    double sum = 0;
    double weight = 0;
    for (size_t k = first; k < end; k++) {
        const double w = c->weights[k < b ? b - k : k - b];
        sum += w * c->rough[k];
        weight += w;
    }
    return sum / weight;
}

static void smooth_target(ps_step_curves *c) {
    memcpy(c->rough, c->target, c->num_bins * sizeof *c->rough);
    for (size_t b = 0; b < c->num_bins; b++) {
        c->target[b] = smooth(c, b);
    }
}

pspec_status ps_step_curves_create(ps_step_curves *c, size_t num_points, size_t num_bins,
                                   ps_step_smoothing smoothing, ps_error *error) {
    *c = (ps_step_curves){.num_points = num_points,
                          .num_bins = num_bins,
                          .smooth_end = (size_t)SMOOTH_END * smoothing.bins};
    PS_TRY(PS_NEW(&c->target, num_bins, "distributions of distances", error));
    PS_TRY(PS_NEW(&c->found, num_bins, "distributions of distances", error));
    PS_TRY(PS_NEW(&c->rough, num_bins, "distributions of distances", error));
    PS_TRY(PS_NEW(&c->weights, c->smooth_end + 1, "distributions of distances", error));
    find_target(c);
    find_weights(c, smoothing.bins);
    if (smoothing.is_of_target) {
        smooth_target(c);
    }
    return PSPEC_OK;
}

void ps_step_curves_destroy(ps_step_curves *c) {
    free(c->target);
    free(c->found);
    free(c->rough);
    free(c->weights);
}

/* Of N(N - 1)/2 pairs, a ring has as many as its area is of the unit square. */
double ps_step_curves_measure(ps_step_curves *c, const uint64_t *counts) {
    const double n = (double)c->num_points;
    const double width = 1 / (2 * (double)c->num_bins);
    double sum = 0;
    for (size_t b = 0; b < c->num_bins; b++) {
        const double area = PI * width * width * (2 * (double)b + 1);
        c->rough[b] = (double)counts[b] / (n * (n - 1) / 2 * area);
    }
    for (size_t b = 0; b < c->num_bins; b++) {
        c->found[b] = smooth(c, b);
        const double off = c->found[b] - c->target[b];
        sum += off * off * width;
    }
    return sqrt(sum);
}

/* Where there are too many pairs up to a distance, those at it go apart, with a force of the sum of
 * what is too much, over N r^2; the table is for differences of points, which are r long. */
void ps_step_curves_force(const ps_step_curves *c, double *table) {
    const double width = 1 / (2 * (double)c->num_bins);
    double sum = 0;
    for (size_t b = 0; b < c->num_bins; b++) {
        const double r = ((double)b + 0.5) * width;
        const double off = (c->found[b] - c->target[b]) * width;
        table[b] = r < FARTHEST ? (sum + off / 2) / ((double)c->num_points * r * r * r) : 0;
        sum += off;
    }
    table[c->num_bins] = 0;
}
