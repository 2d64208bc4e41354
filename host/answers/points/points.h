/* What points of a sampler take, for whoever keeps them. */
#ifndef PS_ANSWERS_POINTS_POINTS_H
#define PS_ANSWERS_POINTS_POINTS_H

#include "samplers/sampler.h"

/* Of so many sets, and of what makes one of them. */
double ps_points_bytes(const ps_sampler_request *sampler, double num_sets);
/* So many sets are in memory at a time: PSPEC_ERROR_MEMORY where they take more than the limit in
 * bytes; 0: than this machine has left. */
pspec_status ps_points_check_memory(const ps_sampler_request *sampler, double num_sets,
                                    uint64_t limit, ps_error *error) PS_MUST_CHECK;

#endif
