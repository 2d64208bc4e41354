/* Mean spectra on rings of the plane, as closed forms, and with noise as realizations have it. */
#ifndef PS_TESTS_HARNESS_RINGS_H
#define PS_TESTS_HARNESS_RINGS_H

#include "spectra/spectrum.h"

enum { TEST_MOST_RINGS = 256 };

/* Rings 1..num of side^2 points in the plane. Not to be copied: the spectrum has the bins of its
 * own struct. */
typedef struct test_rings {
    ps_spectrum spectrum;
    ps_spectrum_bin bins[TEST_MOST_RINGS];
} test_rings;

typedef double test_power_at(double normalized_frequency);

void test_rings_make(test_rings *rings, size_t num, double side, uint64_t num_realizations,
                     test_power_at *power, double relative_error);
/* Realizations in place of the powers: means over count/2 exponential ones, and the errors that
 * they say. */
void test_rings_add_noise(test_rings *rings, uint64_t *state);

double test_power_one(double nu);
/* As farthest-point sets have it: 0.006935 (1 + 12 nu^2). */
double test_power_raised(double nu);
/* (J) of jittered points, the mean over directions. */
double test_power_jittered(double nu);
/* nu^4 */
double test_power_fourth(double nu);

#endif
