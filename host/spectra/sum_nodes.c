#include "spectra/sum_nodes.h"

#include "accumulate/blocks.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

_Static_assert(PS_SUM_BLOCK == SUM_BLOCK, "blocks are those of the sums");

/* The largest power of two that divides x. */
static uint64_t lowest_bit(uint64_t x) {
    return x & (~x + 1);
}

uint64_t ps_segment_end(uint64_t first) {
    return first > 0 ? first + lowest_bit(first) : UINT64_MAX;
}

size_t ps_sum_nodes_size(const ps_sum_nodes *self) {
    size_t num = 0;
    for (int i = 0; i < PS_NUM_NODE_SUMS; i++) {
        num += self->sizes[i];
    }
    return num;
}

void ps_sum_nodes_free(ps_sum_nodes *nodes) {
    for (size_t i = 0; i < nodes->num; i++) {
        free(nodes->nodes[i].sums[0]);
    }
    free(nodes->nodes);
    nodes->nodes = NULL;
    nodes->num = nodes->room = 0;
}

pspec_status ps_sum_nodes_add(ps_sum_nodes *nodes, uint64_t first, uint64_t num, ps_sum_node **out,
                              ps_error *error) {
    ps_sums *sums = NULL;
    void *all = nodes->nodes;
    PS_TRY(
        ps_grow(&all, &nodes->room, nodes->num + 1, sizeof *nodes->nodes, "sums of ranges", error));
    nodes->nodes = all;
    PS_TRY(PS_NEW(&sums, ps_sum_nodes_size(nodes), "sums of ranges", error));
    *out = &nodes->nodes[nodes->num++];
    **out = (ps_sum_node){.first = first, .num = num};
    for (int i = 0; i < PS_NUM_NODE_SUMS; i++) {
        (*out)->sums[i] = sums;
        sums += nodes->sizes[i];
    }
    return PSPEC_OK;
}

/* ---- joining ------------------------------------------------------------------------------- */

bool ps_sum_node_is_possible(uint64_t first, uint64_t num) {
    const bool is_power = num > 0 && lowest_bit(num) == num;
    return num < SUM_BLOCK ? num > 0 && first % SUM_BLOCK == 0 : is_power && first % num == 0;
}

static bool are_halves(const ps_sum_node *early, const ps_sum_node *late) {
    return early->num == late->num && early->num >= SUM_BLOCK &&
           early->first + early->num == late->first && early->first % (2 * early->num) == 0;
}

/* The early one is merged into the late one, as a whole block is into those that it completes. */
static void join(const ps_sum_nodes *self, ps_sum_node *early, ps_sum_node *late) {
    for (int which = 0; which < PS_NUM_NODE_SUMS; which++) {
        for (size_t i = 0; i < self->sizes[which]; i++) {
            ps_sums *const sums = &late->sums[which][i];
            if (self->is_single[which]) {
                ps_sums_merge_singles(sums, &early->sums[which][i]);
            } else {
                ps_sums_merge(sums, &early->sums[which][i], 1);
            }
        }
    }
    free(early->sums[0]);
    late->first = early->first;
    late->num *= 2;
    *early = *late;
}

pspec_status ps_sum_nodes_append(ps_sum_nodes *nodes, const ps_sum_node *node, ps_error *error) {
    ps_sum_node *last = NULL;
    PS_TRY(ps_sum_nodes_add(nodes, node->first, node->num, &last, error));
    memcpy(last->sums[0], node->sums[0], ps_sum_nodes_size(nodes) * sizeof(ps_sums));
    while (nodes->num > 1 && are_halves(last - 1, last)) {
        join(nodes, last - 1, last);
        last--;
        nodes->num--;
    }
    return PSPEC_OK;
}

/* ---- what they come to --------------------------------------------------------------------- */

uint64_t ps_sum_nodes_count(const ps_sum_nodes *nodes) {
    uint64_t count = 0;
    for (size_t i = 0; i < nodes->num; i++) {
        count += nodes->nodes[i].num;
    }
    return count;
}

/* From the last on: of a whole job the open block, then levels from the lowest. */
ps_sums ps_sum_nodes_get(const ps_sum_nodes *nodes, ps_node_sums which, size_t i) {
    ps_sums all = {0};
    for (size_t n = nodes->num; n-- > 0;) {
        ps_sums_merge(&all, &nodes->nodes[n].sums[which][i], 1);
    }
    if (nodes->is_single[which]) {
        ps_sums_drop_rounding(&all, ps_sum_nodes_count(nodes));
    }
    return all;
}
