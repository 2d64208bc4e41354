/* Products of a matrix of distances with vectors on the device, for systems whose matrix does not
 * fit into memory:
 *
 *     out_i = sum_j x_j |u_i - u_j|^(2 power),   0 < power;   power = s - 1 belongs to the Sobolev space of smoothness s
 *
 * in double precision. Distances come from differences of coordinates, sums over segments of points
 * are compensated and merged in a fixed order: the same bits whatever the work-groups. In units of
 * sum |x| the error is about 1e-15 (tests/engines/pairs/test_pairs_product.c).
 */
#ifndef PS_ENGINES_PAIRS_PAIRS_PRODUCT_H
#define PS_ENGINES_PAIRS_PAIRS_PRODUCT_H

#include "base/watch.h"
#include "engines/engine.h"

typedef struct ps_pairs_product ps_pairs_product;

/* Does the device have double precision? NULL: there is none. */
bool ps_pairs_product_is_possible(const ps_device *device);
/* On the device and on the host, all that is allocated. */
uint64_t ps_pairs_product_bytes(uint64_t num_points);

/* points: unit vectors [num_points][3], copied to the device, which is borrowed. Destroyed by the
 * caller. */
pspec_status ps_pairs_product_create(ps_pairs_product **out, ps_device *device, double power,
                                     size_t num_points, const double *points,
                                     ps_error *error) PS_MUST_CHECK;
void ps_pairs_product_destroy(ps_pairs_product *product); /* NULL is allowed */

/* x and out: [num_points], not the same memory. Allocates nothing. watch: told of "points" that are
 * done, or NULL. */
pspec_status ps_pairs_product_apply(ps_pairs_product *product, const double *x, double *out,
                                    const ps_watch *watch, ps_error *error) PS_MUST_CHECK;

#endif
