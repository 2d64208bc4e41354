/* Bytes from counts of work: what a batch takes, on the device and on the host.
 */
#ifndef PS_PLAN_MEMORY_MODEL_H
#define PS_PLAN_MEMORY_MODEL_H

#include "engines/engine.h"

typedef struct ps_memory {
    double device, host;
} ps_memory;

/* Kept for the OpenCL driver of an engine that needs one: a run of 1000 points with an empty cache
 * of kernels took 176 MiB in all, of which 60 MiB were there before the plan (PoCL 3.1,
 * memory.max_usage_in_bytes of a cgroup, 2026-11). */
#define PS_MEMORY_OF_DRIVER ((double)((uint64_t)128 << 20))
/* Kept for everything else that is small: texts, tables, stacks of threads. */
#define PS_MEMORY_OF_PROGRAM ((double)((uint64_t)16 << 20))

/* Coordinates and weights of a set on the host, or of a block. */
double ps_memory_of_set(const ps_problem *problem, const ps_work *work);

/* Counts the memory of a batch: that of the engine, and what else a job keeps
 * (jobs/estimator, spectra/accumulate, bins, spectrum). limits: NULL for work on the host. */
ps_memory ps_memory_count(const ps_engine *engine, ps_precision precision,
                          const ps_problem *problem, const ps_work *work,
                          const ps_device_limits *limits, size_t batch);

#endif
