#include "plan/host_cost.h"

#include "base/workers.h"

#include <stdbool.h>

/* Seconds of a unit on one core. Machine: 2 cores of a Zen 5 EPYC (AVX-512) at a nominal 2.6 GHz,
 * Debian 12, 2026-11; the machine is shared. `pointspec bench --calibrate` measures them on the
 * machine at hand as multiples of these, as usual as its runs are. */
static const struct {
    const char *name;
    double seconds;
    bool is_shared; /* among threads */
} kinds[PS_NUM_HOST_KINDS] = {
    [PS_HOST_START] = {"start", 2.2e-3, false},   /* process and libraries, once */
    [PS_HOST_DRIVER] = {"driver", 32e-3, false},  /* OpenCL's and its compiler's libraries, once */
    [PS_HOST_KERNEL] = {"kernel", 34e-3, false},  /* a kernel that the driver's cache has */
    [PS_HOST_MEMORY] = {"memory", 0.5e-9, false}, /* a byte that is touched for the first time */

    [PS_HOST_LIFT] = {"lift", 40e-9, false},   /* a point, to the sphere */
    [PS_HOST_MOVE] = {"move", 3e-9, false},    /* a point, shifted or rotated */
    [PS_HOST_MORPH] = {"morph", 30e-9, false}, /* a point, to a lobe's density */

    [PS_HOST_READ_TEXT] = {"read-text", 0.85e-9, false},     /* a byte */
    [PS_HOST_READ_BINARY] = {"read-binary", 0.15e-9, false}, /* a byte */
    [PS_HOST_INFLATE] = {"inflate", 3e-9, false},            /* a byte of what comes out */
    [PS_HOST_WRITE_TEXT] = {"write-text", 40e-9, false},     /* a number */
    [PS_HOST_WRITE_BINARY] = {"write-binary", 6e-9, false},  /* a number */
    [PS_HOST_CHECK_POINTS] = {"check-points", 20e-9, false}, /* a point */

    [PS_HOST_FREQUENCY] = {"frequency", 70e-9, false}, /* of a grid: its bin and its mean */
    [PS_HOST_LISTED] = {"listed", 300e-9, false},      /* of a random subset */
    [PS_HOST_COUNT] = {"count", 0.3e-9, false},        /* a step of counting the points of rings */
    [PS_HOST_ACCUMULATE] = {"accumulate", 0.5e-9, true}, /* a power of a realization */
    [PS_HOST_SHIFTS] = {"shifts", 85e-9, false}, /* a number of a grid, for products of a set */
    [PS_HOST_TURNS] = {"turns", 3.3e-9, false},  /* a node, a degree and an order, for the same */
    [PS_HOST_REFEREE] = {"referee", 190e-9, false}, /* a point and a frequency */
    [PS_HOST_REFEREE_DEGREE] = {"referee-degree", 20e-9,
                                false},      /* a point, a degree and an order */
    [PS_HOST_ZONAL] = {"zonal", 1e-9, true}, /* a point and a degree */

    [PS_HOST_SCATTER] = {"scatter", 200e-9,
                         false}, /* a point, on a grid that is larger than caches */

    [PS_HOST_LOBE] = {"lobe", 3.5e-8, false},           /* a coefficient of a lobe */
    [PS_HOST_KAPPA] = {"kappa", 0.4e-9, true},          /* a point and a degree */
    [PS_HOST_PAIR] = {"pair", 1.1e-9, true},            /* of points: their distance */
    [PS_HOST_PAIR_POWER] = {"pair-power", 4e-9, true},  /* and a power of it */
    [PS_HOST_HEMISPHERE] = {"hemisphere", 2e-9, false}, /* a degree of each kind of harmonics */
    [PS_HOST_CHOLESKY] = {"cholesky", 1.25e-11, true},  /* an operation */
    [PS_HOST_MATRIX] = {"matrix", 14e-9, true},         /* an entry, made and summed */
    [PS_HOST_MATRIX_POWER] = {"matrix-power", 19e-9, true},
    [PS_HOST_SOLVE] = {"solve", 8e-9, false},            /* an entry, of condition and solutions */
    [PS_HOST_NEIGHBOURS] = {"neighbours", 0.6e-9, true}, /* a pair of points, in the search */
    [PS_HOST_INVERSE] = {"inverse", 14e-6, true},        /* a point: its row of an inverse */

    [PS_HOST_PRODUCT] = {"product", 0.8e-9, true}, /* a pair, in a product by the device */
    [PS_HOST_PRODUCT_POWER] = {"product-power", 4e-9, true},

    [PS_HOST_ROW] = {"row", 3e-6, false},         /* of a table */
    [PS_HOST_ARRAY] = {"array", 60e-9, false},    /* a number of an array in a file */
    [PS_HOST_CURVE] = {"curve", 2e-6, false},     /* a point of a curve */
    [PS_HOST_PICTURE] = {"picture", 0.15, false}, /* by gnuplot */
};

const char *ps_host_kind_name(ps_host_kind kind) {
    return kinds[kind].name;
}

static double seconds_by(const ps_figures *figures, ps_host_kind kind, double units,
                         double threads) {
    return units * kinds[kind].seconds / threads * ps_figures_host_scale(figures, kinds[kind].name);
}

double ps_host_seconds(const ps_figures *figures, ps_host_kind kind, double units) {
    return seconds_by(figures, kind, units, kinds[kind].is_shared ? ps_workers_most() : 1);
}

double ps_host_seconds_of_sets(const ps_figures *figures, ps_host_kind kind, double units,
                               double sets) {
    const double threads = ps_workers_most();
    const bool is_shared = kinds[kind].is_shared && threads > 1 && units >= PS_WORKERS_LEAST;
    return is_shared ? sets * (seconds_by(figures, kind, units, threads) + PS_WORKERS_SECONDS)
                     : seconds_by(figures, kind, units * sets, 1);
}

double ps_host_referee_scale(const ps_figures *figures, bool is_of_degrees) {
    return ps_figures_host_scale(
        figures, kinds[is_of_degrees ? PS_HOST_REFEREE_DEGREE : PS_HOST_REFEREE].name);
}
