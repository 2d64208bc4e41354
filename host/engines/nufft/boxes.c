#include "engines/nufft/boxes.h"

#include "base/round.h"
#include "nufft/boxes.h"

/* Cells of a box along each axis: with windows of 6 to 12 cells a prototype was slower in boxes of
 * 8 x 8 x 64 (Zen 4, 2026-11: 69 ms for a million points, against 39 to 45); they stay in the
 * second cache. */
static const uint32_t edges[PS_NUFFT_MAX_AXES] = {16, 32, 32};

/* Small grids have smaller boxes, so that all cores have some of a colour. */
enum { LEAST_OF_COLOUR = 8 };

static void cut_axis(ps_nufft_boxes *boxes, unsigned i, const ps_nufft_axis *axis, uint32_t edge) {
    const uint32_t behind = axis->window.width - 1;
    const uint32_t most = axis->n >= edge ? axis->n / edge : 1;
    const uint32_t colours = 1 + (uint32_t)ps_divide_up(behind, edge);
    boxes->colours[i] = most >= colours ? colours : most;
    boxes->num[i] = most / boxes->colours[i] * boxes->colours[i];
    boxes->per_cell[i] = (uint32_t)ps_divide_up((uint64_t)boxes->num[i] << 32, axis->n);
    boxes->sides[i] = 0;
    for (uint32_t b = 0; b < boxes->num[i]; b++) {
        const uint32_t cells =
            box_begin(b + 1, boxes->per_cell[i]) - box_begin(b, boxes->per_cell[i]);
        boxes->sides[i] = cells > boxes->sides[i] ? cells : boxes->sides[i];
    }
    boxes->sides[i] += i + 1 == PS_NUFFT_MAX_AXES ? ps_nufft_bins(axis) : behind;
}

static ps_nufft_boxes cut(const ps_nufft_choice *choice, unsigned halvings) {
    ps_nufft_boxes boxes;
    for (unsigned i = 0; i < PS_NUFFT_MAX_AXES; i++) {
        cut_axis(&boxes, i, &choice->axes[i], edges[i] >> halvings);
    }
    return boxes;
}

ps_nufft_boxes ps_nufft_boxes_measure(const ps_nufft_choice *choice, unsigned halvings) {
    const ps_nufft_boxes boxes = cut(choice, halvings);
    return halvings == 0 && ps_nufft_boxes_of_colour(&boxes) < LEAST_OF_COLOUR ? cut(choice, 1)
                                                                               : boxes;
}

size_t ps_nufft_boxes_count(const ps_nufft_boxes *boxes) {
    return (size_t)boxes->num[0] * boxes->num[1] * boxes->num[2];
}

size_t ps_nufft_boxes_of_colour(const ps_nufft_boxes *boxes) {
    size_t num = 1;
    for (unsigned i = 0; i < PS_NUFFT_MAX_AXES; i++) {
        num *= boxes->num[i] / boxes->colours[i];
    }
    return num;
}

size_t ps_nufft_boxes_reals(const ps_nufft_boxes *boxes) {
    return (size_t)boxes->sides[0] * boxes->sides[1] * boxes->sides[2];
}
