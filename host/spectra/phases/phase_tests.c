#include "spectra/phases/phase_tests.h"

#include "base/memory.h"
#include "math/random/holm.h"

#include <math.h>
#include <stdlib.h>

void ps_phase_test_add(ps_phase_test *test, const double value[2], double error) {
    const double modulus = hypot(value[0], value[1]);
    if (!(modulus > error)) {
        return;
    }
    test->cosines += value[0] / modulus;
    test->sines += value[1] / modulus;
    test->num++;
}

/* Below so many phases the formula is too small by up to 8 %. */
enum { FEWEST_PHASES = 8 };

double ps_rayleigh_p_value(uint64_t num, double resultant) {
    const double n = (double)num;
    const double length = n * resultant;
    return num < FEWEST_PHASES
               ? 1
               : fmin(1, exp(sqrt(1 + 4 * n + 4 * (n - length) * (n + length)) - (1 + 2 * n)));
}

uint64_t ps_phase_tests_least(size_t num_tests, double false_alarm_rate) {
    uint64_t num = FEWEST_PHASES;
    while (ps_rayleigh_p_value(num, 1) * (double)num_tests > false_alarm_rate) {
        num++; /* the probability falls by e^2 each time */
    }
    return num;
}

/* Gathers the tests that can tell, those without enough phases being 1 whatever the others are.
 * Which they are depends on moduli alone, so that Holm's method need not count the others. */
static size_t gather(ps_phase_test *tests, size_t num, double *values) {
    size_t num_able = 0;
    for (size_t i = 0; i < num; i++) {
        ps_phase_test *const test = &tests[i];
        test->resultant =
            test->num > 0 ? fmin(1, hypot(test->cosines, test->sines) / (double)test->num) : 0;
        test->p_value = ps_rayleigh_p_value(test->num, test->resultant);
        if (test->num >= FEWEST_PHASES) {
            values[num_able++] = test->p_value;
        }
    }
    return num_able;
}

static void scatter(ps_phase_test *tests, size_t num, const double *adjusted,
                    double false_alarm_rate) {
    for (size_t i = 0; i < num; i++) {
        tests[i].adjusted_p_value = tests[i].num >= FEWEST_PHASES ? *adjusted++ : 1;
        tests[i].differs = tests[i].adjusted_p_value <= false_alarm_rate;
    }
}

pspec_status ps_phase_tests_judge(ps_phase_test *tests, size_t num, double false_alarm_rate,
                                  ps_error *error) {
    double *values = NULL;
    PS_TRY(PS_NEW(&values, 2 * num, "probabilities of phases", error));
    double *const adjusted = values + num;
    const pspec_status status = ps_holm_adjust(gather(tests, num, values), values, adjusted, error);
    if (status == PSPEC_OK) {
        scatter(tests, num, adjusted, false_alarm_rate);
    }
    free(values);
    return status;
}
