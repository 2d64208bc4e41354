/* Are phases uniform? Tests of homogeneity (docs/mathematics/statistics.md#homogeneity).
 *
 * A translation by tau multiplies S(k) by exp(-2 pi i k.tau), a turn by alpha about an axis c_lm by
 * exp(i m alpha), and every quantity that is made of them has such a character, too. Where
 * realizations have the law of their own translates, the phase of a quantity with a character other
 * than 0 is uniform, and those of independent realizations are independent. The length of their
 * mean, the resultant, then has a law that nothing else enters: Rayleigh's test is exact for every
 * quantity, and Holm's method judges all of them together, dependent as they are. */
#ifndef PS_SPECTRA_PHASES_PHASE_TESTS_H
#define PS_SPECTRA_PHASES_PHASE_TESTS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* One quantity, over realizations. {0} is none yet. */
typedef struct ps_phase_test {
    double cosines, sines; /* sums over realizations */
    uint64_t num;          /* realizations whose value has a phase */
    double resultant;      /* length of the mean of exp(i phase), 0 to 1 */
    double p_value;        /* of this quantity alone */
    /* Holm's: the smallest rate of false alarms at which the phases are not uniform */
    double adjusted_p_value;
    bool differs;
} ps_phase_test;

/* Adds the phase of a complex value, unless its modulus is at most `error`: then it is rounding. A
 * modulus does not change under translations, so leaving values out by it biases nothing. */
void ps_phase_test_add(ps_phase_test *test, const double value[2], double error);

/* Probability that the mean of num uniform independent phases is at least as long, by Greenwood and
 * Durand's formula. It is never too small by more than 0.3 %, and too large where that does not
 * matter: by 4 % for 32 phases and a probability of 1e-5. 1 below eight phases. */
double ps_rayleigh_p_value(uint64_t num, double resultant);

/* The fewest realizations with which equal phases of one quantity among num_tests are an alarm at
 * that rate. */
uint64_t ps_phase_tests_least(size_t num_tests, double false_alarm_rate);

/* Fills what is made of the sums. Quantities of fewer than eight phases do not count in Holm's
 * method, and never differ. */
pspec_status ps_phase_tests_judge(ps_phase_test *tests, size_t num, double false_alarm_rate,
                                  ps_error *error) PS_MUST_CHECK;

#endif
