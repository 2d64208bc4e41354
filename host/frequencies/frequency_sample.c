#include "frequencies/frequency_sample.h"

#include "base/memory.h"
#include "math/lattice_rank.h"
#include "math/random/subset.h"

#include <stdlib.h>

_Static_assert((int)PS_LATTICE_MAX_DIMENSION == (int)PS_MAX_DIMENSION,
               "lattices are counted in as many dimensions as there are");

/* The |k|^2 of one ring or shell. */
typedef struct ring_range {
    uint64_t number; /* of the bin */
    int64_t low, high;
} ring_range;

/* The ring that begins at a |k|^2: 1, or one above the end of another. Rings that no whole number
 * falls into are passed over. */
static ring_range range_from(const ps_frequency_sample *sample, int64_t low) {
    const int64_t number = ps_bin_rule_find(&sample->bins, low);
    return (ring_range){(uint64_t)number, low, ps_bin_rule_low(&sample->bins, number + 1) - 1};
}

static int64_t largest_norm2(const ps_frequency_sample *sample) {
    return ps_bin_rule_largest(&sample->bins, sample->max_frequency);
}

static uint64_t last_number(const ps_frequency_sample *sample) {
    return (uint64_t)ps_bin_rule_find(&sample->bins, largest_norm2(sample));
}

static uint64_t half_size(const ps_lattice *lattice, ring_range range) {
    return ps_lattice_count(lattice, range.low, range.high) / 2;
}

static uint64_t num_drawn(const ps_frequency_sample *sample, uint64_t size) {
    return size < sample->per_ring ? size : sample->per_ring;
}

/* Rings that have frequencies, the frequencies to be drawn, and whether these are all there are. */
static void count_rings(const ps_frequency_sample *sample, const ps_lattice *lattice,
                        size_t *num_rings, uint64_t *num, bool *is_complete) {
    *num_rings = 0;
    *num = 0;
    *is_complete = true;
    const int64_t largest = largest_norm2(sample);
    for (ring_range ring = range_from(sample, 1); ring.low <= largest;
         ring = range_from(sample, ring.high + 1)) {
        const uint64_t size = half_size(lattice, ring);
        *num_rings += size > 0;
        *num += num_drawn(sample, size);
        *is_complete = *is_complete && size <= sample->per_ring;
        if (*num > PS_MAX_NUM_FREQUENCIES) {
            return;
        }
    }
}

static pspec_status draw_ring(const ps_frequency_sample *sample, const ps_lattice *lattice,
                              ring_range range, uint64_t *ranks, int32_t *vectors,
                              ps_error *error) {
    const uint64_t size = half_size(lattice, range);
    const size_t num = (size_t)num_drawn(sample, size);
    ps_random random = ps_random_init(sample->seed, PS_STREAM_FREQUENCIES, range.number);
    if (num == size) {
        for (size_t i = 0; i < num; i++) {
            ranks[i] = i;
        }
    } else {
        PS_TRY(ps_random_subset(ranks, num, size, &random, error));
    }
    for (size_t i = 0; i < num; i++) { /* the half lattice is the upper half of the ranks */
        ps_lattice_unrank(lattice, range.low, range.high, size + ranks[i],
                          vectors + i * sample->dimension);
    }
    return PSPEC_OK;
}

static pspec_status draw_rings(ps_frequencies *out, const ps_frequency_sample *sample,
                               const ps_lattice *lattice, ps_error *error) {
    uint64_t *ranks = NULL;
    size_t ring = 0;
    size_t at = 0;
    pspec_status status = PSPEC_OK;
    const size_t most = (size_t)num_drawn(sample, out->num);
    PS_TRY(PS_NEW(&ranks, most, "ranks of frequencies", error));
    for (ring_range range = range_from(sample, 1); status == PSPEC_OK && ring < out->num_rings;
         range = range_from(sample, range.high + 1)) {
        const uint64_t size = half_size(lattice, range);
        if (size == 0) {
            continue;
        }
        out->rings[ring++] =
            (ps_sampled_ring){size, ps_lattice_mean_norm(lattice, range.low, range.high)};
        status =
            draw_ring(sample, lattice, range, ranks, out->vectors + at * sample->dimension, error);
        at += (size_t)num_drawn(sample, size);
    }
    free(ranks);
    return status;
}

static pspec_status allocate(ps_frequencies *out, const ps_frequency_sample *sample,
                             size_t num_rings, uint64_t num, ps_error *error) {
    *out = (ps_frequencies){.kind = PS_FREQUENCIES_LIST,
                            .dimension = sample->dimension,
                            .max_frequency = sample->max_frequency,
                            .num = (size_t)num,
                            .per_ring = sample->per_ring,
                            .num_rings = num_rings};
    PS_TRY(ps_frequencies_set_bins(out, &sample->bins, error));
    PS_TRY(PS_NEW(&out->rings, num_rings, "the rings", error));
    PS_TRY(ps_allocate_for(&out->vectors, (size_t)num, sample->dimension * sizeof(int32_t),
                           "the frequencies", error));
    return PSPEC_OK;
}

