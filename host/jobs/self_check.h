/* A few random entries of a job recomputed by the referee. */
#ifndef PS_JOBS_SELF_CHECK_H
#define PS_JOBS_SELF_CHECK_H

#include "engines/engine.h"

/* Points of which a long double sum is made: about 25 ms each (190 ns a term). */
enum { PS_SELF_CHECK_POINTS = 1 << 17 };
/* Steps of some nanoseconds that a term takes as long as, by which threads are worth it; of
 * degrees, of which a term is for an order, too. */
enum { PS_SELF_CHECK_STEPS = 50, PS_SELF_CHECK_DEGREE_STEPS = 5 };

/* rows[0] holds the powers of `pattern` (with weights w 2^-exponent) in the slots of the engine. */
typedef struct ps_self_check_input {
    const ps_rows *rows;
    const uint32_t *slots;
    const ps_frequencies *frequencies;
    const pspec_pattern *pattern;
    int exponent;
    double scale, weight_square_sum; /* of the scaled weights */
    double size_square;              /* of pair sums: (sum |w|)^2, scaled; else 0 */
    double engine_error; /* of the engine's formula, for powers of 1, in the units of the problem */
    double sum_rounding; /* on the sphere: the engine's roundoff times |sum w| / sqrt(V); else 0 */
} ps_self_check_input;

/* Terms that it sums up in long double: (point, frequency), or with *is_of_degrees (point, degree,
 * order). */
double ps_self_check_count(const ps_frequencies *frequencies, uint64_t num_points,
                           bool *is_of_degrees);

/* Compares entries with long double direct sums, which are shared among threads; *deviation is the
 * largest | |S| - |S_referee| | / sqrt(V), of pair sums | Q - Q_referee | / (sum |w|)^2. Fails with
 * PSPEC_ERROR_CHECK when an entry is off by more than is explicable by the engine's error. */
pspec_status ps_self_check(const ps_self_check_input *input, ps_device *device, double *deviation,
                           ps_error *error) PS_MUST_CHECK;

#endif
