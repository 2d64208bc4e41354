/* What a start takes: of the program, of a driver, of kernels that the driver's cache has. A
 * process that measures has all of it in its caches, where a kernel loads in half the time; so the
 * program is started anew, as a shell does. */
#ifndef PS_VERIFY_BENCH_START_PROBES_H
#define PS_VERIFY_BENCH_START_PROBES_H

#include "verify/bench/host_probes.h"

/* Starts the program with four engines, which load 15 kernels: 4 times 2.2 ms of the program and
 * 32 ms of the driver, and 15 times 34 ms. PSPEC_ERROR_IO: it does not start, or not well. */
pspec_status ps_probe_start(ps_probe_data *data, const ps_probe *what,
                            ps_error *error) PS_MUST_CHECK;

#endif
