/* Commands that make point files, with a progress line and what was lost on standard error. */
#ifndef PS_CLI_POINTS_SHOWN_H
#define PS_CLI_POINTS_SHOWN_H

#include "results/points.h"

typedef pspec_status ps_make_points(const ps_request *request, const ps_answer_hooks *hooks,
                                    ps_error *error);

/* counted: what the progress line counts. */
pspec_status ps_points_make_shown(ps_make_points *make, const char *command, const char *counted,
                                  const ps_request *arguments, ps_error *error) PS_MUST_CHECK;

#endif
