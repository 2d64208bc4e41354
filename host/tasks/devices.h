/* What OpenCL offers here, and which device would be used. */
#ifndef PS_TASKS_DEVICES_H
#define PS_TASKS_DEVICES_H

#include "questions/request.h"
#include "results/kind.h"

/* A row for every device of every driver; the column "default" is 1 for the one that the request
 * would get. Where there is none the table is empty, and hooks->warn hears why. */
pspec_status ps_devices_tabulate(ps_table **out, const ps_request *request,
                                 const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

#endif
