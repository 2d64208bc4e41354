/* The table of engines. */
#include "engines/engine.h"

const ps_engine *const ps_engines[] = {&ps_torus_nufft,     &ps_torus_direct,  &ps_sphere_grid,
                                       &ps_sphere_nufft,    &ps_sphere_direct, &ps_pairs_direct,
                                       &ps_pairs_histogram, &ps_host_direct,   NULL};
