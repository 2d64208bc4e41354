/* Files that appear when complete: names, permissions, refusals, full disks. */
#define _XOPEN_SOURCE 700 /* symlink, mkfifo, realpath as glibc has them */

#include "files/npy_array.h"
#include "files/output_file.h"
#include "test_folder.h"

#include <fcntl.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <cmocka.h>

static void write_text(const char *path, const char *text) {
    ps_error error = {0};
    ps_output_file *file = NULL;
    assert_int_equal(ps_output_open(&file, path, &error), PSPEC_OK);
    fputs(text, ps_output_stream(file));
    if (ps_output_commit(&file, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
    assert_null(file);
}

static void check_text(const char *path, const char *expected) {
    char *const text = test_read_file(path, NULL);
    assert_non_null(text);
    assert_string_equal(text, expected);
    free(text);
}

static void appears_at_commit_only(void **state) {
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    ps_output_file *file = NULL;
    test_path(*state, "a 'name'\n with \"everything\"", path);
    assert_int_equal(ps_output_open(&file, path, &error), PSPEC_OK);
    fputs("new", ps_output_stream(file));
    assert_int_equal(ps_output_check(file, &error), PSPEC_OK);
    assert_int_equal(access(path, F_OK), -1);
    assert_int_equal(test_folder_count(*state, false), 1);
    assert_int_equal(ps_output_commit(&file, &error), PSPEC_OK);
    check_text(path, "new");
    assert_int_equal(test_folder_count(*state, false), 1);
}

static void discard_leaves_everything_as_it_was(void **state) {
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    ps_output_file *file = NULL;
    ps_output_discard(&file);
    write_text(test_path(*state, "kept", path), "old");
    assert_int_equal(ps_output_open(&file, path, &error), PSPEC_OK);
    fputs("new", ps_output_stream(file));
    ps_output_discard(&file);
    assert_null(file);
    check_text(path, "old");
    assert_int_equal(test_folder_count(*state, false), 1);
}

static void several_outputs_do_not_meet(void **state) {
    enum { NUM_FILES = 3 };
    ps_output_file *files[NUM_FILES] = {NULL};
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    for (size_t i = 0; i < NUM_FILES; i++) {
        char name[] = {(char)('a' + i), '\0'};
        assert_int_equal(ps_output_open(&files[i], test_path(*state, name, path), &error),
                         PSPEC_OK);
        fputs(name, ps_output_stream(files[i]));
    }
    for (size_t i = 0; i < NUM_FILES; i++) {
        assert_int_equal(ps_output_commit(&files[i], &error), PSPEC_OK);
    }
    check_text(test_path(*state, "b", path), "b");
    check_text(test_path(*state, "c", path), "c");
}

static mode_t mode_of(const char *path) {
    struct stat facts;
    assert_int_equal(stat(path, &facts), 0);
    return facts.st_mode & 0777;
}

static void permissions_are_those_of_fopen(void **state) {
    char path[TEST_PATH_BYTES];
    const mode_t kept = umask(027);
    write_text(test_path(*state, "file", path), "1");
    umask(kept);
    assert_int_equal(mode_of(path), 0640);
    assert_int_equal(chmod(path, 0604), 0);
    write_text(path, "2");
    assert_int_equal(mode_of(path), 0604);
    if (geteuid() != 0) { /* root writes everything */
        ps_error error = {0};
        ps_output_file *file = NULL;
        assert_int_equal(chmod(path, 0444), 0);
        assert_int_equal(ps_output_open(&file, path, &error), PSPEC_ERROR_IO);
    }
}

static void writes_through_links(void **state) {
    char path[TEST_PATH_BYTES];
    char link_path[TEST_PATH_BYTES];
    struct stat facts;
    write_text(test_path(*state, "target", path), "old");
    assert_int_equal(symlink("target", test_path(*state, "link", link_path)), 0);
    write_text(link_path, "new");
    check_text(path, "new");
    assert_int_equal(lstat(link_path, &facts), 0);
    assert_true(S_ISLNK(facts.st_mode));
}

static void writes_devices_and_pipes_directly(void **state) {
    char path[TEST_PATH_BYTES];
    struct stat facts;
    write_text("/dev/null", "gone");
    assert_int_equal(stat("/dev/null", &facts), 0);
    assert_true(S_ISCHR(facts.st_mode));
    assert_int_equal(mkfifo(test_path(*state, "fifo", path), 0600), 0);
    const int reader = open(path, O_RDONLY | O_NONBLOCK);
    assert_true(reader >= 0);
    write_text(path, "through");
    char bytes[16] = "";
    assert_int_equal(read(reader, bytes, sizeof bytes), 7);
    assert_string_equal(bytes, "through");
    close(reader);
    assert_int_equal(stat(path, &facts), 0);
    assert_true(S_ISFIFO(facts.st_mode));
}

/* ---- a file that goes between two calls (the linker sends them here) ---- */

static const char *removed_by_access;   /* before access looks at it, or NULL */
static const char *removed_by_realpath; /* before realpath does, or NULL */

int __real_access(const char *path, int mode);
int __wrap_access(const char *path, int mode);
char *__real_realpath(const char *path, char *resolved);
char *__wrap_realpath(const char *path, char *resolved);

int __wrap_access(const char *path, int mode) {
    if (removed_by_access != NULL) {
        unlink(removed_by_access);
    }
    return __real_access(path, mode);
}

char *__wrap_realpath(const char *path, char *resolved) {
    if (removed_by_realpath != NULL) {
        unlink(removed_by_realpath);
    }
    return __real_realpath(path, resolved);
}

static void what_is_removed_meanwhile_is_new(void **state) {
    char path[TEST_PATH_BYTES];
    test_path(*state, "file", path);
    for (int round = 0; round < 2; round++) {
        const char **const culprit = round == 0 ? &removed_by_access : &removed_by_realpath;
        write_text(path, "old");
        *culprit = path;
        write_text(path, "new");
        *culprit = NULL;
        check_text(path, "new");
        assert_int_equal(test_folder_count(*state, false), 1);
    }
}

static void refuses_what_cannot_be_written(void **state) {
    const test_folder *const folder = *state;
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    ps_output_file *file = NULL;
    assert_int_equal(ps_output_open(&file, folder->path, &error), PSPEC_ERROR_IO);
    assert_non_null(strstr(error.message, "Is a directory"));
    assert_int_equal(ps_output_open(&file, test_path(folder, "no/such/folder", path), &error),
                     PSPEC_ERROR_IO);
    assert_non_null(strstr(error.message, "no/such/folder: No such file or directory"));
    assert_int_equal(ps_output_open(&file, "", &error), PSPEC_ERROR_INVALID_ARGUMENT);
    char long_name[400];
    memset(long_name, 'x', sizeof long_name - 1);
    long_name[sizeof long_name - 1] = '\0';
    test_path(folder, long_name, path);
    const pspec_status status = ps_output_open(&file, path, &error);
    assert_true(status == PSPEC_ERROR_IO ||
                (status == PSPEC_OK && ps_output_commit(&file, &error) == PSPEC_ERROR_IO));
    assert_non_null(strstr(error.message, "File name too long"));
    assert_int_equal(test_folder_count(folder, false), 0);
}

static void a_full_device_is_reported(void **state) {
    (void)state;
    if (access("/dev/full", W_OK) != 0) {
        skip();
    }
    ps_error error = {0};
    ps_output_file *file = NULL;
    assert_int_equal(ps_output_open(&file, "/dev/full", &error), PSPEC_OK);
    fputs("does not fit", ps_output_stream(file));
    assert_int_equal(ps_output_commit(&file, &error), PSPEC_ERROR_IO);
    assert_string_equal(error.message, "cannot write /dev/full: No space left on device");
    assert_null(file);
}

/* In a process of its own, since the limit cannot be lifted again by everyone. */
static int write_beyond_limit(const char *path) {
    enum { NUM_VALUES = 100000 };
    static double values[NUM_VALUES];
    const struct rlimit limit = {100000, 100000};
    const ps_npy_array array = {1, {NUM_VALUES}, NUM_VALUES, false, values};
    signal(SIGXFSZ, SIG_IGN);
    ps_error error = {0};
    const bool is_set = setrlimit(RLIMIT_FSIZE, &limit) == 0;
    const pspec_status status = ps_npy_write_array(path, &array, &error);
    const bool is_named = strstr(error.message, "big.npy: File too large") != NULL;
    return is_set && status == PSPEC_ERROR_IO && is_named ? 0 : 1;
}

static void a_disk_that_fills_leaves_no_file(void **state) {
    char path[TEST_PATH_BYTES];
    test_path(*state, "big.npy", path);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        _exit(write_beyond_limit(path));
    }
    int result = 0;
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_true(WIFEXITED(result));
    assert_int_equal(WEXITSTATUS(result), 0);
    assert_int_equal(test_folder_count(*state, false), 0);
}

static void standard_output_stays_open(void **state) {
    char path[TEST_PATH_BYTES];
    fflush(stdout);
    const int kept = dup(STDOUT_FILENO);
    const int target = open(test_path(*state, "out", path), O_WRONLY | O_CREAT, 0600);
    assert_true(kept >= 0 && target >= 0);
    dup2(target, STDOUT_FILENO);
    close(target);
    write_text("-", "first ");
    write_text("-", "second");
    fflush(stdout);
    dup2(kept, STDOUT_FILENO);
    close(kept);
    check_text(path, "first second");
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(appears_at_commit_only),
        IN_FOLDER(discard_leaves_everything_as_it_was),
        IN_FOLDER(several_outputs_do_not_meet),
        IN_FOLDER(permissions_are_those_of_fopen),
        IN_FOLDER(writes_through_links),
        IN_FOLDER(writes_devices_and_pipes_directly),
        IN_FOLDER(what_is_removed_meanwhile_is_new),
        IN_FOLDER(refuses_what_cannot_be_written),
        IN_FOLDER(a_full_device_is_reported),
        IN_FOLDER(a_disk_that_fills_leaves_no_file),
        IN_FOLDER(standard_output_stays_open),
    };
    return cmocka_run_group_tests_name("output", tests, NULL, NULL);
}
