/* The cache of results in one process: an entry that is broken, or no file, is a miss, and gone or
 * replaced. */
#define _XOPEN_SOURCE 700 /* mkfifo */

#include "harness_cache.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

enum { ROOMY = 1 << 30, SMALL = 100 };

/* These bytes as the file of entry 1: a miss, and gone. */
static void check_broken(void **state, ps_cache *cache, const void *bytes, size_t num_bytes) {
    const test_folder *const folder = *state;
    char path[CACHE_PATH_BYTES];
    harness_cache_path(folder->path, 1, path);
    assert_true(test_write_file(path, bytes, num_bytes));
    assert_int_equal(harness_cache_must_get(cache, 1, SMALL), 0);
    assert_int_equal(access(path, F_OK), -1);
}

static char *take_entry(void **state, ps_cache *cache, size_t *num_bytes) {
    const test_folder *const folder = *state;
    char path[CACHE_PATH_BYTES];
    harness_cache_must_put(cache, 1, SMALL);
    char *const bytes = test_read_file(harness_cache_path(folder->path, 1, path), num_bytes);
    assert_non_null(bytes);
    assert_true(*num_bytes > CACHE_KEY_BYTES + SMALL / 2);
    return bytes;
}

static void every_changed_byte_is_noticed(void **state) {
    static const int changes[] = {1, 0x80, 0xff};
    ps_cache *const cache = harness_cache_open(state, ROOMY);
    size_t num_bytes = 0;
    char *const bytes = take_entry(state, cache, &num_bytes);
    for (size_t i = 0; i < num_bytes; i++) {
        for (size_t j = 0; j < sizeof changes / sizeof changes[0]; j++) {
            bytes[i] = (char)(bytes[i] ^ changes[j]);
            check_broken(state, cache, bytes, num_bytes);
            bytes[i] = (char)(bytes[i] ^ changes[j]);
        }
    }
    harness_cache_must_put(cache, 1, SMALL);
    assert_int_equal(harness_cache_must_get(cache, 1, SMALL), 1);
    free(bytes);
    ps_cache_close(cache);
}

static void every_length_is_noticed(void **state) {
    ps_cache *const cache = harness_cache_open(state, ROOMY);
    size_t num_bytes = 0;
    char *const bytes = take_entry(state, cache, &num_bytes); /* and a NUL behind them */
    for (size_t i = 0; i <= num_bytes + 1; i++) {
        if (i != num_bytes) {
            check_broken(state, cache, bytes, i);
        }
    }
    free(bytes);
    ps_cache_close(cache);
}

static void what_is_no_file_is_a_miss(void **state) {
    const test_folder *const folder = *state;
    ps_cache *const cache = harness_cache_open(state, ROOMY);
    ps_error error = {0};
    char path[CACHE_PATH_BYTES];
    assert_int_equal(mkfifo(harness_cache_path(folder->path, 1, path), 0600), 0);
    assert_int_equal(harness_cache_must_get(cache, 1, SMALL), 0); /* does not wait for a writer */
    assert_int_equal(access(path, F_OK), -1);
    assert_int_equal(mkdir(path, 0700), 0);
    assert_int_equal(harness_cache_must_get(cache, 1, SMALL), 0);
    assert_int_equal(harness_cache_put(cache, 1, SMALL, &error), PSPEC_ERROR_IO);
    assert_non_null(strstr(error.message, "Is a directory"));
    harness_cache_check_usage(harness_cache_folder(state), 0, 0);
    assert_int_equal(ps_cache_folder_shrink(harness_cache_folder(state), 0, &error), PSPEC_OK);
    assert_int_equal(access(path, F_OK), 0);
    ps_cache_close(cache);
}

/* Every kind of thing that can have a name, in place of an entry; none is read, waited for or
 * written into. */
static void put_in_place(const char *path, const char *kind, const char *target) {
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    if (strcmp(kind, "pipe") == 0) {
        assert_int_equal(mkfifo(path, 0600), 0);
    } else if (strcmp(kind, "link") == 0) {
        assert_int_equal(symlink(target, path), 0);
    } else if (strcmp(kind, "socket") == 0) {
        const int number = socket(AF_UNIX, SOCK_STREAM, 0);
        assert_true(strlen(path) < sizeof address.sun_path);
        memcpy(address.sun_path, path, strlen(path) + 1);
        assert_int_equal(bind(number, (const struct sockaddr *)&address, sizeof address), 0);
        close(number);
    }
}

static void what_is_no_file_is_replaced(void **state) {
    static const char *const kinds[] = {"pipe", "link", "socket"};
    const test_folder *const folder = *state;
    ps_cache *const cache = harness_cache_open(state, ROOMY);
    char path[CACHE_PATH_BYTES];
    char other[CACHE_PATH_BYTES];
    harness_cache_must_put(cache, 2, SMALL);
    harness_cache_path(folder->path, 1, path);
    harness_cache_path(folder->path, 2, other);
    alarm(600); /* instead of for ever */
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        put_in_place(path, kinds[i], other);
        assert_int_equal(harness_cache_must_get(cache, 1, SMALL), 0);
        (void)unlink(path);
        put_in_place(path, kinds[i], other);
        harness_cache_must_put(cache, 1, SMALL); /* that nobody looked for before */
        assert_int_equal(harness_cache_must_get(cache, 1, SMALL), 1);
        assert_int_equal(harness_cache_must_get(cache, 2, SMALL), 1);
        assert_int_equal(unlink(path), 0);
    }
    alarm(0);
    ps_cache_close(cache);
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(every_changed_byte_is_noticed),
        IN_FOLDER(every_length_is_noticed),
        IN_FOLDER(what_is_no_file_is_a_miss),
        IN_FOLDER(what_is_no_file_is_replaced),
    };
    return cmocka_run_group_tests_name("result_cache_broken", tests, NULL, NULL);
}
