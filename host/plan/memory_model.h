/* Bytes from counts of work: what a batch takes, on the device and on the host.
 */
#ifndef PS_PLAN_MEMORY_MODEL_H
#define PS_PLAN_MEMORY_MODEL_H

#include "engines/engine.h"

typedef struct ps_memory {
    double device, host;
} ps_memory;

/* Coordinates and weights of a set on the host, or of a block. */
double ps_memory_of_set(const ps_problem *problem, const ps_work *work);

/* Of a batch: that of the engine, and what else a job keeps (job/estimator, analysis/accumulate, bins, spectrum).
 * limits: NULL for work on the host. */
ps_memory ps_memory_count(const ps_engine *engine, ps_precision precision,
                          const ps_problem *problem, const ps_work *work,
                          const ps_device_limits *limits, size_t batch);

/* Bytes on the device and on the host that coefficients take besides what a batch has, with the array that they are
 * written to. */
double ps_memory_of_coefficients(const ps_engine *engine, ps_precision precision,
                                 const ps_problem *problem, const ps_device_limits *limits,
                                 ps_harmonics harmonics);

#endif
