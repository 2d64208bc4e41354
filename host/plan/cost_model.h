/* Seconds from counts of work: the only place that holds measured rates. */
#ifndef PS_PLAN_COST_MODEL_H
#define PS_PLAN_COST_MODEL_H

#include "engines/engine.h"

/* Peak of the device in flop/s as its limits suggest: compute units x clock x lanes x 2 pipes x 2.
 * Used to scale measured rates from the machine where they were taken to another one. */
double ps_cost_nominal_flops(const ps_device_limits *limits, ps_precision precision);

/* Estimated seconds of a whole job, by the launches of limits->figures where they were measured. A
 * pure function: nothing is timed while planning. limits is NULL for work on the host. */
double ps_cost_seconds(const ps_work *work, const ps_device_limits *limits, ps_precision precision);
/* The same on the typical device of that kind (device/kind.h), by which engines are chosen. */
double ps_cost_typical(const ps_work *work, const ps_device_limits *limits, ps_precision precision);

/* Estimates the kernel form of quadrature rules on one core of the host: pairs of points, and
 * (point, degree) of kappa. */
double ps_cost_rule_seconds(double pairs, double terms);

/* Realizations of one batch: rows of powers that stay in the cache of a CPU until they are summed
 * up, within the limits of one allocation and of memory. Not more than num_realizations unless that
 * is 0 (unknown). At least 1. */
size_t ps_cost_batch(const ps_work *work, const ps_device_limits *limits,
                     uint64_t num_realizations);

#endif
