#include "samplers/optimized/tournament.h"

#include "base/memory.h"

#include <stdlib.h>

/* The winner of two children, 2 k and 2 k + 1 of node k. */
static uint32_t winner_of(const ps_tournament *t, uint32_t k) {
    const uint32_t half = t->num_leaves / 2;
    const uint32_t left = k < half ? t->winners[2 * k] : 2 * (k - half);
    const uint32_t right = k < half ? t->winners[2 * k + 1] : 2 * (k - half) + 1;
    return t->keys[right] > t->keys[left] ? right : left;
}

pspec_status ps_tournament_create(ps_tournament *t, size_t num, ps_error *error) {
    *t = (ps_tournament){.num_leaves = 2};
    while (t->num_leaves < num) {
        t->num_leaves *= 2;
    }
    PS_TRY(PS_NEW(&t->keys, t->num_leaves, "a tournament", error));
    const pspec_status status = PS_NEW(&t->winners, t->num_leaves, "a tournament", error);
    if (status != PSPEC_OK) {
        ps_tournament_destroy(t);
        return status;
    }
    for (size_t i = num; i < t->num_leaves; i++) {
        t->keys[i] = -1;
    }
    for (uint32_t k = t->num_leaves - 1; k > 0; k--) {
        t->winners[k] = winner_of(t, k);
    }
    return PSPEC_OK;
}

void ps_tournament_destroy(ps_tournament *t) {
    free(t->keys);
    free(t->winners);
    *t = (ps_tournament){0};
}

/* Up to where another wins that won before: nothing changes above. */
void ps_tournament_set(ps_tournament *t, uint32_t i, double key) {
    t->keys[i] = key;
    for (uint32_t k = (t->num_leaves + i) / 2; k > 0; k /= 2) {
        const uint32_t winner = winner_of(t, k);
        if (winner == t->winners[k] && winner != i) {
            return;
        }
        t->winners[k] = winner;
    }
}
