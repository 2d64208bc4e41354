/* Strata: the unit cube cut into m_1 x .. x m_d equal boxes, one point in each.
 *
 * Parameter "strata" is AxB(x..), or "auto": the factorisation of N with the smallest aspect
 * (largest count over smallest), which may be at most 2. Automatic counts ascend from axis to axis.
 */
#ifndef PS_SAMPLERS_TORUS_STRATA_H
#define PS_SAMPLERS_TORUS_STRATA_H

#include "samplers/sampler.h"

#define PS_STRATA_AUTO "auto"
#define PS_STRATA_PARAMETER                                                                        \
    { "strata", PS_STRATA_AUTO, "AxB(x..), strata along each axis; auto: as square as N allows" }

/* Number of strata along each axis of the request, whose parameter i_parameter is "strata". */
pspec_status ps_strata_resolve(const ps_sampler_request *request, unsigned i_parameter,
                               uint64_t counts[PS_MAX_DIMENSION], ps_error *error) PS_MUST_CHECK;

/* Reads strata=AxB.. of num_axes numbers, one stratum for each point. */
pspec_status ps_strata_read(const ps_sampler_request *request, unsigned i_parameter,
                            unsigned num_axes, uint64_t counts[PS_MAX_DIMENSION],
                            ps_error *error) PS_MUST_CHECK;

/* Turns offsets in [0,1) within the stratum into points, in place; the last axis moves fastest.
 * PSPEC_ERROR_CANCELLED where the watch asks to stop. */
pspec_status ps_strata_place(const ps_sampler_request *request,
                             const uint64_t counts[PS_MAX_DIMENSION], double *points,
                             ps_error *error) PS_MUST_CHECK;

/* (i + offset)/m within [i/m, (i+1)/m), exactly: rounding never carries a point out of its stratum,
 * neither in exact arithmetic nor for a reader who computes floor(x * m). i < m <= 2^40. */
double ps_stratum_point(double i, double offset, double m);

/* ---- the search for counts (strata_search.c) ------------------------------------------------ */

/* Factors of num_points, ascending, of smallest aspect; false when the aspect would exceed 2. */
bool ps_strata_factorise(uint64_t num_points, unsigned dimension,
                         uint64_t counts[PS_MAX_DIMENSION]);

/* The admissible numbers of points (aspect at most 2) next to num_points, at most and at least it;
 * *below is 0 when there is none. */
void ps_strata_nearest(uint64_t num_points, unsigned dimension, uint64_t *below, uint64_t *above);

#endif
