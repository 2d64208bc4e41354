#include "sets/sets.h"

#include "base/memory.h"
#include "store/cache_folder.h"
#include "store/result_cache.h"

#include <inttypes.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Sets that take longer are kept. A file of 16 KB that the disk must have takes 0.9 ms (two cores
 * of an EPYC, ext4, 2026-11). */
static const double LEAST_SECONDS = 2e-3;

/* Of the layout of an entry: the array "points" [N][D]. */
enum { VERSION = 2 };

struct ps_set_store {
    const ps_sampler_request *request;
    ps_cache *cache;
    ps_text folder, key; /* the key without the realization */
    atomic_uint_least64_t num_read, num_kept, num_lost;
    ps_error trouble; /* of the thread that was the first to have some */
};

bool ps_sets_are_expensive(const ps_sampler_request *request) {
    return request->sampler->version > 0 && ps_sampler_seconds(request) >= LEAST_SECONDS;
}

bool ps_set_place_takes(const ps_set_place *place, const ps_sampler_request *request) {
    return place->cache_folder != NULL && ps_sets_are_expensive(request) &&
           ps_set_store_bytes(request) <= place->max_bytes;
}

double ps_set_store_seconds(const ps_sampler_request *request) {
    /* 2000 sets of 1024 points: 0.05 s on two such cores, sample --prefetch for a second time */
    const double file = 4e-5;
    const double byte = 0.5e-9; /* copied, and its checksum; not measured by itself */
    return file + byte * (double)ps_set_store_bytes(request);
}

uint64_t ps_set_store_bytes(const ps_sampler_request *request) {
    const uint64_t head = 1280; /* records, headers, the key */
    return ps_cache_disk_bytes(head + (uint64_t)request->num_points *
                                          ps_sampler_own_dimension(request) * sizeof(double));
}

static void append_folder(ps_text *out, const ps_set_place *place) {
    ps_text_append(out, "%s/sets", place->cache_folder);
}

static bool has_folder(const ps_set_place *place) {
    ps_text folder = {0};
    append_folder(&folder, place);
    const bool has = !folder.failed && access(folder.data, X_OK) == 0;
    ps_text_free(&folder);
    return has;
}

static pspec_status open_all(ps_set_store *store, const ps_set_place *place, ps_error *error) {
    append_folder(&store->folder, place);
    ps_text_append(&store->key, "set %d\n", VERSION);
    ps_sampler_identify(store->request, &store->key);
    PS_TRY(ps_text_check(&store->folder, error));
    PS_TRY(ps_text_check(&store->key, error));
    return ps_cache_open(&store->cache, store->folder.data, place->max_bytes, error);
}

pspec_status ps_set_store_open(ps_set_store **out, const ps_sampler_request *request,
                               const ps_set_place *place, ps_error *error) {
    ps_set_store *store = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&store, 1, "kept sets", error));
    store->request = request;
    atomic_init(&store->num_read, 0);
    atomic_init(&store->num_kept, 0);
    atomic_init(&store->num_lost, 0);
    const pspec_status status = open_all(store, place, error);
    if (status != PSPEC_OK) {
        ps_set_store_close(store);
        return status;
    }
    *out = store;
    return PSPEC_OK;
}

void ps_set_store_close(ps_set_store *store) {
    if (store != NULL) {
        ps_cache_close(store->cache);
        ps_text_free(&store->folder);
        ps_text_free(&store->key);
        free(store);
    }
}

/* ---- one set ------------------------------------------------------------------------------- */

static void note_trouble(ps_set_store *store, const ps_error *reason) {
    if (ps_cache_first_failure(store->cache)) {
        store->trouble = *reason;
    }
}

/* The key of a realization, to be freed. */
static ps_text key_of(const ps_set_store *store, uint64_t realization) {
    ps_text key = {0};
    ps_text_append(&key, "%srealization %" PRIu64 "\n", ps_text_string(&store->key), realization);
    return key;
}

static const char points_name[] = "points";

