/* Sums in pairs of single precision, merged on the host as devices do. */
#include "spectra/sums.h"

#define PRECISION 32
#include "accumulate/sums.h"

static block_sums narrow(const ps_sums *sums) {
    return (block_sums){(float)sums->sum, (float)sums->sum_low, (float)sums->square,
                        (float)sums->square_low};
}

void ps_sums_merge_singles(ps_sums *late, const ps_sums *early) {
    const block_sums before = narrow(early);
    block_sums both = narrow(late);
    merge_blocks(&both, &before);
    *late = (ps_sums){both.sum, both.sum_low, both.square, both.square_low};
}
