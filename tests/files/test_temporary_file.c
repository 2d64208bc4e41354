/* Temporary files: what a dead process left goes, what is being written stays, with its lock or without. */
#include "files/temporary_file.h"
#include "test_folder.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(own_files_stay, test_folder_create, test_folder_remove),
        cmocka_unit_test_setup_teardown(files_of_others_stay_while_locked, test_folder_create,
                                        test_folder_remove),
    };
    return cmocka_run_group_tests_name("temporary_file", tests, NULL, NULL);
}
