/* Which choice a problem gets: a search over variants, lengths and windows by their cost. A
 * function of the problem, the precision and the kind of device alone.
 */
#ifndef PS_ENGINES_TORUS_NUFFT_CHOOSE_H
#define PS_ENGINES_TORUS_NUFFT_CHOOSE_H

#include "engines/torus/nufft/choice.h"

/* The cheapest that keeps the tolerance; the most exact one when none does. num_axes == 0: rows
 * would be too long for any local memory. limits: lanes, and whether local memory is apart, as on
 * GPUs; NULL: it is not. */
ps_nufft_choice ps_nufft_choose(const ps_problem *problem, const ps_device_limits *limits,
                                ps_precision precision);
/* The same among these variants, ended by NULL. */
ps_nufft_choice ps_nufft_choose_among(const ps_nufft_variant *const *variants,
                                      const ps_problem *problem, const ps_device_limits *limits,
                                      ps_precision precision);

#endif
