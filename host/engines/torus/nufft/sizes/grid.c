#include "engines/torus/nufft/sizes/grid.h"

#include "base/round.h"
#include "nufft/grid/grid.h"

#include <math.h>

/* Edges of boxes along the axes of the kernels, by the number of axes: a box of 32 cells in the
 * plane was measured on an H200 (16.5 G points/s at windows of 6), in space as many cells as
 * memory has room for. */
static const uint32_t wanted_edges[PS_NUFFT_MAX_AXES][PS_NUFFT_MAX_AXES] = {
    {1, 1, 512}, {1, 32, 32}, {8, 16, 16}};

/* Boxes of the plane with so few points have twice these edges: what is behind them outweighs
 * points. */
static const double few_points = 16;

/* So many copies of a box, each of which one scheduling unit of the device adds to, where there
 * are points for all of them several times. */
enum { MOST_COPIES = 4, LEAST_RUNS = 2 };

static uint32_t power_of_2_in(uint32_t n) {
    return n & (~n + 1);
}

/* So that four rows of eight neighbours lie in 32 banks, where that takes at most a quarter more
 * room; else an odd number. */
static uint32_t pitch_of(uint32_t side, unsigned num_axes) {
    enum { QUARTER = 8, HALF = 16, PART = 4 };
    uint32_t pitch = side;
    while (num_axes > 1 && pitch % HALF != QUARTER) {
        pitch++;
    }
    return pitch - side <= side / PART ? pitch : side | 1;
}

static size_t window_reals(const ps_nufft_choice *choice) {
    enum { LEAST_ROOM = 4 };
    size_t reals = 0;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        const unsigned width = choice->axes[i].window.width;
        reals += width < LEAST_ROOM ? LEAST_ROOM : width;
    }
    return reals | 1;
}

ps_nufft_grid_local ps_nufft_grid_spread_local(const ps_nufft_grid_sizes *sizes,
                                               const ps_nufft_choice *choice, size_t real_bytes) {
    const size_t points = (size_t)sizes->copies * GRID_RUN;
    return (ps_nufft_grid_local){.copies = (size_t)sizes->copies * sizes->sides[0] *
                                           sizes->sides[1] * sizes->pitch * real_bytes,
                                 .windows = points * window_reals(choice) * real_bytes,
                                 .cells = points * sizeof(uint32_t)};
}

static size_t spread_bytes(const ps_nufft_grid_sizes *sizes, const ps_nufft_choice *choice,
                           size_t real_bytes) {
    const ps_nufft_grid_local local = ps_nufft_grid_spread_local(sizes, choice, real_bytes);
    return local.copies + local.windows + local.cells;
}

static void measure_boxes(ps_nufft_grid_sizes *sizes, const ps_nufft_choice *choice) {
    const unsigned first = PS_NUFFT_MAX_AXES - choice->num_axes;
    sizes->tile_reals = 1;
    for (unsigned i = 0; i < PS_NUFFT_MAX_AXES; i++) {
        const unsigned width = i >= first ? choice->axes[i - first].window.width : 1;
        sizes->boxes[i] = sizes->cells[i] / sizes->edges[i];
        sizes->sides[i] = sizes->edges[i] + width - 1;
        sizes->tile_reals *= (size_t)sizes->boxes[i] * sizes->sides[i];
    }
    sizes->pitch = pitch_of(sizes->sides[PS_NUFFT_MAX_AXES - 1], choice->num_axes);
}

/* The longest edge, and of those the first. */
static unsigned longest_edge(const ps_nufft_grid_sizes *sizes) {
    unsigned longest = 0;
    for (unsigned i = 1; i < PS_NUFFT_MAX_AXES; i++) {
        longest = sizes->edges[i] > sizes->edges[longest] ? i : longest;
    }
    return longest;
}

/* Of a box of the plane with the wanted edges. */
static bool has_few_points(const ps_nufft_choice *choice, double num_points) {
    const double cells = (double)wanted_edges[1][1] * wanted_edges[1][2];
    return choice->num_axes == 2 &&
           num_points * cells < few_points * choice->axes[0].n * choice->axes[1].n;
}

