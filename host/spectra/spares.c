#include "spectra/spares.h"

#include "base/memory.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* Those of one spectrum: sums, means, powers, standard errors. */
enum { MOST_SPARES = 4 };

/* The system gives and takes smaller ones in no time. */
enum { LEAST_BYTES = 4 << 20 };

typedef struct spare {
    void *array; /* NULL: none */
    size_t bytes;
} spare;

struct ps_spares {
    pthread_mutex_t lock;
    size_t num_owners;
    uint64_t most_bytes, bytes; /* that may be kept, and are */
    spare spares[MOST_SPARES];
};

pspec_status ps_spares_create(ps_spares **out, uint64_t most_bytes, ps_error *error) {
    PS_TRY(PS_NEW(out, 1, "a store of arrays", error));
    pthread_mutex_init(&(*out)->lock, NULL);
    (*out)->num_owners = 1;
    (*out)->most_bytes = most_bytes;
    return PSPEC_OK;
}

ps_spares *ps_spares_share(ps_spares *spares) {
    if (spares != NULL) {
        pthread_mutex_lock(&spares->lock);
        spares->num_owners++;
        pthread_mutex_unlock(&spares->lock);
    }
    return spares;
}

static void free_all(ps_spares *spares) {
    for (size_t i = 0; i < MOST_SPARES; i++) {
        free(spares->spares[i].array);
        spares->spares[i] = (spare){0};
    }
    spares->bytes = 0;
}

void ps_spares_leave(ps_spares *spares) {
    if (spares == NULL) {
        return;
    }
    pthread_mutex_lock(&spares->lock);
    const bool is_last = --spares->num_owners == 0;
    pthread_mutex_unlock(&spares->lock);
    if (is_last) {
        free_all(spares);
        pthread_mutex_destroy(&spares->lock);
        free(spares);
    }
}

void ps_spares_close(ps_spares *spares) {
    if (spares != NULL) {
        pthread_mutex_lock(&spares->lock);
        free_all(spares);
        spares->most_bytes = 0;
        pthread_mutex_unlock(&spares->lock);
        ps_spares_leave(spares);
    }
}

uint64_t ps_spares_bytes(ps_spares *spares) {
    pthread_mutex_lock(&spares->lock);
    const uint64_t bytes = spares->bytes;
    pthread_mutex_unlock(&spares->lock);
    return bytes;
}

/* The array of a place, which is empty afterwards, where bytes are those; else NULL. */
static void *find(ps_spares *spares, size_t bytes) {
    void *found = NULL;
    pthread_mutex_lock(&spares->lock);
    for (size_t i = 0; i < MOST_SPARES && found == NULL; i++) {
        if (spares->spares[i].array != NULL && spares->spares[i].bytes == bytes) {
            found = spares->spares[i].array;
            spares->spares[i] = (spare){0};
            spares->bytes -= bytes;
        }
    }
    pthread_mutex_unlock(&spares->lock);
    return found;
}

pspec_status ps_spares_take(ps_spares *spares, void *pointer, size_t count, size_t element_bytes,
                            const char *what, ps_error *error) {
    size_t bytes = 0;
    void *found = NULL;
    if (spares != NULL && ps_size_multiply(count, element_bytes, &bytes)) {
        found = find(spares, bytes);
    }
    if (found == NULL) {
        return ps_allocate_for(pointer, count, element_bytes, what, error);
    }
    memcpy(pointer, &found, sizeof found);
    return PSPEC_OK;
}

void ps_spares_give(ps_spares *spares, void *array, size_t bytes) {
    if (spares != NULL && array != NULL && bytes >= LEAST_BYTES) {
        pthread_mutex_lock(&spares->lock);
        const bool has_room = bytes <= spares->most_bytes - spares->bytes;
        for (size_t i = 0; i < MOST_SPARES && array != NULL && has_room; i++) {
            if (spares->spares[i].array == NULL) {
                spares->spares[i] = (spare){array, bytes};
                spares->bytes += bytes;
                array = NULL;
            }
        }
        pthread_mutex_unlock(&spares->lock);
    }
    free(array);
}
