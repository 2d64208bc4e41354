/* Things that threads make ahead, and that one caller takes in their order.
 *
 * There is room for num_slots things: those that are made already, the one that was taken last, and
 * those in the making. What becomes of a thing must not depend on who makes it, and when.
 */
#ifndef PS_SETS_AHEAD_H
#define PS_SETS_AHEAD_H

#include "base/watch.h"

typedef struct ps_ahead ps_ahead;

/* The phase of a wait for a thing whose maker has said nothing yet. */
#define PS_AHEAD_WAITS "realizations"

typedef struct ps_ahead_plan {
    /* Makes thing `index` in room `slot`; while it works it tells the watch, which asks it to stop
     * where nobody waits any more. Several threads call it, each with a slot of its own. */
    pspec_status (*make)(void *payload, uint64_t index, unsigned slot, const ps_watch *watch,
                         ps_error *error);
    void *payload;
    uint64_t num_things;  /* 0 .. num_things - 1 */
    unsigned num_slots;   /* at least 1 */
    unsigned num_threads; /* at most num_slots; 0, or none to be had: the caller makes things
                             himself, when he asks for them */
} ps_ahead_plan;

pspec_status ps_ahead_create(ps_ahead **out, const ps_ahead_plan *plan,
                             ps_error *error) PS_MUST_CHECK;

/* Waits for the next thing, which is in room *slot until the next call. Meanwhile the watch, which
 * may be NULL, hears what the thread that makes it says, ten times a second. The error of a thing
 * is that of the call that should have taken it; it can be asked for again, but will not be made
 * again. No call may follow that of the last thing. */
pspec_status ps_ahead_next(ps_ahead *ahead, const ps_watch *watch, unsigned *slot,
                           ps_error *error) PS_MUST_CHECK;

/* Asks threads that are at work to stop, and waits until they have. NULL is allowed. */
void ps_ahead_destroy(ps_ahead *ahead);

#endif
