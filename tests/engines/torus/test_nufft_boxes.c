/* Boxes of cells in which large sets are spread: every cell is in one, and boxes of a colour share
 * no cell with the cells behind them that windows touch.
 */
#include "harness.h"

#include "engines/torus/nufft/layout.h"
#include "engines/torus/nufft/variant.h"
#include "nufft/boxes.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_CELLS = 700 };

/* Along one axis: the boxes that a cell is touched by, of each colour. */
static void check_colours(const ps_nufft_boxes *boxes, unsigned i, const ps_nufft_axis *axis) {
    for (uint32_t colour = 0; colour < boxes->colours[i]; colour++) {
        uint32_t owner[MOST_CELLS] = {0};
        for (uint32_t b = colour; b < boxes->num[i]; b += boxes->colours[i]) {
            const uint32_t end = box_begin(b + 1, boxes->per_cell[i]) + axis->window.width - 1;
            for (uint32_t cell = box_begin(b, boxes->per_cell[i]); cell < end; cell++) {
                uint32_t *const of_cell = &owner[cell % axis->n];
                assert_true(*of_cell == 0 || *of_cell == b + 1); /* a small grid meets itself */
                *of_cell = b + 1;
            }
        }
    }
}

static void check_axis(const ps_nufft_boxes *boxes, unsigned i, const ps_nufft_axis *axis) {
    const bool is_last = i + 1 == PS_NUFFT_MAX_AXES;
    const uint32_t behind = is_last ? ps_nufft_bins(axis) : axis->window.width - 1;
    assert_true(boxes->num[i] > 0 && boxes->num[i] % boxes->colours[i] == 0);
    assert_int_equal(box_begin(0, boxes->per_cell[i]), 0);
    assert_int_equal(box_begin(boxes->num[i], boxes->per_cell[i]), axis->n);
    for (uint32_t cell = 0; cell < axis->n; cell++) {
        const uint32_t box = box_of(cell, boxes->per_cell[i]);
        const uint32_t begin = box_begin(box, boxes->per_cell[i]);
        const uint32_t end = box_begin(box + 1, boxes->per_cell[i]);
        assert_true(box < boxes->num[i] && begin <= cell && cell < end);
        assert_true(end - begin + behind <= boxes->sides[i]);
    }
    check_colours(boxes, i, axis);
}

static void boxes_of_a_colour_share_no_cell(void **state) {
    (void)state;
    enum { CASES = 400, HALVINGS = 5 };
    uint64_t random = 9;
    for (int c = 0; c < CASES; c++) {
        ps_nufft_choice choice = {.num_axes = 2 + (unsigned)c % 2, .variant = &ps_nufft_large};
        const unsigned first = PS_NUFFT_MAX_AXES - choice.num_axes;
        for (unsigned i = 0; i < choice.num_axes; i++) {
            const unsigned width = 2 + (unsigned)(test_uniform(&random) * 15);
            const uint32_t n = 16 + (uint32_t)(test_uniform(&random) * (MOST_CELLS - 16));
            choice.axes[i] = (ps_nufft_axis){.axis = i, .n = n, .window = {.width = width}};
        }
        for (unsigned halvings = 0; halvings < HALVINGS; halvings++) {
            const ps_nufft_boxes boxes = ps_nufft_boxes_measure(&choice, halvings);
            assert_true(first == 0 || (boxes.num[0] == 1 && boxes.sides[0] == 1));
            for (unsigned i = first; i < PS_NUFFT_MAX_AXES; i++) {
                check_axis(&boxes, i, &choice.axes[i - first]);
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_of_a_colour_share_no_cell),
    };
    return cmocka_run_group_tests_name("nufft_boxes", tests, NULL, NULL);
}
