/* Answers that are merged: parts are what one job answers for all of their sets, in any grouping
 * and through files; what does not belong together, and state that no answer has, is refused. */
#include "harness_answers.h"

#include <math.h>

enum { LINE_BYTES = ANSWERS_LINE, NUM_PARTS = ANSWERS_PARTS };
static const int sets_of_parts[NUM_PARTS] = {3, 1, 5};

/* Of sums over realizations, and of what is subtracted in the anisotropy. */
static const double rounding = 1e-14;

static void write_parts(const test_folder *folder, unsigned columns, bool varies) {
    for (int part = 0; part < NUM_PARTS; part++) {
        answers_write_sets(folder, part, sets_of_parts[part], columns, varies);
    }
}

/* ---- what is guaranteed ---------------------------------------------------------------------- */

/* The answer of all parts is what their merged answers are, in any grouping; one part alone, also
 * through a file, is itself to the bit. */
static void check_parts(const test_folder *folder, const char *text) {
    char path[TEST_PATH_BYTES];
    ps_answer read = {0};
    ps_answer whole = answers_ask(folder, 0, NUM_PARTS - 1, text);
    ps_answer parts[NUM_PARTS];
    for (int i = 0; i < NUM_PARTS; i++) {
        parts[i] = answers_ask(folder, i, i, text);
    }
    ps_answer all = answers_merge(3, &parts[0], &parts[1], &parts[2]);
    answers_assert_near(whole.table, all.table, rounding, text);
    ps_answer first = answers_merge(2, &parts[0], &parts[1]);
    ps_answer last = answers_merge(2, &parts[1], &parts[2]);
    ps_answer left = answers_merge(2, &first, &parts[2]);
    ps_answer right = answers_merge(2, &parts[0], &last);
    answers_assert_near(all.table, left.table, 0, text);
    answers_assert_near(all.table, right.table, rounding, text);
    answers_assert_same_arrays(all.table, left.table);
    ps_answer one = answers_merge(1, &whole);
    answers_assert_near(whole.table, one.table, 0, text);
    answers_assert_same_arrays(whole.table, one.table);
    assert_ok(ps_table_write(all.table, test_path(folder, "all.npz", path), PS_FORMAT_NPZ, error));
    assert_ok(ps_table_read_npz(&read.table, path, error));
    answers_assert_same_arrays(all.table, read.table);
    ps_answer again = answers_merge(1, &read);
    answers_assert_near(all.table, again.table, 0, text);
    ps_answer *const made[] = {&whole, &parts[0], &parts[1], &parts[2], &all,  &first,
                               &last,  &left,     &right,    &one,      &read, &again};
    for (size_t i = 0; i < sizeof made / sizeof made[0]; i++) {
        ps_answer_free(made[i]);
    }
}

#define HOST " --engine host_direct --weights column"

static void merged_parts_are_the_whole(void **state) {
    const test_folder *const folder = *state;
    char line[LINE_BYTES];
    char path[TEST_PATH_BYTES];
    static const char list[] = "1 0\n0 -3\n268435456 -268435456\n2 7\n";
    assert_true(test_write_file(test_path(folder, "list", path), list, sizeof list - 1));
    snprintf(line, sizeof line, "power --frequencies %s" HOST, path);
    write_parts(folder, 2, true);
    check_parts(folder, "power -k 3" HOST);
    check_parts(folder, "power -k 4 --bins shells --normalize effective --full f.npy" HOST);
    check_parts(folder, "power -k 3 --bins width=2/3 --normalize integral" HOST);
    check_parts(folder, "power -k 9 --per-ring 3" HOST);
    check_parts(folder, "power -k 9 --fit auto" HOST);
    check_parts(folder, "power -k 3 --standard-error 1e-9 --floor 0.01" HOST);
    check_parts(folder, "power -k 3 --box 0,2,0,1" HOST);
    check_parts(folder, "angular -l 3 --lift hemisphere --morph diffuse --hemisphere" HOST);
    check_parts(folder, "pairs -l 4 --lift sphere" HOST);
    check_parts(folder, line);
    write_parts(folder, 2, false);
    check_parts(folder, "power -k 5 --bins relative=1/4" HOST);
    write_parts(folder, 3, true);
    check_parts(folder, "power -k 2 -d 3" HOST);
}

