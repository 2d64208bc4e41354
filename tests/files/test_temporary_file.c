/* Temporary files: what a dead process left goes, what is being written stays, with its lock or
 * without. */
#include "files/temporary_file.h"
#include "test_folder.h"

#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static int create(const test_folder *folder, char **path) {
    char where[TEST_PATH_BYTES];
    test_path(folder, "", where);
    const int descriptor = ps_temporary_create(where, strlen(where), 0600, path);
    assert_true(descriptor >= 0);
    return descriptor;
}

static void finish(int descriptor, char *path) {
    close(descriptor);
    unlink(path);
    free(path);
}

/* Makes two files; the first has lost its lock, or never had it, before the second is made. */
static void own_files_stay(void **state) {
    for (int has_lock = 0; has_lock < 2; has_lock++) {
        char *first_path = NULL;
        char *second_path = NULL;
        const int first = create(*state, &first_path);
        assert_int_equal(flock(first, has_lock ? LOCK_EX : LOCK_UN), 0);
        const int second = create(*state, &second_path);
        assert_string_not_equal(first_path, second_path);
        assert_int_equal(access(first_path, F_OK), 0);
        finish(first, first_path);
        finish(second, second_path);
    }
}

/* The name that another process would give: the number of no process in place of ours. */
static void rename_to_other(const char *path, char other[TEST_PATH_BYTES]) {
    char own[32];
    snprintf(own, sizeof own, "-%ld-", (long)getpid());
    const char *const place = strstr(path, own);
    assert_non_null(place);
    snprintf(other, TEST_PATH_BYTES, "%.*s-999999999-%s", (int)(place - path), path,
             place + strlen(own));
    assert_int_equal(rename(path, other), 0);
}

static void files_of_others_stay_while_locked(void **state) {
    for (int has_lock = 0; has_lock < 2; has_lock++) {
        char other[TEST_PATH_BYTES];
        char *first_path = NULL;
        char *second_path = NULL;
        const int first = create(*state, &first_path);
        rename_to_other(first_path, other);
        assert_int_equal(flock(first, has_lock ? LOCK_EX : LOCK_UN), 0);
        const int second = create(*state, &second_path);
        assert_int_equal(access(other, F_OK), has_lock ? 0 : -1);
        finish(first, first_path);
        finish(second, second_path);
        unlink(other);
    }
}

/* ---- several processes --------------------------------------------------------------------- */

/* Makes files and gives them their final name, as outputs are made. 0: every file was there until
 * then. */
static int make_and_rename(const test_folder *folder, unsigned number) {
    enum { NUM_FILES = 4000 };
    char name[32];
    char final_path[TEST_PATH_BYTES];
    char where[TEST_PATH_BYTES];
    snprintf(name, sizeof name, "final-%u", number);
    test_path(folder, name, final_path);
    test_path(folder, "", where);
    for (int i = 0; i < NUM_FILES; i++) {
        char *path = NULL;
        const int descriptor = ps_temporary_create(where, strlen(where), 0600, &path);
        const bool is_there = descriptor >= 0 && rename(path, final_path) == 0;
        close(descriptor);
        free(path);
        if (!is_there) {
            fprintf(stderr, "process %u, file %d: %s\n", number, i, strerror(errno));
            return 1;
        }
    }
    return 0;
}

/* Names are used again at once: who clears up may have opened the file that had the name before. */
static void several_processes_keep_their_files(void **state) {
    enum { NUM_PROCESSES = 4 };
    pid_t children[NUM_PROCESSES];
    fflush(stdout);
    for (unsigned i = 0; i < NUM_PROCESSES; i++) {
        children[i] = fork();
        assert_true(children[i] >= 0);
        if (children[i] == 0) {
            _exit(make_and_rename(*state, i));
        }
    }
    for (unsigned i = 0; i < NUM_PROCESSES; i++) {
        int result = 0;
        assert_int_equal(waitpid(children[i], &result, 0), children[i]);
        assert_true(WIFEXITED(result));
        assert_int_equal(WEXITSTATUS(result), 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(own_files_stay, test_folder_create, test_folder_remove),
        cmocka_unit_test_setup_teardown(files_of_others_stay_while_locked, test_folder_create,
                                        test_folder_remove),
        cmocka_unit_test_setup_teardown(several_processes_keep_their_files, test_folder_create,
                                        test_folder_remove),
    };
    return cmocka_run_group_tests_name("temporary_file", tests, NULL, NULL);
}
