/* The cache of results in one process: what is put comes back, old entries go, folders of others
 * are not taken. */
#define _XOPEN_SOURCE 700 /* mkfifo, setenv */

#include "harness_cache.h"
#include "test_folder.h"

#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <time.h>

#include <cmocka.h>

enum { ROOMY = 1 << 30, SMALL = 100, LARGE = 20000 };

/* As if it had been used so many seconds ago. */
static void make_old(const char *path, time_t seconds) {
    const struct timespec then = {time(NULL) - seconds, 0};
    const struct timespec times[2] = {then, then};
    assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
}

static void entry_used(void **state, unsigned number, time_t seconds_ago) {
    char path[CACHE_PATH_BYTES];
    const test_folder *const folder = *state;
    make_old(harness_cache_path(folder->path, number, path), seconds_ago);
}

/* ---- what comes back ---- */

static void what_was_put_comes_back(void **state) {
    enum { NUM = 20 };
    ps_cache *cache = harness_cache_open(state, ROOMY);
    for (unsigned i = 0; i < NUM; i++) {
        assert_int_equal(harness_cache_must_get(cache, i, LARGE), 0);
        harness_cache_must_put(cache, i, LARGE);
        assert_int_equal(harness_cache_must_get(cache, i, LARGE), 1);
    }
    ps_cache_close(cache);
    ps_cache_close(NULL);
    cache = harness_cache_open(state, ROOMY);
    for (unsigned i = 0; i < NUM; i++) {
        assert_int_equal(harness_cache_must_get(cache, i, LARGE), 1);
    }
    assert_int_equal(test_folder_count(*state, false), NUM);
    harness_cache_must_put(cache, 3, SMALL); /* replaces what is there */
    assert_int_equal(harness_cache_must_get(cache, 3, SMALL), 1);
    assert_int_equal(test_folder_count(*state, false), NUM);
    ps_cache_close(cache);
}

static void keys_and_data_may_be_empty(void **state) {
    ps_cache *const cache = harness_cache_open(state, ROOMY);
    ps_error error = {0};
    void *data = NULL;
    size_t num_bytes = 7;
    bool is_found = false;
    assert_int_equal(ps_cache_put(cache, NULL, 0, NULL, 0, &error), PSPEC_OK);
    assert_int_equal(ps_cache_get(cache, NULL, 0, &data, &num_bytes, &is_found, &error), PSPEC_OK);
    assert_true(is_found);
    assert_non_null(data);
    assert_int_equal(num_bytes, 0);
    free(data);
    ps_cache_close(cache);
}

/* Two keys of one address cannot be found, so the file of one gets the name of the other. */
static void another_key_is_a_miss_and_stays(void **state) {
    const test_folder *const folder = *state;
    ps_cache *const cache = harness_cache_open(state, ROOMY);
    char from[CACHE_PATH_BYTES];
    char to[CACHE_PATH_BYTES];
    harness_cache_must_put(cache, 1, LARGE);
    assert_int_equal(
        rename(harness_cache_path(folder->path, 1, from), harness_cache_path(folder->path, 2, to)),
        0);
    assert_int_equal(harness_cache_must_get(cache, 2, LARGE), 0);
    assert_int_equal(access(to, F_OK), 0);
    assert_int_equal(rename(to, from), 0);
    assert_int_equal(harness_cache_must_get(cache, 1, LARGE), 1);
    ps_cache_close(cache);
}

static void folders_that_others_can_write_are_refused(void **state) {
    static const mode_t refused[] = {0777, 0770, 0720, 0702, 01777};
    static const mode_t taken[] = {0700, 0755, 0750};
    const test_folder *const folder = *state;
    ps_cache *cache = NULL;
    ps_error error = {0};
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        assert_int_equal(chmod(folder->path, refused[i]), 0);
        assert_int_equal(ps_cache_open(&cache, folder->path, ROOMY, &error), PSPEC_ERROR_IO);
        assert_null(cache);
        assert_non_null(strstr(error.message, "can be written by other users"));
        assert_non_null(strstr(error.message, folder->path));
    }
    for (size_t i = 0; i < sizeof taken / sizeof taken[0]; i++) {
        assert_int_equal(chmod(folder->path, taken[i]), 0);
        ps_cache_close(harness_cache_open(state, ROOMY));
    }
}

static void only_the_first_failure_is_told(void **state) {
    ps_cache *const cache = harness_cache_open(state, ROOMY);
    assert_true(ps_cache_first_failure(cache));
    assert_false(ps_cache_first_failure(cache));
    assert_false(ps_cache_first_failure(cache));
    ps_cache_close(cache);
}

/* ---- what goes ---- */

