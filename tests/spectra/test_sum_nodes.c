/* Sums of ranges of realizations, put together, are those of one counter, for every partition of a
 * small number of blocks, in double precision and in pairs of single precision. */
#include "harness.h"

#include "spectra/sum_nodes.h"

#define PRECISION 32
#include "accumulate/sums.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_BLOCKS = 6, OPEN = 40, MOST_ROWS = 5, NUM = 2 };
_Static_assert(PS_SUM_BLOCK == SUM_BLOCK, "blocks are those of the sums");

/* Number i of realization r: of order 1, and over many orders. */
static double value_of(uint64_t r, size_t i) {
    uint64_t seed = 7 * r + i + 1;
    const double x = test_uniform(&seed) + test_uniform(&seed);
    return i == 0 ? (float)x : (float)exp(12 * x - 12);
}

/* ---- counters -------------------------------------------------------------------------------- */

/* In single precision as kernels have it (kernels/accumulate/state.h), written once more; in double
 * precision that of the library. */
typedef struct counter {
    bool is_single;
    uint64_t count;
    block_sums rows[MOST_ROWS][NUM];
    ps_running_sums running;
} counter;

static void begin(counter *self, bool is_single) {
    *self = (counter){.is_single = is_single};
    assert_ok(
        ps_running_sums_create(&self->running, NUM, MOST_BLOCKS * SUM_BLOCK + OPEN, false, error));
}

static void carry(counter *self, size_t i) {
    uint64_t block = self->count / SUM_BLOCK;
    block_sums merged = self->rows[0][i];
    size_t row = 1;
    for (; block & 1; block /= 2, row++) {
        merge_blocks(&merged, &self->rows[row][i]);
    }
    self->rows[row][i] = merged;
}

static void add(counter *self, uint64_t r) {
    const double values[NUM] = {value_of(r, 0), value_of(r, 1)};
    ps_running_sums_add(&self->running, values, NULL);
    for (size_t i = 0; i < NUM; i++) {
        if (self->count % SUM_BLOCK == 0) {
            self->rows[0][i] = (block_sums){0};
        }
        add_to_block(&self->rows[0][i], (float)values[i]);
        if (self->count % SUM_BLOCK == SUM_BLOCK - 1) {
            carry(self, i);
        }
    }
    self->count++;
}

static ps_sums get_row(const counter *self, unsigned row, size_t i) {
    const block_sums *const sums = &self->rows[row][i];
    return self->is_single ? (ps_sums){sums->sum, sums->sum_low, sums->square, sums->square_low}
                           : self->running.rows[row * NUM + i];
}

/* All rows become nodes behind `first`, and the counter begins anew. */
static void take_rows(counter *self, ps_sum_nodes *nodes, uint64_t first) {
    for (unsigned row = MOST_ROWS; row-- > 0;) {
        const uint64_t num = row > 0 ? (uint64_t)SUM_BLOCK << (row - 1) : self->count % SUM_BLOCK;
        if (ps_running_has_row(self->count, row)) {
            ps_sum_node *node = NULL;
            assert_ok(ps_sum_nodes_add(nodes, first, num, &node, error));
            assert_true(ps_sum_node_is_possible(first, num));
            for (size_t i = 0; i < NUM; i++) {
                node->sums[PS_NODE_POWERS][i] = get_row(self, row, i);
            }
            first += num;
        }
    }
    self->count = self->running.count = 0;
}

/* ---- ranges ---------------------------------------------------------------------------------- */

static ps_sum_nodes make_nodes(bool is_single) {
    return (ps_sum_nodes){.sizes = {[PS_NODE_POWERS] = NUM},
                          .is_single = {[PS_NODE_POWERS] = is_single}};
}

/* Segment by segment. */
static ps_sum_nodes add_range(uint64_t first, uint64_t end, bool is_single) {
    ps_sum_nodes nodes = make_nodes(is_single);
    counter sums;
    uint64_t segment = first;
    begin(&sums, is_single);
    for (uint64_t r = first; r < end; r++) {
        add(&sums, r);
        if (r + 1 == ps_segment_end(segment)) {
            take_rows(&sums, &nodes, segment);
            segment = r + 1;
        }
    }
    take_rows(&sums, &nodes, segment);
    ps_running_sums_free(&sums.running);
    assert_int_equal(ps_sum_nodes_count(&nodes), end - first);
    return nodes;
}

