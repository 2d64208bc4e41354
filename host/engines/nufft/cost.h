/* What the parts of a realization cost, in one table; how many of each there are in a choice. ps_nufft_flops
 * (nufft_choice.h) is the sum of the products.
 */
#ifndef PS_ENGINES_NUFFT_COST_H
#define PS_ENGINES_NUFFT_COST_H

#include "engines/nufft/choice.h"

typedef enum ps_nufft_part {
    PS_NUFFT_OPERATION,
    PS_NUFFT_PASSED,
    PS_NUFFT_SORTED,
    PS_NUFFT_PHASE,
    PS_NUFFT_COEFFICIENT,
    PS_NUFFT_VALUE,
    PS_NUFFT_TOUCHED,
    PS_NUFFT_CLEARED,
    PS_NUFFT_POWER,
    PS_NUFFT_GRID_BLOCK,
    PS_NUFFT_GRID_ROW,
    PS_NUFFT_GRID_CELL,
    PS_NUFFT_GRID_PAIR,
    PS_NUFFT_WHOLE_POINT,
    PS_NUFFT_WHOLE_POLYNOMIAL,
    PS_NUFFT_WHOLE_ROW,
    PS_NUFFT_WHOLE_FAR_ROW,
    PS_NUFFT_WHOLE_CELL,
    PS_NUFFT_WHOLE_TURNED,
    PS_NUFFT_WHOLE_SHARED,
    PS_NUFFT_WHOLE_POWER,
    PS_NUFFT_WHOLE_CLEARED,
    PS_NUFFT_NUM_PARTS
} ps_nufft_part;

/* Cycles of a core for one of each. */
extern const double ps_nufft_cycles[PS_NUFFT_NUM_PARTS];

typedef struct ps_nufft_counts {
    double num[PS_NUFFT_NUM_PARTS];
} ps_nufft_counts;

/* How many there are in one realization of num_points points. */
ps_nufft_counts ps_nufft_count(const ps_nufft_choice *choice, ps_precision precision,
                               double num_points);

/* Cycles of the two transforms of a whole realization, to choose their lengths by. */
double ps_nufft_whole_transform_cycles(const ps_nufft_choice *choice);

#endif
