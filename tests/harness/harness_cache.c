#include "harness_cache.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

void harness_cache_key(unsigned number, char key[CACHE_KEY_BYTES]) {
    memset(key, 0, CACHE_KEY_BYTES);
    snprintf(key, CACHE_KEY_BYTES, "%u", number);
    key[CACHE_KEY_BYTES - 1] = '\xff'; /* keys are not texts */
}

size_t harness_cache_data(unsigned number, size_t most_bytes, unsigned char *data) {
    uint32_t state = number * 2654435761u + 1;
    const size_t num_bytes = state / 7 % most_bytes;
    for (size_t i = 0; i < num_bytes; i++) {
        state = state * 1664525u + 1013904223u;
        data[i] = (unsigned char)(state >> 24);
    }
    return num_bytes;
}

pspec_status harness_cache_put(ps_cache *cache, unsigned number, size_t most_bytes,
                               ps_error *error) {
    char key[CACHE_KEY_BYTES];
    unsigned char *const data = malloc(most_bytes);
    if (data == NULL) {
        return PSPEC_ERROR_MEMORY;
    }
    harness_cache_key(number, key);
    const size_t num_bytes = harness_cache_data(number, most_bytes, data);
    const pspec_status status = ps_cache_put(cache, key, sizeof key, data, num_bytes, error);
    free(data);
    return status;
}

int harness_cache_get(ps_cache *cache, unsigned number, size_t most_bytes, ps_error *error) {
    char key[CACHE_KEY_BYTES];
    void *data = NULL;
    size_t num_bytes = 0;
    bool is_found = false;
    harness_cache_key(number, key);
    if (ps_cache_get(cache, key, sizeof key, &data, &num_bytes, &is_found, error) != PSPEC_OK) {
        return -1;
    }
    if (!is_found) {
        return data == NULL ? 0 : -1;
    }
    unsigned char *const expected = malloc(most_bytes);
    const bool is_right = expected != NULL && data != NULL &&
                          harness_cache_data(number, most_bytes, expected) == num_bytes &&
                          memcmp(data, expected, num_bytes) == 0;
    free(expected);
    free(data);
    return is_right ? 1 : -1;
}

const char *harness_cache_path(const char *directory, unsigned number,
                               char path[CACHE_PATH_BYTES]) {
    char key[CACHE_KEY_BYTES];
    harness_cache_key(number, key);
    const XXH128_hash_t hash = XXH3_128bits(key, sizeof key);
    snprintf(path, CACHE_PATH_BYTES, "%s/%016" PRIx64 "%016" PRIx64 ".result", directory,
             (uint64_t)hash.high64, (uint64_t)hash.low64);
    return path;
}

ps_cache *harness_cache_open(void **state, uint64_t max_bytes) {
    const test_folder *const folder = *state;
    ps_cache *cache = NULL;
    ps_error error = {0};
    if (ps_cache_open(&cache, folder->path, max_bytes, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
    return cache;
}

void harness_cache_must_put(ps_cache *cache, unsigned number, size_t most_bytes) {
    ps_error error = {0};
    if (harness_cache_put(cache, number, most_bytes, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
}

int harness_cache_must_get(ps_cache *cache, unsigned number, size_t most_bytes) {
    ps_error error = {0};
    const int found = harness_cache_get(cache, number, most_bytes, &error);
    if (found < 0) {
        fail_msg("entry %u is wrong, or: %s", number, error.message);
    }
    return found;
}

const char *harness_cache_folder(void **state) {
    return ((const test_folder *)*state)->path;
}

void harness_cache_check_usage(const char *folder, size_t num_entries, uint64_t bytes) {
    size_t entries_there = 0;
    uint64_t bytes_there = 0;
    ps_error error = {0};
    assert_int_equal(ps_cache_folder_usage(folder, &entries_there, &bytes_there, &error), PSPEC_OK);
    assert_int_equal(entries_there, num_entries);
    assert_int_equal(bytes_there, bytes);
}
