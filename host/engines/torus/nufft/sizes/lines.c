#include "engines/torus/nufft/layout.h"

#include "base/round.h"

/* Rows of powers are whole vectors. */
enum { POWER_UNIT = 16 };

/* kernels/nufft/line.h */
static size_t spread_reals_of(const ps_nufft_axis *axis) {
    const size_t bins = ps_nufft_bins(axis);
    return PS_NUFFT_LINE_ROWS * (axis->n + bins) + PS_NUFFT_CHUNK * bins;
}

ps_nufft_line_sizes ps_nufft_lines_measure(const ps_nufft_choice *choice, unsigned lanes) {
    unsigned num = 0;
    const ps_nufft_axis *axes = ps_nufft_last_axes(choice, &num);
    if (!choice->has_line) {
        return (ps_nufft_line_sizes){.cells = 0};
    }
    const ps_nufft_axis *along = &axes[num - 1];
    const bool has_rows = num == 2;
    const size_t rows = has_rows ? axes[0].n : 1;
    const size_t kept = (size_t)along->max_frequency + 1;
    const size_t columns = has_rows ? 2 * (size_t)axes[0].max_frequency + 1 : 1;
    return (ps_nufft_line_sizes){.cells = rows * along->n,
                                 .grid_reals = has_rows ? kept * rows * 2 * lanes : 0,
                                 .powers = ps_round_up(kept * columns, POWER_UNIT),
                                 .spread_reals = spread_reals_of(along)};
}

bool ps_nufft_lines_pay(const ps_nufft_choice *choice, const ps_problem *problem) {
    const bool is_alone =
        choice->stride == 0 && choice->span > 1 && choice->span % choice->lanes == 1;
    return is_alone && problem->num_realizations != 1;
}
