#include "frequencies/frequencies.h"

#include "base/memory.h"
#include "math/lattice_rank.h"
#include "math/pi.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

int64_t ps_frequency_norm2(const int32_t *k, unsigned dimension) {
    int64_t sum = 0;
    for (unsigned i = 0; i < dimension; i++) {
        sum += (int64_t)k[i] * k[i];
    }
    return sum;
}

bool ps_frequency_is_in_half_lattice(const int32_t *k, unsigned dimension) {
    unsigned i = 0;
    while (i < dimension && k[i] == 0) {
        i++;
    }
    return i < dimension && k[i] > 0;
}

/* ((2K+1)^d - 1) / 2, or more than the limit when it does not fit. */
static uint64_t half_box_size(unsigned dimension, int64_t max_frequency) {
    uint64_t size = 1;
    for (unsigned i = 0; i < dimension; i++) {
        if (size > 4 * PS_MAX_NUM_FREQUENCIES) {
            return size;
        }
        size *= (uint64_t)(2 * max_frequency + 1);
    }
    return (size - 1) / 2;
}

/* Half the volume of the ball, whose radius is K + 1/2 for rings by rounding: planning needs no
 * more than this. */
static size_t approximate_half_ball_size(unsigned dimension, int64_t max_norm2) {
    const double quarter = 0.25; /* K^2 + K + 1/4 is the square of K + 1/2 */
    const double radius = sqrt((double)max_norm2 + quarter);
    const double half_dimension = dimension / 2.0;
    const double unit_ball = pow(PS_PI, half_dimension) / tgamma(half_dimension + 1);
    return (size_t)ceil(unit_ball * pow(radius, dimension) / 2);
}

static int32_t largest_allowed(unsigned dimension) {
    int32_t low = 1;
    int32_t high = PS_MAX_FREQUENCY;
    while (low < high) {
        const int32_t middle = low + (high - low + 1) / 2;
        if (half_box_size(dimension, middle) <= PS_MAX_NUM_FREQUENCIES) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

bool ps_frequencies_can_sample(unsigned dimension, int64_t max_frequency) {
    return dimension > 1 && dimension <= PS_MAX_DIMENSION && max_frequency >= 1 &&
           max_frequency <= PS_MAX_SAMPLED_RING &&
           ps_lattice_estimate(dimension, max_frequency * (max_frequency + 1)).most <
               (double)UINT64_MAX;
}

/* The end of a sentence about a K that is too large. */
static const char *say_offers(unsigned dimension, int32_t max_frequency, unsigned offers) {
    const bool may_list = (offers & PS_OFFER_LISTS) != 0 && max_frequency > 0;
    const bool may_sample =
        (offers & PS_OFFER_RINGS) != 0 && ps_frequencies_can_sample(dimension, max_frequency);
    return may_sample && may_list ? "; a random subset of every ring (--per-ring) and lists of "
                                    "frequencies have no such limit"
           : may_sample           ? "; a random subset of every ring (--per-ring) has no such limit"
           : may_list             ? "; a list of frequencies has no such limit"
                                  : "";
}

pspec_status ps_frequencies_lattice(ps_frequencies *out, unsigned dimension, int32_t max_frequency,
                                    bool is_ball, ps_error *error) {
    static const ps_bin_rule rings = {.kind = PS_BINS_ROUND};
    return ps_frequencies_grid(out, dimension, max_frequency, is_ball, &rings, 0, error);
}

pspec_status ps_frequencies_set_bins(ps_frequencies *set, const ps_bin_rule *bins,
                                     ps_error *error) {
    set->bins = *bins;
    set->max_norm2 = ps_bin_rule_largest(bins, set->max_frequency);
    return set->max_norm2 > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "bins of %s reach beyond the frequencies up to %d: none of them is "
                         "complete",
                         ps_bin_rule_write(bins).text, (int)set->max_frequency);
}

pspec_status ps_frequencies_grid(ps_frequencies *out, unsigned dimension, int32_t max_frequency,
                                 bool is_ball, const ps_bin_rule *bins, unsigned offers,
                                 ps_error *error) {
    *out = (ps_frequencies){.kind = is_ball ? PS_FREQUENCIES_BALL : PS_FREQUENCIES_BOX,
                            .dimension = dimension,
                            .max_frequency = max_frequency};
    if (dimension < 1 || dimension > PS_MAX_DIMENSION) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "dimension %u is not between 1 and %d",
                       dimension, PS_MAX_DIMENSION);
    }
    const int32_t largest = largest_allowed(dimension);
    if (max_frequency < 1 || max_frequency > largest) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "max frequency %d is not between 1 and %d, the largest whose full grid in "
                       "dimension %u can be indexed%s",
                       (int)max_frequency, (int)largest, dimension,
                       say_offers(dimension, max_frequency, offers));
    }
    PS_TRY(ps_frequencies_set_bins(out, bins, error));
    const size_t box = (size_t)half_box_size(dimension, max_frequency);
    const size_t ball = approximate_half_ball_size(dimension, out->max_norm2);
    out->num = is_ball && ball < box ? ball : box;
    return PSPEC_OK;
}

