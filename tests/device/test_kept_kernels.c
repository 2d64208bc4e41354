/* Kernels that PoCL keeps: a file that is cut anywhere, or empty in its last part, is refused. */
#include "harness.h"
#include "test_folder.h"

#include "device/drivers.h"

#include <fcntl.h>
#include <link.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char object_file[] = "AB/CDE/sum/8-1-1/sum.so";
static const char bitcode_file[] = "AB/CDE/program.bc";
static char top[64];
static ps_error last;

/* What a linker ends a shared object with. */
typedef struct object {
    ElfW(Ehdr) head;
    char code[100];
    ElfW(Shdr) sections[2];
} object;

static object make_object(void) {
    object out = {.head = {.e_shoff = offsetof(object, sections), .e_shnum = 2, .e_shstrndx = 1},
                  .sections = {{0}, {.sh_type = SHT_STRTAB}}};
    memcpy(out.head.e_ident, ELFMAG, SELFMAG);
    return out;
}

/* Two blocks, of 1 and of 2 words. */
static const uint32_t bitcode[] = {0xdec04342, 0x35, 1, 7, 0x21, 2, 8, 9};

/* Changed last at that second. */
static void set_time(const char *path, time_t second) {
    const struct timespec times[2] = {{.tv_sec = second}, {.tv_sec = second}};
    assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
}

/* Changed after its folder. */
static void put(const char *name, const void *bytes, size_t num) {
    char path[TEST_PATH_BYTES];
    snprintf(path, sizeof path, "%s/%s", top, name);
    assert_true(test_write_file(path, bytes, num));
    set_time(path, 2);
    *strrchr(path, '/') = '\0';
    set_time(path, 1);
}

static pspec_status check(const char *kernel) {
    glob_t kept;
    assert_ok(ps_kept_list(&kept, error));
    const pspec_status status = ps_kept_check(&kept, kernel, &last);
    globfree(&kept);
    return status;
}

static int make_folders(void **state) {
    static const char *const folders[] = {"AB", "AB/CDE", "AB/CDE/sum", "AB/CDE/sum/8-1-1",
                                          "other"};
    char path[TEST_PATH_BYTES];
    strcpy(top, "/tmp/pointspec-test-XXXXXX");
    assert_non_null(mkdtemp(top));
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", top, folders[i]);
        assert_int_equal(mkdir(path, 0700), 0);
    }
    setenv("POCL_CACHE_DIR", top, 1);
    *state = NULL;
    return 0;
}

static int remove_folders(void **state) {
    char command[TEST_PATH_BYTES];
    (void)state;
    snprintf(command, sizeof command, "rm -r %s", top);
    return system(command);
}

static void whole_files_pass(void **state) {
    (void)state;
    const object whole = make_object();
    assert_ok(check("sum")); /* neither file is there yet: PoCL makes them */
    put(object_file, &whole, sizeof whole);
    put(bitcode_file, bitcode, sizeof bitcode);
    assert_ok(check("sum"));
    assert_ok(check(NULL));
}

static void cut_files_are_refused(void **state) {
    (void)state;
    const object whole = make_object();
    for (size_t num = 0; num < sizeof whole; num++) {
        put(object_file, &whole, num);
        assert_int_equal(check("sum"), PSPEC_ERROR_DEVICE);
    }
    assert_non_null(strstr(last.message, object_file));
    assert_non_null(strstr(last.message, "POCL_CACHE_DIR"));
    assert_int_equal(check(NULL), PSPEC_ERROR_DEVICE);
    assert_ok(check("other")); /* is not what was asked for */
    put(object_file, &whole, sizeof whole);
    for (size_t num = 0; num < sizeof bitcode; num++) {
        put(bitcode_file, bitcode, num);
        const bool is_between_blocks = num == 4 * sizeof bitcode[0]; /* nobody says how many */
        assert_int_equal(check("sum"), is_between_blocks ? PSPEC_OK : PSPEC_ERROR_DEVICE);
    }
    put(bitcode_file, bitcode, sizeof bitcode);
}

/* A disk that lost power gives files their lengths and zeroes. */
static void zeroes_are_refused(void **state) {
    (void)state;
    object lost = make_object();
    memset(lost.sections, 0, sizeof lost.sections);
    put(object_file, &lost, sizeof lost);
    assert_int_equal(check("sum"), PSPEC_ERROR_DEVICE);
    memset(&lost, 0, sizeof lost);
    put(object_file, &lost, sizeof lost);
    assert_int_equal(check("sum"), PSPEC_ERROR_DEVICE);
}

/* What its folder was changed with is as PoCL left it, and is not read; but for what is empty. */
static void old_files_are_let_pass(void **state) {
    (void)state;
    char folder[TEST_PATH_BYTES];
    snprintf(folder, sizeof folder, "%s/AB/CDE/sum/8-1-1", top);
    put(object_file, "", 1);
    set_time(folder, 2);
    assert_ok(check("sum"));
    put(object_file, "", 0);
    set_time(folder, 2);
    assert_int_equal(check("sum"), PSPEC_ERROR_DEVICE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_files_pass),
        cmocka_unit_test(cut_files_are_refused),
        cmocka_unit_test(zeroes_are_refused),
        cmocka_unit_test(old_files_are_let_pass),
    };
    return cmocka_run_group_tests(tests, make_folders, remove_folders);
}
