/* State of a spectrum, read back. */
#include "base/memory.h"
#include "frequencies/frequency_sample.h"
#include "spectra/spectrum_state.h"
#include "spectra/spectrum_state_places.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* All but the stretch are whole numbers from 0 on. */
static const double most_of_question[STRETCH] = {[DIMENSION] = PS_MAX_DIMENSION,
                                                 [KIND] = PS_FREQUENCIES_DEGREES,
                                                 [DEGREE_STEP] = 2,
                                                 [MAX_FREQUENCY] = PS_MAX_FREQUENCY,
                                                 [REACH] = PS_MAX_FREQUENCY,
                                                 [PER_RING] = PS_MAX_NUM_FREQUENCIES,
                                                 [BINS] = PS_BINS_SHELLS,
                                                 [NUMERATOR] = PS_MOST_BIN_WIDTH,
                                                 [DENOMINATOR] = PS_MOST_BIN_WIDTH,
                                                 [RELATIVE_TO] = 0x1p53,
                                                 [NORMALIZATION] = PSPEC_NORMALIZATION_INTEGRAL};

typedef struct reader {
    const ps_table *table;
    size_t question;
    const char *name;
    const double *numbers; /* state_question */
    ps_error *error;
} reader;

bool ps_spectrum_state_is_there(const ps_table *table, size_t question) {
    return ps_table_find_array(table, ps_state_name_of("state_question", question).text) != NULL;
}

static pspec_status fail(const reader *in, const char *what) {
    return ps_fail(in->error, PSPEC_ERROR_INPUT, "%s holds no sums of a spectrum: %s", in->name,
                   what);
}

/* An array [rows][columns], rows 0: of any number; columns 0: a vector of rows. */
static pspec_status find(const reader *in, const char *stem, size_t rows, size_t columns,
                         const ps_npy_array **out) {
    char what[96];
    const ps_state_name name = ps_state_name_of(stem, in->question);
    const ps_npy_array *const array = ps_table_find_array(in->table, name.text);
    if (array == NULL || array->is_complex || array->rank != (columns > 0 ? 2 : 1) ||
        (rows > 0 ? array->shape[0] != rows : array->shape[0] == 0) ||
        (columns > 0 && array->shape[1] != columns)) {
        snprintf(what, sizeof what, "its array %s is %s", name.text,
                 array == NULL ? "missing" : "of another shape");
        return fail(in, what);
    }
    *out = array;
    return PSPEC_OK;
}

static bool is_whole(double x, double least, double most) {
    return x >= least && x <= most && x == floor(x);
}

static pspec_status find_question(reader *in) {
    const ps_npy_array *array = NULL;
    PS_TRY(find(in, "state_question", QUESTION_SIZE, 0, &array));
    for (size_t i = 0; i < STRETCH; i++) {
        if (!is_whole(array->data[i], 0, most_of_question[i])) {
            return fail(in, "a number of its state_question is none");
        }
    }
    in->numbers = array->data;
    return PSPEC_OK;
}

static pspec_status read_rule(const reader *in, ps_bin_rule *out) {
    const ps_bin_rule said = {.kind = (ps_bin_kind)in->numbers[BINS],
                              .numerator = (uint32_t)in->numbers[NUMERATOR],
                              .denominator = (uint32_t)in->numbers[DENOMINATOR]};
    const bool is_rule =
        ps_bin_rule_parse(out, "bins", ps_bin_rule_write(&said).text, NULL) == PSPEC_OK &&
        ps_bin_rule_is_same(out, &said) &&
        (out->kind == PS_BINS_RELATIVE) == (in->numbers[RELATIVE_TO] > 0);
    ps_bin_rule_resolve(out, (unsigned)in->numbers[DIMENSION], (uint64_t)in->numbers[RELATIVE_TO]);
    return is_rule ? PSPEC_OK : fail(in, "its bins are of an unknown kind");
}

static pspec_status read_list(const reader *in, ps_frequencies *out) {
    const ps_npy_array *array = NULL;
    int32_t *vectors = NULL;
    const unsigned dimension = (unsigned)in->numbers[DIMENSION];
    PS_TRY(find(in, "state_frequencies", 0, dimension, &array));
    PS_TRY(PS_NEW(&vectors, array->num, "frequencies", in->error));
    *out = (ps_frequencies){.kind = PS_FREQUENCIES_LIST, .vectors = vectors}; /* to be freed */
    for (size_t i = 0; i < array->num; i++) {
        if (!is_whole(array->data[i], -PS_MAX_FREQUENCY, PS_MAX_FREQUENCY)) {
            return fail(in, "a frequency in it is none");
        }
        vectors[i] = (int32_t)array->data[i];
    }
    return ps_frequencies_list(out, dimension, array->shape[0], vectors, in->error);
}