static double find_least(const double *stretch, unsigned dimension) {
    double least = stretch[0];
    for (unsigned i = 1; i < dimension; i++) {
        least = fmin(least, stretch[i]);
    }
    return least;
}

int32_t ps_frequencies_limit_reach(int32_t max_frequency, unsigned dimension,
                                   const double *stretch) {
    if (stretch == NULL) {
        return max_frequency;
    }
    /* bins end at K + 1 */
    const double most = largest_allowed(dimension) * find_least(stretch, dimension) - 1;
    return (int32_t)fmin(max_frequency, fmax(most, 1));
}

pspec_status ps_frequencies_stretch(ps_frequencies *grid, const double *stretch, ps_error *error) {
    const ps_frequencies cube = *grid;
    const bool is_ball = cube.kind == PS_FREQUENCIES_BALL;
    const double largest =
        fmin(sqrt((double)cube.max_norm2 + 1) / find_least(stretch, cube.dimension), INT32_MAX);
    ps_error inner = {0};
    const pspec_status status =
        ps_frequencies_grid(grid, cube.dimension, (int32_t)largest, is_ball, &cube.bins, 0, &inner);
    if (status != PSPEC_OK) {
        return ps_fail(error, status, "the box is no cube, and rings up to %d need |k_i| = %d: %s",
                       (int)cube.max_frequency, (int)largest, inner.message);
    }
    const size_t ball = approximate_half_ball_size(cube.dimension, cube.max_norm2);
    grid->num = is_ball && ball < grid->num ? ball : grid->num;
    grid->max_norm2 = cube.max_norm2;
    grid->reach = cube.max_frequency;
    memcpy(grid->stretch, stretch, cube.dimension * sizeof *stretch);
    return PSPEC_OK;
}

int32_t ps_frequencies_reach(const ps_frequencies *set) {
    return set->reach > 0 ? set->reach : set->max_frequency;
}

double ps_frequencies_length2(const ps_frequencies *set, const int32_t *k) {
    double sum = 0;
    if (set->reach == 0) {
        return (double)ps_frequency_norm2(k, ps_frequency_components(set));
    }
    for (unsigned i = 0; i < set->dimension; i++) {
        sum += k[i] * set->stretch[i] * (k[i] * set->stretch[i]);
    }
    return sum;
}

/* Bins that are complete are those below the bin of K + 1; shells end with the rings by rounding.
 */
static int64_t bin_of_length(const ps_frequencies *set, double length2) {
    static const ps_bin_rule rings = {.kind = PS_BINS_ROUND};
    const ps_bin_rule *const borders = set->bins.kind == PS_BINS_SHELLS ? &rings : &set->bins;
    const int64_t outside = ps_bin_rule_find_length(borders, (double)set->max_norm2 + 1);
    return ps_bin_rule_find_length(borders, length2) < outside
               ? ps_bin_rule_find_length(&set->bins, length2)
               : INT64_MAX;
}

