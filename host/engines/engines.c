/* The table of engines. */
#include "engines/engine.h"
#include "engines/host/host_direct.h"
#include "engines/pairs/pairs_direct.h"
#include "engines/pairs/pairs_histogram.h"
#include "engines/sphere/nufft/sphere_nufft.h"
#include "engines/sphere/sphere_direct.h"
#include "engines/torus/nufft/torus_nufft.h"
#include "engines/torus/torus_direct.h"

const ps_engine *const ps_engines[] = {&ps_torus_nufft,     &ps_torus_direct,  &ps_sphere_grid,
                                       &ps_sphere_nufft,    &ps_sphere_direct, &ps_pairs_direct,
                                       &ps_pairs_histogram, &ps_host_direct,   NULL};
