/* Pairs of near points of a set, on the unit torus or the sphere: nearest neighbours, how many
 * pairs there are at each distance, and how the number of points in a ball varies, over all places
 * where the ball may be (docs/user/measure.md). Distances on the sphere are chords.
 *
 * Lengths are in units of N^(-1/d), on the sphere of sqrt(4 pi / N): one point for each unit of
 * volume. Within the reach of the bins a white set has PS_NEAR_MEAN points about each.
 */
#ifndef PS_JOBS_MEASURE_NEAR_H
#define PS_JOBS_MEASURE_NEAR_H

#include "device/device.h"
#include "measures/near.h"

#define PS_NEAR_MEAN 80.0

typedef struct ps_near ps_near;

/* Beyond them the share that two balls have is no closed form that is worth its lines. */
enum { PS_NEAR_MOST_WINDOW_DIMENSION = 3 };

/* dimension: of the torus, or 3 with on_sphere. with_windows: the number variance is wanted, of at
 * most PS_NEAR_MOST_WINDOW_DIMENSION dimensions of the torus. The device must have doubles. Borrows
 * it. */
pspec_status ps_near_create(ps_near **out, unsigned dimension, bool on_sphere, bool with_windows,
                            ps_device *device, ps_error *error) PS_MUST_CHECK;
void ps_near_destroy(ps_near *near); /* NULL is allowed */

/* Looks at a set, points [num][dimension] of [0,1)^d, or unit vectors. */
pspec_status ps_near_look(ps_near *near, const double *points, size_t num,
                          ps_error *error) PS_MUST_CHECK;

/* Of the set that was looked at last. Distances to the nearest neighbour, [num] in an order of
 * their own; of a set of one point they are infinite. */
const double *ps_near_distances(const ps_near *near);
/* Units of length in the end of the last bin, whatever N is. */
double ps_near_reach(unsigned dimension, bool on_sphere);
/* g of bin b, which has distances from b to b + 1 over NEAR_BINS of the reach: ordered pairs over
 * those of white points. nan: the torus ends before it. */
double ps_near_correlation(const ps_near *near, size_t bin);
/* Of the number of points in a ball whose radius is w + 1 over NEAR_WINDOWS of half of the reach,
 * its centre uniform on the torus: the variance, over the mean with over_mean. nan: the ball meets
 * its own image, or windows were not wanted. */
double ps_near_number_variance(const ps_near *near, size_t window, bool over_mean);

#endif
