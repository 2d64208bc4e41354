/* Answers of every kind that has checkpoints, cancelled everywhere and gone on with, are those of
 * jobs that nobody cancelled, to the bit, and leave no file behind. */
#include "spectra/harness_answers.h"

#include <limits.h>

enum { SETS = 9 };

enum { NEVER = INT_MAX };

static int tell(const ps_watch_report *report, void *payload) {
    int *const left = payload; /* calls before it cancels */
    (void)report;
    return (*left)-- == 0;
}

/* Cancelled after so many calls, one more each time; returns how many the last one was given. */
static int go_on(ps_answer *out, const test_folder *files, const char *line, int calls) {
    for (;; calls++) {
        int left = calls;
        const ps_watch watch = {tell, &left};
        ps_error error = {0};
        const pspec_status status = answers_try(out, files, 0, 0, line, &watch, &error);
        if (status == PSPEC_OK) {
            return calls;
        }
        if (status != PSPEC_ERROR_CANCELLED) {
            fail_msg("%s: %s", line, error.message);
        }
        ps_answer_free(out);
    }
}

/* saves: there are checkpoints on the way, for what began anew each time would take as many calls
 * as the whole job. */
static void compare(const test_folder *folder, size_t num_files, bool saves, const char *text) {
    char line[ANSWERS_LINE];
    char path[TEST_PATH_BYTES];
    const test_folder *const files = strstr(text, "--sampler") == NULL ? folder : NULL;
    int left = NEVER;
    const ps_watch watch = {tell, &left};
    ps_answer whole;
    assert_ok(answers_try(&whole, files, 0, 0, text, &watch, error));
    snprintf(line, sizeof line, "%s --checkpoint %s --checkpoint-interval 0", text,
             test_path(folder, "job.npz", path));
    for (int calls = 0; calls < 6; calls += 2) {
        ps_answer pieces;
        const int most = go_on(&pieces, files, line, calls);
        assert_true(!saves || most + 1 < NEVER - left);
        answers_assert_near(whole.table, pieces.table, 0, text);
        answers_assert_same_arrays(whole.table, pieces.table);
        ps_answer_free(&pieces);
        assert_int_equal(test_folder_count(folder, false), num_files);
    }
    ps_answer_free(&whole);
}

static const char *const of_samplers[] = {
    "variance --integrand disk --integrand gaussian --sampler jittered -n 4,9 -m 700 --shifts 3",
    "variance --integrand cap --sampler white-sphere -n 12 -m 700 -l 8 --shifts 2",
    "variance --integrand disk --sampler grid -n 16 -m 40 --shifts 40",
    "shade --integrand map:width=16 --brdf glossy:n=5 --sampler white-hemisphere -n 12,20 -m 9 "
    "--shifts 20 -l 8",
    "interpolation --integrand map:width=16 --sampler white-sphere -n 12,20 -m 6 --smoothness "
    "1.5,1.7",
};
/* All in one batch. */
static const char *const of_pairs[] = {
    "shade --integrand map:width=16 --brdf glossy:n=5 --sampler white-hemisphere -n 12 -m 5 "
    "--engine pairs_direct -l 8 --shifts 2",
    "quadrature --brdf diffuse --weights optimal --sampler white-hemisphere -n 12 -l 6 -m 3",
};
static const char *const of_files[] = {
    "variance --integrand disk --shifts 4 -k 4 --weights column",
    "interpolation --integrand map:width=16 --lift sphere --columns xyw",
};

static void samplers_go_on(void **state) {
    for (size_t i = 0; i < sizeof of_samplers / sizeof of_samplers[0]; i++) {
        compare(*state, 0, true, of_samplers[i]);
    }
    for (size_t i = 0; i < sizeof of_pairs / sizeof of_pairs[0]; i++) {
        compare(*state, 0, false, of_pairs[i]);
    }
}

static void files_go_on(void **state) {
    answers_write_sets(*state, 0, SETS, 2, true);
    for (size_t i = 0; i < sizeof of_files / sizeof of_files[0]; i++) {
        compare(*state, 1, false, of_files[i]);
    }
    test_folder_count(*state, true);
}

/* With other files that stay. */
static void compare_with(const test_folder *folder, const char *format, const char *path) {
    char text[ANSWERS_LINE];
    snprintf(text, sizeof text, format, path);
    compare(folder, test_folder_count(folder, false), true, text);
    test_folder_count(folder, true);
}

static void meshes_go_on(void **state) {
    char path[TEST_PATH_BYTES];
    FILE *const file = fopen(test_path(*state, "quad.obj", path), "w");
    assert_non_null(file);
    fputs("v -1 -1 -2\nv 1 -1 -2\nv 1 1 -2\nv -1 1 -2\nf 1 2 3 4\n", file);
    assert_int_equal(fclose(file), 0);
    compare_with(*state,
                 "occlusion --mesh %s --image 8x8 --reference 64 --sampler white-sphere "
                 "--sampler white-hemisphere -n 5,8 -m 3",
                 path);
}

static void checks_go_on(void **state) {
    char path[TEST_PATH_BYTES];
    ps_answer saved = answers_ask(NULL, 0, 0, "power --sampler jittered -n 16 -m 40 -k 4");
    assert_ok(
        ps_table_write(saved.table, test_path(*state, "saved.npz", path), PS_FORMAT_NPZ, error));
    ps_answer_free(&saved);
    compare_with(*state, "check --against %s --sampler jittered -m 20000", path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samplers_go_on),
        cmocka_unit_test(files_go_on),
        cmocka_unit_test(meshes_go_on),
        cmocka_unit_test(checks_go_on),
    };
    answers_open_device();
    const int failed =
        cmocka_run_group_tests_name("kinds_go_on", tests, test_folder_create, test_folder_remove);
    answers_close_device();
    return failed;
}
