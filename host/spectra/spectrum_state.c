#include "spectra/spectrum_state.h"

#include "spectra/spectrum_state_places.h"

#include <math.h>
#include <string.h>

typedef struct writer {
    ps_table *table;
    size_t question;
    ps_error *error;
} writer;

/* An array [rows][columns] of zeros, to be filled; columns 0: a vector of rows. */
static pspec_status put(const writer *self, const char *stem, size_t rows, size_t columns,
                        double **data) {
    const size_t shape[] = {rows, columns};
    ps_npy_array array;
    PS_TRY(ps_npy_make_array(&array, columns > 0 ? 2 : 1, shape, false, self->error));
    *data = array.data;
    return ps_table_add_array(self->table, ps_state_name_of(stem, self->question).text, true,
                              &array, self->error);
}

_Static_assert(sizeof(ps_sums) == SUM_SIZE * sizeof(double), "sums are four doubles");

static pspec_status put_sums(const writer *self, const char *stem, const ps_sums *sums, size_t num,
                             size_t columns) {
    double *data = NULL;
    PS_TRY(put(self, stem, num, columns, &data));
    for (size_t i = 0; i < num; i++) {
        memcpy(data + i * columns, &sums[i], columns * sizeof *data);
    }
    return PSPEC_OK;
}

static pspec_status put_question(const writer *self, const ps_spectrum_sums *sums) {
    const ps_frequencies *const set = &sums->frequencies;
    double *data = NULL;
    PS_TRY(put(self, "state_question", QUESTION_SIZE, 0, &data));
    data[DIMENSION] = set->dimension;
    data[KIND] = set->kind;
    data[DEGREE_STEP] = set->degree_step;
    data[MAX_FREQUENCY] = set->max_frequency;
    data[REACH] = set->reach;
    data[PER_RING] = (double)set->per_ring;
    data[BINS] = set->bins.kind;
    data[NUMERATOR] = set->bins.numerator;
    data[DENOMINATOR] = set->bins.denominator;
    data[RELATIVE_TO] = (double)set->bins.num_points;
    data[NORMALIZATION] = sums->normalization;
    memcpy(data + STRETCH, set->stretch, sizeof set->stretch);
    return PSPEC_OK;
}

static pspec_status put_totals(const writer *self, const ps_spectrum_sums *sums) {
    const ps_pattern_totals *const totals = &sums->totals;
    double *data = NULL;
    PS_TRY(put(self, "state_totals", TOTALS_SIZE, 0, &data));
    data[REALIZATIONS] = (double)totals->num_realizations;
    data[NUM_EQUAL] = (double)sums->num_equal;
    data[SMALLEST] = (double)totals->smallest_points;
    data[LARGEST] = (double)totals->largest_points;
    data[SUM_WEIGHTS] = totals->sum_weights;
    data[REFERENCE] = sums->reference_points;
    data[ERROR] = sums->error;
    data[SELF_CHECK] = sums->self_check;
    data[LENGTH_ERROR] = sums->length_error;
    memcpy(data + POINTS, &totals->points, sizeof totals->points);
    memcpy(data + SAMPLE_SIZES, &totals->sample_sizes, sizeof totals->sample_sizes);
    return PSPEC_OK;
}

static pspec_status put_list(const writer *self, const ps_frequencies *set) {
    double *data = NULL;
    PS_TRY(put(self, "state_frequencies", set->num, set->dimension, &data));
    for (size_t i = 0; i < set->num * set->dimension; i++) {
        data[i] = set->vectors[i];
    }
    return PSPEC_OK;
}

static pspec_status put_rings(const writer *self, const ps_frequencies *set) {
    double *data = NULL;
    PS_TRY(put(self, "state_rings", set->num_rings, 2, &data));
    for (size_t i = 0; i < set->num_rings; i++) {
        data[2 * i] = (double)set->rings[i].num_frequencies;
        data[2 * i + 1] = set->rings[i].mean_frequency;
    }
    return PSPEC_OK;
}

pspec_status ps_spectrum_state_add(ps_table *table, size_t question, const ps_spectrum_sums *sums,
                                   ps_error *error) {
    const writer self = {table, question, error};
    const ps_frequencies *const set = &sums->frequencies;
    PS_TRY(put_question(&self, sums));
    PS_TRY(put_totals(&self, sums));
    PS_TRY(put_sums(&self, "state_bins", sums->bins, sums->num_bins, SUM_SIZE));
    if (sums->powers != NULL) {
        PS_TRY(put_sums(&self, "state_powers", sums->powers, set->num,
                        isnan(sums->powers[0].square) ? MEAN_SIZE : SUM_SIZE));
    }
    if (sums->c2 != NULL) {
        PS_TRY(put_sums(&self, "state_c2", sums->c2, set->num, SUM_SIZE));
    }
    if (set->kind == PS_FREQUENCIES_LIST) {
        PS_TRY(put_list(&self, set));
    }
    if (set->rings != NULL) {
        PS_TRY(put_rings(&self, set));
    }
    return sums->num_all > 0 ? ps_spectrum_state_add_range(table, question, sums, error) : PSPEC_OK;
}
