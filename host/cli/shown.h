/* Work that a terminal sees: a progress line, warnings on standard error, interrupts. */
#ifndef PS_CLI_SHOWN_H
#define PS_CLI_SHOWN_H

#include "cli/command.h"

typedef struct ps_shown {
    const ps_request *arguments;
    const char *counted; /* what the progress line counts: "realizations" */
    const char *speaker; /* who says warnings: "pointspec" */
    /* What is made goes to the output while the line is shown: it would run into points on the same
     * terminal. */
    bool is_streamed;
    ps_progress *progress; /* NULL between two phases of the work */
} ps_shown;

/* shown must outlive the work. With --quiet there are no warnings, but what is missing is told. */
ps_answer_hooks ps_shown_hooks(ps_shown *shown);

/* Runs the command with these, and writes what they name. Differences that a check found are
 * PSPEC_ERROR_CHECK. */
pspec_status ps_shown_run(const ps_command *command, const ps_request *arguments,
                          ps_error *error) PS_MUST_CHECK;

#endif
