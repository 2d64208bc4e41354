/* What powers are computed of. On the torus integer frequencies: a list that somebody made, or the
 * half lattice of a box. On the sphere degrees.
 *
 * Real weights make |S(-k)| = |S(k)|, so a box |k_i| <= K is represented by its half lattice: the k
 * whose first non-zero component is positive, in lexicographic order, DC left out
 * (docs/mathematics/torus.md#rings). A ball keeps only the k of bins that are complete in the box,
 * by rounding |k|^2 <= K^2 + K: all rings 1..K, no corners.
 *
 * The power of a degree l is a mean over its 2l + 1 orders
 * (docs/mathematics/sphere.md#coefficients-and-power). Degree 0 is the DC of the sphere and left
 * out like it; on the hemisphere, the projective plane, only even degrees are there
 * (docs/mathematics/sphere.md#hemisphere).
 */
#ifndef PS_FREQUENCIES_FREQUENCIES_H
#define PS_FREQUENCIES_FREQUENCIES_H

#include "base/status.h"
#include "frequencies/bin_rule.h"
#include "math/dimension.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Largest |k_i|: fixed-point phases in float stay exact to a few units below it (torus/phase.h:
 * the sum over six axes must stay below 2^31). */
#define PS_MAX_FREQUENCY ((int32_t)1 << 28)

typedef enum ps_frequency_kind {
    PS_FREQUENCIES_LIST,
    PS_FREQUENCIES_BOX,
    PS_FREQUENCIES_BALL,
    PS_FREQUENCIES_DEGREES
} ps_frequency_kind;

/* Largest degree: the coefficients of one set take 8 GiB there, and nothing was tested above. */
#define PS_MAX_DEGREE ((int32_t)1 << 15)

/* Coordinates of a point on the sphere: a unit vector. */
enum { PS_SPHERE_DIMENSION = 3 };

/* A ring or shell of which a list holds a part, or all. */
typedef struct ps_sampled_ring {
    uint64_t num_frequencies; /* half-lattice frequencies that the ring has */
    double mean_frequency;    /* mean |k| of all of them */
} ps_sampled_ring;

typedef struct ps_frequencies {
    ps_frequency_kind kind;
    unsigned dimension;    /* coordinates of a point */
    int32_t max_frequency; /* K; for a list the largest |k_i| in it; L for degrees */
    size_t num;            /* exact but for balls that are not enumerated */
    /* [num][ps_frequency_components]; NULL for boxes, balls and degrees not yet enumerated */
    int32_t *vectors;
    struct ps_shared_vectors *shared; /* of enumerated sets: their copies have the same vectors */
    int32_t degree_step; /* from degree to degree: 1, or 2 on the hemisphere; 0 on the torus */
    /* How grids, and lists that were drawn from rings, are put into bins, and the largest |k|^2 of
     * bins that are reported; 0 for other lists and for degrees */
    ps_bin_rule bins;
    int64_t max_norm2;
    /* Of a grid in a box that is no cube, else 0: K of its bins, where max_frequency is the largest
     * |k_i| that they need, and what k_i is multiplied by to be in cycles per edge of the cube of
     * the same volume (points/box.h); |k| is then the length of that vector */
    int32_t reach;
    double stretch[PS_MAX_DIMENSION];

    /* A list that holds at most per_ring frequencies of every ring or shell up to max_norm2
     * (frequencies/frequency_sample.h). Otherwise 0, 0 and NULL. */
    uint64_t per_ring;
    size_t num_rings;
    ps_sampled_ring *rings; /* ascending */
} ps_frequencies;

/* Slots of results are 32-bit indices on the device, with padding and both signs. */
#define PS_MAX_NUM_FREQUENCIES (((uint64_t)1 << 31) / 4)

/* What a question may be asked of instead of all frequencies, for sentences that say what would
 * help. */
enum {
    PS_OFFER_RINGS = 1, /* a random subset of every ring */
    PS_OFFER_LISTS = 2
};

/* Counting rings up to K takes (d + 1) K^2 numbers of 64 bits and d K^3 additions: at this K, 200
 * MB and some ten seconds. */
enum { PS_MAX_SAMPLED_RING = 2000 };

