/* How long a spectrum job takes beside its engine, phase by phase. */
#ifndef PS_JOBS_SPECTRUM_POWER_PHASES_H
#define PS_JOBS_SPECTRUM_POWER_PHASES_H

#include "jobs/spectrum/power_job.h"
#include "plan/phases.h"

/* Adds those of a job that is made and not yet run. Returns by what the seconds of its engines are
 * to be multiplied: files do not say beforehand how many sets they have. */
double ps_power_job_phases(const ps_power_job *job, ps_phases *phases);

/* Adds the beginning of a program: its libraries, and where the chosen engine needs a device, that
 * and its kernels, which the driver's cache has. NULL: no engine is needed. */
void ps_phases_start(ps_phases *phases, const ps_candidate *chosen, const ps_device_limits *limits);

typedef struct ps_phases_load {
    double seconds, coordinates; /* of all realizations, by the engine */
    double bytes;                /* besides its own, on the host */
} ps_phases_load;

/* Adds what the chosen engine takes, the way of points to a device that has memory of its own, and
 * memory. limits: of the device, if there is one. */
void ps_phases_run(ps_phases *phases, const ps_candidate *chosen, const ps_device_limits *limits,
                   const ps_phases_load *load);

/* Adds so many more programs of kernels to that beginning. */
void ps_phases_load_programs(ps_phases *phases, double programs);

/* Adds zonal sums of a realization (engines/pairs/pairs_zonal.h) of so many points and degrees. */
void ps_phases_sum_zonal(ps_phases *phases, double points, double degrees);

#endif
