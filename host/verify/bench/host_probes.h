/* The host's own work in small: one or two inputs of some milliseconds for every kind of it. */
#ifndef PS_VERIFY_BENCH_HOST_PROBES_H
#define PS_VERIFY_BENCH_HOST_PROBES_H

#include "plan/host_cost.h"
#include "rules/representer.h"

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

#endif
