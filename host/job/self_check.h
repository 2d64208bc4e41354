/* A few random entries of a job recomputed by the referee. */
#ifndef PS_JOB_SELF_CHECK_H
#define PS_JOB_SELF_CHECK_H

#include "engines/engine.h"

/* Compares entries of the first row (of `pattern`) with long double direct sums. slots as from the
 * engine. *deviation is the largest | |S| - |S_referee| | / sqrt(V). Fails with PSPEC_ERROR_CHECK
 * when an entry is off by more than is explicable by the engine's error. */
pspec_status ps_self_check(const ps_rows *rows, const uint32_t *slots,
                           const ps_frequencies *frequencies, const pspec_pattern *pattern,
                           double scale, double weight_square_sum, double engine_error,
                           ps_device *device, double *deviation, ps_error *error) PS_MUST_CHECK;

#endif
