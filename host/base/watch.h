/* How long work says what it is doing, and hears that it should stop: by a call of whoever asked
 * for it.
 *
 * A job passes one watch down to every phase that can take more than a tenth of a second. A phase
 * tells it at least ten times a second, from the thread that runs the job; tasks on other threads
 * do a bounded piece of work at a time and return to that thread between two.
 */
#ifndef PS_BASE_WATCH_H
#define PS_BASE_WATCH_H

#include "base/status.h"

#include <stdint.h>

/* What is being done, as the public callback hears it: of total things, 0 when nobody knows how
 * many, done are done. */
typedef pspec_progress_report ps_watch_report;

/* What a phase counts, the end of its name: "passes" of "sampler: fpo, passes". */
const char *ps_watch_things(const char *phase);

typedef struct ps_watch {
    int (*tell)(const ps_watch_report *report, void *payload); /* not 0: stop */
    void *payload;
} ps_watch;

/* Tells the watch, which may be NULL; PSPEC_ERROR_CANCELLED with a sentence when it asks to stop.
 */
pspec_status ps_watch_tell(const ps_watch *watch, const char *phase, uint64_t done, uint64_t total,
                           const char *detail, ps_error *error) PS_MUST_CHECK;

#endif
