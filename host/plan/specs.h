/* Parts of every question about point sets, as the option table fills them (request/options.c)
 * and the program, scenes and the C library hand them on: nested in the request, in the questions
 * of jobs, and in what decides about needs, so that a value is said once.
 */
#ifndef PS_PLAN_SPECS_H
#define PS_PLAN_SPECS_H

#include "plan/choose.h"
#include "plan/range.h"
#include "sets/sets.h"
#include "store/checkpoint.h"

/* How exact a result has to be, and what may be left out for that. */
typedef struct ps_accuracy_spec {
    double tolerance; /* of what, the question says */
    double floor;     /* powers down to it are right to 10 %; 0: none */
    /* relative, of every bin above the floor, at which realizations stop (spectra/sequential.h); 0:
     * all are done */
    double standard_error;
    bool no_skip;       /* what the question does not need is done all the same; symmetries stay */
    bool no_self_check; /* the referee recomputes nothing */
} ps_accuracy_spec;

/* Where the work is done, and in what memory. */
typedef struct ps_limits_spec {
    ps_plan_constraints constraints; /* engine, precision and memory that somebody asked for */
    const char *device;              /* selector (device/choice.h); NULL: the default */
    bool mixed;                      /* devices of different kinds may share a job */
    const char *cache_folder;        /* of what can be made again, such as figures; NULL: none */
    uint64_t kept_bytes;             /* what sets of samplers may take in it */
    bool profile;                    /* kernels are timed */
    ps_checkpoint_spec checkpoint;   /* of jobs that average realizations */
} ps_limits_spec;

/* Opens the device of the limits, or takes the one that is open, which may be NULL, unless there is
 * one already or no engine that may be chosen needs it. may_lack: without any device *out stays
 * NULL. *owns: *out is to be closed. */
pspec_status ps_limits_open_device(const ps_limits_spec *limits, ps_device *open, bool may_lack,
                                   ps_device **out, bool *owns, ps_error *error) PS_MUST_CHECK;
/* Where sets of samplers are kept, and in what memory they are made ahead: nowhere with no_skip. */
ps_sets_options ps_limits_sets(const ps_limits_spec *limits, bool no_skip);

#endif
