#include "spectra/bins.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

uint64_t ps_bin_num_computed(const ps_bin *bin) {
    const uint64_t num_members = bin->end - bin->begin;
    return num_members == bin->num_frequencies ? bin->num_modes : 2 * num_members;
}

/* Keys of frequencies, in their order; later the numbers of their bins. */
enum { NO_BIN = -1 }; /* of DC */

/* What is not reported sorts behind all others. */
static int64_t key_of(const ps_frequencies *set, const int32_t *k) {
    if (set->kind == PS_FREQUENCIES_DEGREES) {
        return k[0];
    }
    if (ps_frequency_norm2(k, set->dimension) == 0) {
        return NO_BIN;
    }
    const bool has_rings = set->kind != PS_FREQUENCIES_LIST || set->rings != NULL;
    return has_rings ? ps_frequencies_bin(set, k) : INT64_MAX;
}

/* Members in the order of frequencies, and the largest key of a reported bin. */
static int64_t find_keys(ps_bins *out, const ps_frequencies *set, int64_t *keys) {
    const unsigned num_components = ps_frequency_components(set);
    int64_t largest = 0;
    for (size_t i = 0; i < set->num; i++) {
        keys[i] = key_of(set, set->vectors + i * num_components);
        largest = keys[i] > largest && keys[i] < INT64_MAX ? keys[i] : largest;
        if (keys[i] != NO_BIN) {
            out->members[out->num_members++] = (uint32_t)i;
        }
    }
    return largest;
}

/* ---- order --------------------------------------------------------------------------------- */

/* Bits of a key that are sorted by at a time: rings take one pass, their beginnings fit into the
 * nearest cache. */
enum { DIGIT_BITS = 13, NUM_DIGITS = 1 << DIGIT_BITS, KEY_BITS = 63 };

typedef struct digits {
    const int64_t *keys;
    int64_t rest; /* stands for INT64_MAX, so that it takes no bits of its own */
    unsigned shift;
} digits;

static size_t digit_of(const digits *order, uint32_t member) {
    const int64_t key = order->keys[member];
    return (size_t)((key < order->rest ? key : order->rest) >> order->shift) % NUM_DIGITS;
}

/* Members of equal digits stay in their order. */
static void sort_by_digit(const digits *order, const uint32_t *from, uint32_t *to, size_t num,
                          size_t *begins) {
    size_t begin = 0;
    memset(begins, 0, NUM_DIGITS * sizeof *begins);
    for (size_t i = 0; i < num; i++) {
        begins[digit_of(order, from[i])]++;
    }
    for (size_t digit = 0; digit < NUM_DIGITS; digit++) {
        const size_t count = begins[digit];
        begins[digit] = begin;
        begin += count;
    }
    for (size_t i = 0; i < num; i++) {
        to[begins[digit_of(order, from[i])]++] = from[i];
    }
}

/* Members in ascending order of keys, those of one key in ascending order: comparisons would take
 * longer, and as much memory again. */
static pspec_status sort_members(ps_bins *out, const int64_t *keys, int64_t largest,
                                 ps_error *error) {
    digits order = {keys, largest + 1, 0};
    uint32_t *other = NULL;
    size_t *begins = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, PS_NEW(&begins, NUM_DIGITS, "bins", error));
    PS_TRY_OUT(status, PS_NEW(&other, out->num_members, "bins", error));
    while (order.shift < KEY_BITS && order.rest >> order.shift > 0) {
        uint32_t *const sorted = other;
        sort_by_digit(&order, out->members, sorted, out->num_members, begins);
        other = out->members;
        out->members = sorted;
        order.shift += DIGIT_BITS;
    }
out:
    free(other);
    free(begins);
    return status;
}

/* ---- bins ---------------------------------------------------------------------------------- */

static size_t count_bins(const ps_bins *bins, const int64_t *keys) {
    size_t count = 0;
    for (size_t i = 0; i < bins->num_members; i++) {
        count += i == 0 || keys[bins->members[i]] != keys[bins->members[i - 1]];
    }
    return count;
}

/* mean_frequency is the sum over the members. Of a subset, what is said of the bin is said of the
 * ring. */
static void finish_bin(ps_bin *bin, const ps_frequencies *set, const ps_sampled_ring *ring) {
    bin->num_frequencies = bin->end - bin->begin;
    bin->mean_frequency /= (double)bin->num_frequencies;
    if (ring != NULL) {
        bin->num_frequencies = ring->num_frequencies;
        bin->mean_frequency = ring->mean_frequency;
    }
    bin->num_modes =
        set->kind == PS_FREQUENCIES_DEGREES ? 2 * (uint64_t)bin->key + 1 : 2 * bin->num_frequencies;
}

/* Keys become numbers of bins. */
static void begin_bins(ps_bins *out, int64_t *keys) {
    size_t bin = 0;
    for (size_t i = 0; i < out->num_members; i++) {
        int64_t *const key = &keys[out->members[i]];
        if (i > 0 && *key != out->bins[bin].key) {
            bin++;
        }
        ps_bin *const at = &out->bins[bin];
        at->begin = at->end == 0 ? i : at->begin;
        at->key = *key;
        at->end = i + 1;
        *key = (int64_t)bin;
    }
}

/* Frequencies in their order, which is that of every bin, too: the next one is at hand. */
static void fill_bins(ps_bins *out, const ps_frequencies *set, const int64_t *numbers) {
    const unsigned num_components = ps_frequency_components(set);
    for (size_t i = 0; i < set->num; i++) {
        if (numbers[i] != NO_BIN) {
            out->bins[numbers[i]].mean_frequency +=
                sqrt(ps_frequencies_length2(set, set->vectors + i * num_components));
        }
    }
    for (size_t i = 0; i < out->num; i++) {
        finish_bin(&out->bins[i], set, set->rings != NULL ? &set->rings[i] : NULL);
    }
    const bool has_rest = out->num > 0 && out->bins[out->num - 1].key == INT64_MAX;
    out->num_reported = has_rest ? out->num - 1 : out->num;
    for (size_t i = 0; set->reach > 0 && set->bins.kind == PS_BINS_SHELLS && i < out->num_reported;
         i++) { /* their |k|^2 are no whole numbers */
        out->bins[i].key = (int64_t)i + 1;
    }
}

static pspec_status check_rings(const ps_bins *bins, const ps_frequencies *set, ps_error *error) {
    return set->rings == NULL || bins->num == set->num_rings
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "the frequencies lie in %zu rings or shells, but were drawn from %zu",
                         bins->num, set->num_rings);
}

pspec_status ps_bins_create(ps_bins *out, const ps_frequencies *frequencies, ps_error *error) {
    int64_t *keys = NULL;
    pspec_status status = PSPEC_OK;
    *out = (ps_bins){0};
    PS_TRY_OUT(status, PS_NEW(&keys, frequencies->num, "bins", error));
    PS_TRY_OUT(status, PS_NEW(&out->members, frequencies->num, "bins", error));
    const int64_t largest = find_keys(out, frequencies, keys);
    PS_TRY_OUT(status, sort_members(out, keys, largest, error));
    out->num = count_bins(out, keys);
    PS_TRY_OUT(status, check_rings(out, frequencies, error));
    PS_TRY_OUT(status, PS_NEW(&out->bins, out->num, "bins", error));
    begin_bins(out, keys);
    fill_bins(out, frequencies, keys);
out:
    free(keys);
    if (status != PSPEC_OK) {
        ps_bins_free(out);
    }
    return status;
}

void ps_bins_free(ps_bins *bins) {
    free(bins->bins);
    free(bins->members);
    *bins = (ps_bins){0};
}
