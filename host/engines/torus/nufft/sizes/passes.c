#include "engines/torus/nufft/sizes/grid.h"

#include "base/round.h"

/* ---- radices ------------------------------------------------------------------------------ */

/* Those of kernels/nufft/grid/stockham.h. */
static const uint32_t known[] = {16, 9, 8, 7, 5, 4, 3, 2};
enum { NUM_KNOWN = sizeof known / sizeof known[0] };

/* The product of `num` radices from known[first] on. */
static bool find_radices(uint32_t length, unsigned num, size_t first, uint32_t *radices) {
    if (num == 0) {
        return length == 1;
    }
    for (size_t i = first; i < NUM_KNOWN; i++) {
        radices[0] = known[i];
        if (length % known[i] == 0 && find_radices(length / known[i], num - 1, i, radices + 1)) {
            return true;
        }
    }
    return false;
}

/* Radices whose product is the length, as few as possible and the largest first; false: more
 * than there may be. */
static bool choose_radices(uint32_t length, uint32_t radices[PS_NUFFT_PASS_RADICES]) {
    for (unsigned num = 1; num <= PS_NUFFT_PASS_RADICES; num++) {
        for (unsigned i = num; i < PS_NUFFT_PASS_RADICES; i++) {
            radices[i] = 1;
        }
        if (find_radices(length, num, 0, radices)) {
            return true;
        }
    }
    return false;
}

/* ---- lines -------------------------------------------------------------------------------- */

size_t ps_nufft_line_reals(uint32_t length) {
    enum { BANKS = 32, BEHIND = 40, PAD_EVERY = 16 };
    return (length + length / PAD_EVERY) / BANKS * BANKS + BEHIND;
}

/* A work-item holds at least so many numbers of a line. */
enum { LEAST_HELD = 16 };

/* Work-items hold twice as many at most, and local memory one line at least. */
static bool fits(uint32_t length, const ps_device_limits *limits, size_t real_bytes) {
    const uint64_t most = 2 * (uint64_t)LEAST_HELD * limits->max_work_group_size;
    uint32_t radices[PS_NUFFT_PASS_RADICES];
    return length <= most && ps_nufft_line_reals(length) * real_bytes <= limits->local_bytes &&
           choose_radices(length, radices);
}

/* The length of the first half of lines, the largest that is not beyond the second; 1: they are
 * not cut; 0: there is no such length. */
static uint32_t cut_line(uint32_t n, const ps_device_limits *limits, size_t real_bytes) {
    uint32_t best = fits(n, limits, real_bytes) ? 1 : 0;
    for (uint32_t a = 2; best != 1 && (uint64_t)a * a <= n; a++) {
        const bool is_fit =
            n % a == 0 && fits(a, limits, real_bytes) && fits(n / a, limits, real_bytes);
        best = is_fit ? a : best;
    }
    return best;
}

/* Lines next to each other fill whole sectors of 32 bytes, and work-groups are not small. */
static void fill_group(ps_nufft_pass *pass, const ps_device_limits *limits, size_t real_bytes) {
    enum { SECTOR_LINES = 4, MOST_LINES = 16, WANTED_ITEMS = 128 };
    const uint32_t of_line = (uint32_t)ps_divide_up(pass->length, LEAST_HELD);
    const size_t line_bytes = ps_nufft_line_reals(pass->length) * real_bytes;
    uint32_t lines = pass->inner > 1 ? SECTOR_LINES : 1;
    while (lines < MOST_LINES && 2 * lines * of_line <= WANTED_ITEMS) {
        lines *= 2;
    }
    while (lines > 1 && (lines * line_bytes > limits->local_bytes ||
                         (size_t)lines * of_line > limits->max_work_group_size)) {
        lines /= 2;
    }
    pass->lines_at_once = lines;
    pass->items = lines * of_line;
}

/* ---- all passes --------------------------------------------------------------------------- */

static uint64_t kept_of(const ps_nufft_choice *choice, unsigned axis) {
    const uint64_t K = (uint64_t)choice->axes[axis].max_frequency;
    return axis + 1 == choice->num_axes ? K + 1 : 2 * K + 1;
}

/* Adds one pass; outer lines of an axis in front of it, inner numbers behind. */
static void add_pass(ps_nufft_pass *pass, const ps_device_limits *limits, size_t real_bytes,
                     uint64_t outer) {
    choose_radices(pass->length, pass->radices);
    pass->lines = outer * pass->inner;
    pass->from = pass->lines * pass->length;
    fill_group(pass, limits, real_bytes);
}

bool ps_nufft_pass_measure(ps_nufft_pass *pass, uint32_t length, uint64_t lines,
                           const ps_device_limits *limits, size_t real_bytes) {
    *pass = (ps_nufft_pass){.length = length, .inner = 1};
    if (!fits(length, limits, real_bytes)) {
        return false;
    }
    add_pass(pass, limits, real_bytes, lines);
    return true;
}

unsigned ps_nufft_passes_measure(ps_nufft_pass passes[PS_NUFFT_MOST_PASSES],
                                 const ps_nufft_choice *choice, const ps_device_limits *limits,
                                 size_t real_bytes) {
    unsigned num = 0;
    uint64_t outer = 1, inner = 1;
    for (unsigned i = 0; i < choice->num_axes; i++) {
        outer *= choice->axes[i].n;
    }
    for (unsigned i = choice->num_axes; i-- > 0;) {
        const uint32_t n = choice->axes[i].n, first = cut_line(n, limits, real_bytes);
        outer /= n;
        if (first == 0) {
            return 0;
        }
        if (first > 1) {
            passes[num] = (ps_nufft_pass){.axis = i,
                                          .length = first,
                                          .is_first = num == 0,
                                          .is_turned = true,
                                          .inner = inner * (n / first),
                                          .apart = 1,
                                          .neighbours = (uint32_t)inner};
            add_pass(&passes[num], limits, real_bytes, outer);
            passes[num].to = passes[num].from;
            num++;
        }
        passes[num] = (ps_nufft_pass){.axis = i,
                                      .length = n / first,
                                      .is_first = num == 0,
                                      .is_last = i == 0,
                                      .inner = inner,
                                      .apart = first,
                                      .neighbours = 1};
        add_pass(&passes[num], limits, real_bytes, outer * first);
        passes[num].to = outer * kept_of(choice, i) * inner;
        inner *= kept_of(choice, i);
        num++;
    }
    return num;
}
