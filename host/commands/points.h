/* The commands that make point files: sample, which writes realizations of the only sampler, one of
 * them in memory at a time, and draws the first, and convert, which writes the sets of all files
 * into one, a block of points at a time, and draws the first. Without an output the first of every
 * sampler or file is only drawn. hooks->warn hears what the format could not keep, hooks->watch of
 * realizations or points. */
#ifndef PS_COMMANDS_POINTS_H
#define PS_COMMANDS_POINTS_H

#include "answers/kind.h"

pspec_status ps_points_sample(const ps_request *request, const ps_answer_hooks *hooks,
                              ps_error *error) PS_MUST_CHECK;
pspec_status ps_points_convert(const ps_request *request, const ps_answer_hooks *hooks,
                               ps_error *error) PS_MUST_CHECK;
/* Refuses files, no sampler, and several samplers or numbers of points unless these may be. */
pspec_status ps_points_check_words(const ps_request *request, bool may_be_several,
                                   ps_error *error) PS_MUST_CHECK;
/* What the only sampler of the request is asked for. Refuses files, none, and several. */
pspec_status ps_points_find_sampler(ps_sampler_request *out, const ps_request *request,
                                    ps_error *error) PS_MUST_CHECK;

/* What they would take. */
pspec_status ps_points_plan_sample(ps_planner *planner, const ps_request *request,
                                   ps_error *error) PS_MUST_CHECK;
pspec_status ps_points_plan_convert(ps_planner *planner, const ps_request *request,
                                    ps_error *error) PS_MUST_CHECK;

#endif
