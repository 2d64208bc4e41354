#include "spectra/bins.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

typedef struct keyed {
    int64_t key;
    uint32_t index;
} keyed;

static int compare_keys(const void *a, const void *b) {
    const keyed *x = a;
    const keyed *y = b;
    if (x->key != y->key) {
        return x->key < y->key ? -1 : 1;
    }
    return x->index < y->index ? -1 : x->index > y->index;
}

uint64_t ps_bin_num_computed(const ps_bin *bin) {
    const uint64_t num_members = bin->end - bin->begin;
    return num_members == bin->num_frequencies ? bin->num_modes : 2 * num_members;
}

/* What is not reported sorts behind all others. */
static int64_t key_of(const ps_frequencies *set, const int32_t *k) {
    if (set->kind == PS_FREQUENCIES_DEGREES) {
        return k[0];
    }
    const int64_t norm2 = ps_frequency_norm2(k, set->dimension);
    const bool has_rings = set->kind != PS_FREQUENCIES_LIST || set->rings != NULL;
    return has_rings && norm2 <= set->max_norm2 ? ps_bin_rule_find(&set->bins, norm2) : INT64_MAX;
}

static size_t count_bins(const keyed *keys, size_t num) {
    size_t count = 0;
    for (size_t i = 0; i < num; i++) {
        count += i == 0 || keys[i].key != keys[i - 1].key;
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

static void fill_bins(ps_bins *out, const ps_frequencies *set, const keyed *keys) {
    const unsigned num_components = ps_frequency_components(set);
    size_t bin = 0;
    for (size_t i = 0; i < out->num_members; i++) {
        if (i > 0 && keys[i].key != keys[i - 1].key) {
            bin++;
        }
        ps_bin *at = &out->bins[bin];
        at->begin = at->end == 0 ? i : at->begin;
        at->key = keys[i].key;
        at->end = i + 1;
        out->members[i] = keys[i].index;
        at->mean_frequency += sqrt((double)ps_frequency_norm2(
            set->vectors + (size_t)keys[i].index * num_components, num_components));
    }
    for (size_t i = 0; i < out->num; i++) {
        finish_bin(&out->bins[i], set, set->rings != NULL ? &set->rings[i] : NULL);
    }
    const bool has_rest = out->num > 0 && out->bins[out->num - 1].key == INT64_MAX;
    out->num_reported = has_rest ? out->num - 1 : out->num;
}

static pspec_status check_rings(const ps_bins *bins, const ps_frequencies *set, ps_error *error) {
    return set->rings == NULL || bins->num == set->num_rings
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "the frequencies lie in %zu rings or shells, but were drawn from %zu",
                         bins->num, set->num_rings);
}

pspec_status ps_bins_create(ps_bins *out, const ps_frequencies *frequencies, ps_error *error) {
    keyed *keys = NULL;
    pspec_status status = PSPEC_OK;
    const unsigned num_components = ps_frequency_components(frequencies);
    *out = (ps_bins){0};
    PS_TRY_OUT(status, PS_NEW(&keys, frequencies->num, "bins", error));
    for (size_t i = 0; i < frequencies->num; i++) {
        const int32_t *k = frequencies->vectors + i * num_components;
        if (ps_frequency_norm2(k, num_components) > 0) {
            keys[out->num_members++] = (keyed){key_of(frequencies, k), (uint32_t)i};
        }
    }
    qsort(keys, out->num_members, sizeof *keys, compare_keys);
    out->num = count_bins(keys, out->num_members);
    PS_TRY_OUT(status, check_rings(out, frequencies, error));
    PS_TRY_OUT(status, PS_NEW(&out->bins, out->num, "bins", error));
    PS_TRY_OUT(status, PS_NEW(&out->members, out->num_members, "bins", error));
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
