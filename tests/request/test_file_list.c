/* Names of files with commas and patterns, and the sources of a request that they make. */
#include "test_folder.h"

#include "request/file_list.h"
#include "request/option_text.h"

#include <sys/stat.h>

// clang-format off
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>
// clang-format on

static void write_files(const test_folder *folder) {
    static const char *const names[] = {"b2.txt",   "b1.txt", "b10.txt",
                                        "a[1].txt", "a1.txt", "c.dat"};
    char path[TEST_PATH_BYTES];
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        assert_true(test_write_file(test_path(folder, names[i], path), "0.5 0.5\n", 8));
    }
}

/* text: with FOLDER/ before every item. */
static pspec_status read_list(ps_file_list *out, const test_folder *folder, const char *text,
                              ps_error *error) {
    char items[8 * TEST_PATH_BYTES] = "";
    char copy[TEST_PATH_BYTES];
    snprintf(copy, sizeof copy, "%s", text);
    for (char *item = strtok(copy, ","); item != NULL; item = strtok(NULL, ",")) {
        const size_t length = strlen(items);
        snprintf(items + length, sizeof items - length, "%s%s/%s", length > 0 ? "," : "",
                 folder->path, item);
    }
    return ps_file_list_read(out, "--set a", items, error);
}

static void must_be(const test_folder *folder, const char *text, const char *expected) {
    char found[TEST_PATH_BYTES] = "";
    ps_file_list list;
    ps_error error;
    assert_int_equal(read_list(&list, folder, text, &error), PSPEC_OK);
    for (size_t i = 0; i < list.num; i++) {
        const size_t length = strlen(found);
        snprintf(found + length, sizeof found - length, "%s%s", length > 0 ? " " : "",
                 strrchr(list.paths[i], '/') + 1);
    }
    assert_string_equal(found, expected);
    ps_file_list_free(&list);
    assert_int_equal(list.num, 0);
}

static void names_and_patterns_make_a_list(void **state) {
    const test_folder *const folder = *state;
    write_files(folder);
    must_be(folder, "b2.txt", "b2.txt");
    must_be(folder, "b2.txt,c.dat,b1.txt", "b2.txt c.dat b1.txt");
    must_be(folder, "b*.txt", "b1.txt b10.txt b2.txt");
    must_be(folder, "c.dat,b?.txt", "c.dat b1.txt b2.txt");
    must_be(folder, "b[12].txt", "b1.txt b2.txt");
    must_be(folder, "a\\[1].txt", "a[1].txt");
    /* a file of that very name beside one that it matches, and one that is not there: who opens it
     * says so */
    must_be(folder, "a[1].txt", "a[1].txt");
    must_be(folder, "none.txt", "none.txt");
}

static void what_is_no_list_is_refused(void **state) {
    const test_folder *const folder = *state;
    ps_file_list list;
    ps_error error;
    write_files(folder);
    assert_int_equal(read_list(&list, folder, "c.dat,z*.txt", &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "--set a: no file matches \""));
    ps_file_list_free(&list);
    static const char *const bad[] = {"a,,b", "", "a,"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(ps_file_list_read(&list, "--set a", bad[i], &error),
                         PSPEC_ERROR_INVALID_ARGUMENT);
        ps_file_list_free(&list);
    }
}

/* Letters of a folder are no pattern. */
static void folders_stand_for_themselves(void **state) {
    const test_folder *const folder = *state;
    char path[TEST_PATH_BYTES];
    char inside[TEST_PATH_BYTES];
    ps_file_list list = {0};
    ps_error error;
    assert_int_equal(mkdir(test_path(folder, "d[1]", path), 0700), 0);
    snprintf(inside, sizeof inside, "%.200s/a1.txt", path);
    assert_true(test_write_file(inside, "0.5 0.5\n", 8));
    snprintf(path, sizeof path, "%.200s/d[1]/", folder->path);
    assert_int_equal(ps_file_list_add(&list, "sets", path, "a*.txt", &error), PSPEC_OK);
    assert_int_equal(ps_file_list_add(&list, "sets", path, "none.txt", &error), PSPEC_OK);
    assert_int_equal(list.num, 2);
    assert_string_equal(list.paths[0], inside);
    assert_non_null(strstr(list.paths[1], "/d[1]/none.txt"));
    ps_file_list_free(&list);
    remove(inside);
    path[strlen(path) - 1] = '\0';
    remove(path);
}

