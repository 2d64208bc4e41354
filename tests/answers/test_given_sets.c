/* Points that a caller gives instead of files: every kind of answer takes them, and answers as it
 * does of the same points in a file, whose path is their name, to the bit. */
#include "harness_given.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NUM_POINTS = 36 };

static const test_folder *folder;
static ps_device *device;

/* The table as CSV, without the lines of formats, to be freed. */
static char *answer(test_question *asked) {
    char table[TEST_PATH_BYTES];
    const ps_answer_hooks hooks = {.device = device};
    ps_answer out;
    asked->request.output = test_path(folder, "table.csv", table);
    asked->request.is_given[PS_OPTION_OUTPUT] = true;
    assert_ok(ps_answer_produce(&out, asked->kind, &asked->request, &hooks, error));
    ps_answer_free(&out);
    char *const text = test_read_file(table, NULL);
    for (char *line = text; (line = strstr(line, "# input_format: ")) != NULL;) {
        const char *const end = strchr(line, '\n') + 1;
        memmove(line, end, strlen(end) + 1);
    }
    return text;
}

static void compare_files(const char *name, char **former, size_t *former_bytes, bool is_first) {
    char path[TEST_PATH_BYTES];
    size_t num = 0;
    char *const bytes = test_read_file(test_path(folder, name, path), &num);
    if (is_first) {
        *former = bytes;
        *former_bytes = num;
        return;
    }
    assert_int_equal(num, *former_bytes);
    assert_true(num == 0 || memcmp(bytes, *former, num) == 0);
    free(bytes);
    free(*former);
}

/* By files first, which are gone when the caller gives the same. The answer contains this line. */
static void check(const char *format, test_given *sets, test_given *others, const char *file_format,
                  const char *line) {
    char *expected = NULL;
    char *array = NULL;
    size_t array_bytes = 0;
    char path[TEST_PATH_BYTES];
    test_path(folder, "array.npy", path);
    for (int is_given = 0; is_given < 2; is_given++) {
        test_question asked;
        ps_given_set all[] = {test_given_set(others), test_given_set(sets)};
        test_ask(&asked, format, sets->name, others->name, path);
        remove(sets->name);
        remove(others->name);
        remove(path);
        asked.request.reading.given = (ps_given_sets){all, is_given ? 2 : 0};
        if (!is_given) {
            test_given_save(sets, file_format);
            test_given_save(others, file_format);
        }
        char *const found = answer(&asked);
        compare_files("array.npy", &array, &array_bytes, !is_given);
        assert_non_null(strstr(found, line));
        if (is_given && strcmp(found, expected) != 0) {
            fail_msg("%s: \n%s\n%s", format, found, expected);
        }
        free(expected);
        expected = found;
    }
    assert_true(sets->num_calls > 0);
    free(expected);
}

static const char *const of_plane[] = {
    "power files=%1$s max-frequency=4",
    "power files=%1$s files=%2$s max-frequency=5 bins=shells normalize=effective",
    "power files=%1$s max-frequency=12 fit=auto bins=floor",
    "power files=%1$s max-frequency=3 tol=1e-3 engine=torus_nufft",
    "power files=%1$s max-frequency=2 scatter=1,1",
    "power files=%1$s max-frequency=2 full=%3$s",
    "power files=%1$s max-frequency=2 standard-error=0.5 select-sets=3..40",
    "power files=%1$s max-frequency=2 box=0,2,-1,1",
    "power set=one=%1$s set=two=%2$s max-frequency=2 sampler=white points=9",
    "angular files=%1$s lift=hemisphere morph=glossy:n=3 max-degree=4",
    "variance files=%1$s integrand=disk integrand=gaussian max-frequency=4 bounds=auto",
    "variance set=a=%1$s set=b=%2$s integrand=disk max-frequency=4 rank",
    "check homogeneous files=%1$s max-frequency=2",
};

static const char *const of_weights[] = {
    "power files=%1$s weights=column max-frequency=4",
    "power files=%1$s weights=column normalize=integral max-frequency=2 coefficients=%3$s",
    "variance files=%1$s weights=column integrand=disk max-frequency=4",
};

static const char *const of_sphere[] = {
    "angular files=%1$s max-degree=6 fit=auto",
    "pairs files=%1$s files=%2$s max-degree=5",
    "variance files=%1$s domain=sphere integrand=cap max-degree=6",
    "quadrature files=%1$s brdf=diffuse drop-below-horizon max-degree=5",
    "check homogeneous files=%1$s domain=sphere max-degree=3",
};