int64_t ps_frequencies_bin(const ps_frequencies *set, const int32_t *k) {
    if (set->reach > 0) {
        return bin_of_length(set, ps_frequencies_length2(set, k));
    }
    const int64_t norm2 = ps_frequency_norm2(k, set->dimension);
    return norm2 <= set->max_norm2 ? ps_bin_rule_find(&set->bins, norm2) : INT64_MAX;
}

pspec_status ps_frequencies_list(ps_frequencies *out, unsigned dimension, size_t num,
                                 int32_t *vectors, ps_error *error) {
    *out = (ps_frequencies){
        .kind = PS_FREQUENCIES_LIST, .dimension = dimension, .num = num, .vectors = vectors};
    for (size_t i = 0; i < num * dimension; i++) {
        const int64_t size = llabs((long long)vectors[i]);
        if (size > PS_MAX_FREQUENCY) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                           "frequency %zu has the component %d; the largest allowed is %d",
                           i / dimension + 1, (int)vectors[i], (int)PS_MAX_FREQUENCY);
        }
        out->max_frequency = size > out->max_frequency ? (int32_t)size : out->max_frequency;
    }
    return PSPEC_OK;
}

pspec_status ps_frequencies_degrees(ps_frequencies *out, int64_t max_degree, bool only_even,
                                    ps_error *error) {
    const int32_t first = only_even ? 2 : 1;
    *out = (ps_frequencies){
        .kind = PS_FREQUENCIES_DEGREES, .dimension = PS_SPHERE_DIMENSION, .degree_step = first};
    if (max_degree < first) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "the largest degree %lld leaves none: the first is %d%s",
                       (long long)max_degree, (int)first,
                       only_even ? ", odd degrees vanish on the hemisphere"
                                 : ", degree 0 is known to be N");
    }
    if (max_degree > PS_MAX_DEGREE) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "the largest degree %lld is above %d, where the coefficients of one set "
                       "take 8 GiB",
                       (long long)max_degree, (int)PS_MAX_DEGREE);
    }
    out->max_frequency = (int32_t)(max_degree - max_degree % first);
    out->num = (size_t)(max_degree / first);
    return PSPEC_OK;
}

unsigned ps_frequency_components(const ps_frequencies *frequencies) {
    return frequencies->kind == PS_FREQUENCIES_DEGREES ? 1 : frequencies->dimension;
}

unsigned ps_frequencies_space_dimension(const ps_frequencies *frequencies) {
    return frequencies->kind == PS_FREQUENCIES_DEGREES ? frequencies->dimension - 1
                                                       : frequencies->dimension;
}

/* The next vector of the box in lexicographic order; false after the last. */
static bool advance(int32_t *k, unsigned dimension, int32_t max_frequency) {
    for (unsigned i = dimension; i-- > 0;) {
        if (k[i] < max_frequency) {
            k[i]++;
            return true;
        }
        k[i] = -max_frequency;
    }
    return false;
}

/* Of all bins; cubes need not know which. */
static bool is_outside(const ps_frequencies *set, const int32_t *k) {
    return set->reach > 0 ? ps_frequencies_bin(set, k) == INT64_MAX
                          : ps_frequency_norm2(k, set->dimension) > set->max_norm2;
}

/* Walks through the half lattice after DC; stores vectors where out is not NULL. */
static size_t walk_half_lattice(const ps_frequencies *set, int32_t *out) {
    int32_t k[PS_MAX_DIMENSION] = {0};
    size_t count = 0;
    while (advance(k, set->dimension, set->max_frequency)) {
        if (set->kind == PS_FREQUENCIES_BALL && is_outside(set, k)) {
            continue;
        }
        for (unsigned i = 0; out != NULL && i < set->dimension; i++) {
            out[count * set->dimension + i] = k[i];
        }
        count++;
    }
    return count;
}

