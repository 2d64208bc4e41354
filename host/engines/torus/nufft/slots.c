#include "engines/torus/nufft/slots.h"

/* k or -k, whichever has its rest modulo the first length in the first half. */
static uint32_t line_slot(const ps_nufft_layout *layout, uint32_t k) {
    const uint32_t first = layout->choice.lengths[0];
    const uint32_t rest = k % first;
    uint32_t kept[2];
    ps_nufft_whole_kept(&layout->choice, kept);
    const uint32_t k_1 = rest <= first / 2 ? rest : first - rest;
    const uint32_t q = rest <= first / 2 ? kept[1] + k / first : kept[1] - k / first - 1;
    return (k_1 / layout->lanes * (2 * kept[1] + 1) + q) * layout->lanes + k_1 % layout->lanes;
}

uint32_t ps_nufft_slot(const ps_nufft_layout *layout, const int32_t *k, unsigned dimension) {
    const ps_nufft_choice *choice = &layout->choice;
    const int32_t sign = k[0] < 0 ? -1 : 1; /* |S(-k)| = |S(k)| */
    const uint32_t along = (uint32_t)(sign * k[0]);
    const uint32_t within = choice->stride != 0 ? along % choice->stride : along;
    unsigned num = 0;
    const ps_nufft_axis *last = ps_nufft_last_axes(choice, &num);
    if (choice->is_whole && dimension == 1) {
        return line_slot(layout, along);
    }
    uint32_t slot = within / layout->lanes;
    for (unsigned i = num;
         i-- > 0;) { /* kernels/nufft/columns.cl writes the first axis innermost */
        const int32_t q = choice->stride != 0
                              ? (int32_t)(along / choice->stride) - last[i].max_frequency
                              : sign * k[dimension - num + i];
        slot = slot * (2 * (uint32_t)last[i].max_frequency + 1) +
               (uint32_t)(last[i].max_frequency + q);
    }
    return slot * layout->lanes + within % layout->lanes;
}
