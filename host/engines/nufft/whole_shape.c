#include "engines/nufft/whole_shape.h"

#include "device/reals.h"
#include "engines/nufft/cost.h"
#include "engines/nufft/sizes/whole.h"

#include <math.h>

/* The grid stays in the cache of a core (1 MB, Zen 5), or nearly. Nominal, whatever the device has,
 * so that choices depend on nothing else. */
static const double most_bytes = 1.25 * (1 << 20);

/* Chooses the factors of the grid of one dimension by what the transforms take. The optimum is flat
 * (first lengths of 128 to 4096 of 131072 cells take the same time within 5 %), so it is looked for
 * up to twice the root. */
static void choose_lengths(ps_nufft_choice *choice) {
    const uint32_t n = choice->axes[0].n;
    double least = HUGE_VAL;
    for (uint32_t first = 2; first * first <= 4 * n; first++) {
        ps_nufft_choice other = *choice;
        uint32_t kept[2];
        if (n % first != 0) {
            continue;
        }
        other.lengths[0] = first;
        other.lengths[1] = n / first;
        other.span = first / 2 + 1;
        ps_nufft_whole_kept(&other, kept);
        const double cycles = ps_nufft_whole_transform_cycles(&other);
        if (2 * kept[1] + 1 <= other.lengths[1] && cycles < least) {
            least = cycles;
            *choice = other;
        }
    }
}

bool ps_nufft_whole_shape(ps_nufft_choice *choice, ps_precision precision) {
    choice->lengths[0] = 0;
    if (choice->num_axes == 1) {
        choose_lengths(choice);
    } else {
        choice->lengths[0] = choice->axes[0].n;
        choice->lengths[1] = choice->axes[1].n;
    }
    if (choice->lengths[0] == 0) {
        return false;
    }
    const ps_nufft_whole_sizes sizes = ps_nufft_whole_measure(choice, choice->lanes);
    return (double)(sizes.grid_reals + sizes.row_reals) * (double)ps_real_bytes(precision) <=
           most_bytes;
}
