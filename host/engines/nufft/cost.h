/* How many parts of each kind a realization of a choice has, and what that costs by the table of
 * cycles.h.
 */
#ifndef PS_ENGINES_NUFFT_COST_H
#define PS_ENGINES_NUFFT_COST_H

#include "engines/nufft/choice.h"
#include "engines/nufft/cycles.h"

typedef struct ps_nufft_counts {
    double num[PS_NUFFT_NUM_PARTS];
} ps_nufft_counts;

/* How many there are in one realization of num_points points. */
ps_nufft_counts ps_nufft_count(const ps_nufft_choice *choice, ps_precision precision,
                               double num_points);

/* What a device of its lanes would do at its peak while it works on one realization of num_points
 * points. */
double ps_nufft_flops(const ps_nufft_choice *choice, ps_precision precision, double num_points);

/* Cycles of the two transforms of a whole realization, to choose their lengths by. */
double ps_nufft_whole_transform_cycles(const ps_nufft_choice *choice);

#endif
