/* Sums over a range of realizations, as nodes of the tree in which the sums of a whole job are
 * added (kernels/accumulate/sums.h), so that ranges put together have its bits.
 *
 * A node is 2^j blocks of realizations that begin at a multiple of so many, or the block that the
 * job leaves open at its end. Two of a length that are halves of a larger one are joined as device
 * and host carry whole blocks, in the precision of the sums there. What covers the job from its
 * first realization to its last is then the rows of ps_running_sums (spectra/sums.h).
 *
 * One counter, which begins at 0 or after any node, gives such nodes where it is started anew at
 * the ends of segments: ps_segment_end.
 */
#ifndef PS_SPECTRA_SUM_NODES_H
#define PS_SPECTRA_SUM_NODES_H

#include "spectra/sums.h"

/* Realizations of a block, at multiples of which ranges begin (SUM_BLOCK). */
enum { PS_SUM_BLOCK = 128 };

/* What there are sums of. */
typedef enum ps_node_sums {
    PS_NODE_BINS,
    PS_NODE_POWERS, /* of single frequencies */
    PS_NODE_C2,
    PS_NODE_TOTALS, /* of numbers of points, of W^2 / V, of sums of weights */
    PS_NUM_NODE_SUMS
} ps_node_sums;
enum { PS_TOTAL_POINTS, PS_TOTAL_SAMPLE_SIZES, PS_TOTAL_WEIGHTS, PS_NUM_TOTALS };

typedef struct ps_sum_node {
    uint64_t first, num;             /* realizations */
    ps_sums *sums[PS_NUM_NODE_SUMS]; /* [sizes[i]], in one piece of memory */
} ps_sum_node;

typedef struct ps_sum_nodes {
    size_t sizes[PS_NUM_NODE_SUMS];   /* 0: there are none */
    bool is_single[PS_NUM_NODE_SUMS]; /* pairs of single precision, those of a device */
    size_t num, room;
    ps_sum_node *nodes; /* in the order of their realizations */
} ps_sum_nodes;

/* One past the last realization of the segment that begins at realization `first`: 0, which never
 * ends, or a multiple of a block. */
uint64_t ps_segment_end(uint64_t first);

size_t ps_sum_nodes_size(const ps_sum_nodes *nodes); /* sums of a node */
void ps_sum_nodes_free(ps_sum_nodes *nodes);         /* {0} is allowed; sizes stay */
/* One more behind the others, all 0, borrowed until the next is added. */
pspec_status ps_sum_nodes_add(ps_sum_nodes *nodes, uint64_t first, uint64_t num, ps_sum_node **out,
                              ps_error *error) PS_MUST_CHECK;
/* The same with the sums of another one, then as many joined as can be. Sizes are the same. */
pspec_status ps_sum_nodes_append(ps_sum_nodes *nodes, const ps_sum_node *node,
                                 ps_error *error) PS_MUST_CHECK;
/* Can there be such a node? */
bool ps_sum_node_is_possible(uint64_t first, uint64_t num);
uint64_t ps_sum_nodes_count(const ps_sum_nodes *nodes); /* of realizations */
/* The plain sums of number i, as ps_running_sums_get and devices have them. */
ps_sums ps_sum_nodes_get(const ps_sum_nodes *nodes, ps_node_sums which, size_t i);

#endif