/* Is there a subset of fewer frequencies than all up to K? In one dimension a ring has one, and
 * beyond a K, or where there are more than can be counted, nobody knows how many a ring has. */
bool ps_frequencies_can_sample(unsigned dimension, int64_t max_frequency);

/* A box or ball of rings by rounding, not enumerated: costs nothing, whatever the size. dimension
 * 1..6, K >= 1. More frequencies than an index holds: PSPEC_ERROR_INVALID_ARGUMENT with the largest
 * K that fits. */
pspec_status ps_frequencies_lattice(ps_frequencies *out, unsigned dimension, int32_t max_frequency,
                                    bool is_ball, ps_error *error) PS_MUST_CHECK;
/* The same in bins of a rule that is resolved, with a sentence that says which of these offers
 * there are, where K is too large. A K below the first bin is PSPEC_ERROR_INVALID_ARGUMENT. */
pspec_status ps_frequencies_grid(ps_frequencies *out, unsigned dimension, int32_t max_frequency,
                                 bool is_ball, const ps_bin_rule *bins, unsigned offers,
                                 ps_error *error) PS_MUST_CHECK;
/* Makes a grid that is not enumerated one of a box that is no cube: all |k| up to its K. */
pspec_status ps_frequencies_stretch(ps_frequencies *grid, const double *stretch,
                                    ps_error *error) PS_MUST_CHECK;
/* K, or the largest one, 1 at least, whose full grid in the box can be indexed; NULL: a cube, K. */
int32_t ps_frequencies_limit_reach(int32_t max_frequency, unsigned dimension,
                                   const double *stretch);
/* K or L that was asked for. */
int32_t ps_frequencies_reach(const ps_frequencies *set);
/* |k|^2 of a box of any shape, or of a degree. */
double ps_frequencies_length2(const ps_frequencies *set, const int32_t *k);
/* The bin of k != 0, or INT64_MAX where it is in none that is reported. */
int64_t ps_frequencies_bin(const ps_frequencies *set, const int32_t *k);
/* The rule and its largest |k|^2 for this K, where a bin is complete. */
pspec_status ps_frequencies_set_bins(ps_frequencies *set, const ps_bin_rule *bins,
                                     ps_error *error) PS_MUST_CHECK;
/* A list: takes vectors over ([num][dimension], allocated by malloc). */
pspec_status ps_frequencies_list(ps_frequencies *out, unsigned dimension, size_t num,
                                 int32_t *vectors, ps_error *error) PS_MUST_CHECK;
/* Degrees 1 .. max_degree, or with only_even 2, 4 .. max_degree, not enumerated. An L that leaves
 * none or is larger than PS_MAX_DEGREE is PSPEC_ERROR_INVALID_ARGUMENT. */
pspec_status ps_frequencies_degrees(ps_frequencies *out, int64_t max_degree, bool only_even,
                                    ps_error *error) PS_MUST_CHECK;
/* Numbers of a vector: the dimension, or 1 for degrees. */
unsigned ps_frequency_components(const ps_frequencies *frequencies);
/* Dimension of the space that the points fill: 2 on the sphere. */
unsigned ps_frequencies_space_dimension(const ps_frequencies *frequencies);
/* Fills vectors (and the exact num of a ball). */
pspec_status ps_frequencies_enumerate(ps_frequencies *frequencies, ps_error *error) PS_MUST_CHECK;
/* A copy that may outlive the original, which is enumerated. Vectors are read only then: copies of
 * grids and degrees share them, whatever threads have them. */
pspec_status ps_frequencies_copy(ps_frequencies *out, const ps_frequencies *original,
                                 ps_error *error) PS_MUST_CHECK;
void ps_frequencies_free(ps_frequencies *frequencies);
/* Half-lattice frequencies of all rings that the list was drawn from; num when it was not. */
uint64_t ps_frequencies_population(const ps_frequencies *frequencies);

/* |k|^2 */
int64_t ps_frequency_norm2(const int32_t *k, unsigned dimension);
/* True when the first non-zero component is positive. */
bool ps_frequency_is_in_half_lattice(const int32_t *k, unsigned dimension);

#endif