static void check_all(const char *const *formats, size_t num, test_given *sets, test_given *others,
                      const char *file_format) {
    for (size_t i = 0; i < num; i++) {
        check(formats[i], sets, others, file_format, "# pointspec_version: ");
    }
    test_given_free(sets);
    test_given_free(others);
}
#define CHECK_ALL(formats, sets, others, file_format)                                              \
    check_all(formats, sizeof(formats) / sizeof(formats)[0], sets, others, file_format)

static void every_kind_takes_them(void **state) {
    test_given sets, others;
    folder = *state;
    test_given_make(&sets, folder, "a.npy", 2, false, 48, NUM_POINTS, 0);
    test_given_make(&others, folder, "b.npy", 2, false, 47, NUM_POINTS, 0);
    CHECK_ALL(of_plane, &sets, &others, "npy");
    test_given_make(&sets, folder, "a.npy", 2, true, 9, NUM_POINTS, 0);
    test_given_make(&others, folder, "b.npy", 2, true, 1, NUM_POINTS, 0);
    CHECK_ALL(of_weights, &sets, &others, "npy");
    test_given_make(&sets, folder, "a.npy", 3, false, 48, NUM_POINTS, 0);
    test_given_make(&others, folder, "b.npy", 3, false, 1, NUM_POINTS, 0);
    CHECK_ALL(of_sphere, &sets, &others, "npy");
}

/* Numbers of points need not be the same. */
static void sets_may_differ_in_points(void **state) {
    static const char *const formats[] = {"power files=%1$s max-frequency=3",
                                          "variance files=%1$s integrand=disk max-frequency=3"};
    test_given sets, others;
    folder = *state;
    test_given_make(&sets, folder, "a.txt", 2, false, 5, NUM_POINTS, 9);
    test_given_make(&others, folder, "b.txt", 2, false, 1, NUM_POINTS, 0);
    CHECK_ALL(formats, &sets, &others, "utk-text");
}

/* In a small part of the box they are as one at low frequencies, where powers are large. */
static void a_second_plan_reads_them_again(void **state) {
    test_given sets, others;
    folder = *state;
    test_given_make(&sets, folder, "a.npy", 2, false, 3, 400, 0);
    test_given_make(&others, folder, "b.npy", 2, false, 1, NUM_POINTS, 0);
    check("power files=%1$s box=0,64,0,64 max-frequency=8 tol=1e-5", &sets, &others, "npy",
          "# planned_twice: ");
    test_given_free(&sets);
    test_given_free(&others);
}

/* ---- nonsense -------------------------------------------------------------------------------- */

/* What a kind says of them: the sentence of the caller, and of a set that counts twice. */
static void kinds_say_why(void **state) {
    test_given sets;
    folder = *state;
    test_given_make(&sets, folder, "mine", 2, false, 4, NUM_POINTS, 0);
    for (int i = 0; i < 2; i++) {
        ps_error error = {0};
        ps_answer out;
        test_question asked;
        ps_given_set one = test_given_set(&sets);
        test_ask(&asked, i == 0 ? "power files=%1$s" : "power set=a=%1$s set=b=%1$s", sets.name);
        asked.request.reading.given = (ps_given_sets){&one, 1};
        sets.failing = 3;
        assert_int_equal(
            ps_answer_make(&out, asked.kind, &asked.request, &(ps_answer_hooks){0}, &error),
            i == 0 ? PSPEC_ERROR_CANCELLED : PSPEC_ERROR_INPUT);
        assert_non_null(
            strstr(error.message, i == 0 ? "the caller has gone home" : "are one file"));
        ps_answer_free(&out);
    }
    test_given_free(&sets);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_kind_takes_them, test_folder_create,
                                        test_folder_remove),
        cmocka_unit_test_setup_teardown(sets_may_differ_in_points, test_folder_create,
                                        test_folder_remove),
        cmocka_unit_test_setup_teardown(a_second_plan_reads_them_again, test_folder_create,
                                        test_folder_remove),
        cmocka_unit_test_setup_teardown(kinds_say_why, test_folder_create, test_folder_remove),
    };
    device = test_open_device();
    const int num_failed = cmocka_run_group_tests_name("given_sets", tests, NULL, NULL);
    ps_device_close(device);
    return num_failed;
}
