/* The planner: a loop over engines and precisions. Feasible first (it can do the problem, its error
 * is within the tolerance, its memory within the limit), then the cheapest; losers keep their
 * reason.
 *
 * What is chosen depends on the problem, the kind of device and the limit that somebody typed. What
 * memory is free at the moment makes batches smaller, or the job is refused: the same question has
 * the same bits on a busy machine.
 */
#ifndef PS_PLAN_CHOOSE_H
#define PS_PLAN_CHOOSE_H

#include "base/process/memory_limit.h"
#include "engines/engine.h"

typedef struct ps_candidate {
    const ps_engine *engine;
    ps_precision precision;
    bool is_excluded; /* by the constraints: --engine, --precision */
    bool is_applicable, is_feasible, is_chosen;
    double seconds, bytes, error; /* of the whole job; meaningful when applicable */
    /* the seconds of the built-in model, which decide: figures that were measured only change what
     * is said */
    double cost;
    double floor_error;  /* relative, of powers at the floor; 0 without one */
    double device_bytes; /* part of bytes in buffers of the device */
    /* part of bytes in the memory of the machine, where devices may have theirs, too */
    double host_bytes;
    double host_room; /* what there is of that; infinite when nobody looked */
    /* it may be chosen, but there is no room for it now, not even for one realization at a time */
    bool is_crowded;
    double programs; /* of kernels, which the driver loads, those of averages included */
    size_t batch;
    char reason[160]; /* one phrase: why chosen, why not */
} ps_candidate;

enum { PS_MAX_CANDIDATES = 16 };

typedef struct ps_plan {
    ps_memory_room room; /* that it was made for */
    size_t num_candidates;
    ps_candidate candidates[PS_MAX_CANDIDATES];
    const ps_candidate *chosen; /* NULL: nothing is feasible; points into candidates */
    /* on the sphere, of what would be feasible then; 0: none, or not needed */
    int32_t largest_degree;
    bool would_fit_subset; /* of every ring, which is on offer; false where it is not needed */
} ps_plan;

typedef struct ps_plan_constraints {
    const char *engine;    /* NULL: any */
    int precision;         /* a ps_precision, or -1: any */
    uint64_t memory_limit; /* bytes that somebody typed, which may change the engine; 0: none */
    /* What is free may shrink batches, or refuse what was chosen, but changes no choice. NULL:
     * nobody looked. */
    const ps_memory_room *room;
    unsigned offers; /* PS_OFFER_RINGS, .. (frequencies/frequencies.h), where there is too much */
    bool prefers_double; /* before any other precision, even where less is within the tolerance */
} ps_plan_constraints;

/* May an engine that these constraints leave need a device? */
bool ps_plan_may_need_device(const ps_plan_constraints *constraints);

/* The tolerance of S that both a tolerance and a floor ask for (floor 0: none): |dS| <= e sqrt(V)
 * with three times e still leaving a power of `floor` right to 10 %
 * (docs/mathematics/statistics.md#tolerance-of-a-floor: the relative error of a power P is 2 e /
 * sqrt(P)). */
double ps_plan_tolerance(double tolerance, double floor);
/* The loosest tolerance of S with which a standard error, relative, of powers down to `floor` means
 * what it says: the numerical error of such a power is at most a third of it, three times over, and
 * the powers are right to 10 %. */
double ps_plan_statistical_tolerance(double standard_error, double floor);

/* The name of an engine of that domain, or NULL; else PSPEC_ERROR_INVALID_ARGUMENT with the nearest
 * one. */
pspec_status ps_plan_check_engine(const char *name, unsigned domain, ps_error *error) PS_MUST_CHECK;

/* Fills *plan. limits is NULL without a device. An unknown engine name is
 * PSPEC_ERROR_INVALID_ARGUMENT with the nearest one; that nothing is feasible is not an error here
 * (see ps_plan_require). *plan must not be moved afterwards. */
pspec_status ps_plan_make(ps_plan *plan, const ps_problem *problem, const ps_device_limits *limits,
                          const ps_plan_constraints *constraints, ps_error *error) PS_MUST_CHECK;

/* The cheapest feasible candidate of that precision, or of any for precision < 0; NULL: there is
 * none. */
const ps_candidate *ps_plan_cheapest(const ps_plan *plan, int precision);

/* The cheapest feasible one that there is room for; NULL: none. */
const ps_candidate *ps_plan_fitting(const ps_plan *plan);

/* Is a power at the floor further off than it may be? */
bool ps_plan_misses_floor(const ps_candidate *candidate);

/* Fails when nothing is feasible: PSPEC_ERROR_TOLERANCE when only the tolerance stood in the way
 * (with the best error that can be reached), else PSPEC_ERROR_MEMORY or _INVALID_ARGUMENT;
 * PSPEC_ERROR_MEMORY, too, when there is no room for what was chosen. */
pspec_status ps_plan_require(const ps_plan *plan, const ps_problem *problem,
                             ps_error *error) PS_MUST_CHECK;

#endif
