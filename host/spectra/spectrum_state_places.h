/* What writer and reader of state agree on: places in its arrays, and their names. */
#ifndef PS_SPECTRA_SPECTRUM_STATE_PLACES_H
#define PS_SPECTRA_SPECTRUM_STATE_PLACES_H

#include "math/dimension.h"

#include <stddef.h>
#include <stdio.h>

/* Places of state_question: members of ps_frequencies, its rule of bins and its stretch. */
enum {
    DIMENSION,
    KIND,
    DEGREE_STEP,
    MAX_FREQUENCY,
    REACH,
    PER_RING,
    BINS,
    NUMERATOR,
    DENOMINATOR,
    RELATIVE_TO, /* number of points of relative widths */
    NORMALIZATION,
    STRETCH,
    QUESTION_SIZE = STRETCH + PS_MAX_DIMENSION
};

/* Places of state_totals: members of ps_spectrum_sums and of its totals. */
enum { SUM_SIZE = 4, MEAN_SIZE = 2 };
enum {
    REALIZATIONS,
    NUM_EQUAL,
    SMALLEST,
    LARGEST,
    SUM_WEIGHTS,
    REFERENCE,
    ERROR,
    SELF_CHECK,
    LENGTH_ERROR,
    POINTS,
    SAMPLE_SIZES = POINTS + SUM_SIZE,
    TOTALS_SIZE = SAMPLE_SIZES + SUM_SIZE
};

/* Places of state_range: realizations of the range and of the job, which sums are in single
 * precision, the tolerance, what an error follows from, and what this plan was made for and another
 * would be; and the columns of state_parts. */
enum {
    RANGE_FIRST,
    RANGE_END,
    RANGE_ALL,
    RANGE_SINGLE_BINS,
    RANGE_SINGLE_POWERS,
    RANGE_TOLERANCE,
    RANGE_AMPLITUDE_ERROR,
    RANGE_SHARE,
    RANGE_POWER,
    RANGE_PLANS,
    RANGE_PLANNED_POWER,
    RANGE_PLANNED_SHARE,
    RANGE_PLANNED_POINTS,
    RANGE_SIZE
};
enum { PART_FIRST, PART_NUM, PART_TOTALS, PART_SIZE = PART_TOTALS + 3 * SUM_SIZE };

typedef struct ps_state_name {
    char text[48];
} ps_state_name;

/* Of an array of that question, "state_bins" or "state_bins_2". */
static inline ps_state_name ps_state_name_of(const char *stem, size_t question) {
    ps_state_name out;
    if (question == 0) {
        snprintf(out.text, sizeof out.text, "%s", stem);
    } else {
        snprintf(out.text, sizeof out.text, "%s_%zu", stem, question + 1);
    }
    return out;
}

#endif