/* Boxes that local memory has room for: with fewer copies first, and then smaller ones; false:
 * not one cell has. */
static bool choose_boxes(ps_nufft_grid_sizes *sizes, const ps_nufft_choice *choice,
                         double num_points, uint64_t local_bytes, size_t real_bytes) {
    const unsigned first = PS_NUFFT_MAX_AXES - choice->num_axes;
    const bool are_few = has_few_points(choice, num_points);
    for (unsigned i = 0; i < PS_NUFFT_MAX_AXES; i++) {
        const uint32_t wanted = wanted_edges[choice->num_axes - 1][i] * (are_few && i > 0 ? 2 : 1);
        const uint32_t fitting = i < first ? 1 : power_of_2_in(choice->axes[i - first].n);
        sizes->cells[i] = i < first ? 1 : choice->axes[i - first].n;
        sizes->edges[i] = fitting < wanted ? fitting : wanted;
    }
    measure_boxes(sizes, choice);
    const double of_box = num_points / (double)ps_nufft_grid_boxes(sizes);
    sizes->copies = of_box >= MOST_COPIES * LEAST_RUNS * GRID_RUN ? MOST_COPIES : 1;
    while (spread_bytes(sizes, choice, real_bytes) > local_bytes) {
        const unsigned longest = longest_edge(sizes);
        if (sizes->copies == 1 && sizes->edges[longest] == 1) {
            return false;
        }
        sizes->edges[longest] /= sizes->copies == 1 ? 2 : 1;
        sizes->copies /= sizes->copies == 1 ? 1 : 2;
        measure_boxes(sizes, choice);
    }
    return true;
}

/* Whole chunks. */
static uint32_t choose_flush(const ps_nufft_grid_sizes *sizes) {
    const double cells = (double)sizes->edges[0] * sizes->edges[1] * sizes->edges[2];
    const uint64_t wanted = (uint64_t)(cells * PS_NUFFT_GRID_FLUSH);
    return (uint32_t)ps_round_up(wanted > 0 ? wanted : 1, (uint64_t)sizes->copies * GRID_RUN);
}

static size_t larger(size_t a, size_t b) {
    return a > b ? a : b;
}

ps_nufft_grid_sizes ps_nufft_grid_measure(const ps_nufft_choice *choice, double num_points,
                                          const ps_device_limits *limits, size_t real_bytes) {
    ps_nufft_grid_sizes sizes = {0};
    if (!choose_boxes(&sizes, choice, num_points, limits->local_bytes, real_bytes)) {
        return sizes;
    }
    sizes.flush = choose_flush(&sizes);
    sizes.local_bytes = spread_bytes(&sizes, choice, real_bytes);
    sizes.num_passes = ps_nufft_passes_measure(sizes.passes, choice, limits, real_bytes);
    for (unsigned i = 0; i < sizes.num_passes; i++) {
        const ps_nufft_pass *pass = &sizes.passes[i];
        const size_t bytes = pass->lines_at_once * ps_nufft_line_reals(pass->length) * real_bytes;
        sizes.local_bytes = larger(sizes.local_bytes, bytes);
        const size_t numbers = pass->is_last && !choice->keeps_sums ? 1 : pass->to;
        sizes.numbers[i % 2] = larger(sizes.numbers[i % 2], numbers);
    }
    return sizes;
}

double ps_nufft_grid_nominal_tile(const ps_nufft_choice *choice, double num_points,
                                  size_t real_bytes) {
    const uint64_t nominal_local_bytes = 48 << 10;
    ps_nufft_grid_sizes sizes = {0};
    const bool fits = choose_boxes(&sizes, choice, num_points, nominal_local_bytes, real_bytes);
    return fits ? (double)sizes.tile_reals : HUGE_VAL;
}

size_t ps_nufft_grid_boxes(const ps_nufft_grid_sizes *sizes) {
    return (size_t)sizes->boxes[0] * sizes->boxes[1] * sizes->boxes[2];
}