/* On a device frequencies have sums of fewer bits. */
static void devices_have_state(void **state) {
    answers_open_device();
    write_parts(*state, 2, false);
    check_parts(*state, "power -k 3 --engine torus_direct --weights column");
    answers_close_device();
}

/* Several questions in one answer, each by its own frequencies. */
static void all_questions_are_merged(void **state) {
    (void)state;
    static const char line[] = "power --sampler white --sampler jittered -n 16,64 -m 4 -k 4 "
                               "--engine host_direct --seed %s";
    char text[2][LINE_BYTES];
    ps_answer parts[2];
    for (int i = 0; i < 2; i++) {
        snprintf(text[i], sizeof text[i], line, i == 0 ? "1" : "2");
        parts[i] = answers_ask(NULL, 0, 0, text[i]);
    }
    ps_answer all = answers_merge(2, &parts[0], &parts[1]);
    ps_answer back = answers_merge(2, &parts[1], &parts[0]);
    assert_int_equal(ps_table_num_rows(all.table), ps_table_num_rows(parts[0].table));
    assert_string_equal(ps_table_find_meta(all.table, "seed").text, "1; 2");
    assert_string_equal(ps_table_find_meta(all.table, "sampler").text, "white");
    assert_string_equal(ps_table_find_meta(all.table, "merged").text, text[0]);
    assert_int_equal(ps_table_find_meta(all.table, "realizations").integer, 8);
    size_t power = 0;
    assert_true(ps_table_find_column(all.table, "power", &power));
    for (size_t row = 0; row < ps_table_num_rows(all.table); row++) {
        const double mean = (ps_table_cell(parts[0].table, row, power).number +
                             ps_table_cell(parts[1].table, row, power).number) /
                            2;
        assert_true(fabs(ps_table_cell(all.table, row, power).number / mean - 1) < rounding);
        assert_true(answers_are_near(ps_table_cell(all.table, row, power),
                                     ps_table_cell(back.table, row, power), rounding));
    }
    ps_answer_free(&all);
    ps_answer_free(&back);
    ps_answer_free(&parts[0]);
    ps_answer_free(&parts[1]);
}

/* ---- what is refused ------------------------------------------------------------------------- */

#define LISTED "power --sampler white -n 16 -m 2 --engine host_direct"
#define WHITE LISTED " -k 4"
#define SOBOL "power --sampler sobol -n 16 -m 2 -k 4 --engine host_direct"
#define SPHERE " --engine host_direct --sampler white-sphere -n 8 -m 2 -l 4"

static void check_refused(const char *a, const char *b, const char *part) {
    ps_answer parts[] = {answers_ask(NULL, 0, 0, a), answers_ask(NULL, 0, 0, b)};
    const ps_table *const tables[] = {parts[0].table, parts[0].table, parts[1].table};
    ps_answer merged;
    ps_error error = {0};
    assert_int_equal(answers_try_merge(&merged, 3, tables, &error), PSPEC_ERROR_INPUT);
    if (strstr(error.message, part) == NULL) {
        fail_msg("\"%s\" is not in \"%s\"", part, error.message);
    }
    ps_answer_free(&merged);
    ps_answer_free(&parts[0]);
    ps_answer_free(&parts[1]);
}

