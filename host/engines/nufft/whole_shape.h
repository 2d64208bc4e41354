/* The lengths of the two transforms of realizations that one work-group does whole, by what they
 * cost.
 */
#ifndef PS_ENGINES_NUFFT_WHOLE_SHAPE_H
#define PS_ENGINES_NUFFT_WHOLE_SHAPE_H

#include "engines/nufft/choice.h"

/* Gives a choice whose axes have grids the lengths of the transforms, and the span of axis 0. False
 * where the cache of a core is too small for it. */
bool ps_nufft_whole_shape(ps_nufft_choice *choice, ps_precision precision);

#endif
