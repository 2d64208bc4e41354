#include "engines/torus/nufft/layout.h"

#include "base/round.h"
#include "nufft/boxes.h"

/* Cells of a box along the axes of the kernel. With what windows touch behind them they are to stay
 * in the second cache of a core; where points are few for their cells, larger boxes are better, for
 * each is added to the grid (Zen 4, 2026-11, a million points, K = 64, at 1e-6: 16 x 16 x 32 take
 * 1.16 times as long as 16 x 32 x 32). */
static const uint32_t edges_of_plane[PS_NUFFT_MAX_AXES] = {1, 64, 128};
static const uint32_t edges_of_space[PS_NUFFT_MAX_AXES] = {16, 32, 32};
enum { LEAST_EDGE = 4 };

/* Small grids have smaller boxes, so that all cores have some of a colour; in space what is added
 * behind them soon outweighs that. */
enum { LEAST_OF_COLOUR = 8, HALVINGS_OF_PLANE = 3, HALVINGS_OF_SPACE = 1 };

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
    const bool is_plane = choice->num_axes == 2;
    const uint32_t *const edges = is_plane ? edges_of_plane : edges_of_space;
    const unsigned first = PS_NUFFT_MAX_AXES - choice->num_axes;
    ps_nufft_boxes boxes = {.num = {1}, .colours = {1}, .sides = {1}};
    for (unsigned i = first; i < PS_NUFFT_MAX_AXES; i++) {
        const uint32_t edge = edges[i] >> halvings;
        cut_axis(&boxes, i, &choice->axes[i - first], edge > LEAST_EDGE ? edge : LEAST_EDGE);
    }
    return boxes;
}

ps_nufft_boxes ps_nufft_boxes_measure(const ps_nufft_choice *choice, unsigned halvings) {
    const unsigned most = choice->num_axes == 2 ? HALVINGS_OF_PLANE : HALVINGS_OF_SPACE;
    unsigned own = 0;
    ps_nufft_boxes boxes = cut(choice, 0);
    while (own < most && ps_nufft_boxes_of_colour(&boxes) < LEAST_OF_COLOUR) {
        boxes = cut(choice, ++own);
    }
    return halvings == 0 ? boxes : cut(choice, own + halvings);
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
