/* What the parts of a fast transform of scattered points cost, one table for torus and sphere.
 * Nominal figures of one CPU and of one GPU, whatever the device, so that choices depend on nothing
 * else.
 */
#ifndef PS_ENGINES_NUFFT_CYCLES_H
#define PS_ENGINES_NUFFT_CYCLES_H

#include "device/precision.h"

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
    PS_NUFFT_GRID_CELL,
    PS_NUFFT_GRID_PAIR,
    PS_NUFFT_BOX_POINT,
    PS_NUFFT_BOX_ROW,
    PS_NUFFT_BOX_CELL,
    PS_NUFFT_WHOLE_POINT,
    PS_NUFFT_WHOLE_POLYNOMIAL,
    PS_NUFFT_WHOLE_ROW,
    PS_NUFFT_WHOLE_FAR_ROW,
    PS_NUFFT_WHOLE_CELL,
    PS_NUFFT_WHOLE_TURNED,
    PS_NUFFT_WHOLE_SHARED,
    PS_NUFFT_WHOLE_POWER,
    PS_NUFFT_WHOLE_CLEARED,
    PS_NUFFT_STRIP_FAR,
    PS_NUFFT_PARTS_OF_CPUS, /* how many they are; those of GPUs follow */
    PS_NUFFT_GPU_SORTED = PS_NUFFT_PARTS_OF_CPUS,
    PS_NUFFT_GPU_POINT,
    PS_NUFFT_GPU_STEP,
    PS_NUFFT_GPU_WORD,
    PS_NUFFT_GPU_OPERATION,
    PS_NUFFT_NUM_PARTS
} ps_nufft_part;

/* Cycles of a core for one of each: of a CPU, and of a GPU as if it were cores. */
extern const double ps_nufft_cycles[PS_NUFFT_NUM_PARTS];

/* Lanes of a wide CPU, to choose for where there is no device, and on GPUs. */
unsigned ps_nufft_nominal_lanes(ps_precision precision);

#endif
