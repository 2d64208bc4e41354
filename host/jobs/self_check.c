#include "jobs/self_check.h"

#include "base/pieces.h"
#include "engines/host/host_direct.h"
#include "math/random/random.h"

#include <math.h>
#include <stdio.h>

/* Entries to look at, and the most long double terms to spend on them; those of a degree, one for
 * each order and point, take a tenth of the time. */
enum { MOST_ENTRIES = 8, MOST_TERMS = 1 << 20, MOST_DEGREE_TERMS = 10 * MOST_TERMS };

/* How far one entry may lie outside the engine's root-mean-square error before something is wrong:
 * rounding errors are sums of many small ones, and 8 standard deviations do not happen. */
static const double allowed_factor = 8;

/* Degree 0 rounds, too, and its rounding varies slowly over the sphere: it stays in low degrees,
 * which are those that are looked at, where the error formula, a mean over all degrees and orders,
 * has as much in each of them. Measured in single precision: up to 4.8 roundoffs of |sum w|, spread
 * over the 2l + 1 orders (fibonacci, N = 1e5 and 2e5, L = 150, 300 and 600). */
static double allowed_of_sum(const ps_self_check_input *input, int32_t degree) {
    return allowed_factor * input->sum_rounding / sqrt(2.0 * degree + 1);
}

/* Results must not depend on when the check is made: its choices have a seed of their own. */
static const uint64_t check_seed = 0x5e1fc4ec;

static pspec_status read_entry(const ps_rows *rows, uint32_t slot, ps_device *device, double *out,
                               ps_error *error) {
    if (rows->host != NULL) {
        *out = rows->host[slot];
        return PSPEC_OK;
    }
    if (rows->precision == PS_DOUBLE) {
        return ps_buffer_read(device, &rows->device, slot * sizeof(double), out, sizeof(double),
                              error);
    }
    float value = 0;
    PS_TRY(
        ps_buffer_read(device, &rows->device, slot * sizeof(float), &value, sizeof value, error));
    *out = value;
    return PSPEC_OK;
}

/* "frequency (3, -4)" or "degree 3" */
static void print_frequency(char *text, size_t text_bytes, const int32_t *k,
                            const ps_frequencies *set) {
    const unsigned dimension = set->dimension;
    size_t length = 0;
    if (set->kind == PS_FREQUENCIES_DEGREES) {
        snprintf(text, text_bytes, "degree %d", (int)k[0]);
        return;
    }
    length = (size_t)snprintf(text, text_bytes, "frequency ");
    for (unsigned axis = 0; axis < dimension && length < text_bytes; axis++) {
        length += (size_t)snprintf(text + length, text_bytes - length, "%s%d",
                                   axis == 0 ? "(" : ", ", (int)k[axis]);
    }
    if (length < text_bytes) {
        snprintf(text + length, text_bytes - length, ")");
    }
}

/* What is known of one entry: by the engine, and by the referee. */
typedef struct checked {
    size_t entry;
    double power;
    long double exact;
    pspec_status status;
    ps_error error;
} checked;

typedef struct work {
    const ps_self_check_input *input;
    checked *entries;
} work;

static void sum_exactly(void *payload, size_t i) {
    const ps_self_check_input *const input = ((const work *)payload)->input;
    checked *const one = &((const work *)payload)->entries[i];
    one->status = ps_host_power(input->pattern, input->frequencies, one->entry, input->exponent,
                                &one->exact, &one->error);
}

