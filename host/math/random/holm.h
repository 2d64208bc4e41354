/* Holm's method: many probabilities judged together, whether independent or not. */
#ifndef PS_MATH_RANDOM_HOLM_H
#define PS_MATH_RANDOM_HOLM_H

#include "base/status.h"

#include <stddef.h>

/* adjusted[i] is the smallest rate of false alarms, for all num tests together, at which test i
 * with the probability p_values[i] of its own is an alarm. */
pspec_status ps_holm_adjust(size_t num, const double *p_values, double *adjusted,
                            ps_error *error) PS_MUST_CHECK;

#endif
