/* The sum of worst_case_error.h over all pairs of many points, split into near and far pairs: far
 * ones are summed between few points that stand for many
 * (docs/user/quadrature.md#near-and-far-pairs).
 *
 * The sphere is cut into cells, squares on the faces of a cube around it, which are cut into four
 * where they have many points. As seen from another cell that is far enough, the points of a cell
 * are 16 x 16 Chebyshev points with weights that integrate what interpolates there, whose error is
 * below rounding at these distances. All is by the host, in double precision and in a fixed order.
 */
#ifndef PS_RULES_DISTANCE_SPLIT_H
#define PS_RULES_DISTANCE_SPLIT_H

#include "rules/worst_case_error.h"

#include <stdint.h>

/* Up to so many points all pairs are summed one by one: it is as quick as that. */
enum { PS_DISTANCE_MOST_WHOLE = 1 << 15 };

typedef struct ps_distance_split ps_distance_split;

/* Cells and pairs of cells for the points of a rule, which is borrowed. *pays: the sum is quicker
 * than over all pairs, as it is but for few points and where cells that cannot be cut keep many of
 * the points; else it is not made ready to be summed. pays NULL: it is in any case. Destroyed by
 * ps_distance_split_destroy, also after an error. */
pspec_status ps_distance_split_create(ps_distance_split **out, const ps_rule *rule, bool *pays,
                                      ps_error *error) PS_MUST_CHECK;
void ps_distance_split_destroy(ps_distance_split *split); /* NULL is allowed */

/* sum_ij w_i w_j |u_i-u_j|^(2s-2), with weights of 1 where the rule has none. watch: told how far
 * it is; NULL: nobody. */
pspec_status ps_distance_split_sum(ps_distance_split *split, double smoothness,
                                   const ps_watch *watch, double *sum,
                                   ps_error *error) PS_MUST_CHECK;

/* How many distances are computed for so many points: all pairs, or what the split leaves of them
 * for points that are spread out. */
double ps_distance_count(double num_points);
/* The same for points that are known: where many are in one place all pairs are left. Takes as long
 * as sorting them. */
pspec_status ps_distance_count_of(const ps_rule *rule, double *num_distances,
                                  ps_error *error) PS_MUST_CHECK;
/* Bytes that ps_rule_distance takes at most for points that are spread out. */
uint64_t ps_distance_bytes(uint64_t num_points);

#endif
