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
};

/* The parts of the variants that serve GPUs, in the same unit: a nominal core does 64 operations in
 * a cycle in single precision and 32 in double, so that an H200 (60 TFLOP/s) is at its peak with a
 * cycle in 0.96 ps. Parts of 0 are in others, or in variants that GPUs do not have. A variant for
 * GPUs counts parts of its own and has its figures here. */
const double ps_nufft_gpu_cycles[PS_NUFFT_NUM_PARTS] = {
    /* tiles, measured on an H200 at (N, K) = (256, 32) to (16384, 512) in the plane: 240 to 360 ps
     * for a point in a tile of four frequencies or two, of which a nominal one has four, whatever
     * else is done: items wait for each other while a chunk of points is spread. Half of it is laid
     * on the cells that are touched, so that wide windows are not free. Transforms: 1.4 TFLOP/s, an
     * estimate between spreading's 0.3 and what transforms of prototypes reached. */
    [PS_NUFFT_VALUE] = 500,
    [PS_NUFFT_TOUCHED] = 60,
    [PS_NUFFT_OPERATION] = 12,
    /* sorts: 10^7 points in 1.5 ms, by a prototype of the same passes (1.05 ms) and one pass more
     * over the points */
    [PS_NUFFT_SORTED] = 157,
    /* large sets: kernels of an H200 without the sort took 25 ms for (1e7, 1024) in the plane and
     * 15 for (1e6, 64) in space, on grids of 4608 x 5120 and 320 x 256 x 320 cells; (65536, 1024)
     * took 1.05 ms on 2560^2 in double precision, a third of which is laid on the cells. Clearing,
     * halos and pairs of numbers by their bytes at 2.9 TB/s, which sums over realizations of a
     * prototype reached. */
    [PS_NUFFT_BOX_ROW] = 200,
    [PS_NUFFT_BOX_CELL] = 3,
    [PS_NUFFT_GRID_CELL] = 30,
    [PS_NUFFT_GRID_PAIR] = 6,
};

unsigned ps_nufft_nominal_lanes(ps_precision precision) {
    return precision == PS_SINGLE ? 16 : 8;
}
