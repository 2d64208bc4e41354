/* The cache of results among processes: several at once, processes that are killed while they
 * write, disks that are full and folders that may not be written to. */
#define _DEFAULT_SOURCE /* setgroups */

#include "harness_cache.h"
#include "test_folder.h"

#include <fcntl.h>
#include <grp.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>

#include <cmocka.h>

enum { NUM_KEYS = 40, LARGE = 20000, BOUND = 20 * CACHE_BLOCK_BYTES };

static ps_cache *open_cache(const test_folder *folder) {
    ps_cache *cache = NULL;
    ps_error error = {0};
    if (ps_cache_open(&cache, folder->path, BOUND, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
    return cache;
}

/* Runs a test in a process of its own, which ends with 0 when all is well; other numbers say what
 * is not. */
static pid_t start(int (*run)(const test_folder *, unsigned), const test_folder *folder,
                   unsigned number) {
    fflush(stdout);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        _exit(run(folder, number));
    }
    return child;
}

static void check_end(pid_t child) {
    int result = 0;
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_true(WIFEXITED(result));
    assert_int_equal(WEXITSTATUS(result), 0);
}

static size_t check_entries(ps_cache *cache) {
    ps_error error = {0};
    size_t num_found = 0;
    for (unsigned i = 0; i < NUM_KEYS; i++) {
        const int found = harness_cache_get(cache, i, LARGE, &error);
        assert_true(found >= 0);
        num_found += (size_t)found;
    }
    return num_found;
}

/* ---- several at once ---- */

static int work(const test_folder *folder, unsigned number) {
    enum { NUM_STEPS = 300, CLEAR_EVERY = 97 };
    ps_error error = {0};
    ps_cache *cache = NULL;
    uint32_t state = number;
    size_t num_hits = 0;
    if (ps_cache_open(&cache, folder->path, BOUND, &error) != PSPEC_OK) {
        return 1;
    }
    for (int i = 0; i < NUM_STEPS; i++) {
        state = state * 1664525u + 1013904223u;
        const unsigned key = state >> 16 & 0xffff;
        const int found = harness_cache_get(cache, key % NUM_KEYS, LARGE, &error);
        num_hits += found > 0 ? 1 : 0;
        const bool wants_put = found == 0 || i % 2 == 0; /* also over what is there */
        if (found < 0 ||
            (wants_put && harness_cache_put(cache, key % NUM_KEYS, LARGE, &error) != PSPEC_OK)) {
            fprintf(stderr, "process %u, step %d: %s\n", number, i, error.message);
            return 2;
        }
        if (i % CLEAR_EVERY == 0 && ps_cache_folder_shrink(folder->path, 0, &error) != PSPEC_OK) {
            return 3;
        }
    }
    ps_cache_close(cache);
    return num_hits > 0 ? 0 : 4;
}

static void several_processes_share_it(void **state) {
    enum { NUM_PROCESSES = 4 };
    pid_t children[NUM_PROCESSES];
    ps_error error = {0};
    for (unsigned i = 0; i < NUM_PROCESSES; i++) {
        children[i] = start(work, *state, i + 1);
    }
    for (unsigned i = 0; i < NUM_PROCESSES; i++) {
        check_end(children[i]);
    }
    ps_cache *const cache = open_cache(*state);
    size_t num_entries = 0;
    uint64_t bytes = 0;
    assert_int_equal(harness_cache_put(cache, 0, LARGE, &error), PSPEC_OK);
    assert_int_equal(
        ps_cache_folder_usage(harness_cache_folder(state), &num_entries, &bytes, &error), PSPEC_OK);
    assert_true(bytes <= BOUND);
    assert_int_equal(check_entries(cache), num_entries);
    assert_true(test_folder_count(*state, false) <= num_entries + 1); /* and the lock */
    ps_cache_close(cache);
}

/* Whoever has the lock evicts; others do not wait for it for long, and their entries are there. */
static void a_lock_that_is_held_delays_eviction_only(void **state) {
    char path[TEST_PATH_BYTES];
    ps_cache *const cache = open_cache(*state);
    ps_error error = {0};
    size_t num_entries = 0;
    uint64_t bytes = 0;
    const int lock = open(test_path(*state, "lock", path), O_RDWR | O_CREAT, 0600);
    assert_true(lock >= 0);
    assert_int_equal(flock(lock, LOCK_EX), 0);
    unsigned key = 0;
    for (; bytes <= BOUND; key++) {
        assert_int_equal(harness_cache_put(cache, key, LARGE, &error), PSPEC_OK);
        assert_int_equal(
            ps_cache_folder_usage(harness_cache_folder(state), &num_entries, &bytes, &error),
            PSPEC_OK);
        assert_int_equal(num_entries, key + 1);
    }
    close(lock);
    assert_int_equal(harness_cache_put(cache, key, LARGE, &error), PSPEC_OK);
    assert_int_equal(
        ps_cache_folder_usage(harness_cache_folder(state), &num_entries, &bytes, &error), PSPEC_OK);
    assert_true(num_entries < key && bytes <= BOUND);
    ps_cache_close(cache);
}

/* ---- killed ---- */

static int put_for_ever(const test_folder *folder, unsigned number) {
    ps_error error = {0};
    ps_cache *cache = NULL;
    if (ps_cache_open(&cache, folder->path, BOUND, &error) != PSPEC_OK) {
        return 1;
    }
    for (unsigned key = number;; key++) {
        if (harness_cache_put(cache, key % NUM_KEYS, LARGE, &error) != PSPEC_OK) {
            return 2;
        }
    }
}

/* Every entry that is there is whole; temporary files are older than an hour now. */
static void check_after_kill(const test_folder *folder, ps_cache *cache, size_t *num_temporary) {
    const struct timespec times[2] = {{1, 0}, {1, 0}};
    size_t num_entries = 0;
    DIR *const entries = opendir(folder->path);
    char path[TEST_PATH_BYTES];
    assert_non_null(entries);
    for (const struct dirent *entry = readdir(entries); entry != NULL; entry = readdir(entries)) {
        test_path(folder, entry->d_name, path);
        if (strstr(entry->d_name, ".tmp") != NULL) {
            *num_temporary += 1;
            assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
        } else if (strstr(entry->d_name, ".result") != NULL) {
            num_entries++;
        }
    }
    closedir(entries);
    assert_int_equal(check_entries(cache), num_entries);
}

static void processes_that_are_killed_leave_whole_entries(void **state) {
    enum { NUM_KILLS = 60, MOST_KILLS = 6000, LONGEST = 8000000 };
    ps_cache *const cache = open_cache(*state);
    ps_error error = {0};
    size_t num_temporary = 0;
    /* Until one came in between: where other work is in the way a child may not get so far. */
    for (unsigned i = 0; i < NUM_KILLS || (i < MOST_KILLS && num_temporary == 0); i++) {
        const struct timespec pause = {0, 1000000 + (long)(i * 2654435761u % LONGEST)};
        const pid_t child = start(put_for_ever, *state, i * 7);
        nanosleep(&pause, NULL);
        kill(child, SIGKILL);
        int result = 0;
        assert_int_equal(waitpid(child, &result, 0), child);
        assert_true(WIFSIGNALED(result));
        check_after_kill(*state, cache, &num_temporary);
    }
    assert_true(num_temporary > 0);
    assert_int_equal(ps_cache_folder_shrink(harness_cache_folder(state), 0, &error), PSPEC_OK);
    assert_true(test_folder_count(*state, false) <= 1); /* the lock */
    ps_cache_close(cache);
}

/* What killed processes leave takes from the room of entries, until it goes. */
static void temporary_files_count_and_go(void **state) {
    static const char bytes[BOUND / 2];
    const struct timespec times[2] = {{1, 0}, {1, 0}};
    char path[TEST_PATH_BYTES];
    ps_cache *const cache = open_cache(*state);
    ps_error error = {0};
    size_t num_entries[2] = {0};
    uint64_t bytes_there = 0;
    test_path(*state, ".pointspec-1-0.tmp", path);
    assert_true(test_write_file(path, bytes, sizeof bytes));
    for (int round = 0; round < 2; round++) {
        for (unsigned key = 0; key < NUM_KEYS; key++) {
            assert_int_equal(harness_cache_put(cache, key, LARGE, &error), PSPEC_OK);
            assert_int_equal(ps_cache_folder_usage(harness_cache_folder(state), &num_entries[round],
                                                   &bytes_there, &error),
                             PSPEC_OK);
            assert_true(num_entries[round] > 0 && bytes_there <= BOUND);
        }
        assert_int_equal(access(path, F_OK), round == 0 ? 0 : -1);
        assert_true(round == 1 || utimensat(AT_FDCWD, path, times, 0) == 0);
    }
    assert_true(num_entries[1] > num_entries[0]);
    ps_cache_close(cache);
}

/* ---- refused by the system ---- */

/* A limit for files does what a full disk does, in the middle of a write. */
static int fill_disk(const test_folder *folder, unsigned number) {
    (void)number;
    const struct rlimit limit = {1000, 1000};
    ps_error error = {0};
    ps_cache *cache = NULL;
    signal(SIGXFSZ, SIG_IGN);
    if (ps_cache_open(&cache, folder->path, BOUND, &error) != PSPEC_OK ||
        harness_cache_put(cache, 1, LARGE, &error) != PSPEC_OK ||
        setrlimit(RLIMIT_FSIZE, &limit) != 0) {
        return 1;
    }
    const size_t before = test_folder_count(folder, false);
    const bool is_refused = harness_cache_put(cache, 2, LARGE, &error) == PSPEC_ERROR_IO &&
                            harness_cache_put(cache, 1, LARGE, &error) == PSPEC_ERROR_IO &&
                            strstr(error.message, ".result: File too large") != NULL;
    const bool is_as_before = test_folder_count(folder, false) == before &&
                              harness_cache_get(cache, 1, LARGE, &error) == 1 &&
                              harness_cache_get(cache, 2, LARGE, &error) == 0;
    ps_cache_close(cache);
    return !is_refused ? 2 : !is_as_before ? 3 : 0;
}

static void a_full_disk_changes_nothing(void **state) {
    check_end(start(fill_disk, *state, 0));
}

/* What a process of another user is told of the folder. */
static int use_as_guest(const test_folder *folder, unsigned number) {
    enum { NOBODY = 65534 };
    ps_error error = {0};
    ps_cache *cache = NULL;
    (void)number;
    if (setgroups(0, NULL) != 0 || setgid(NOBODY) != 0 || setuid(NOBODY) != 0) {
        return 77;
    }
    if (ps_cache_open(&cache, folder->path, BOUND, &error) != PSPEC_ERROR_IO || cache != NULL) {
        return 1;
    }
    return strstr(error.message, "belongs to another user") != NULL ? 0 : 2;
}

static void the_folder_of_another_user_is_not_used(void **state) {
    const test_folder *const folder = *state;
    if (geteuid() != 0) {
        skip(); /* nobody else can be made */
    }
    assert_int_equal(chmod(folder->path, 0755), 0);
    check_end(start(use_as_guest, folder, 0));
}

static void an_entry_of_another_user_is_not_taken(void **state) {
    enum { SOMEBODY = 12345 };
    const test_folder *const folder = *state;
    char path[CACHE_PATH_BYTES];
    ps_error error = {0};
    if (geteuid() != 0) {
        skip();
    }
    ps_cache *const cache = open_cache(folder);
    assert_int_equal(harness_cache_put(cache, 1, LARGE, &error), PSPEC_OK);
    assert_int_equal(chown(harness_cache_path(folder->path, 1, path), SOMEBODY, SOMEBODY), 0);
    assert_int_equal(harness_cache_get(cache, 1, LARGE, &error), -1);
    assert_int_equal(error.status, PSPEC_ERROR_IO);
    assert_non_null(strstr(error.message, "belongs to another user, number 12345"));
    assert_int_equal(harness_cache_put(cache, 1, LARGE, &error), PSPEC_OK); /* in its place */
    ps_cache_close(cache);
}

/* Of one's own it can be read as it is. */
static void a_folder_that_cannot_be_written_can_be_read(void **state) {
    const test_folder *const folder = *state;
    ps_cache *const cache = open_cache(folder);
    ps_error error = {0};
    char path[CACHE_PATH_BYTES];
    assert_int_equal(harness_cache_put(cache, 1, LARGE, &error), PSPEC_OK);
    assert_int_equal(chmod(harness_cache_path(folder->path, 1, path), 0444), 0);
    assert_int_equal(chmod(folder->path, 0555), 0);
    assert_int_equal(harness_cache_get(cache, 1, LARGE, &error), 1);
    if (geteuid() != 0) {
        assert_int_equal(harness_cache_put(cache, 2, LARGE, &error), PSPEC_ERROR_IO);
        assert_non_null(strstr(error.message, "Permission denied"));
    }
    assert_int_equal(chmod(folder->path, 0700), 0);
    ps_cache_close(cache);
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(several_processes_share_it),
        IN_FOLDER(a_lock_that_is_held_delays_eviction_only),
        IN_FOLDER(processes_that_are_killed_leave_whole_entries),
        IN_FOLDER(temporary_files_count_and_go),
        IN_FOLDER(a_full_disk_changes_nothing),
        IN_FOLDER(the_folder_of_another_user_is_not_used),
        IN_FOLDER(an_entry_of_another_user_is_not_taken),
        IN_FOLDER(a_folder_that_cannot_be_written_can_be_read),
    };
    return cmocka_run_group_tests_name("result_cache_processes", tests, NULL, NULL);
}
