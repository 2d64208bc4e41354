#include "store/result_cache.h"

#include "base/memory.h"
#include "store/cache_entry.h"
#include "store/cache_folder.h"
#include "store/cache_trust.h"

#include <inttypes.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xxhash.h>

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
static pspec_status entry_path(ps_text *path, const ps_cache *cache, const void *key,
                               size_t key_bytes, ps_error *error) {
    const XXH128_hash_t hash = XXH3_128bits(key, key_bytes);
    ps_text_append(path, "%s/%016" PRIx64 "%016" PRIx64 ".result", cache->directory,
                   (uint64_t)hash.high64, (uint64_t)hash.low64);
    return ps_text_check(path, error);
}

/* ---- entries ---- */

pspec_status ps_cache_get(ps_cache *cache, const void *key, size_t key_bytes, void **data,
                          size_t *data_bytes, bool *is_found, ps_error *error) {
    ps_text path = {0};
    ps_cache_finding finding = PS_CACHE_ABSENT;
    *data = NULL;
    *data_bytes = 0;
    pspec_status status = entry_path(&path, cache, key, key_bytes, error);
    if (status == PSPEC_OK) {
        status = ps_cache_entry_read(path.data, key, key_bytes, data, data_bytes, &finding, error);
    }
    *is_found = status == PSPEC_OK && finding == PS_CACHE_FOUND;
    if (status == PSPEC_OK && finding == PS_CACHE_BROKEN) {
        /* In the meantime it may be a new one of another process: then that is computed once more.
         */
        (void)unlink(path.data);
        atomic_fetch_add(&cache->num_broken, 1);
    }
    ps_text_free(&path);
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

pspec_status ps_cache_put(ps_cache *cache, const void *key, size_t key_bytes, const void *data,
                          size_t data_bytes, ps_error *error) {
    const uint64_t least = sizeof(ps_cache_head) + (uint64_t)key_bytes; /* keys are in memory */
    const uint64_t bytes =
        data_bytes > UINT64_MAX - least ? UINT64_MAX : ps_cache_disk_bytes(least + data_bytes);
    if (bytes > cache->max_bytes) {
        return PSPEC_OK;
    }
    ps_text path = {0};
    pspec_status status = entry_path(&path, cache, key, key_bytes, error);
    if (status == PSPEC_OK) { /* somebody may have emptied ~/.cache while we computed */
        status = ps_cache_folder_make(cache->directory, error);
    }
    if (status == PSPEC_OK) {
        status = ps_cache_entry_write(path.data, key, key_bytes, data, data_bytes, error);
    }
    ps_text_free(&path);
    PS_TRY(status);
    return evict(cache, bytes, error);
}

/* ---- all of them ---- */

pspec_status ps_cache_usage(const ps_cache *cache, size_t *num_entries, uint64_t *bytes,
                            ps_error *error) {
    return ps_cache_folder_usage(cache->directory, num_entries, bytes, error);
}

pspec_status ps_cache_clear(const ps_cache *cache, ps_error *error) {
    return ps_cache_folder_shrink(cache->directory, 0, error);
}
