/* Realizations of a range: sums by segments, each of which ends as a node of the tree of the whole
 * job (spectra/sum_nodes.h). */
#include "accumulate/blocks.h"
#include "jobs/estimator_private.h"

#include <stdio.h>
#include <string.h>

uint64_t ps_estimator_position(const ps_estimator *self) {
    return self->options.first + self->totals.num_realizations + self->num_elsewhere;
}

void ps_estimator_go_to(ps_estimator *estimator, uint64_t number) {
    estimator->num_elsewhere = number - estimator->totals.num_realizations;
}

uint64_t ps_estimator_segment_left(const ps_estimator *self) {
    return self->options.is_range ? ps_segment_end(self->segment) - ps_estimator_position(self)
                                  : UINT64_MAX;
}

pspec_status ps_estimator_expect(ps_estimator *estimator, uint64_t num_points, ps_error *error) {
    PS_TRY(ps_estimator_add_pending(estimator, error));
    return ps_estimator_get_ready(estimator, num_points, error);
}

void ps_estimator_restart_segments(ps_estimator *self) {
    ps_sum_nodes_free(&self->nodes);
    self->segment = self->options.first;
}

static void set_sizes(const ps_estimator *self, ps_sum_nodes *nodes) {
    const ps_estimator_options *const options = &self->options;
    const size_t num = options->problem.frequencies->num;
    nodes->sizes[PS_NODE_BINS] = self->bins.num;
    nodes->sizes[PS_NODE_POWERS] = options->want_frequencies ? num : 0;
    nodes->sizes[PS_NODE_C2] = options->want_c2 ? num : 0;
    nodes->sizes[PS_NODE_TOTALS] = PS_NUM_TOTALS;
    ps_accumulator_find_singles(self->accumulator, &nodes->is_single[PS_NODE_BINS],
                                &nodes->is_single[PS_NODE_POWERS]);
}

static void copy_row(const ps_running_sums *sums, unsigned row, ps_sums *out) {
    memcpy(out, sums->rows + row * sums->num, sums->num * sizeof *out);
}

static pspec_status add_row(ps_estimator *self, ps_sum_nodes *nodes, unsigned row, uint64_t first,
                            uint64_t num, ps_error *error) {
    ps_sum_node *node = NULL;
    PS_TRY(ps_sum_nodes_add(nodes, first, num, &node, error));
    ps_accumulator_get_row(self->accumulator, row, node->sums[PS_NODE_BINS],
                           nodes->sizes[PS_NODE_POWERS] > 0 ? node->sums[PS_NODE_POWERS] : NULL);
    copy_row(&self->total_sums, row, node->sums[PS_NODE_TOTALS]);
    if (self->options.want_c2) {
        copy_row(&self->c2.sums, row, node->sums[PS_NODE_C2]);
    }
    return PSPEC_OK;
}

/* The rows of the segment, from the highest level on, and the open block. */
static pspec_status add_rows(ps_estimator *self, ps_sum_nodes *nodes, ps_error *error) {
    const uint64_t count = self->total_sums.count;
    uint64_t first = self->segment;
    PS_TRY(ps_accumulator_read_rows(self->accumulator, error));
    for (unsigned row = sum_levels(count) + 1; row-- > 0;) {
        const uint64_t num = row > 0 ? (uint64_t)SUM_BLOCK << (row - 1) : count % SUM_BLOCK;
        if (ps_running_has_row(count, row)) {
            PS_TRY(add_row(self, nodes, row, first, num, error));
            first += num;
        }
    }
    return PSPEC_OK;
}

pspec_status ps_estimator_end_segment(ps_estimator *self, ps_error *error) {
    if (ps_estimator_segment_left(self) > 0) {
        return PSPEC_OK;
    }
    PS_TRY(ps_estimator_add_pending(self, error));
    set_sizes(self, &self->nodes);
    PS_TRY(add_rows(self, &self->nodes, error));
    ps_accumulator_restart(self->accumulator);
    self->total_sums.count = 0;
    self->c2.sums.count = 0;
    self->segment = ps_estimator_position(self);
    return PSPEC_OK;
}

pspec_status ps_estimator_nodes(ps_estimator *self, ps_sum_nodes *out, ps_error *error) {
    *out = (ps_sum_nodes){0};
    set_sizes(self, out);
    for (size_t i = 0; i < self->nodes.num; i++) {
        PS_TRY(ps_sum_nodes_append(out, &self->nodes.nodes[i], error));
    }
    return add_rows(self, out, error);
}

/* ---- checkpoints ------------------------------------------------------------------------- */

static pspec_status walk_node(ps_estimator *self, ps_snapshot *snapshot, size_t index,
                              ps_error *error) {
    ps_sum_nodes *const nodes = &self->nodes;
    char place[48];
    char sums[48];
    ps_sum_node *node = index < nodes->num ? &nodes->nodes[index] : NULL;
    uint64_t numbers[] = {node != NULL ? node->first : 0, node != NULL ? node->num : 0};
    snprintf(place, sizeof place, "node_%zu_place", index);
    snprintf(sums, sizeof sums, "node_%zu_sums", index);
    PS_TRY(ps_snapshot_counts(snapshot, place, numbers, 2, error));
    if (node == NULL) {
        PS_TRY(ps_sum_nodes_add(nodes, numbers[0], numbers[1], &node, error));
    }
    return ps_snapshot_doubles(snapshot, sums, (double *)node->sums[0],
                               sizeof(ps_sums) / sizeof(double) * ps_sum_nodes_size(nodes), error);
}

pspec_status ps_estimator_walk_segments(ps_estimator *self, ps_snapshot *snapshot,
                                        ps_error *error) {
    uint64_t numbers[] = {self->segment, self->nodes.num};
    if (!self->options.is_range) {
        return PSPEC_OK;
    }
    PS_TRY(ps_snapshot_counts(snapshot, "segments", numbers, 2, error));
    self->segment = numbers[0];
    set_sizes(self, &self->nodes);
    for (size_t i = 0; i < numbers[1]; i++) {
        PS_TRY(walk_node(self, snapshot, i, error));
    }
    return PSPEC_OK;
}