/* ---- sources ------------------------------------------------------------------------------- */

static pspec_status say(ps_request *request, ps_option_id id, const char *text, ps_error *error) {
    return ps_option_apply(request, id, ps_options[id].metavar, text, error);
}

static void sources_are_in_the_order_in_which_they_were_said(void **state) {
    (void)state;
    ps_request first = ps_request_default;
    ps_error error;
    assert_false(ps_request_has_files(&first) || ps_request_has_samplers(&first));
    assert_null(ps_request_name(&first, 0));
    assert_int_equal(say(&first, PS_OPTION_SET, "mine=a=b.txt,c*.txt", &error), PSPEC_OK);
    assert_true(ps_request_has_files(&first) && !ps_request_has_samplers(&first));
    assert_int_equal(say(&first, PS_OPTION_SAMPLER, "white", &error), PSPEC_OK);
    assert_int_equal(say(&first, PS_OPTION_SAMPLER, "white", &error), PSPEC_OK);
    const ps_request copy = first; /* names are the request's own */
    first = ps_request_default;
    assert_int_equal(ps_request_num_questions(&copy), 3);
    assert_string_equal(ps_request_name(&copy, 0), "mine");
    assert_string_equal(copy.sources[0].files, "a=b.txt,c*.txt");
    assert_null(ps_request_sampler(&copy, 0));
    assert_string_equal(ps_request_name(&copy, 1), "white");
    assert_string_equal(ps_request_sampler(&copy, 2), "white");
    assert_true(ps_request_has_files(&copy) && ps_request_has_samplers(&copy));
}

static void names_tell_sources_apart(void **state) {
    (void)state;
    ps_request request = ps_request_default;
    ps_error error;
    static const char *const bad[] = {
        "a.txt", "=a.txt",
        "a=", "0123456789012345678901234567890123456789012345678901234567890123=a.txt"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(say(&request, PS_OPTION_SET, bad[i], &error),
                         PSPEC_ERROR_INVALID_ARGUMENT);
    }
    assert_int_equal(request.num_sources, 0);
    assert_int_equal(say(&request, PS_OPTION_SET,
                         "012345678901234567890123456789012345678901234567890123456789012=a.txt",
                         &error),
                     PSPEC_OK);
    assert_int_equal(say(&request, PS_OPTION_SET, "a=a.txt", &error), PSPEC_OK);
    assert_int_equal(say(&request, PS_OPTION_SET, "a=b.txt", &error), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(say(&request, PS_OPTION_SAMPLER, "a", &error), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(request.num_sources, 2);
    while (request.num_sources < PS_MAX_SAMPLERS) {
        assert_int_equal(say(&request, PS_OPTION_SAMPLER, "white", &error), PSPEC_OK);
    }
    assert_int_equal(say(&request, PS_OPTION_SET, "b=b.txt", &error), PSPEC_ERROR_INVALID_ARGUMENT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(names_and_patterns_make_a_list, test_folder_create,
                                        test_folder_remove),
        cmocka_unit_test_setup_teardown(what_is_no_list_is_refused, test_folder_create,
                                        test_folder_remove),
        cmocka_unit_test_setup_teardown(folders_stand_for_themselves, test_folder_create,
                                        test_folder_remove),
        cmocka_unit_test(sources_are_in_the_order_in_which_they_were_said),
        cmocka_unit_test(names_tell_sources_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
