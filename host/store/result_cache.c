#include "store/result_cache.h"

#include "base/memory.h"
#include "store/cache_folder.h"
#include "store/cache_trust.h"

#include <inttypes.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

/* Arrays of an entry. */
static const char key_name[] = "cache_key", data_name[] = "data";

struct ps_cache {
    char *directory;
    uint64_t max_bytes;
    atomic_flag has_failed;
    atomic_uint num_broken;
    atomic_uint_least64_t unsurveyed; /* bytes put since all files were counted */
};

/* Files of a folder are counted again when this handle has put so much of the limit: with 50,000
 * of them that takes 0.2 s, and an entry 0.9 ms (two cores of an EPYC, ext4, 2026-11). */
enum { SURVEYS_OF_LIMIT = 64 };

/* ---- where ---- */

/* NULL: not set, or empty */
static const char *variable(const char *name) {
    const char *const value = getenv(name);
    return value != NULL && value[0] != '\0' ? value : NULL;
}

pspec_status ps_cache_default_directory(ps_text *out, ps_error *error) {
    const char *const own = variable("POINTSPEC_CACHE_DIR");
    const char *const all = variable("XDG_CACHE_HOME");
    const char *const home = variable("HOME");
    if (own != NULL) {
        ps_text_append(out, "%s", own);
    } else if (all != NULL && all[0] == '/') {
        ps_text_append(out, "%s/pointspec", all);
    } else if (home != NULL) {
        ps_text_append(out, "%s/.cache/pointspec", home);
    } else {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "no folder for the cache of results: none of POINTSPEC_CACHE_DIR, "
                       "XDG_CACHE_HOME and HOME is set");
    }
    return ps_text_check(out, error);
}

pspec_status ps_cache_open(ps_cache **out, const char *directory, uint64_t max_bytes,
                           ps_error *error) {
    *out = NULL;
    if (directory[0] == '\0') {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "the name of the folder of the cache is empty");
    }
    PS_TRY(ps_cache_folder_make(directory, error));
    PS_TRY(ps_cache_check_folder(directory, error));
    ps_cache *cache = NULL;
    PS_TRY(PS_NEW(&cache, 1, "cache", error));
    cache->max_bytes = max_bytes;
    atomic_flag_clear(&cache->has_failed);
    atomic_init(&cache->num_broken, 0);
    atomic_init(&cache->unsurveyed, max_bytes); /* what is there already is not known */
    cache->directory = strdup(directory);
    if (cache->directory == NULL) {
        free(cache);
        return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for a file name");
    }
    *out = cache;
    return PSPEC_OK;
}

void ps_cache_close(ps_cache *cache) {
    if (cache != NULL) {
        free(cache->directory);
        free(cache);
    }
}

bool ps_cache_first_failure(ps_cache *cache) {
    return !atomic_flag_test_and_set(&cache->has_failed);
}

/* cache_folder.c knows entries by this form of name. */
pspec_status ps_cache_append_name(ps_text *path, const void *key, size_t key_bytes,
                                  ps_error *error) {
    const XXH128_hash_t hash = XXH3_128bits(key, key_bytes);
    ps_text_append(path, "/%016" PRIx64 "%016" PRIx64 ".result", (uint64_t)hash.high64,
                   (uint64_t)hash.low64);
    return ps_text_check(path, error);
}

static pspec_status entry_path(ps_text *path, const ps_cache *cache, const void *key,
                               size_t key_bytes, ps_error *error) {
    ps_text_append(path, "%s", cache->directory);
    return ps_cache_append_name(path, key, key_bytes, error);
}

/* ---- entries ---- */

/* The archive there, NULL where there is none of this key; *is_broken: what is there is none. */
static pspec_status read_entry(ps_npz_file **out, bool *is_broken, const char *path,
                               const void *key, size_t key_bytes, ps_error *error) {
    int descriptor = -1;
    uint64_t num_bytes = 0;
    ps_cache_file_kind kind = PS_CACHE_FILE_ABSENT;
    ps_error reason = {0};
    PS_TRY(ps_cache_file_open(path, &descriptor, &num_bytes, &kind, error));
    *is_broken = kind == PS_CACHE_FILE_NONE;
    if (kind != PS_CACHE_FILE_OWN) {
        return PSPEC_OK;
    }
    const pspec_status status = ps_npz_read(out, descriptor, path, PS_NPZ_LIMIT, &reason);
    const ps_npz_array *const stored = *out != NULL ? ps_npz_find(*out, key_name) : NULL;
    *is_broken = status == PSPEC_ERROR_INPUT || (*out != NULL && stored == NULL);
    if (stored != NULL && stored->rank == 1 && stored->shape[0] == key_bytes &&
        (key_bytes == 0 || memcmp(stored->data, key, key_bytes) == 0)) {
        (void)futimens(descriptor, NULL); /* where the folder can be written */
    } else {
        ps_npz_free(*out); /* of two keys with one address, or broken */
        *out = NULL;
    }
    close(descriptor);
    return status == PSPEC_OK || *is_broken ? PSPEC_OK
                                            : ps_fail(error, status, "%s", reason.message);
}

