/* The parameter of both capacity-constrained samplers. */
#ifndef PS_SAMPLERS_CCVT_CCVT_VALUES_H
#define PS_SAMPLERS_CCVT_CCVT_VALUES_H

#include "samplers/ccvt/ccvt.h"
#include "samplers/sampler.h"

#define PS_CCVT_PARAMETER(preset)                                                                  \
    { "M", preset, "4 to 16384, background points of every site; more are more regular" }

/* The value, and with the number of points the limits of all background points. */
pspec_status ps_ccvt_capacity(const ps_sampler_request *request, size_t *capacity,
                              ps_error *error) PS_MUST_CHECK;
/* For the row: the same as a check. */
pspec_status ps_ccvt_check_request(const ps_sampler_request *request,
                                   ps_error *error) PS_MUST_CHECK;

/* N (each + root sqrt(N)) microseconds with M = 64, which grow with M as M (1 + M/512): passes
 * become more. Right to a factor of 1.5 from 16 to 4096 (bench_cells ccvt). That points take longer
 * where there are more is of sites drawn at random, whose numbers differ the more from those of
 * equal capacities, the larger the part of the room. 0 of a request that is refused. */
double ps_ccvt_seconds(const ps_sampler_request *request, double each, double root);

#endif
