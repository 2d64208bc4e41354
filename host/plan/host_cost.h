/* Seconds of what the host does beside the engines, from counts of work: the host's part of the
 * cost model. Nothing is chosen by it: it is for the seconds that plan prints. */
#ifndef PS_PLAN_HOST_COST_H
#define PS_PLAN_HOST_COST_H

#include "device/figures.h"

#include <stdbool.h>

/* Kinds of work; what one unit of each is stands in host_cost.c. */
typedef enum ps_host_kind {
    /* beginning */
    PS_HOST_START,
    PS_HOST_DRIVER,
    PS_HOST_KERNEL,
    PS_HOST_MEMORY,
    /* points of samplers, besides what their rows say */
    PS_HOST_LIFT,
    PS_HOST_MOVE,
    PS_HOST_MORPH,
    /* files of points */
    PS_HOST_READ_TEXT,
    PS_HOST_READ_BINARY,
    PS_HOST_INFLATE,
    PS_HOST_WRITE_TEXT,
    PS_HOST_WRITE_BINARY,
    PS_HOST_CHECK_POINTS,
    /* spectra */
    PS_HOST_FREQUENCY,
    PS_HOST_LISTED,
    PS_HOST_COUNT,
    PS_HOST_ACCUMULATE,
    PS_HOST_SHIFTS,
    PS_HOST_TURNS,
    PS_HOST_REFEREE,
    PS_HOST_REFEREE_DEGREE,
    PS_HOST_ZONAL,
    PS_HOST_SCATTER,
    /* quadrature */
    PS_HOST_LOBE,
    PS_HOST_KAPPA,
    PS_HOST_PAIR,
    PS_HOST_PAIR_POWER,
    PS_HOST_HEMISPHERE,
    PS_HOST_CHOLESKY,
    PS_HOST_MATRIX,
    PS_HOST_MATRIX_POWER,
    PS_HOST_SOLVE,
    PS_HOST_NEIGHBOURS,
    PS_HOST_INVERSE,
    PS_HOST_PRODUCT,
    PS_HOST_PRODUCT_POWER,
    /* results */
    PS_HOST_ROW,
    PS_HOST_ARRAY,
    PS_HOST_CURVE,
    PS_HOST_PICTURE,
    PS_NUM_HOST_KINDS
} ps_host_kind;

/* "lift", for files of figures and tables. */
const char *ps_host_kind_name(ps_host_kind kind);

/* Estimates the seconds of so many units; figures: what was measured of this host, NULL: nothing.
 * Work that is shared out among threads is divided by the processors of this machine. */
double ps_host_seconds(const ps_figures *figures, ps_host_kind kind, double units);

/* The same for sets of so many units each, which are shared out one set at a time: few units are
 * left to one thread, and for many the threads are started for every set (ps_workers_share). */
double ps_host_seconds_of_sets(const ps_figures *figures, ps_host_kind kind, double units,
                               double sets);

/* How many times longer than built in a referee's sum takes on this host, in the engine host_direct
 * as in the self-check. */
double ps_host_referee_scale(const ps_figures *figures, bool is_of_degrees);

#endif