/* What a list was drawn from. */
static pspec_status read_rings(const reader *in, const ps_bin_rule *rule, ps_frequencies *set) {
    const ps_npy_array *array = NULL;
    const int32_t max_frequency = (int32_t)in->numbers[MAX_FREQUENCY];
    uint64_t sum = 0;
    PS_TRY(find(in, "state_rings", 0, 2, &array));
    PS_TRY(PS_NEW(&set->rings, array->shape[0], "rings", in->error));
    set->num_rings = array->shape[0];
    set->per_ring = (uint64_t)in->numbers[PER_RING];
    if (set->max_frequency > max_frequency || set->per_ring < PS_MIN_PER_RING) {
        return fail(in, "its frequencies are beyond its max_frequency");
    }
    set->max_frequency = max_frequency;
    if (ps_frequencies_set_bins(set, rule, NULL) != PSPEC_OK) {
        return fail(in, "its bins do not fit its max_frequency");
    }
    for (size_t i = 0; i < set->num_rings; i++) {
        const double *const ring = array->data + 2 * i;
        if (!is_whole(ring[0], 1, 0x1p62) || !(ring[1] > 0) ||
            (uint64_t)ring[0] > UINT64_MAX / 2 - sum) {
            return fail(in, "its rings are none");
        }
        set->rings[i] = (ps_sampled_ring){(uint64_t)ring[0], ring[1]};
        sum += set->rings[i].num_frequencies;
    }
    return PSPEC_OK;
}

static pspec_status make_grid(const reader *in, const ps_bin_rule *rule, ps_frequencies *out) {
    const double *const numbers = in->numbers;
    const bool is_stretched = numbers[REACH] > 0;
    const double reach = numbers[is_stretched ? REACH : MAX_FREQUENCY];
    PS_TRY(ps_frequencies_grid(out, (unsigned)numbers[DIMENSION], (int32_t)reach,
                               numbers[KIND] == PS_FREQUENCIES_BALL, rule, 0, NULL));
    for (unsigned i = 0; is_stretched && i < out->dimension; i++) {
        if (!(numbers[STRETCH + i] > 0) || isinf(numbers[STRETCH + i])) {
            return PSPEC_ERROR_INPUT;
        }
    }
    return is_stretched ? ps_frequencies_stretch(out, numbers + STRETCH, NULL) : PSPEC_OK;
}

/* num: as many as there are sums. The number of a ball is known only approximately before it is
 * enumerated: what is off by more than this factor is not tried, however large the box around it.
 */
static pspec_status make_lattice(const reader *in, const ps_bin_rule *rule, size_t num,
                                 ps_frequencies *out) {
    static const char misfit[] = "its max_frequency does not fit its sums";
    const double factor = 4;
    const double *const numbers = in->numbers;
    const pspec_status status = numbers[KIND] == PS_FREQUENCIES_DEGREES
                                    ? ps_frequencies_degrees(out, (int64_t)numbers[MAX_FREQUENCY],
                                                             numbers[DEGREE_STEP] == 2, NULL)
                                    : make_grid(in, rule, out);
    if (status != PSPEC_OK || out->dimension != numbers[DIMENSION] ||
        out->max_frequency != numbers[MAX_FREQUENCY] || (double)out->num > factor * (double)num) {
        return fail(in, misfit);
    }
    PS_TRY(ps_frequencies_enumerate(out, in->error));
    return out->num == num ? PSPEC_OK : fail(in, misfit);
}

static pspec_status read_frequencies(const reader *in, size_t num, ps_frequencies *out) {
    ps_bin_rule rule;
    PS_TRY(read_rule(in, &rule));
    if (in->numbers[KIND] != PS_FREQUENCIES_LIST) {
        return make_lattice(in, &rule, num, out);
    }
    PS_TRY(read_list(in, out));
    return in->numbers[PER_RING] > 0 ? read_rings(in, &rule, out) : PSPEC_OK;
}

/* Every ring has as many of its frequencies in the list as were to be drawn. */
static pspec_status make_bins(const reader *in, const ps_frequencies *set, size_t num,
                              ps_bins *bins) {
    ps_error inner = {0};
    const pspec_status status = ps_bins_create(bins, set, &inner);
    if (status == PSPEC_ERROR_MEMORY) {
        return ps_fail(in->error, status, "%s", inner.message);
    }
    if (status != PSPEC_OK || bins->num != num) {
        return fail(in, "its bins do not fit its frequencies");
    }
    for (size_t b = 0; set->rings != NULL && b < bins->num; b++) {
        const uint64_t size = bins->bins[b].num_frequencies;
        const uint64_t drawn = bins->bins[b].end - bins->bins[b].begin;
        if (drawn != (size < set->per_ring ? size : set->per_ring) ||
            bins->bins[b].key == INT64_MAX) {
            return fail(in, "its rings do not fit its frequencies");
        }
    }
    return PSPEC_OK;
}

static ps_sums take_sums(const double *numbers, size_t columns) {
    return columns == SUM_SIZE ? (ps_sums){numbers[0], numbers[1], numbers[2], numbers[3]}
                               : (ps_sums){numbers[0], numbers[1], NAN, NAN};
}