pspec_status ps_cache_find(ps_cache *cache, const void *key, size_t key_bytes, ps_npz_file **out,
                           ps_error *error) {
    ps_text path = {0};
    bool is_broken = false;
    *out = NULL;
    pspec_status status = entry_path(&path, cache, key, key_bytes, error);
    if (status == PSPEC_OK) {
        status = read_entry(out, &is_broken, path.data, key, key_bytes, error);
    }
    if (status == PSPEC_OK && is_broken) {
        /* In the meantime it may be a new one of another process: then that is computed once more.
         */
        (void)unlink(path.data);
        atomic_fetch_add(&cache->num_broken, 1);
    }
    ps_text_free(&path);
    return status;
}

pspec_status ps_cache_get(ps_cache *cache, const void *key, size_t key_bytes, void **data,
                          size_t *data_bytes, bool *is_found, ps_error *error) {
    ps_npz_file *file = NULL;
    *data = NULL;
    *data_bytes = 0;
    pspec_status status = ps_cache_find(cache, key, key_bytes, &file, error);
    const ps_npz_array *const array = file != NULL ? ps_npz_find(file, data_name) : NULL;
    if (array != NULL && array->kind == 'u' && array->rank == 1) {
        status = ps_allocate(data, array->shape[0], 1, "a saved result", error);
    }
    *is_found = *data != NULL;
    if (*is_found) {
        *data_bytes = array->shape[0];
        memcpy(*data, array->data, *data_bytes);
    }
    ps_npz_free(file);
    return status;
}

/* Asked of names alone: an entry may be damaged. */
bool ps_cache_has(const ps_cache *cache, const void *key, size_t key_bytes) {
    ps_text path = {0};
    const bool has =
        entry_path(&path, cache, key, key_bytes, NULL) == PSPEC_OK && access(path.data, R_OK) == 0;
    ps_text_free(&path);
    return has;
}

unsigned ps_cache_num_broken(const ps_cache *cache) {
    return atomic_load(&cache->num_broken);
}

static pspec_status evict(ps_cache *cache, uint64_t put_bytes, ps_error *error) {
    const uint64_t unsurveyed = atomic_fetch_add(&cache->unsurveyed, put_bytes) + put_bytes;
    if (unsurveyed < cache->max_bytes / SURVEYS_OF_LIMIT) {
        return PSPEC_OK;
    }
    atomic_store(&cache->unsurveyed, 0);
    return ps_cache_folder_evict(cache->directory, cache->max_bytes, error);
}

static pspec_status add_bytes(ps_npz *npz, const char *name, const void *bytes, size_t num,
                              ps_error *error) {
    const ps_npz_array array = {name, 'u', 1, 1, &num, num > 0 ? bytes : ""};
    return ps_npz_add(npz, &array, error);
}

pspec_status ps_cache_begin(ps_cache *cache, const void *key, size_t key_bytes, ps_npz **out,
                            ps_error *error) {
    ps_text path = {0};
    pspec_status status = PSPEC_OK;
    *out = NULL;
    PS_TRY_OUT(status, entry_path(&path, cache, key, key_bytes, error));
    /* somebody may have emptied ~/.cache while we computed */
    PS_TRY_OUT(status, ps_cache_folder_make(cache->directory, error));
    PS_TRY_OUT(status, ps_cache_clear_way(path.data, error));
    PS_TRY_OUT(status, ps_npz_open(out, path.data, PS_NPZ_LIMIT, error));
    status = add_bytes(*out, key_name, key, key_bytes, error);
out:
    if (status != PSPEC_OK) {
        ps_npz_discard(out);
    }
    ps_text_free(&path);
    return status;
}

pspec_status ps_cache_end(ps_cache *cache, ps_npz **npz, ps_error *error) {
    uint64_t bytes = 0;
    pspec_status status = ps_npz_end(*npz, &bytes, error);
    bytes = ps_cache_disk_bytes(bytes);
    const bool fits = bytes <= cache->max_bytes;
    if (status == PSPEC_OK && fits) {
        status = ps_npz_commit(npz, error);
    }
    ps_npz_discard(npz);
    PS_TRY(status);
    return fits ? evict(cache, bytes, error) : PSPEC_OK;
}

pspec_status ps_cache_put(ps_cache *cache, const void *key, size_t key_bytes, const void *data,
                          size_t data_bytes, ps_error *error) {
    ps_npz *npz = NULL;
    PS_TRY(ps_cache_begin(cache, key, key_bytes, &npz, error));
    const pspec_status status = add_bytes(npz, data_name, data, data_bytes, error);
    if (status != PSPEC_OK) {
        ps_npz_discard(&npz);
        return status;
    }
    return ps_cache_end(cache, &npz, error);
}
