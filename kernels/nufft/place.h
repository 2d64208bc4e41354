/* Sorted points: what kernels/nufft/ agrees on with host/engines/nufft_*.c.
 *
 * The places of a realization are its points in the order of cells, and empty ones up to a multiple of
 * PLACE_UNIT: their windows are zero.
 *
 * Window values of a place are [pitch] numbers: GAP zeros, `width` values, zeros up to the pitch, at least GAP.
 * Two neighbours up to GAP cells apart can then be added in one go.
 */
#ifndef PS_NUFFT_PLACE_H
#define PS_NUFFT_PLACE_H

#define PLACE_UNIT 16
#define NO_POINT 0xFFFFFFFFu
#define GAP 4

#endif
