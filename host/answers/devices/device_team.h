/* Several devices whose threads are the members of a team (base/process/team.h): for kinds whose
 * realizations are rows (jobs/rows/row_stream.h).
 *
 * Where a device fails, those that are left begin anew, or behind the checkpoint, with a warning.
 */
#ifndef PS_ANSWERS_DEVICES_DEVICE_TEAM_H
#define PS_ANSWERS_DEVICES_DEVICE_TEAM_H

#include "answers/kind.h"
#include "device/choice.h"

typedef struct ps_device_team_task {
    /* ps_answer_make or ps_answer_produce, of every member */
    pspec_status (*answer)(ps_answer *out, const ps_kind *kind, const ps_request *request,
                           const ps_answer_hooks *hooks, ps_error *error);
    const ps_kind *kind;
    const ps_request *request;
    const ps_answer_hooks *hooks; /* called by the thread of who calls alone, whose device, if there
                                     is one, is the first of the selectors */
    const ps_selectors *selectors;
    const char *device; /* what the answer calls them */
} ps_device_team_task;

/* *out is freed by ps_answer_free, also after an error. */
pspec_status ps_device_team_answer(ps_answer *out, const ps_device_team_task *task,
                                   ps_error *error) PS_MUST_CHECK;

#endif
