#include "math/random/subset.h"

#include "base/memory.h"

#include <stdbool.h>
#include <stdlib.h>

/* A set of integers below 2^64 - 1, by open addressing; at most half of the slots are in use. */
typedef struct number_set {
    uint64_t *slots;  /* number + 1, 0 is a free slot */
    size_t num_slots; /* a power of two */
} number_set;

static pspec_status create_set(number_set *set, size_t count, ps_error *error) {
    set->num_slots = 2;
    while (set->num_slots / 2 < count) {
        if (set->num_slots > SIZE_MAX / 2) {
            return ps_fail(error, PSPEC_ERROR_MEMORY, "a subset of %zu numbers is too large",
                           count);
        }
        set->num_slots *= 2;
    }
    PS_TRY(PS_NEW(&set->slots, set->num_slots, "a random subset", error));
    return PSPEC_OK;
}

/* False when the number was there before. */
static bool insert(number_set *set, uint64_t number) {
    const uint64_t golden = UINT64_C(0x9E3779B97F4A7C15); /* 2^64 / 1.618..: spreads neighbours */
    const unsigned high_bits = 32;
    size_t place = (size_t)(number * golden >> high_bits) & (set->num_slots - 1);
    while (set->slots[place] != 0) {
        if (set->slots[place] == number + 1) {
            return false;
        }
        place = (place + 1) & (set->num_slots - 1);
    }
    set->slots[place] = number + 1;
    return true;
}

static int compare(const void *a, const void *b) {
    const uint64_t x = *(const uint64_t *)a;
    const uint64_t y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

pspec_status ps_random_subset(uint64_t *out, size_t count, uint64_t population, ps_random *random,
                              ps_error *error) {
    number_set set = {0};
    PS_TRY(create_set(&set, count, error));
    for (size_t i = 0; i < count; i++) {
        const uint64_t last = population - count + i;
        const uint64_t drawn = ps_random_below(random, last + 1);
        out[i] = insert(&set, drawn) ? drawn : last;
        if (out[i] != drawn) {
            insert(&set, last);
        }
    }
    free(set.slots);
    qsort(out, count, sizeof *out, compare);
    return PSPEC_OK;
}

void ps_random_order(ps_random *random, uint32_t *order, size_t num) {
    for (size_t j = 0; j < num; j++) {
        order[j] = (uint32_t)j;
    }
    for (size_t j = num; j > 1; j--) {
        const size_t other = (size_t)ps_random_below(random, j);
        const uint32_t kept = order[other];
        order[other] = order[j - 1];
        order[j - 1] = kept;
    }
}