/* The points in an entry; false: it is none of this sampler. */
static bool take_points(const ps_sampler_request *request, const ps_npz_file *file, double *points,
                        size_t *num_points) {
    const ps_npz_array *const array = ps_npz_find(file, points_name);
    if (array == NULL || array->kind != 'f' || array->rank != 2 ||
        array->shape[0] > ps_sampler_most_points(request) ||
        array->shape[1] != ps_sampler_own_dimension(request)) {
        return false;
    }
    *num_points = array->shape[0];
    memcpy(points, array->data, array->shape[0] * array->shape[1] * sizeof *points);
    return true;
}

static bool read_set(ps_set_store *store, const ps_text *key, double *points, size_t *num_points) {
    ps_npz_file *file = NULL;
    ps_error reason = {0};
    if (ps_cache_find(store->cache, key->data, key->length, &file, &reason) != PSPEC_OK) {
        note_trouble(store, &reason);
    }
    const bool is_found = file != NULL && take_points(store->request, file, points, num_points);
    ps_npz_free(file);
    return is_found;
}

static pspec_status write_set(ps_set_store *store, const ps_text *key, const double *points,
                              size_t num_points, ps_error *error) {
    const size_t shape[] = {num_points, ps_sampler_own_dimension(store->request)};
    const ps_npz_array array = {points_name, 'f', sizeof *points, 2, shape, points};
    ps_npz *npz = NULL;
    PS_TRY(ps_cache_begin(store->cache, key->data, key->length, &npz, error));
    const pspec_status status = ps_npz_add(npz, &array, error);
    if (status != PSPEC_OK) {
        ps_npz_discard(&npz);
        return status;
    }
    return ps_cache_end(store->cache, &npz, error);
}

static void keep_set(ps_set_store *store, const ps_text *key, const double *points,
                     size_t num_points) {
    ps_error reason = {0};
    if (write_set(store, key, points, num_points, &reason) == PSPEC_OK) {
        atomic_fetch_add(&store->num_kept, 1);
    } else {
        atomic_fetch_add(&store->num_lost, 1);
        note_trouble(store, &reason);
    }
}

pspec_status ps_set_store_make(ps_set_store *store, uint64_t realization, double *points,
                               size_t *num_points, const ps_watch *watch, ps_error *error) {
    ps_text key = key_of(store, realization);
    pspec_status status = ps_text_check(&key, error);
    if (status == PSPEC_OK && read_set(store, &key, points, num_points)) {
        atomic_fetch_add(&store->num_read, 1);
    } else if (status == PSPEC_OK) {
        status = ps_sampler_make(store->request, realization, points, num_points, watch, error);
        if (status == PSPEC_OK) {
            keep_set(store, &key, points, *num_points);
        }
    }
    ps_text_free(&key);
    return status;
}

/* ---- all of them --------------------------------------------------------------------------- */

ps_set_counts ps_set_store_counts(const ps_set_store *store) {
    return (ps_set_counts){atomic_load(&store->num_read), atomic_load(&store->num_kept),
                           atomic_load(&store->num_lost), ps_cache_num_broken(store->cache)};
}

const char *ps_set_store_trouble(const ps_set_store *store) {
    return store->trouble.message;
}

static uint64_t count_names(const ps_set_store *store, uint64_t num) {
    uint64_t count = 0;
    for (uint64_t r = 0; r < num; r++) {
        ps_text key = key_of(store, r);
        count += !key.failed && ps_cache_has(store->cache, key.data, key.length);
        ps_text_free(&key);
    }
    return count;
}

/* A folder that cannot be used has nothing. */
uint64_t ps_sets_count_kept(const ps_sampler_request *request, const ps_set_place *place,
                            uint64_t num) {
    const uint64_t most = 10000; /* 30 ms */
    const uint64_t looked_at = num < most ? num : most;
    ps_set_store *store = NULL;
    uint64_t count = 0;
    if (ps_set_place_takes(place, request) && has_folder(place) &&
        ps_set_store_open(&store, request, place, NULL) == PSPEC_OK) {
        count = count_names(store, looked_at);
    }
    ps_set_store_close(store);
    return num > looked_at ? (uint64_t)((double)count / (double)looked_at * (double)num) : count;
}
