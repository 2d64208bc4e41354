#include "spectra/spectrum.h"

#include <math.h>

/* Mean of the averaged periodogram over the members, its sample variance, and the mean square of
 * the standard errors over the realizations (nan when there was one). */
typedef struct moments {
    long double mean;
    double variance, noise;
} moments;

static moments find_moments(const ps_mean *powers, const uint32_t *members, size_t num_members) {
    long double sum = 0;
    long double squares = 0;
    long double noise = 0;
    for (size_t i = 0; i < num_members; i++) {
        sum += powers[members[i]].mean;
    }
    const long double mean = sum / (long double)num_members;
    for (size_t i = 0; i < num_members; i++) {
        const long double deviation = powers[members[i]].mean - mean;
        const long double error = powers[members[i]].standard_error;
        squares += deviation * deviation;
        noise += error * error;
    }
    return (moments){mean, (double)(squares / (long double)(num_members - 1)),
                     (double)(noise / (long double)num_members)};
}

double ps_anisotropy_db(const ps_mean *powers, const uint32_t *members, size_t num_members) {
    const double decibels = 10;
    if (num_members < 2) {
        return NAN;
    }
    const moments ring = find_moments(powers, members, num_members);
    const double ratio = ring.variance / (double)(ring.mean * ring.mean);
    return ring.mean > 0 && ratio > 0 ? decibels * log10(ratio) : NAN;
}

double ps_subset_standard_error(const ps_mean *powers, const uint32_t *members, size_t num_members,
                                uint64_t num_frequencies, double standard_error) {
    if (num_members >= num_frequencies || num_members < 2) {
        return standard_error;
    }
    const double num = (double)num_members;
    const double left_out = 1 - num / (double)num_frequencies;
    const moments ring = find_moments(powers, members, num_members);
    if (isnan(standard_error)) {
        return sqrt(left_out * ring.variance / num);
    }
    /* The variance over the subset holds that of the spectrum over the ring, and the noise of
     * single frequencies as far as it is not common to them. */
    const double square = standard_error * standard_error;
    const double own_noise = num / (num - 1) * (ring.noise - square);
    return sqrt(square + left_out / num * fmax(ring.variance - own_noise, 0));
}
