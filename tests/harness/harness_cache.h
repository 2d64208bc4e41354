/* Entries for the tests of the cache of results: key and data follow from a number. */
#ifndef PS_TESTS_HARNESS_CACHE_H
#define PS_TESTS_HARNESS_CACHE_H

#include "store/cache_folder.h"
#include "store/result_cache.h"
#include "test_folder.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { CACHE_KEY_BYTES = 40, CACHE_BLOCK_BYTES = 4096, CACHE_PATH_BYTES = 512 };

void harness_cache_key(unsigned number, char key[CACHE_KEY_BYTES]);
/* From 0 to most_bytes - 1 bytes. */
size_t harness_cache_data(unsigned number, size_t most_bytes, unsigned char *data);

pspec_status harness_cache_put(ps_cache *cache, unsigned number, size_t most_bytes,
                               ps_error *error);
/* 1: the data of this number came, 0: nothing came, -1: an error, or other data. */
int harness_cache_get(ps_cache *cache, unsigned number, size_t most_bytes, ps_error *error);

/* The cache in the folder of a test; and the same as above, where what does not work is a failure
 * of the test. */
ps_cache *harness_cache_open(void **state, uint64_t max_bytes);
void harness_cache_must_put(ps_cache *cache, unsigned number, size_t most_bytes);
int harness_cache_must_get(ps_cache *cache, unsigned number, size_t most_bytes);
/* That folder, and what entries and temporary files of a folder take on the disk. */
const char *harness_cache_folder(void **state);
void harness_cache_check_usage(const char *folder, size_t num_entries, uint64_t bytes);

/* The file of an entry. */
const char *harness_cache_path(const char *directory, unsigned number, char path[CACHE_PATH_BYTES]);

#endif