static pspec_status check_number(const ps_frequency_sample *sample, uint64_t num, ps_error *error) {
    return num <= PS_MAX_NUM_FREQUENCIES
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%llu frequencies of every ring or shell up to %llu are more than %llu, "
                         "which can be indexed",
                         (unsigned long long)sample->per_ring,
                         (unsigned long long)last_number(sample),
                         (unsigned long long)PS_MAX_NUM_FREQUENCIES);
}

static pspec_status make_ball(ps_frequencies *out, const ps_frequency_sample *sample,
                              ps_error *error) {
    return ps_frequencies_grid(out, sample->dimension, sample->max_frequency, true, &sample->bins,
                               0, error);
}

static pspec_status make(ps_frequencies *out, const ps_frequency_sample *sample,
                         const ps_lattice *lattice, ps_error *error) {
    size_t num_rings = 0;
    uint64_t num = 0;
    bool is_complete = false;
    count_rings(sample, lattice, &num_rings, &num, &is_complete);
    PS_TRY(check_number(sample, num, error));
    if (is_complete) {
        return make_ball(out, sample, error);
    }
    pspec_status status = allocate(out, sample, num_rings, num, error);
    if (status == PSPEC_OK) {
        status = draw_rings(out, sample, lattice, error);
    }
    if (status != PSPEC_OK) {
        ps_frequencies_free(out);
    }
    return status;
}

/* No fewer frequencies than rings up to K have, when those up to a smaller one have num. Rings of
 * width 1 and more grow like b^(d-1), and from FIRST on their sizes differ from that by far less
 * than twice: where one has twice what is drawn, the later ones have enough. Narrower rings and
 * shells, of which there are more than K, do not grow like that. */
static uint64_t at_least(const ps_frequency_sample *sample, const ps_frequency_sample *part,
                         const ps_lattice *lattice, uint64_t num) {
    const uint64_t number = last_number(part);
    const int64_t low = ps_bin_rule_low(&part->bins, (int64_t)number);
    const ring_range last = {number, low, largest_norm2(part)};
    const bool are_large =
        number <= (uint64_t)part->max_frequency && half_size(lattice, last) / 2 >= sample->per_ring;
    return are_large ? num + (last_number(sample) - number) * sample->per_ring : num;
}

/* Counting all rings takes seconds where K is large: those of a smaller K, counted in an eighth of
 * the time of twice that K, tell mostly that there are too many. */
static pspec_status refuse_soon(const ps_frequency_sample *sample, ps_error *error) {
    enum { FIRST = 125, TIMES = 2 };
    ps_frequency_sample part = *sample;
    for (part.max_frequency = FIRST; part.max_frequency < sample->max_frequency;
         part.max_frequency *= TIMES) {
        ps_lattice lattice;
        size_t num_rings = 0;
        uint64_t num = 0;
        bool is_complete = false;
        if (largest_norm2(&part) == 0) {
            continue; /* no bin is that narrow */
        }
        PS_TRY(ps_lattice_create(&lattice, part.dimension, largest_norm2(&part), error));
        count_rings(&part, &lattice, &num_rings, &num, &is_complete);
        num = num <= PS_MAX_NUM_FREQUENCIES ? at_least(sample, &part, &lattice, num) : num;
        ps_lattice_free(&lattice);
        PS_TRY(check_number(sample, num, error));
    }
    return PSPEC_OK;
}

static pspec_status check(const ps_frequency_sample *sample, ps_error *error) {
    if (sample->dimension < 1 || sample->dimension > PS_MAX_DIMENSION) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "dimension %u is not between 1 and %d",
                       sample->dimension, PS_MAX_DIMENSION);
    }
    if (sample->per_ring < PS_MIN_PER_RING) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%llu frequencies per ring have no variance: at least %d are needed",
                       (unsigned long long)sample->per_ring, PS_MIN_PER_RING);
    }
    if (sample->dimension > 1 &&
        (sample->max_frequency < 1 || sample->max_frequency > PS_MAX_SAMPLED_RING)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "max frequency %d is not between 1 and %d, the largest whose rings are "
                       "counted for a random subset of each",
                       (int)sample->max_frequency, PS_MAX_SAMPLED_RING);
    }
    ps_frequencies set = {.max_frequency = sample->max_frequency};
    return sample->dimension > 1 ? ps_frequencies_set_bins(&set, &sample->bins, error) : PSPEC_OK;
}

pspec_status ps_frequencies_sample(ps_frequencies *out, const ps_frequency_sample *sample,
                                   ps_error *error) {
    ps_lattice lattice;
    *out = (ps_frequencies){0};
    PS_TRY(check(sample, error));
    if (sample->dimension == 1) { /* where a ring has one frequency of the half lattice */
        return make_ball(out, sample, error);
    }
    if (ps_lattice_estimate(sample->dimension, largest_norm2(sample)).least < (double)UINT64_MAX) {
        PS_TRY(refuse_soon(sample, error));
    }
    PS_TRY(ps_lattice_create(&lattice, sample->dimension, largest_norm2(sample), error));
    const pspec_status status = make(out, sample, &lattice, error);
    ps_lattice_free(&lattice);
    return status;
}
