/* What a start takes: of the program, of a driver, of kernels that the driver's cache has. A
 * process that measures has all of it in its caches, where a kernel loads in half the time; so the
 * program is started anew, as a shell does. */
#ifndef PS_VERIFY_BENCH_START_PROBES_H
#define PS_VERIFY_BENCH_START_PROBES_H

#include "verify/bench/host_probes.h"

/* Starts the program for PS_HOST_START, PS_HOST_DRIVER and PS_HOST_KERNEL, in this order: each
 * leaves out what those before it measured. PSPEC_ERROR_IO: it does not start, or not well. */
pspec_status ps_probe_start(ps_probe_data *data, const ps_probe *what, double *predicted,
                            ps_error *error) PS_MUST_CHECK;

#endif
