/* Point sets of others behind one interface: what bench/blue_noise/peers.sh builds and
 * bench_blue_noise times.
 */
#ifndef BENCH_BLUE_NOISE_PEERS_H
#define BENCH_BLUE_NOISE_PEERS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Writes points [..][2] of the torus [0,1)^2 and returns how many, about num and at most twice
 * that. points holds num uniform ones before, for those that begin with points of others. */
typedef size_t (*peer_sampler)(size_t num, double parameter, uint64_t set, double *points);

/* Farthest-point optimisation to the least distance 0.925, with which its source is written. */
size_t peer_fpo(size_t num, double distance, uint64_t set, double *points);
/* From the points, to eps; regular patches stay as they are, as in ours. */
size_t peer_bnot(size_t num, double eps, uint64_t set, double *points);
/* num darts of a radius in units of hexagonal packing's distance. */
size_t peer_darts(size_t num, double relative_radius, uint64_t set, double *points);
/* Points of a radius until no place is left (Dunbar and Humphreys 2006, "pure"). */
size_t peer_fast_poisson(size_t num, double radius, uint64_t set, double *points);

#ifdef __cplusplus
}
#endif

#endif
