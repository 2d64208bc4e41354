#include "jobs/spectrum/power_job.h"

#include "frequencies/frequency_sample.h"
#include "points/lists/frequency_list.h"

#include <math.h>
#include <stdlib.h>

static pspec_status default_max_frequency(int32_t *out, const ps_power_question *question,
                                          unsigned dimension, size_t num_points, ps_error *error) {
    /* 5 N^(1/d): what UTK, PSA and GBN show. Above three dimensions it would be a surprise. */
    enum { LARGEST_DIMENSION = 3 };
    const double asked = question->reach > 0 ? question->reach : 5;
    const double most = pow(question->most_reached / (double)num_points, 1.0 / dimension) / 2;
    const double times = question->most_reached > 0 ? fmin(asked, fmax(most, 2)) : asked;
    const unsigned offers = question->limits.constraints.offers;
    if (dimension > LARGEST_DIMENSION) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "in dimension %u the largest frequency must be given: -k K%s", dimension,
                       offers & PS_OFFER_RINGS
                           ? " (and --per-ring S, when all frequencies up to K are too many)"
                           : "");
    }
    /* The root of an exact power may come out a rounding above it. */
    const double root = pow((double)num_points, 1.0 / dimension);
    const double rounding = 1e-12;
    *out = (int32_t)fmin(ceil(times * root * (1 - rounding)), PS_MAX_FREQUENCY);
    return PSPEC_OK;
}

static int64_t find_max_degree(const ps_power_question *question, size_t num_points) {
    /* 4 sqrt N: past the second bump of a blue-noise spectrum, which begins near 1.8 sqrt N. */
    const double times = 4;
    const double by_default = fmin(ceil(times * sqrt((double)num_points)), PS_MAX_DEGREE);
    return question->max_degree > 0 ? question->max_degree : (int64_t)by_default;
}

static int64_t cut(const ps_power_question *question, int64_t largest) {
    const bool is_cut =
        question->useful > 0 && !question->accuracy.no_skip && question->useful < largest;
    return is_cut ? question->useful : largest;
}

static pspec_status read_list(ps_frequencies *out, const char *path, uint64_t memory_limit,
                              unsigned dimension, ps_error *error) {
    int *vectors = NULL;
    size_t num = 0;
    unsigned found = 0;
    PS_TRY(ps_read_frequencies(path, memory_limit, &vectors, &num, &found, error));
    ps_error inner = {0};
    const pspec_status status = ps_frequencies_list(out, found, num, vectors, &inner);
    if (status != PSPEC_OK) {
        return ps_fail(error, status, "\"%s\": %s", path, inner.message);
    }
    if (found != dimension) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "\"%s\" holds frequencies of dimension %u, the points have dimension %u",
                       path, found, dimension);
    }
    return PSPEC_OK;
}

/* The frequency that is shown is one of the grid. */
static pspec_status check_shown(const ps_frequencies_spec *spec, unsigned dimension,
                                int32_t max_frequency, ps_error *error) {
    if (spec->num_shown != 0 && spec->num_shown != dimension) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "the frequency of the scatter has %u number%s, and points have %u",
                       spec->num_shown, spec->num_shown == 1 ? "" : "s", dimension);
    }
    for (unsigned axis = 0; axis < spec->num_shown; axis++) {
        if (abs(spec->shown[axis]) > max_frequency) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                           "the frequency of the scatter has the number %d, and the largest "
                           "frequency (-k) is %d",
                           (int)spec->shown[axis], (int)max_frequency);
        }
    }
    return PSPEC_OK;
}

pspec_status ps_power_frequencies(ps_frequencies *out, const ps_power_question *question,
                                  unsigned dimension, size_t num_points, const ps_box *box,
                                  ps_error *error) {
    int32_t max_frequency = question->frequencies.max_frequency;
    double numbers[PS_MAX_DIMENSION];
    ps_bin_rule bins = question->frequencies.bins;
    if (question->on_sphere) {
        return ps_frequencies_degrees(out, cut(question, find_max_degree(question, num_points)),
                                      question->on_hemisphere, error);
    }
    if (question->frequencies.path != NULL) {
        return read_list(out, question->frequencies.path, question->limits.constraints.memory_limit,
                         dimension, error);
    }
    const double *const stretch =
        question->has_rings_of_box && ps_box_stretch(box, dimension, numbers) ? numbers : NULL;
    if (max_frequency == 0) {
        PS_TRY(default_max_frequency(&max_frequency, question, dimension, num_points, error));
        max_frequency = ps_frequencies_limit_reach(max_frequency, dimension, stretch);
    }
    max_frequency = (int32_t)cut(question, max_frequency);
    ps_bin_rule_resolve(&bins, dimension, num_points);
    if (question->frequencies.per_ring > 0 && stretch != NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--per-ring draws from rings of a cube, and the box of these points is "
                       "none; pointspec convert writes them as points of the unit cube");
    }
    if (question->frequencies.per_ring > 0) {
        const ps_frequency_sample sample = {.dimension = dimension,
                                            .max_frequency = max_frequency,
                                            .bins = bins,
                                            .per_ring = question->frequencies.per_ring,
                                            .seed = question->per_ring_seed};
        return ps_frequencies_sample(out, &sample, error);
    }
    const bool only_ball = !question->wants_full_array && !question->accuracy.no_skip;
    PS_TRY(ps_frequencies_grid(out, dimension, max_frequency, only_ball, &bins,
                               question->limits.constraints.offers, error));
    PS_TRY(stretch == NULL ? PSPEC_OK : ps_frequencies_stretch(out, stretch, error));
    return check_shown(&question->frequencies, dimension, out->max_frequency, error);
}

int32_t ps_power_frequencies_uncut(const ps_power_question *question, unsigned dimension,
                                   size_t num_points) {
    int32_t largest = question->frequencies.max_frequency;
    if (question->useful == 0) {
        return 0;
    }
    if (question->on_sphere) {
        return (int32_t)find_max_degree(question, num_points);
    }
    if (question->frequencies.path != NULL ||
        (largest == 0 &&
         default_max_frequency(&largest, question, dimension, num_points, NULL) != PSPEC_OK)) {
        return 0;
    }
    return largest;
}
