#include "plan/host_cost.h"

#include "base/workers.h"

#include <stdbool.h>

/* The machine of all seconds of the host's work: one core of 2 of a Zen 5 EPYC (AVX-512) at a
 * nominal 2.6 GHz, Debian 12, 2026-11; the machine is shared. `pointspec bench --calibrate`
 * measures how many times longer each kind takes on the machine at hand, as usual as its runs
 * are. */
static const struct {
    const char *name;
    bool is_shared; /* among threads */
} kinds[PS_NUM_HOST_KINDS] = {
    [PS_HOST_START] = {"start", false},   [PS_HOST_MEMORY] = {"memory", false},
    [PS_HOST_TEXT] = {"text", false},     [PS_HOST_BINARY] = {"binary", false},
    [PS_HOST_SCALAR] = {"scalar", false}, [PS_HOST_REFEREE] = {"referee", false},
    [PS_HOST_SUMS] = {"sums", true},      [PS_HOST_POWERS] = {"powers", true},
    [PS_HOST_DENSE] = {"dense", true},
};

const char *ps_host_kind_name(ps_host_kind kind) {
    return kinds[kind].name;
}

static double seconds_by(const ps_figures *figures, ps_host_kind kind, double seconds,
                         double threads) {
    return seconds / threads * ps_figures_host_scale(figures, kinds[kind].name);
}

double ps_host_seconds(const ps_figures *figures, ps_host_kind kind, double seconds) {
    return seconds_by(figures, kind, seconds, kinds[kind].is_shared ? ps_workers_most() : 1);
}

double ps_host_seconds_of_sets(const ps_figures *figures, ps_host_kind kind, double things,
                               double each, double sets) {
    const double threads = ps_workers_most();
    const bool is_shared = kinds[kind].is_shared && threads > 1 && things >= PS_WORKERS_LEAST;
    return is_shared
               ? sets * (seconds_by(figures, kind, things * each, threads) + PS_WORKERS_SECONDS)
               : seconds_by(figures, kind, things * each * sets, 1);
}
