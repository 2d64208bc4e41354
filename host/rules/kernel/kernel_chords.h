/* Kernel sums over pairs on the device.
 *
 * sums[r] = sum_{i != j} w_i w_j |u_i - u_j|^(2 power) with weights w 2^-exponents[r] (NULL: 0), 0
 * < power; power = s - 1 belongs to the Sobolev space of smoothness s. The diagonal, where K(u, u)
 * = c, is the caller's. Points stand for their directions. In units of (sum |w|)^2 the error is
 * about 1e-15 in double precision, 1e-7 in single (tests/engines/pairs/test_pairs.c). Scales of the
 * batch are not looked at. Memory for the whole batch is allocated and freed.
 */
#ifndef PS_RULES_KERNEL_KERNEL_CHORDS_H
#define PS_RULES_KERNEL_KERNEL_CHORDS_H

#include "engines/engine.h"

pspec_status ps_kernel_chord_sums(ps_device *device, ps_precision precision, double power,
                                  const ps_batch *batch, double *sums,
                                  ps_error *error) PS_MUST_CHECK;

#endif
