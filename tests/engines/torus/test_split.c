/* A lattice as sums and differences of two factors: the vector that a slot stands for, found from
 * the tables alone, must be the frequency, and tile pairs are those that are needed.
 */
#include "harness.h"

#include "engines/torus/torus_split.h"

#include <stdlib.h>
#include <string.h>

static void add_side(const ps_split *split, const ps_split_side *side, size_t index, int sign,
                     int32_t *k) {
    assert_true(index < side->num); /* not in the padding */
    for (unsigned axis = 0; axis < split->dimension; axis++) {
        k[axis] += sign * side->vectors[index * split->dimension + axis];
    }
}

/* The vector of a slot, by the layout in torus_split.h. */
static void vector_of_slot(const ps_split *split, size_t slot, int32_t *k) {
    const size_t lanes = split->lanes;
    memset(k, 0, split->dimension * sizeof *k);
    if (slot >= ps_split_right_slot(split)) {
        add_side(split, &split->right, slot - ps_split_right_slot(split), 1, k);
    } else if (slot >= ps_split_left_slot(split)) {
        add_side(split, &split->left, slot - ps_split_left_slot(split), 1, k);
    } else {
        const size_t right = slot % lanes, is_minus = slot / lanes % 2;
        const size_t left = slot / lanes / 2 % lanes, pair = slot / lanes / 2 / lanes;
        assert_true(pair < split->num_pairs);
        add_side(split, &split->left, split->pairs[pair][0] * lanes + left, 1, k);
        add_side(split, &split->right, split->pairs[pair][1] * lanes + right, is_minus ? -1 : 1, k);
    }
}

/* Slots are below the stride, of one frequency each, and stand for it; marks the pairs used. */
static void check_slots(const ps_split *split, const ps_frequencies *lattice, bool *pair_is_used) {
    const size_t stride = ps_split_stride(split);
    bool *is_taken = calloc(stride, sizeof *is_taken);
    assert_non_null(is_taken);
    for (size_t i = 0; i < lattice->num; i++) {
        int32_t found[PS_MAX_DIMENSION];
        const int32_t *k = lattice->vectors + i * lattice->dimension;
        const size_t slot = ps_split_slot(split, k);
        assert_true(slot < stride && !is_taken[slot]);
        is_taken[slot] = true;
        vector_of_slot(split, slot, found);
        assert_memory_equal(found, k, lattice->dimension * sizeof *k);
        if (slot < ps_split_left_slot(split)) {
            pair_is_used[slot / (2 * split->lanes * split->lanes)] = true;
        }
    }
    free(is_taken);
}

/* A side is zero on the other's axes and its own part is in the half lattice. */
static void check_side(const ps_split *split, const ps_split_side *side, bool is_left) {
    const unsigned middle = split->dimension == 1 ? 1 : split->left_axes;
    assert_int_equal(side->num_tiles, (side->num + split->lanes - 1) / split->lanes);
    for (size_t i = 0; i < side->num; i++) {
        const int32_t *k = side->vectors + i * split->dimension;
        assert_true(ps_frequency_is_in_half_lattice(k, split->dimension));
        for (unsigned axis = 0; split->dimension > 1 && axis < split->dimension; axis++) {
            assert_true((axis < middle) == is_left || k[axis] == 0);
        }
    }
}

static void check_split(unsigned dimension, int32_t max_frequency, bool is_ball, unsigned lanes) {
    ps_frequencies lattice = {0};
    ps_split split = {0};
    size_t num_left = 0;
    size_t num_right = 0;
    assert_ok(ps_frequencies_lattice(&lattice, dimension, max_frequency, is_ball, error));
    ps_split_sizes(&lattice, lanes, &num_left, &num_right);
    assert_ok(ps_frequencies_enumerate(&lattice, error));
    assert_ok(ps_split_create(&split, &lattice, lanes, error));
    assert_int_equal(split.left.num, num_left);
    assert_int_equal(split.right.num, num_right);
    assert_int_equal(ps_split_stride(&split) % lanes, 0);
    check_side(&split, &split.left, true);
    check_side(&split, &split.right, false);
    bool *pair_is_used = calloc(split.num_pairs + 1, sizeof *pair_is_used);
    check_slots(&split, &lattice, pair_is_used);
    for (size_t pair = 0; pair < split.num_pairs; pair++) {
        assert_true(pair_is_used[pair]); /* pairs that nobody needs are left out */
        assert_true(split.pairs[pair][0] < split.left.num_tiles);
        assert_true(split.pairs[pair][1] < split.right.num_tiles);
    }
    free(pair_is_used);
    ps_split_free(&split);
    ps_frequencies_free(&lattice);
}

static void slots_of_lattices(void **state) {
    (void)state;
    static const unsigned lanes[] = {1, 2, 4, 8, 16};
    static const int32_t frequencies[PS_MAX_DIMENSION][4] = {
        {1, 2, 17, 1000}, {1, 2, 5, 33}, {1, 2, 3, 9}, {1, 2, 3, 4}, {1, 1, 2, 2}, {1, 1, 2, 2}};
    for (unsigned dimension = 1; dimension <= PS_MAX_DIMENSION; dimension++) {
        for (size_t i = 0; i < 4; i++) {
            for (size_t j = 0; j < sizeof lanes / sizeof lanes[0]; j++) {
                check_split(dimension, frequencies[dimension - 1][i], false, lanes[j]);
                check_split(dimension, frequencies[dimension - 1][i], true, lanes[j]);
            }
        }
    }
}

/* In one dimension every K has another step. */
static void slots_of_lines(void **state) {
    (void)state;
    for (int32_t k = 1; k <= 300; k++) {
        check_split(1, k, false, 1);
        check_split(1, k, true, 4);
        check_split(1, k, false, 16);
    }
}

/* A ball leaves about 1 - pi/4 of the tile pairs of its box out. */
static void corners_are_left_out(void **state) {
    (void)state;
    size_t num_pairs[2] = {0};
    for (int is_ball = 0; is_ball <= 1; is_ball++) {
        ps_frequencies lattice = {0};
        ps_split split = {0};
        assert_ok(ps_frequencies_lattice(&lattice, 2, 256, is_ball != 0, error));
        assert_ok(ps_frequencies_enumerate(&lattice, error));
        assert_ok(ps_split_create(&split, &lattice, 4, error));
        num_pairs[is_ball] = split.num_pairs;
        ps_split_free(&split);
        ps_frequencies_free(&lattice);
    }
    const double share = (double)num_pairs[1] / (double)num_pairs[0];
    assert_int_equal(num_pairs[0], 64 * 64);
    assert_true(share > 0.785 && share < 0.82); /* the rim passes through tiles */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slots_of_lattices),
        cmocka_unit_test(slots_of_lines),
        cmocka_unit_test(corners_are_left_out),
    };
    return cmocka_run_group_tests_name("split", tests, NULL, NULL);
}