static void append_all(ps_sum_nodes *nodes, const ps_sum_nodes *more) {
    for (size_t i = 0; i < more->num; i++) {
        assert_ok(ps_sum_nodes_append(nodes, &more->nodes[i], error));
    }
}

static void assert_same(const ps_sum_nodes *a, const ps_sum_nodes *b) {
    assert_int_equal(a->num, b->num);
    for (size_t n = 0; n < a->num; n++) {
        assert_int_equal(a->nodes[n].first, b->nodes[n].first);
        assert_int_equal(a->nodes[n].num, b->nodes[n].num);
        assert_memory_equal(a->nodes[n].sums[PS_NODE_POWERS], b->nodes[n].sums[PS_NODE_POWERS],
                            NUM * sizeof(ps_sums));
    }
}

/* Cuts are bits: bit b cuts behind block b + 1. Ranges are joined one after the other, and the last
 * ones first. */
static void check_partition(const ps_sum_nodes *whole, uint64_t count, unsigned cuts,
                            bool is_single) {
    ps_sum_nodes all = make_nodes(is_single);
    ps_sum_nodes late = make_nodes(is_single);
    ps_sum_nodes nested = make_nodes(is_single);
    uint64_t first = 0;
    for (uint64_t end = SUM_BLOCK; first < count; end += SUM_BLOCK) {
        const bool is_last = end >= count;
        if (is_last || (cuts >> (end / SUM_BLOCK - 1) & 1) != 0) {
            ps_sum_nodes range = add_range(first, is_last ? count : end, is_single);
            append_all(&all, &range);
            append_all(first == 0 ? &nested : &late, &range);
            ps_sum_nodes_free(&range);
            first = end;
        }
    }
    append_all(&nested, &late);
    assert_same(whole, &all);
    assert_same(whole, &nested);
    ps_sum_nodes_free(&all);
    ps_sum_nodes_free(&late);
    ps_sum_nodes_free(&nested);
}

static void every_partition_is_the_whole(void **state) {
    (void)state;
    for (int is_single = 0; is_single < 2; is_single++) {
        for (uint64_t blocks = 1; blocks <= MOST_BLOCKS; blocks++) {
            const uint64_t count = blocks * SUM_BLOCK + (blocks % 2) * OPEN;
            ps_sum_nodes whole = add_range(0, count, is_single);
            for (unsigned cuts = 0; cuts < 1U << blocks; cuts++) {
                check_partition(&whole, count, cuts, is_single);
            }
            ps_sum_nodes_free(&whole);
        }
    }
}

/* What nodes come to is what running sums say, to the bit. */
static void nodes_have_running_sums(void **state) {
    (void)state;
    const uint64_t count = 3 * SUM_BLOCK + OPEN;
    counter sums;
    begin(&sums, false);
    for (uint64_t r = 0; r < count; r++) {
        add(&sums, r);
    }
    ps_sum_nodes nodes = add_range(0, count, false);
    for (size_t i = 0; i < NUM; i++) {
        const ps_sums a = ps_running_sums_get(&sums.running, i);
        const ps_sums b = ps_sum_nodes_get(&nodes, PS_NODE_POWERS, i);
        assert_memory_equal(&a, &b, sizeof a);
    }
    ps_running_sums_free(&sums.running);
    ps_sum_nodes_free(&nodes);
}

static void other_nodes_are_impossible(void **state) {
    (void)state;
    static const uint64_t wrong[][2] = {{0, 0},   {64, 64},   {1, 128},    {128, 256},
                                        {0, 384}, {256, 200}, {640, 1024}, {0, UINT64_MAX}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_false(ps_sum_node_is_possible(wrong[i][0], wrong[i][1]));
    }
    assert_true(ps_sum_node_is_possible(1152, 128) && ps_sum_node_is_possible(384, 127));
    assert_true(ps_segment_end(0) == UINT64_MAX && ps_segment_end(384) == 512);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_partition_is_the_whole),
        cmocka_unit_test(nodes_have_running_sums),
        cmocka_unit_test(other_nodes_are_impossible),
    };
    return cmocka_run_group_tests_name("sum_nodes", tests, NULL, NULL);
}
