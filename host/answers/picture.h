/* The picture of an answer (--plot): it comes after the numbers, and costs none when it fails. */
#ifndef PS_ANSWERS_PICTURE_H
#define PS_ANSWERS_PICTURE_H

#include "answers/kind.h"

/* Is the picture all that was asked for: the output goes to /dev/null, and there is no other file?
 * keeps_answer: what is written nowhere is kept by who asked for it. */
bool ps_picture_is_all(const ps_request *request, bool keeps_answer);

/* What --plot-log and --plot-range say together: no logarithmic axis begins at 0 or below. */
pspec_status ps_picture_check_axes(const ps_plot_axes *axes, ps_error *error) PS_MUST_CHECK;

/* Before the work: can the ending be drawn, and is there gnuplot? Without it a warning, or an error
 * where the picture is all. */
pspec_status ps_picture_check(const ps_request *request, bool is_all, const ps_answer_hooks *hooks,
                              ps_error *error) PS_MUST_CHECK;

/* The picture request->plot, of the table of an answer; pictures: those of its kind. */
pspec_status ps_picture_draw(const ps_picture_kind *pictures, const ps_request *request,
                             const ps_table *table, ps_error *error) PS_MUST_CHECK;

/* After the numbers: what drawing came to, as what the answer comes to. A failure becomes a
 * warning, except for an interruption and where the picture is all. */
pspec_status ps_picture_settle(const ps_request *request, bool is_all, const ps_answer_hooks *hooks,
                               pspec_status drawn, ps_error *error) PS_MUST_CHECK;

#endif
