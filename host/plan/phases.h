/* What a job is made of besides the sums of its engine, and how long each part of it takes: what
 * plan prints. Nothing is chosen by it. What a piece of work takes stands beside the formula that
 * counts it, in seconds of one core of the machine of phases.c. */
#ifndef PS_PLAN_PHASES_H
#define PS_PLAN_PHASES_H

#include "base/status.h"
#include "device/figures.h"

typedef struct ps_phase_cost {
    const char *name; /* "points"; static storage */
    char what[96];    /* "200000 points of white-sphere" */
    double seconds;
    bool is_at_most; /* what iterates until it is good enough */
} ps_phase_cost;

enum { PS_MAX_PHASES = 16 };

/* What is there already from jobs before in the same process. */
typedef struct ps_begun {
    bool program, driver;
    unsigned engines; /* bits of those whose kernels are loaded */
} ps_begun;

typedef struct ps_phases {
    const ps_figures *host; /* what was measured of this host; NULL: nothing */
    ps_begun *begun;        /* NULL: this job is the first and the last */
    size_t num;
    ps_phase_cost list[PS_MAX_PHASES];
} ps_phases;

/* Work of so many seconds becomes a phase, or more of the phase of that name, whose `what` stays;
 * nothing for no seconds. */
void ps_phases_add(ps_phases *phases, const char *name, double seconds);
/* The same of sets of so many things each, which take `each` seconds and are shared out among the
 * threads of this machine one set at a time: few things are left to one thread, and for many the
 * threads are started for every set (ps_workers_share). */
void ps_phases_share(ps_phases *phases, const char *name, double things, double each, double sets);
/* The same of seconds of this machine. */
void ps_phases_add_seconds(ps_phases *phases, const char *name, double seconds);
/* Adds the time that the system takes for memory of so many bytes, when they are touched for the
 * first time. */
void ps_phases_touch(ps_phases *phases, double bytes);
/* Adds rows of tables to the phase "results". */
void ps_phases_tabulate(ps_phases *phases, double rows);
/* Adds so many pictures, which gnuplot draws. */
void ps_phases_draw(ps_phases *phases, const char *name, size_t num);
/* Describes the phase of that name, if there is one; longer texts are cut. */
void ps_phases_say(ps_phases *phases, const char *name, const char *format, ...) PS_PRINTF(3, 4);
/* The phase of that name may end sooner. */
void ps_phases_limit(ps_phases *phases, const char *name);

double ps_phases_seconds(const ps_phases *phases);
bool ps_phases_are_at_most(const ps_phases *phases);

#endif
