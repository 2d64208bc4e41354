#include "engines/torus/nufft/layout.h"

/* Of frequency 0 of axis 0, kernels/nufft/lines.cl. */
static uint32_t slot_at_zero(const ps_nufft_layout *layout, const int32_t *k) {
    unsigned num = 0;
    const ps_nufft_axis *last = ps_nufft_last_axes(&layout->choice, &num);
    const int32_t sign = k[num] < 0 ? -1 : 1;
    const uint32_t q = (uint32_t)(sign * k[num]);
    const int32_t across = num > 1 ? last[0].max_frequency : 0;
    const uint32_t place =
        num > 1 ? q * (2 * (uint32_t)across + 1) + (uint32_t)(across + sign * k[1]) : q;
    return (uint32_t)layout->first_line_power + place;
}

/* In tiles. along: of axis 0, not negative; sign: of k there */
static uint32_t slot_in_tiles(const ps_nufft_layout *layout, const int32_t *last_k, uint32_t along,
                              int32_t sign) {
    const ps_nufft_choice *choice = &layout->choice;
    const bool has_stride = choice->stride != 0;
    const uint32_t within = has_stride ? along % choice->stride : along - ps_nufft_base(choice);
    unsigned num = 0;
    const ps_nufft_axis *last = ps_nufft_last_axes(choice, &num);
    uint32_t slot = within / layout->lanes;
    for (unsigned i = num;
         i-- > 0;) { /* kernels/nufft/columns.cl writes the first axis innermost */
        const int32_t q = has_stride ? (int32_t)(along / choice->stride) - last[i].max_frequency
                                     : sign * last_k[i];
        slot = slot * (2 * (uint32_t)last[i].max_frequency + 1) +
               (uint32_t)(last[i].max_frequency + q);
    }
    return slot * layout->lanes + within % layout->lanes;
}

uint32_t ps_nufft_tile_slot(const ps_nufft_layout *layout, const int32_t *k, unsigned dimension) {
    const ps_nufft_choice *choice = &layout->choice;
    const int32_t sign = k[0] < 0 ? -1 : 1; /* |S(-k)| = |S(k)| */
    const uint32_t along = (uint32_t)(sign * k[0]);
    if (choice->has_line && along == 0) {
        return slot_at_zero(layout, k);
    }
    return slot_in_tiles(layout, dimension > 1 ? k + 1 : NULL, along, sign);
}