static void the_longest_unused_goes_first(void **state) {
    enum { NUM = 10 };
    ps_cache *cache = harness_cache_open(state, NUM * CACHE_BLOCK_BYTES);
    for (unsigned i = 0; i < NUM; i++) {
        harness_cache_must_put(cache, i, SMALL);
        entry_used(state, i, 1000 - (time_t)i);
    }
    harness_cache_check_usage(harness_cache_folder(state), NUM, NUM * CACHE_BLOCK_BYTES);
    assert_int_equal(harness_cache_must_get(cache, 0, SMALL), 1);
    harness_cache_must_put(cache, NUM, SMALL);
    harness_cache_check_usage(harness_cache_folder(state), NUM, NUM * CACHE_BLOCK_BYTES);
    assert_int_equal(harness_cache_must_get(cache, 1, SMALL), 0);
    assert_int_equal(harness_cache_must_get(cache, 0, SMALL), 1);
    ps_cache_close(cache);
    cache = harness_cache_open(state, 4 * CACHE_BLOCK_BYTES); /* the limit is the opener's */
    harness_cache_must_put(cache, NUM + 1, SMALL);
    harness_cache_check_usage(harness_cache_folder(state), 4, 4 * CACHE_BLOCK_BYTES);
    for (unsigned i = 0; i < NUM + 2; i++) {
        assert_int_equal(harness_cache_must_get(cache, i, SMALL), i == 0 || i >= NUM - 1);
    }
    ps_cache_close(cache);
}

static void the_bound_holds_for_entries_of_any_size(void **state) {
    const uint64_t bound = 10 * CACHE_BLOCK_BYTES;
    ps_cache *const cache = harness_cache_open(state, bound);
    ps_error error = {0};
    for (unsigned i = 0; i < 60; i++) {
        size_t num_entries = 0;
        uint64_t bytes = 0;
        harness_cache_must_put(cache, i, LARGE);
        assert_int_equal(
            ps_cache_folder_usage(harness_cache_folder(state), &num_entries, &bytes, &error),
            PSPEC_OK);
        assert_true(num_entries > 0 && bytes <= bound);
        assert_int_equal(harness_cache_must_get(cache, i, LARGE),
                         1); /* the one just put is the youngest */
    }
    ps_cache_close(cache);
}

static void what_is_larger_than_the_limit_is_not_stored(void **state) {
    ps_cache *cache = harness_cache_open(state, 2 * CACHE_BLOCK_BYTES);
    static const char data[2 * CACHE_BLOCK_BYTES] = {0};
    const test_folder *const folder = *state;
    char key[CACHE_KEY_BYTES];
    char path[CACHE_PATH_BYTES];
    struct stat facts;
    ps_error error = {0};
    harness_cache_key(7, key);
    assert_int_equal(ps_cache_put(cache, key, sizeof key, data, 1, &error), PSPEC_OK);
    assert_int_equal(stat(harness_cache_path(folder->path, 7, path), &facts), 0);
    assert_int_equal(unlink(path), 0);
    const size_t fits = sizeof data - (size_t)facts.st_size + 1;
    harness_cache_must_put(cache, 1, SMALL);
    assert_int_equal(ps_cache_put(cache, key, sizeof key, data, fits + 1, &error), PSPEC_OK);
    assert_int_equal(harness_cache_must_get(cache, 1, SMALL), 1);
    harness_cache_check_usage(harness_cache_folder(state), 1, CACHE_BLOCK_BYTES);
    assert_int_equal(ps_cache_put(cache, key, sizeof key, data, fits, &error), PSPEC_OK);
    harness_cache_check_usage(harness_cache_folder(state), 1, 2 * CACHE_BLOCK_BYTES);
    assert_int_equal(harness_cache_must_get(cache, 1, SMALL), 0);
    ps_cache_close(cache);
    cache = harness_cache_open(state, 0);
    harness_cache_must_put(cache, 1, SMALL);
    assert_int_equal(harness_cache_must_get(cache, 1, SMALL), 0);
    ps_cache_close(cache);
}

static void a_date_in_the_future_makes_nothing_young(void **state) {
    ps_cache *const cache = harness_cache_open(state, 2 * CACHE_BLOCK_BYTES);
    harness_cache_must_put(cache, 1, SMALL);
    harness_cache_must_put(cache, 2, SMALL);
    entry_used(state, 1, -100000);
    harness_cache_must_put(cache, 3, SMALL);
    assert_int_equal(harness_cache_must_get(cache, 1, SMALL), 0);
    assert_int_equal(harness_cache_must_get(cache, 2, SMALL), 1);
    ps_cache_close(cache);
}

static void only_our_files_count_and_go(void **state) {
    static const char *const foreign[] = {
        "notes.txt", "0123.result", "0123456789abcdef0123456789abcdeF.result",
        "0123456789abcdef0123456789abcdef.results", ".pointspec-1-0.txt"};
    enum { NUM_FOREIGN = sizeof foreign / sizeof foreign[0] };
    ps_cache *const cache = harness_cache_open(state, ROOMY);
    ps_error error = {0};
    char path[TEST_PATH_BYTES];
    for (size_t i = 0; i < NUM_FOREIGN; i++) {
        assert_true(test_write_file(test_path(*state, foreign[i], path), "text", 4));
        make_old(path, 100000);
    }
    harness_cache_check_usage(harness_cache_folder(state), 0, 0);
    harness_cache_must_put(cache, 1, SMALL);
    assert_true(test_write_file(test_path(*state, ".pointspec-1-0.tmp", path), "text", 4));
    harness_cache_check_usage(harness_cache_folder(state), 1, 2 * CACHE_BLOCK_BYTES);
    assert_int_equal(ps_cache_folder_shrink(harness_cache_folder(state), 0, &error),
                     PSPEC_OK); /* somebody may be writing to it */
    harness_cache_check_usage(harness_cache_folder(state), 0, CACHE_BLOCK_BYTES);
    make_old(path, 4000); /* its process is gone */
    assert_int_equal(ps_cache_folder_shrink(harness_cache_folder(state), 0, &error), PSPEC_OK);
    harness_cache_check_usage(harness_cache_folder(state), 0, 0);
    assert_int_equal(test_folder_count(*state, false), NUM_FOREIGN);
    ps_cache_close(cache);
}

