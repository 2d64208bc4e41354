/* Sizes that the torus kernels and their host agree on (host/engines/torus/ passes them).
 *
 *   LANES      frequencies in one vector, and in one tile of a table
 *   DIMENSION  of the points
 *   RUN        points summed in working precision before the sum goes into a pair: the error of a
 *              run grows with its length, the cost of the pairs falls with it. Products keep their
 *              pairs in memory (RUN), lists in registers (LIST_RUN), where they cost little
 */
#ifndef PS_TORUS_LAYOUT_H
#define PS_TORUS_LAYOUT_H

#ifndef DIMENSION
#define DIMENSION 2
#endif
/* Left factors of a grid, the first weighted_tiles of a table, look at the axes before LEFT_AXES
 * only and right ones at the rest (all at the same one in one dimension): elsewhere their
 * frequencies are zero. */
#ifndef LEFT_AXES
#define LEFT_AXES DIMENSION
#endif
#if LEFT_AXES < DIMENSION
#define RIGHT_BEGIN LEFT_AXES
#else
#define RIGHT_BEGIN 0
#endif
#ifndef RUN
#define RUN 32
#endif
#ifndef LIST_RUN
#define LIST_RUN 8
#endif

#endif
