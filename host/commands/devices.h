/* What OpenCL offers here, and which device would be used. */
#ifndef PS_COMMANDS_DEVICES_H
#define PS_COMMANDS_DEVICES_H

#include "base/text.h"
#include "request/request.h"
#include "tables/table.h"

/* A row for every device of every driver; the column "default" is 1 for the one that the request
 * would get. Where there is none the table is empty, and the sentence why is appended to why_none:
 * to be said when nothing else failed. */
pspec_status ps_devices_tabulate(ps_table **out, ps_text *why_none, const ps_request *request,
                                 ps_error *error) PS_MUST_CHECK;

#endif
