/* Realizations of a batch shared between work-groups that sum the same orders, for devices with
 * many of them: share s of `shares` has those from share_begin(s, ..) up to share_begin(s + 1, ..).
 * Pairs stay together, so that each is summed as it would be by one work-group.
 */
#ifndef PS_SPHERE_SHARES_H
#define PS_SPHERE_SHARES_H

#include "shared/fixed.h"

static inline ps_u32 share_begin(const ps_u32 share, const ps_u32 shares,
                                 const ps_u32 num_realizations) {
    const ps_u32 pairs = (num_realizations + 1) / 2;
    const ps_u32 begin = 2 * ((pairs + shares - 1) / shares * share);
    return begin < num_realizations ? begin : num_realizations;
}

#endif