static void what_differs_is_not_merged(void **state) {
    char path[TEST_PATH_BYTES];
    char other[TEST_PATH_BYTES];
    char lines[2][LINE_BYTES];
    assert_true(test_write_file(test_path(*state, "a", path), "1 2\n3 4\n", 8));
    assert_true(test_write_file(test_path(*state, "b", other), "1 2\n3 5\n", 8));
    snprintf(lines[0], LINE_BYTES, LISTED " --frequencies %s", path);
    snprintf(lines[1], LINE_BYTES, LISTED " --frequencies %s", other);
    check_refused(WHITE " --full f.npy", WHITE " -d 3", "the third has dimension 3 instead of 2");
    check_refused(WHITE, WHITE " -k 5", "the third has max frequency 5 instead of 4");
    check_refused(WHITE " --full f.npy", WHITE, "of rings instead of the frequencies of a box");
    check_refused(WHITE, WHITE " --bins shells", "bins by shells instead of round");
    check_refused(WHITE, WHITE " --normalize effective", "effective instead of power");
    check_refused(WHITE, lines[0], "a list of frequencies instead of");
    check_refused(lines[0], lines[1], "another frequency 2");
    check_refused(WHITE " --bins relative=1/2", WHITE " --bins relative=1/2 -n 9",
                  "bins relative to sets of 9 points instead of 16");
    check_refused(WHITE " --per-ring 2", WHITE " --per-ring 2 --seed 2", "(another seed?)");
    check_refused("angular" SPHERE, "pairs" SPHERE, "an answer of pairs instead of angular");
    check_refused("angular" SPHERE,
                  "angular --engine host_direct --hemisphere --sampler white-hemisphere -n 8 -l 4",
                  "the even degrees of the hemisphere instead of the degrees of the sphere");
    check_refused("angular" SPHERE, "angular" SPHERE " -l 3", "max degree 3 instead of 4");
    check_refused(WHITE, WHITE " --scatter 1,1", "the sums of 0 questions instead of 1");
    check_refused(WHITE " --scatter 1,1", WHITE, "instead of");
    check_refused(WHITE " --sampler jittered", WHITE " --sampler latin-hypercube",
                  "other samplers");
    check_refused(SOBOL, SOBOL, "of a deterministic set");
    check_refused("truncation --brdf diffuse -l 2", "truncation --brdf diffuse -l 2",
                  "is an answer of truncation");
}

/* Numbers that no answer has, in any place of what sizes are taken from; and arrays of another
 * size. */
static void hostile_state_is_refused(void **state) {
    (void)state;
    static const char *const lines[] = {WHITE " --full f.npy", WHITE " --per-ring 2 -k 9",
                                        ("pairs" SPHERE)};
    static const char *const names[] = {"state_question", "state_frequencies", "state_rings"};
    static const double numbers[] = {NAN, -1e9, 0.5, 1e9, 1e300, INFINITY};
    for (size_t l = 0; l < sizeof lines / sizeof lines[0]; l++) {
        ps_answer answer = answers_ask(NULL, 0, 0, lines[l]);
        for (size_t n = 0; n < sizeof names / sizeof names[0]; n++) {
            const ps_npy_array *const array = ps_table_find_array(answer.table, names[n]);
            for (size_t i = 0; array != NULL && i < array->num; i++) {
                for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
                    const double before = array->data[i];
                    ps_answer merged;
                    ps_error error = {0};
                    array->data[i] = numbers[k];
                    const ps_table *const table = answer.table;
                    const pspec_status status = answers_try_merge(&merged, 1, &table, &error);
                    const bool is_stretch = n == 0 && i > 10; /* without a reach */
                    const bool is_ring = /* more than were drawn, or another mean */
                        n == 2 && (i % 2 == 0 ? numbers[k] == 1e9 : numbers[k] > 0);
                    if (status != PSPEC_ERROR_INPUT && !is_stretch && !is_ring) {
                        fail_msg("%s: %s[%zu] = %g was taken", lines[l], names[n], i, numbers[k]);
                    }
                    ps_answer_free(&merged);
                    array->data[i] = before;
                }
            }
        }
        ps_answer_free(&answer);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(merged_parts_are_the_whole, test_folder_create,
                                        test_folder_remove),
        cmocka_unit_test_setup_teardown(devices_have_state, test_folder_create, test_folder_remove),
        cmocka_unit_test(all_questions_are_merged),
        cmocka_unit_test_setup_teardown(what_differs_is_not_merged, test_folder_create,
                                        test_folder_remove),
        cmocka_unit_test(hostile_state_is_refused),
    };
    return cmocka_run_group_tests_name("merge", tests, NULL, NULL);
}
