/* --plot of commands that make point files. */
#ifndef PS_COMMANDS_POINTS_DRAWING_H
#define PS_COMMANDS_POINTS_DRAWING_H

#include "answers/kind.h"
#include "answers/points/points.h"

/* Before the work: can the picture be drawn and written, is it no other file of the request? */
pspec_status ps_points_drawing_check(const ps_request *request, const ps_answer_hooks *hooks,
                                     ps_error *error) PS_MUST_CHECK;
/* Adds a set of a file: points of the sphere none of which is below the equator are those of a
 * hemisphere. */
pspec_status ps_points_draw_file(ps_points_picture *picture, const char *path,
                                 const ps_point_set *set, const ps_watch *watch,
                                 ps_error *error) PS_MUST_CHECK;
/* Draws what was added to the picture, after the points are written: a failure is then told, and no
 * error. */
pspec_status ps_points_draw(const ps_points_picture *picture, const ps_request *request,
                            const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

#endif