static void take_all(ps_sums *out, const ps_npy_array *array) {
    const size_t columns = array->shape[1];
    for (size_t i = 0; i < array->shape[0]; i++) {
        out[i] = take_sums(array->data + i * columns, columns);
    }
}

static pspec_status read_totals(const reader *in, ps_spectrum_sums *out) {
    const ps_npy_array *array = NULL;
    PS_TRY(find(in, "state_totals", TOTALS_SIZE, 0, &array));
    const double *const numbers = array->data;
    const double most = 0x1p53; /* a double counts no further, nor an array of doubles */
    const bool is_possible =
        is_whole(numbers[REALIZATIONS], 1, most) && is_whole(numbers[NUM_EQUAL], 0, most) &&
        is_whole(numbers[SMALLEST], 1, most) &&
        is_whole(numbers[LARGEST], numbers[SMALLEST], most) && numbers[REFERENCE] > 0 &&
        isfinite(numbers[REFERENCE]) && numbers[POINTS] > 0 && isfinite(numbers[POINTS]) &&
        isfinite(numbers[SUM_WEIGHTS]) && numbers[ERROR] >= 0;
    if (!is_possible) {
        return fail(in, "its numbers of points are none");
    }
    out->normalization = (pspec_normalization)in->numbers[NORMALIZATION];
    out->num_equal = (uint64_t)numbers[NUM_EQUAL];
    out->reference_points = numbers[REFERENCE];
    out->error = numbers[ERROR];
    out->self_check = numbers[SELF_CHECK];
    out->length_error = numbers[LENGTH_ERROR];
    out->totals = (ps_pattern_totals){.num_realizations = (uint64_t)numbers[REALIZATIONS],
                                      .sum_weights = numbers[SUM_WEIGHTS],
                                      .points = take_sums(numbers + POINTS, SUM_SIZE),
                                      .sample_sizes = take_sums(numbers + SAMPLE_SIZES, SUM_SIZE),
                                      .smallest_points = (size_t)numbers[SMALLEST],
                                      .largest_points = (size_t)numbers[LARGEST]};
    return PSPEC_OK;
}

static pspec_status read_state(reader *in, ps_frequencies *set, ps_spectrum_sums *out,
                               ps_bins *bins) {
    const ps_npy_array *of_bins = NULL;
    const ps_npy_array *of_powers = NULL;
    const ps_npy_array *of_c2 = NULL;
    PS_TRY(find_question(in));
    const bool on_sphere = in->numbers[KIND] == PS_FREQUENCIES_DEGREES;
    PS_TRY(find(in, "state_bins", 0, SUM_SIZE, &of_bins));
    if (!on_sphere && find(in, "state_powers", 0, MEAN_SIZE, &of_powers) != PSPEC_OK) {
        PS_TRY(find(in, "state_powers", 0, SUM_SIZE, &of_powers));
    }
    const size_t num = on_sphere ? of_bins->shape[0] : of_powers->shape[0];
    PS_TRY(read_frequencies(in, num, set));
    if (in->numbers[NORMALIZATION] == PSPEC_NORMALIZATION_PAIRS) {
        PS_TRY(find(in, "state_c2", num, SUM_SIZE, &of_c2));
    }
    if (set->num != num || (of_c2 != NULL && !on_sphere)) {
        return fail(in, "its sums do not fit its frequencies");
    }
    PS_TRY(make_bins(in, set, of_bins->shape[0], bins));
    PS_TRY(ps_spectrum_sums_create(out, set, bins->num, !on_sphere, of_c2 != NULL, in->error));
    take_all(out->bins, of_bins);
    if (!on_sphere) {
        take_all(out->powers, of_powers);
    }
    if (of_c2 != NULL) {
        take_all(out->c2, of_c2);
    }
    PS_TRY(read_totals(in, out));
    return ps_spectrum_state_read_range(out, in->table, in->question, in->name, in->error);
}

pspec_status ps_spectrum_state_read(ps_spectrum_sums *out, ps_bins *bins, const ps_table *table,
                                    size_t question, const char *name, ps_error *error) {
    reader in = {table, question, name, NULL, error};
    ps_frequencies set = {0};
    *out = (ps_spectrum_sums){0};
    *bins = (ps_bins){0};
    const pspec_status status = read_state(&in, &set, out, bins);
    ps_frequencies_free(&set);
    if (status != PSPEC_OK) {
        ps_spectrum_sums_free(out);
        ps_bins_free(bins);
    }
    return status;
}

pspec_status ps_spectrum_state_read_errors(ps_spectrum_sums *out, const ps_table *table,
                                           size_t question, const char *name, ps_error *error) {
    reader in = {table, question, name, NULL, error};
    *out = (ps_spectrum_sums){0};
    PS_TRY(find_question(&in));
    PS_TRY(read_totals(&in, out));
    return ps_spectrum_state_read_errors_of_range(out, table, question, name, error);
}
