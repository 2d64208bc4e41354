/* A random subset of the frequencies of every ring or shell, for lattices too large to be walked
 * through: in six dimensions ring 100 alone has 3e11 frequencies.
 *
 * Rings with at most per_ring half-lattice frequencies are complete; of every other one, per_ring
 * are drawn without replacement, all subsets being equally probable, so that the mean over the
 * subset is an unbiased estimate of the mean over the ring. Nothing is listed: rings are counted,
 * ranks are drawn, and vectors made from ranks (math/lattice_rank.h). What is drawn from a ring or
 * shell depends on the seed, the dimension, its number and per_ring alone, not on K.
 */
#ifndef PS_FREQUENCIES_FREQUENCY_SAMPLE_H
#define PS_FREQUENCIES_FREQUENCY_SAMPLE_H

#include "frequencies/frequencies.h"

/* A ring's subset needs two frequencies to have a variance. */
enum { PS_MIN_PER_RING = 2 };

typedef struct ps_frequency_sample {
    unsigned dimension;
    int32_t max_frequency; /* K: of bins that are complete in the box |k_i| <= K */
    ps_bin_rule bins;      /* resolved */
    uint64_t per_ring;
    uint64_t seed;
} ps_frequency_sample;

/* A list, ring by ring, lexicographic in each; or the ball up to K, not enumerated, when every ring
 * is complete, as always in one dimension. Too large a K, more frequencies than can be counted or
 * indexed, or per_ring < 2: PSPEC_ERROR_INVALID_ARGUMENT. */
pspec_status ps_frequencies_sample(ps_frequencies *out, const ps_frequency_sample *sample,
                                   ps_error *error) PS_MUST_CHECK;

#endif
