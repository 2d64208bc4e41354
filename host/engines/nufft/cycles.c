#include "engines/nufft/cycles.h"

/* Zen 5, PoCL 3.1, 2026-11: profiles of bench_nufft, of kernels with parts left out in turn, and
 * transforms of lengths 392, 512 and 1024 (5800, 6100, 12600 cycles). `./dev bench calibrate`
 * measures all of them on another device and prints this table. Vectors are of as many numbers as
 * the device has lanes. */
const double ps_nufft_cycles[PS_NUFFT_NUM_PARTS] = {
    /* transforms: an operation on vectors; a cell on its way through a pass */
    [PS_NUFFT_OPERATION] = 0.27,
    [PS_NUFFT_PASSED] = 0.8,
    /* tiles: a point to be sorted; its phases, once for all tiles whose rows are in local memory
     * together, and its windows, where a fused operation makes a value of a vector of points; a
     * point in a tile, and a cell that it touches there; a cell cleared; a frequency written */
    [PS_NUFFT_SORTED] = 8,
    [PS_NUFFT_PHASE] = 13,
    [PS_NUFFT_COEFFICIENT] = 0.5,
    [PS_NUFFT_VALUE] = 2.5,
    [PS_NUFFT_TOUCHED] = 1,
    [PS_NUFFT_CLEARED] = 2.3,
    [PS_NUFFT_POWER] = 12,
    /* grids of large sets: four bytes of a cell cleared and fetched by the transform, and taken
     * into pairs for every chunk */
    [PS_NUFFT_GRID_CELL] = 5,
    [PS_NUFFT_GRID_PAIR] = 1,
    /* boxes of large sets (Zen 4, where tiles take 1.6 times what the table says; so much less is
     * here than was measured): a point on its way to a box, 32 bytes of a row of it, and four bytes
     * of a cell cleared and added to the grid for every chunk */
    [PS_NUFFT_BOX_POINT] = 30,
    [PS_NUFFT_BOX_ROW] = 1.4,
    [PS_NUFFT_BOX_CELL] = 0.6,
    /* whole realizations (4096 points and K = 64 in the plane): a point to be placed; a vector of
     * polynomials, mirrored ones half; a vector added to a row in the nearest cache, and beyond; a
     * column of cells fetched, and a vector turned into a tile, a quarter; a cell of a lane put
     * into a shared tile; a vector of powers written; a vector of the grid cleared */
    [PS_NUFFT_WHOLE_POINT] = 7,
    [PS_NUFFT_WHOLE_POLYNOMIAL] = 0.45,
    [PS_NUFFT_WHOLE_ROW] = 1.5,
    [PS_NUFFT_WHOLE_FAR_ROW] = 2.5,
    [PS_NUFFT_WHOLE_CELL] = 3,
    [PS_NUFFT_WHOLE_TURNED] = 21,
    [PS_NUFFT_WHOLE_SHARED] = 15,
    [PS_NUFFT_WHOLE_POWER] = 12,
    [PS_NUFFT_WHOLE_CLEARED] = 1,
    /* strips, which are made of the parts of whole realizations (Zen 4): four bytes of tiles that
     * are too many for a cache */
    [PS_NUFFT_STRIP_FAR] = 1.5,
    /* the grid of GPUs, as if it were cores: a nominal one does 64 operations in a cycle, so
     * that an H200 (62 TFLOP/s in single precision) is at its peak with a cycle in a picosecond.
     * Prototypes on an H200 (single, 2026-11). A point sorted (10^7 in 1.05 ms), spread with a
     * part for its windows and one for each 64 cells (16.5 G points/s at windows of 6); four
     * bytes written or read (3.3 TB/s); an operation of transforms, an estimate of what memory
     * does not hide (2304 x 2304 took 84 microseconds in all) */
    [PS_NUFFT_GPU_SORTED] = 105,
    [PS_NUFFT_GPU_POINT] = 20,
    [PS_NUFFT_GPU_STEP] = 40,
    [PS_NUFFT_GPU_WORD] = 1.2,
    [PS_NUFFT_GPU_OPERATION] = 0.04,
};

unsigned ps_nufft_nominal_lanes(ps_precision precision) {
    return precision == PS_SINGLE ? 16 : 8;
}