/* How far |S| of one entry is from the referee's, in units of sqrt(V). */
static pspec_status compare(const ps_self_check_input *input, const checked *one, double *off,
                            ps_error *error) {
    const ps_frequencies *set = input->frequencies;
    const int32_t *k = set->vectors + one->entry * ps_frequency_components(set);
    const double unit = sqrt(input->weight_square_sum);
    const double power = one->power;
    const long double exact = one->exact;
    char text[112];
    const bool is_pairs = input->size_square > 0;
    const double expected = (double)sqrtl(exact) / unit;
    const double allowed = allowed_factor * input->engine_error * (is_pairs ? 1 : 1 + expected) +
                           (input->sum_rounding > 0 ? allowed_of_sum(input, k[0]) : 0);
    /* a sum over pairs may be a rounding below 0 */
    *off = is_pairs ? (double)fabsl(power / input->scale - exact) / input->size_square
                    : fabs(sqrt(fmax(power, 0) / input->scale) / unit - expected);
    if (!(*off <= allowed)) {
        print_frequency(text, sizeof text, k, set);
        return ps_fail(error, PSPEC_ERROR_CHECK,
                       "self-check failed: %s of %s is off by %.3g %s, "
                       "expected below %.3g; the device or its driver computes wrongly",
                       is_pairs ? "Q" : "|S|", text, *off,
                       is_pairs ? "(sum |w|)^2" : "sqrt(sum w^2)", allowed);
    }
    return PSPEC_OK;
}

/* Entries that may be chosen, and how many of them: of degrees the low ones, whose sums are short.
 */
static size_t choose_entries(const ps_frequencies *set, size_t num_points, size_t *num_candidates) {
    size_t affordable = MOST_TERMS / num_points;
    *num_candidates = set->num;
    if (set->kind == PS_FREQUENCIES_DEGREES) {
        const size_t highest = MOST_DEGREE_TERMS / MOST_ENTRIES / num_points;
        const size_t num = highest / (size_t)set->degree_step;
        *num_candidates = num < set->num ? num : set->num;
        *num_candidates = *num_candidates > 0 ? *num_candidates : 1;
        affordable = MOST_ENTRIES;
    }
    return affordable < MOST_ENTRIES ? affordable : MOST_ENTRIES;
}

double ps_self_check_count(const ps_frequencies *frequencies, uint64_t num_points,
                           bool *is_of_degrees) {
    const size_t points =
        num_points < PS_SELF_CHECK_POINTS ? (size_t)num_points : PS_SELF_CHECK_POINTS;
    size_t num_candidates = 0;
    const size_t entries = choose_entries(frequencies, points > 0 ? points : 1, &num_candidates);
    const double terms = (double)entries * (double)points;
    *is_of_degrees = frequencies->kind == PS_FREQUENCIES_DEGREES;
    /* the mean of degrees chosen at random */
    return *is_of_degrees ? terms * (double)num_candidates * frequencies->degree_step / 2 : terms;
}

static size_t work_of(const ps_self_check_input *input) {
    bool is_of_degrees = false;
    const double terms =
        ps_self_check_count(input->frequencies, input->pattern->num_points, &is_of_degrees);
    return (size_t)terms * (is_of_degrees ? PS_SELF_CHECK_DEGREE_STEPS : PS_SELF_CHECK_STEPS);
}

pspec_status ps_self_check(const ps_self_check_input *input, ps_device *device, double *deviation,
                           ps_error *error) {
    static const ps_watch nobody = {0};
    checked entries[MOST_ENTRIES];
    work all = {input, entries};
    ps_random random = ps_random_init(check_seed, PS_STREAM_COORDINATES, 0);
    size_t num_candidates = 0;
    const size_t num =
        choose_entries(input->frequencies, input->pattern->num_points, &num_candidates);
    for (size_t i = 0; i < num; i++) {
        entries[i] = (checked){.entry = (size_t)ps_random_below(&random, num_candidates)};
        PS_TRY(read_entry(input->rows, input->slots[entries[i].entry], device, &entries[i].power,
                          error));
    }
    PS_TRY(ps_pieces_share(&nobody, "entries", work_of(input), num, sum_exactly, &all, error));
    *deviation = 0;
    for (size_t i = 0; i < num; i++) {
        double off = 0;
        if (entries[i].status != PSPEC_OK) {
            *error = entries[i].error;
            return entries[i].status;
        }
        PS_TRY(compare(input, &entries[i], &off, error));
        *deviation = off > *deviation ? off : *deviation;
    }
    return PSPEC_OK;
}
