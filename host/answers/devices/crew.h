/* Several devices that answer the parts of a job (answers/parts/parts.h), each by a thread of its
 * own, which takes the next part when it is done with one.
 *
 * A device that fails is dropped with a warning, and its part is answered by another: the job fails
 * with the last device, or with what no device can mend. Who answers a part makes no difference to
 * its bits on devices of one kind. */
#ifndef PS_ANSWERS_DEVICES_CREW_H
#define PS_ANSWERS_DEVICES_CREW_H

#include "answers/parts/parts.h"
#include "device/choice.h"

/* What the parts are of. */
typedef struct ps_crew_task {
    const ps_kind *kind;
    const ps_request *request;
    const ps_answer_hooks *hooks; /* called by the thread of who calls alone; its device, if there
                                     is one, is the first of the selectors */
    const ps_selectors *selectors;
    const char *device;        /* what the answer calls them */
    uint64_t num_realizations; /* of all parts */
    uint64_t num_parts;
    unsigned num_jobs; /* of a part, one after the other */
} ps_crew_task;

/* What there is of a part; {0} before, freed by ps_answer_free and ps_part_end, also after an
 * error. */
typedef struct ps_crew_part {
    ps_part part;
    ps_answer answer;
} ps_crew_part;

/* Is that what another device may do better? */
bool ps_crew_is_of_device(pspec_status status);

/* The answers of all parts[num_parts], in order. */
pspec_status ps_crew_answer(ps_crew_part *parts, const ps_crew_task *task,
                            ps_error *error) PS_MUST_CHECK;

#endif
