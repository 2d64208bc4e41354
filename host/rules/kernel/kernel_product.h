/* Products of a matrix of distances with vectors on the device, for systems whose matrix does not
 * fit into memory:
 *
 *     out_i = sum_j x_j |u_i - u_j|^(2 power),   0 < power;   power = s - 1 belongs to the Sobolev space of smoothness s
 *
 * in double precision. Distances come from differences of coordinates, sums over segments of points
 * are compensated and merged in a fixed order: the same bits whatever the work-groups. In units of
 * sum |x| the error is about 1e-15 (tests/rules/test_kernel_product.c).
 */
#ifndef PS_RULES_KERNEL_KERNEL_PRODUCT_H
#define PS_RULES_KERNEL_KERNEL_PRODUCT_H

#include "base/watch.h"
#include "engines/engine.h"
#include "rules/worst_case_error.h"

typedef struct ps_kernel_product ps_kernel_product;

/* Does the device have double precision? NULL: there is none. */
bool ps_kernel_product_is_possible(const ps_device *device);
/* Is it a GPU that has it? */
bool ps_kernel_product_is_on_gpu(const ps_device *device);
/* On the device and on the host, all that is allocated. */
uint64_t ps_kernel_product_bytes(uint64_t num_points);

/* points: unit vectors [num_points][3], copied to the device, which is borrowed. Destroyed by the
 * caller. */
pspec_status ps_kernel_product_create(ps_kernel_product **out, ps_device *device, double power,
                                      size_t num_points, const double *points,
                                      ps_error *error) PS_MUST_CHECK;
void ps_kernel_product_destroy(ps_kernel_product *product); /* NULL is allowed */

/* x and out: [num_points], not the same memory. Allocates nothing. watch: told of "points" that are
 * done, or NULL. */
pspec_status ps_kernel_product_apply(ps_kernel_product *product, const double *x, double *out,
                                     const ps_watch *watch, ps_error *error) PS_MUST_CHECK;

/* ---- sums of distances of rules, several at a time ------------------------------------------ */

/* Whether a GPU sums those of a rule of so many points: on CPUs threads of the host take half the
 * pairs. */
bool ps_kernel_distances_pay(const ps_device *device, uint64_t num_points);
/* Rules of so many points that fill a GPU for some hundredths of a second, of num_rules in all; 0:
 * nobody knows. */
size_t ps_kernel_distances_at_once(uint64_t num_points, uint64_t num_rules);
/* For up to most_sets rules of up to most_points points. */
pspec_status ps_kernel_distances_create(ps_kernel_product **out, ps_device *device, double power,
                                        size_t most_points, size_t most_sets,
                                        ps_error *error) PS_MUST_CHECK;
size_t ps_kernel_distances_most_points(const ps_kernel_product *product); /* NULL: 0 */
size_t ps_kernel_distances_most_rules(const ps_kernel_product *product);
/* sums[r] = sum_ij w_i w_j |u_i - u_j|^(2 power), within rounding of ps_rule_distance; rules have
 * weights. The same bits whatever other rules there are. */
pspec_status ps_kernel_distances_sum(ps_kernel_product *product, const ps_rule *rules, size_t num,
                                     double *sums, ps_error *error) PS_MUST_CHECK;

#endif