static void list_degrees(ps_frequencies *set) {
    for (size_t i = 0; i < set->num; i++) {
        set->vectors[i] = (int32_t)(i + 1) * set->degree_step;
    }
}

/* Vectors with the number of sets that have them. */
typedef struct ps_shared_vectors {
    atomic_size_t num_owners;
    int32_t vectors[];
} ps_shared_vectors;

static pspec_status create_shared(ps_frequencies *set, size_t num_components, ps_error *error) {
    void *memory = NULL;
    const size_t header = sizeof(ps_shared_vectors) / sizeof(int32_t);
    PS_TRY(
        ps_allocate(&memory, header + num_components, sizeof(int32_t), "the frequencies", error));
    set->shared = memory;
    set->vectors = set->shared->vectors;
    atomic_init(&set->shared->num_owners, 1);
    return PSPEC_OK;
}

static pspec_status copy_vectors(ps_frequencies *out, const ps_frequencies *original,
                                 ps_error *error) {
    const size_t num_components = original->num * ps_frequency_components(original);
    if (original->shared != NULL) {
        atomic_fetch_add(&original->shared->num_owners, 1);
        return PSPEC_OK;
    }
    PS_TRY(PS_NEW(&out->vectors, num_components, "the frequencies", error));
    memcpy(out->vectors, original->vectors, num_components * sizeof(int32_t));
    return PSPEC_OK;
}

static void free_vectors(ps_frequencies *set) {
    if (set->shared == NULL) {
        free(set->vectors);
    } else if (atomic_fetch_sub(&set->shared->num_owners, 1) == 1) {
        free(set->shared);
    }
}

pspec_status ps_frequencies_enumerate(ps_frequencies *frequencies, ps_error *error) {
    size_t num_components = 0;
    if (frequencies->vectors != NULL) {
        return PSPEC_OK;
    }
    const bool are_degrees = frequencies->kind == PS_FREQUENCIES_DEGREES;
    const size_t num = are_degrees ? frequencies->num : walk_half_lattice(frequencies, NULL);
    if (!ps_size_multiply(num, ps_frequency_components(frequencies), &num_components)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "%zu frequencies are too many", num);
    }
    PS_TRY(create_shared(frequencies, num_components, error));
    frequencies->num = num;
    if (are_degrees) {
        list_degrees(frequencies);
    } else {
        walk_half_lattice(frequencies, frequencies->vectors);
    }
    return PSPEC_OK;
}

static pspec_status copy_rings(ps_frequencies *out, const ps_frequencies *original,
                               ps_error *error) {
    PS_TRY(PS_NEW(&out->rings, original->num_rings, "the rings", error));
    memcpy(out->rings, original->rings, original->num_rings * sizeof *out->rings);
    return PSPEC_OK;
}

pspec_status ps_frequencies_copy(ps_frequencies *out, const ps_frequencies *original,
                                 ps_error *error) {
    *out = *original;
    out->rings = NULL;
    if (original->shared == NULL) {
        out->vectors = NULL;
    }
    pspec_status status = copy_vectors(out, original, error);
    if (status == PSPEC_OK && original->rings != NULL) {
        status = copy_rings(out, original, error);
    }
    if (status != PSPEC_OK) {
        ps_frequencies_free(out);
    }
    return status;
}

void ps_frequencies_free(ps_frequencies *frequencies) {
    free_vectors(frequencies);
    free(frequencies->rings);
    *frequencies = (ps_frequencies){0};
}

uint64_t ps_frequencies_population(const ps_frequencies *frequencies) {
    uint64_t sum = 0;
    for (size_t i = 0; i < frequencies->num_rings; i++) {
        sum += frequencies->rings[i].num_frequencies;
    }
    return frequencies->rings != NULL ? sum : frequencies->num;
}
