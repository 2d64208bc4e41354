/* Rings of boxes that are no cubes against their definition, and the shape of boxes. */
#include "harness.h"

#include "points/box.h"
#include "spectra/bins.h"

#include <math.h>

/* Edges of a box, and that of the cube of the same volume. */
typedef struct box_case {
    unsigned dimension;
    int32_t max_frequency;
    double edges[3];
    long double cube;
} box_case;

/* Of a bin that is found by its members, or by the definition. */
typedef struct counted {
    size_t num;
    long double sum; /* of |k| */
} counted;

enum { MOST_KEYS = 64 };

/* Borders of rings are multiples of 1/2, 1 and 1/3, which lengths of the first two boxes meet. */
static int64_t box_key(const ps_bin_rule *rule, long double length) {
    return rule->kind == PS_BINS_ROUND
               ? (int64_t)floorl(length + 0.5L)
               : (int64_t)floorl(length * rule->denominator / rule->numerator);
}

/* All frequencies of a lattice that is larger than any grid, both signs; those of complete bins. */
static void count_lattice(counted *found, const box_case *box, const ps_bin_rule *rule) {
    enum { LARGEST = 16 };
    const int32_t third = box->dimension > 2 ? LARGEST : 0;
    const int64_t outside = box_key(rule, box->max_frequency + 1.0L);
    for (int32_t x = -LARGEST; x <= LARGEST; x++) {
        for (int32_t y = -LARGEST; y <= LARGEST; y++) {
            for (int32_t z = -third; z <= third; z++) {
                const long double q[] = {x / (long double)box->edges[0],
                                         y / (long double)box->edges[1],
                                         third > 0 ? z / (long double)box->edges[2] : 0};
                const long double length =
                    box->cube * sqrtl(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
                const int64_t key = box_key(rule, length);
                if (length > 0 && key < outside) {
                    assert_true(key < MOST_KEYS);
                    found[key].num++;
                    found[key].sum += length;
                }
            }
        }
    }
}

static void check_box(const box_case *box, bool is_ball, const ps_bin_rule *rule) {
    ps_frequencies set = {0};
    ps_bins bins = {0};
    counted expected[MOST_KEYS] = {{0}};
    double stretch[PS_MAX_DIMENSION];
    size_t b = 0;
    count_lattice(expected, box, rule);
    for (unsigned i = 0; i < box->dimension; i++) {
        stretch[i] = (double)(box->cube / box->edges[i]) * (1 + (i % 2 == 0 ? 1 : -1) * 1e-15);
    }
    assert_ok(
        ps_frequencies_grid(&set, box->dimension, box->max_frequency, is_ball, rule, 0, error));
    assert_ok(ps_frequencies_stretch(&set, stretch, error));
    assert_int_equal(ps_frequencies_reach(&set), box->max_frequency);
    assert_ok(ps_frequencies_enumerate(&set, error));
    assert_ok(ps_bins_create(&bins, &set, error));
    for (int64_t key = 0; key < MOST_KEYS; key++) {
        if (expected[key].num > 0) {
            assert_true(b < bins.num_reported);
            assert_int_equal(bins.bins[b].key, key);
            assert_int_equal(bins.bins[b].num_modes, expected[key].num);
            assert_true(fabsl(bins.bins[b].mean_frequency * (long double)expected[key].num /
                                  expected[key].sum -
                              1) < 1e-13L);
            b++;
        }
    }
    assert_int_equal(bins.num_reported, b);
    assert_int_equal(bins.num, is_ball ? b : b + 1);
    ps_bins_free(&bins);
    ps_frequencies_free(&set);
}

/* Rings are of wave vectors, whole, and a frequency on a border is above it whatever rounding made
 * of it. */
static void bins_of_boxes(void **state) {
    (void)state;
    static const box_case boxes[] = {{3, 5, {8, 4, 2}, 4},
                                     {2, 7, {2, 8, 0}, 4},
                                     {2, 6, {3, 1.75, 0}, 2.2912878474779200033L},
                                     {3, 2, {1, 10, 3}, 3.1072325059538588669L}};
    static const ps_bin_rule rules[] = {
        {.kind = PS_BINS_ROUND}, {PS_BINS_WIDTH, 1, 1, 0, 0}, {PS_BINS_WIDTH, 1, 3, 0, 0}};
    for (size_t i = 0; i < sizeof boxes / sizeof boxes[0]; i++) {
        for (size_t j = 0; j < sizeof rules / sizeof rules[0]; j++) {
            check_box(&boxes[i], false, &rules[j]);
            check_box(&boxes[i], true, &rules[j]);
        }
    }
}

/* The bins of lengths that happen to be whole are those of whole numbers, borders included. */
static void lengths_that_are_whole(void **state) {
    (void)state;
    static const ps_bin_rule rules[] = {{.kind = PS_BINS_ROUND},
                                        {PS_BINS_WIDTH, 1, 1, 0, 0},
                                        {PS_BINS_WIDTH, 7, 5, 0, 0},
                                        {PS_BINS_RELATIVE, 1, 8, 3, 64},
                                        {PS_BINS_RELATIVE, 1, 8, 2, 1000}};
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++) {
        for (int64_t norm2 = 1; norm2 <= 100000; norm2++) {
            assert_int_equal(ps_bin_rule_find_length(&rules[i], (double)norm2),
                             ps_bin_rule_find(&rules[i], norm2));
        }
    }
}

/* The cube of 8 x 4 x 2 has the edge 4. */
static void shapes_of_boxes(void **state) {
    (void)state;
    const ps_box none = {0};
    const ps_box pixels = {.num_axes = 1, .high = {512}};
    const ps_box cube = {3, {0, -1, 5}, {10, 9, 15.000000000001}};
    const ps_box cuboid = {3, {0, -1, 5}, {8, 3, 7}};
    double stretch[PS_MAX_DIMENSION];
    assert_false(ps_box_stretch(&none, 6, stretch));
    assert_false(ps_box_stretch(&pixels, 3, stretch));
    assert_false(ps_box_stretch(&cube, 3, stretch));
    for (unsigned i = 0; i < 3; i++) {
        assert_true(stretch[i] == 1);
    }
    assert_true(ps_box_stretch(&cuboid, 3, stretch));
    for (unsigned i = 0; i < 3; i++) {
        assert_true(stretch[i] == 0.5 * (1 << i));
    }
}

static void boxes_that_change(void **state) {
    (void)state;
    const ps_box moved = {2, {1, 1}, {5, 3}};
    const ps_box same = {2, {0, 0}, {4, 2}};
    const ps_box larger = {2, {0, 0}, {8, 4}};
    const ps_box longer = {2, {0, 0}, {5, 2}};
    ps_boxes boxes = {0};
    ps_boxes_add(&boxes, &same, 2);
    ps_boxes_add(&boxes, &moved, 2);
    assert_false(boxes.differ || boxes.differ_in_shape);
    ps_boxes_add(&boxes, &larger, 2);
    assert_true(boxes.differ && !boxes.differ_in_shape);
    ps_boxes_add(&boxes, &longer, 2);
    assert_true(boxes.differ && boxes.differ_in_shape);
    assert_true(boxes.first.high[0] == 4 && boxes.shortest[0] == 4 && boxes.longest[0] == 8);
    assert_true(boxes.shortest[1] == 2 && boxes.longest[1] == 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bins_of_boxes),
        cmocka_unit_test(lengths_that_are_whole),
        cmocka_unit_test(shapes_of_boxes),
        cmocka_unit_test(boxes_that_change),
    };
    return cmocka_run_group_tests_name("box_bins", tests, NULL, NULL);
}
