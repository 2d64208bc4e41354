#include "engines/torus/nufft/variant.h"

const ps_nufft_variant *const ps_nufft_variants[] = {&ps_nufft_tiles,
                                                     &ps_nufft_large,
                                                     &ps_nufft_whole,
                                                     &ps_nufft_strips,
                                                     &ps_nufft_grid,
                                                     &ps_nufft_grid_chunks,
                                                     NULL};
