/* Runs of scenes with a progress line, warnings and interrupts. */
#ifndef PS_CLI_RUN_SHOWN_H
#define PS_CLI_RUN_SHOWN_H

#include "scene/run/run.h"

/* Warnings go to standard error unless the arguments are quiet; nothing shows progress yet. */
ps_run_hooks ps_run_hooks_make(const ps_request *arguments);
/* ps_run_answer of a run with these hooks, with a progress line. */
pspec_status ps_run_answer_shown(ps_run *run, ps_error *error) PS_MUST_CHECK;

#endif
