/* The host's own work in small: one or two inputs of some milliseconds for every kind of it. */
#ifndef PS_VERIFY_BENCH_HOST_PROBES_H
#define PS_VERIFY_BENCH_HOST_PROBES_H

#include "plan/host_cost.h"
#include "rules/representer.h"
#include "samplers/sampler.h"

enum { PS_PROBE_POINTS = 1 << 17 };

/* What probes work on. */
typedef struct ps_probe_data {
    double *points;  /* [PS_PROBE_POINTS][3]: unit vectors */
    double *numbers; /* [PS_PROBE_POINTS][3]: room */
    ps_representer representer;
    const char *file;    /* to be written and read */
    const char *program; /* pointspec itself, to be started */
    const char *device;  /* as --device takes it; NULL: the usual one */
    double unmeasured;   /* seconds of a probe that are no part of what it measures */
} ps_probe_data;

typedef struct ps_probe {
    ps_host_kind kind;
    double seconds; /* by the built-in model, on one core of its machine */
    pspec_status (*run)(ps_probe_data *data, const struct ps_probe *what, ps_error *error);
} ps_probe;

enum { PS_NUM_PROBES = 14 };

/* In an order in which each finds what it needs. Every kind has one at least. */
extern const ps_probe ps_probes[PS_NUM_PROBES];

/* What a start takes: of the program, of a driver, of kernels that the driver's cache has. A
 * process that measures has all of it in its caches, where a kernel loads in half the time; so the
 * program is started anew, as a shell does, with four engines, which load 15 kernels: 4 times
 * 2.2 ms of the program and 32 ms of the driver, and 15 times 34 ms. PSPEC_ERROR_IO: it does not
 * start, or not well. */
pspec_status ps_probe_start(ps_probe_data *data, const ps_probe *what,
                            ps_error *error) PS_MUST_CHECK;

/* A sampler against its row: makes a realization of as many points as take some milliseconds by
 * the row, PS_PROBE_POINTS at most; room is [PS_PROBE_POINTS][3]. *predicted is the row's, in
 * seconds; 0, and nothing is made, where the fewest points take longer, as on a device. */
pspec_status ps_probe_sampler(const ps_sampler *sampler, double *room, double *predicted,
                              ps_error *error) PS_MUST_CHECK;

#endif
