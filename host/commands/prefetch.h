/* pointspec sample --prefetch: sets of a sampler that are not kept yet are made, and kept. */
#ifndef PS_COMMANDS_PREFETCH_H
#define PS_COMMANDS_PREFETCH_H

#include "answers/kind.h"

/* Nothing is written but the store (sets/sets.h). hooks->warn hears how many sets there were and
 * how many were made, hooks->watch of realizations. What is done when the work ends early stays,
 * and is not done again. Samplers whose sets are not kept are PSPEC_ERROR_INVALID_ARGUMENT, more
 * sets than the store may have PSPEC_ERROR_MEMORY, a store that takes nothing PSPEC_ERROR_IO. */
pspec_status ps_points_prefetch(const ps_request *request, const ps_answer_hooks *hooks,
                                ps_error *error) PS_MUST_CHECK;
/* look_at_shares of the row: ranges of realizations, which share 0 then finds kept. */
pspec_status ps_points_look_at_shares(uint64_t *num, ps_error *why, const ps_request *request,
                                      ps_error *error) PS_MUST_CHECK;

#endif
