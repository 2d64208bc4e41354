#include "jobs/variance/formulas.h"

#include "base/memory.h"
#include "jobs/variance/tails.h"
#include "math/gauss_legendre.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

/* ---- by profiles ----------------------------------------------------------------------------- */

/* |k| N^(-1/d), or l N^(-1/2). */
static double find_frequency(const ps_frequencies *set, size_t i, double unit) {
    const unsigned dimension = set->dimension;
    return set->kind == PS_FREQUENCIES_DEGREES
               ? set->vectors[i] / unit
               : sqrt((double)ps_frequency_norm2(set->vectors + i * dimension, dimension)) / unit;
}

/* Between a cut-off and all that lies beyond it: a box ends at K + 1, rings by rounding at
 * K + 1/2, and degrees are whole. */
static const double BEYOND = 0.5;

/* The frequencies of the spectrum, or more of their kind, up to where the profile is flat. */
static pspec_status make_frequencies(ps_frequencies *out, const ps_spectrum *spectrum,
                                     const ps_integrand *integrand, bool over_shells, double flat,
                                     ps_error *error) {
    const ps_frequencies *const set = &spectrum->frequencies;
    const double most = (double)ps_tails_largest_cutoff(integrand, over_shells);
    const double cutoff = fmin(ceil(flat), most);
    if (!(cutoff > set->max_frequency)) {
        return ps_frequencies_copy(out, set, error);
    }
    PS_TRY(set->kind == PS_FREQUENCIES_DEGREES
               ? ps_frequencies_degrees(out, (int64_t)cutoff, set->degree_step > 1, error)
               : ps_frequencies_lattice(out, set->dimension, (int32_t)cutoff,
                                        set->kind == PS_FREQUENCIES_BALL, error));
    return ps_frequencies_enumerate(out, error);
}

pspec_status ps_bounds_variance(double *out, const ps_integrand *integrand,
                                const ps_spectrum *spectrum, bool over_shells,
                                const ps_point_way *way, const ps_bound *profile, bool is_below,
                                ps_error *error) {
    const double num_points = spectrum->mean_points;
    const double unit =
        pow(num_points, 1.0 / ps_frequencies_space_dimension(&spectrum->frequencies));
    ps_frequencies set = {0};
    double *weights = NULL;
    double held = 0;
    long double sum = 0;
    pspec_status status = PSPEC_OK;
    PS_TRY(make_frequencies(&set, spectrum, integrand, over_shells, profile->alpha * unit, error));
    PS_TRY_OUT(status, PS_NEW(&weights, set.num, "weights of a bound", error));
    PS_TRY_OUT(status,
               ps_prediction_weigh(integrand, &set, over_shells, way, weights, &held, error));
    for (size_t i = 0; i < set.num; i++) {
        sum += weights[i] * ps_bound_power(profile, find_frequency(&set, i, unit));
    }
    const double rest =
        ps_integrand_factor(integrand) * fmax(ps_integrand_energy(integrand) - held, 0);
    const double power =
        is_below ? ps_bound_power(profile, (set.max_frequency + BEYOND) / unit) : profile->gamma;
    *out = ((double)sum + power * rest) / num_points;
out:
    free(weights);
    ps_frequencies_free(&set);
    return status;
}

/* ---- over |k| -------------------------------------------------------------------------------- */

/* Rings are about 1 apart, and a power of an integrand of the cell has at most one wave in that. */
enum { NUM_NODES = 24 };

typedef struct ring {
    double norm2; /* mean |k|^2 */
    double power;
    uint64_t count;
} ring;

static void fill_rings(ring *rings, const ps_spectrum *spectrum) {
    const ps_frequencies *const set = &spectrum->frequencies;
    const unsigned dimension = set->dimension;
    for (size_t i = 0; i < set->num; i++) {
        const int64_t norm2 = ps_frequency_norm2(set->vectors + i * dimension, dimension);
        const size_t b = (size_t)ps_ring_of_norm2(norm2) - 1;
        if (b < spectrum->num_bins) { /* no corner of the box */
            rings[b].count++;
            rings[b].norm2 += ((double)norm2 - rings[b].norm2) / (double)rings[b].count;
        }
    }
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        rings[b].power = spectrum->bins[b].power;
    }
}

/* Pm at rho, from this ring and the next. */
static double mean_power(const ring *low, double rho) {
    const ring *const high = low + 1;
    const double t = (rho * rho - low->norm2) / (high->norm2 - low->norm2);
    return fmax(low->power + t * (high->power - low->power), 0);
}

typedef struct radial_sums {
    double variance; /* with Pm */
    double square;   /* without */
} radial_sums;

/* Adds the integral between two rho. low NULL: Pm is power. */
static void add_piece(radial_sums *sums, const ps_integrand *integrand, const ring *low,
                      double power, double from, double to) {
    const double dimension = integrand->place.dimension;
    double nodes[NUM_NODES];
    double weights[NUM_NODES];
    ps_gauss_legendre(NUM_NODES, nodes, weights);
    for (size_t i = 0; i < NUM_NODES; i++) {
        const double rho = from + (to - from) * nodes[i];
        const double term = weights[i] * (to - from) * pow(rho, dimension - 1) *
                            ps_integrand_radial(integrand, rho);
        sums->square += term;
        sums->variance += term * (low != NULL ? mean_power(low, rho) : power);
    }
}

static double integrate(const ps_integrand *integrand, const ring *rings, size_t num) {
    const double half_dimension = integrand->place.dimension / 2.0;
    const double sphere = 2 * pow(PS_PI, half_dimension) / tgamma(half_dimension); /* S_d */
    const double half = 0.5;
    const double end = (double)num + half; /* of the last ring */
    radial_sums sums = {0, 0};
    double from = 0;
    for (size_t b = 0; b + 1 < num; b++) {
        const double to = sqrt(rings[b + 1].norm2);
        add_piece(&sums, integrand, &rings[b], 0, from, to);
        from = to;
    }
    add_piece(&sums, integrand, NULL, rings[num - 1].power, from, end);
    const double beyond = fmax(ps_integrand_whole_square(integrand) - sphere * sums.square, 0);
    return sphere * sums.variance + beyond;
}

pspec_status ps_radial_variance(double *out, const ps_integrand *integrand,
                                const ps_spectrum *spectrum, ps_error *error) {
    ring *rings = NULL;
    PS_TRY(PS_NEW(&rings, spectrum->num_bins, "rings", error));
    fill_rings(rings, spectrum);
    *out = integrate(integrand, rings, spectrum->num_bins) / spectrum->mean_points;
    free(rings);
    return PSPEC_OK;
}
