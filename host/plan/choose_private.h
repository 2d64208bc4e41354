/* What choosing and refusing (choose.c, require.c) share. */
#ifndef PS_PLAN_CHOOSE_PRIVATE_H
#define PS_PLAN_CHOOSE_PRIVATE_H

#include "plan/choose.h"

/* The cheapest feasible one that there is room for; NULL: none. */
const ps_candidate *ps_plan_fitting(const ps_plan *plan);

/* Is a power at the floor further off than it may be? */
bool ps_plan_misses_floor(const ps_candidate *candidate);

#endif
