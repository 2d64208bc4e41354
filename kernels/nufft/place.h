/* Sorted points: what kernels/nufft/ agrees on with host/engines/nufft/axis.h.
 *
 * The places of a realization are its points in the order of cells, and points without weight up to
 * a multiple of PLACE_UNIT.
 *
 * Window values of a place are [pitch] numbers: GAP zeros, `width` values, zeros up to the pitch,
 * at least GAP. Neighbours up to GAP cells apart can then be added in one go. Vectors hold the same
 * number of LANES places.
 */
#ifndef PS_NUFFT_PLACE_H
#define PS_NUFFT_PLACE_H

#define PLACE_UNIT 16
#define GAP 4

/* Points that are spread together; PLACE_UNIT is a multiple of it, and LANES divides it. */
#define CHUNK 16

#endif
