/* The picture of a command (--plot): it comes after the numbers, and costs none when it fails. */
#ifndef PS_CLI_PICTURE_H
#define PS_CLI_PICTURE_H

#include "questions/request.h"

/* Before the work: can the ending be drawn, and is there gnuplot? Without it a warning, or an error where the picture is all
 * that was asked for: the table goes to /dev/null, and there is no other file. */
pspec_status ps_picture_check(const ps_request *arguments, ps_error *error) PS_MUST_CHECK;

/* After the numbers: what drawing came to, as what the command comes to. A failure becomes a warning, except for an
 * interruption and where the picture is all. */
pspec_status ps_picture_settle(const ps_request *arguments, pspec_status drawn,
                               ps_error *error) PS_MUST_CHECK;

#endif