/* ---- the folder ---- */

static void the_folder_is_made_when_it_is_missing(void **state) {
    char path[TEST_PATH_BYTES];
    struct stat facts;
    ps_cache *cache = NULL;
    ps_error error = {0};
    test_path(*state, "a//b/c/", path);
    assert_int_equal(ps_cache_open(&cache, path, ROOMY, &error), PSPEC_OK);
    assert_int_equal(stat(path, &facts), 0);
    assert_int_equal(facts.st_mode & 0777, 0700);
    assert_int_equal(rmdir(path), 0); /* as somebody may empty ~/.cache at any time */
    harness_cache_check_usage(path, 0, 0);
    assert_int_equal(harness_cache_must_get(cache, 1, SMALL), 0);
    assert_int_equal(ps_cache_folder_shrink(path, 0, &error), PSPEC_OK);
    harness_cache_must_put(cache, 1, SMALL);
    assert_int_equal(harness_cache_must_get(cache, 1, SMALL), 1);
    assert_int_equal(ps_cache_folder_shrink(path, 0, &error), PSPEC_OK);
    ps_cache_close(cache);
    assert_int_equal(rmdir(path), 0);
    assert_int_equal(rmdir(test_path(*state, "a/b", path)), 0);
}

static void folders_that_cannot_be_are_refused(void **state) {
    char path[TEST_PATH_BYTES];
    ps_cache *cache = NULL;
    ps_error error = {0};
    assert_true(test_write_file(test_path(*state, "file", path), "text", 4));
    assert_int_equal(ps_cache_open(&cache, path, ROOMY, &error), PSPEC_ERROR_IO);
    assert_non_null(strstr(error.message, "/file: Not a directory"));
    assert_int_equal(ps_cache_open(&cache, test_path(*state, "file/below", path), ROOMY, &error),
                     PSPEC_ERROR_IO);
    assert_non_null(strstr(error.message, "/file/below: Not a directory"));
    assert_int_equal(ps_cache_open(&cache, "", ROOMY, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_null(cache);
}

static void set_variable(const char *name, const char *value) {
    assert_int_equal(value != NULL ? setenv(name, value, 1) : unsetenv(name), 0);
}

static void the_environment_names_the_folder(void **state) {
    (void)state;
    static const struct {
        const char *own, *all, *home, *expected;
    } cases[] = {{"x/y", "/all", "/home", "x/y"},
                 {NULL, "/all", "/home", "/all/pointspec"},
                 {"", "/all", NULL, "/all/pointspec"},
                 {NULL, NULL, "/home", "/home/.cache/pointspec"},
                 {NULL, "relative", "/home", "/home/.cache/pointspec"},
                 {NULL, "", "", NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_text directory = {0};
        ps_error error = {0};
        set_variable("POINTSPEC_CACHE_DIR", cases[i].own);
        set_variable("XDG_CACHE_HOME", cases[i].all);
        set_variable("HOME", cases[i].home);
        assert_int_equal(ps_cache_default_directory(&directory, &error),
                         cases[i].expected != NULL ? PSPEC_OK : PSPEC_ERROR_INVALID_ARGUMENT);
        assert_string_equal(ps_text_string(&directory),
                            cases[i].expected != NULL ? cases[i].expected : "");
        ps_text_free(&directory);
    }
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(what_was_put_comes_back),
        IN_FOLDER(keys_and_data_may_be_empty),
        IN_FOLDER(another_key_is_a_miss_and_stays),
        IN_FOLDER(folders_that_others_can_write_are_refused),
        IN_FOLDER(only_the_first_failure_is_told),
        IN_FOLDER(the_longest_unused_goes_first),
        IN_FOLDER(the_bound_holds_for_entries_of_any_size),
        IN_FOLDER(what_is_larger_than_the_limit_is_not_stored),
        IN_FOLDER(a_date_in_the_future_makes_nothing_young),
        IN_FOLDER(only_our_files_count_and_go),
        IN_FOLDER(the_folder_is_made_when_it_is_missing),
        IN_FOLDER(folders_that_cannot_be_are_refused),
        cmocka_unit_test(the_environment_names_the_folder),
    };
    return cmocka_run_group_tests_name("result_cache", tests, NULL, NULL);
}
