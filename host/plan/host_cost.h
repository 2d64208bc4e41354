/* Seconds of what the host does beside the engines: the host's part of the cost model. Nothing is
 * chosen by it: it is for the seconds that plan prints. What a piece of work takes stands beside
 * the formula that counts it, in seconds of one core of the machine of host_cost.c. */
#ifndef PS_PLAN_HOST_COST_H
#define PS_PLAN_HOST_COST_H

#include "device/figures.h"

/* Kinds of work, each of which is as a whole faster or slower on another machine. */
typedef enum ps_host_kind {
    PS_HOST_START,   /* programs and libraries that are started, kernels that the cache has */
    PS_HOST_MEMORY,  /* that is touched for the first time, or in no order */
    PS_HOST_TEXT,    /* numbers that are read or written as text */
    PS_HOST_BINARY,  /* bytes of other files and arrays, and checks of them */
    PS_HOST_SCALAR,  /* arithmetic and functions, one after the other */
    PS_HOST_REFEREE, /* sums in long double */
    PS_HOST_SUMS,    /* sums by all threads */
    PS_HOST_POWERS,  /* the same with a power of each term */
    PS_HOST_DENSE,   /* factors of matrices by all threads */
    PS_NUM_HOST_KINDS
} ps_host_kind;

/* "text", for files of figures and tables. */
const char *ps_host_kind_name(ps_host_kind kind);

/* Seconds here of work that takes so many on one core of the machine of host_cost.c; figures: what
 * was measured of this host, NULL: nothing. Work that is shared out among threads is divided by the
 * processors of this machine. */
double ps_host_seconds(const ps_figures *figures, ps_host_kind kind, double seconds);

/* The same for sets of so many things each, which take `each` seconds and are shared out one set at
 * a time: few things are left to one thread, and for many the threads are started for every set
 * (ps_workers_share). */
double ps_host_seconds_of_sets(const ps_figures *figures, ps_host_kind kind, double things,
                               double each, double sets);

#endif
