/* Outputs looked at before hours of work, not after: can they be written, is each a file of its
 * own? */
#ifndef PS_ANSWERS_OUTPUT_CHECK_H
#define PS_ANSWERS_OUTPUT_CHECK_H

#include "request/request.h"

/* Refuses outputs that would overwrite each other or an input, and those whose folder cannot be
 * written. Pipes and devices are not opened: somebody may be waiting at their other end. is_table:
 * --output is one, which as NPY has a file of column names beside it. An output NULL is none, and
 * "-" is standard output, whose place may be an input, too. */
pspec_status ps_outputs_check(const ps_request *arguments, bool is_table,
                              ps_error *error) PS_MUST_CHECK;

#endif
