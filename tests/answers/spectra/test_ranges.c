/* Answers to ranges of the realizations of one job are merged to the answer of the job, to the bit;
 * what does not fit, and powers that need another plan, are refused. */
#include "harness_answers.h"

#include <math.h>

enum { LINE_BYTES = ANSWERS_LINE, NUM_PARTS = ANSWERS_PARTS };

#define HOST " --engine host_direct --weights column"

/* Parts of one job, in any order and in any grouping: the job, to the bit, in every cell and array,
 * in its state and in what is told. files: the first of the folder is read. */
static void check_ranges(const test_folder *folder, const char *text,
                         const char *const ranges[NUM_PARTS]) {
    ps_answer parts[NUM_PARTS];
    ps_answer whole = answers_ask(folder, 0, 0, text);
    for (int i = 0; i < NUM_PARTS; i++) {
        char line[LINE_BYTES];
        snprintf(line, sizeof line, "%s --range %s", text, ranges[i]);
        parts[i] = answers_ask(folder, 0, 0, line);
        assert_non_null(ps_table_find_array(parts[i].table, "state_range"));
    }
    ps_answer all = answers_merge(3, &parts[2], &parts[0], &parts[1]);
    ps_answer late = answers_merge(2, &parts[2], &parts[1]);
    ps_answer nested = answers_merge(2, &late, &parts[0]);
    answers_assert_near(whole.table, all.table, 0, text);
    answers_assert_same_arrays(whole.table, all.table);
    answers_assert_same_arrays(whole.table, nested.table);
    ps_answer *const made[] = {&whole, &parts[0], &parts[1], &parts[2], &all, &late, &nested};
    for (size_t i = 0; i < sizeof made / sizeof made[0]; i++) {
        ps_answer_free(made[i]);
    }
}

#define OF_SAMPLER(engine) " --sampler white -n 8 -m 700 --engine " engine
static const char *const three_ranges[] = {"0:128", "128:512", "512:700"};
static const char *const late_ranges[] = {"0:384", "384:640", "640:700"};

static void ranges_are_the_job(void **state) {
    static const char *const file_ranges[] = {"0:128", "128:256", "256:300"};
    check_ranges(NULL, "power -k 2 --full f.npy" OF_SAMPLER("host_direct"), three_ranges);
    check_ranges(NULL, "power -k 2 --sampler jittered" OF_SAMPLER("host_direct"), late_ranges);
    check_ranges(NULL, "power -k 4 --per-ring 2" OF_SAMPLER("host_direct"), three_ranges);
    check_ranges(NULL, "pairs -l 2 --sampler white-sphere -n 4 -m 300 --engine host_direct",
                 file_ranges);
    answers_write_sets(*state, 0, 300, 2, true);
    check_ranges(*state, "power -k 2 --full f.npy" HOST, file_ranges);
    check_ranges(*state, "power -k 2 --normalize integral --fit auto" HOST, file_ranges);
    check_ranges(*state, "power -k 2 --normalize effective" HOST, file_ranges);
    check_ranges(*state, "angular -l 2 --lift hemisphere --hemisphere" HOST, file_ranges);
    check_ranges(*state, "pairs -l 3 --lift sphere" HOST, file_ranges);
}

/* Sets of four points but for two of many, for which the job makes its engine anew. */
static void write_unequal(const test_folder *folder) {
    enum { NUM = 300, FEW = 4, MANY = 3000, EARLY = 60, LATE = 200 };
    char path[TEST_PATH_BYTES];
    uint64_t seed = 8;
    FILE *const file = fopen(test_path(folder, "0.txt", path), "w");
    assert_non_null(file);
    for (int set = 0; set < NUM; set++) {
        fputs(set > 0 ? "#\n" : "", file);
        for (int i = 0; i < (set == EARLY || set == LATE ? MANY : FEW); i++) {
            fprintf(file, "%.9f %.9f 1\n", test_uniform(&seed), test_uniform(&seed));
        }
    }
    assert_int_equal(fclose(file), 0);
}

static void ranges_have_the_engine_of_the_job(void **state) {
    static const char *const ranges[] = {"0:128", "128:256", "256:300"};
    write_unequal(*state);
    answers_open_device();
    check_ranges(*state, "power -k 3 --engine torus_direct --weights column", ranges);
    check_ranges(*state, "angular -l 3 --engine sphere_direct --lift sphere --weights column",
                 ranges);
    check_ranges(*state, "pairs -l 3 --engine pairs_histogram --lift sphere --weights column",
                 ranges);
    answers_close_device();
}

/* In pairs of single and double precision, on a CPU and as GPUs do it, which make the points, too.
 */
static void ranges_of_devices_are_the_job(void **state) {
    (void)state;
    ps_device *const device = answers_open_device();
    for (int is_gpu = 0; is_gpu < 2; is_gpu++) {
        ps_device_set_dedicated_local_memory(device, is_gpu > 0);
        check_ranges(
            NULL, "power -k 2 --precision single --tol 1e-5 --full f.npy" OF_SAMPLER("torus_nufft"),
            three_ranges);
        check_ranges(NULL, "power -k 2 --precision double --full f.npy" OF_SAMPLER("torus_direct"),
                     late_ranges);
        check_ranges(NULL,
                     "power -k 4 -d 1 --precision single --tol 1e-5" OF_SAMPLER("torus_nufft"),
                     late_ranges);
    }
    ps_device_set_dedicated_local_memory(device, false);
    check_ranges(
        NULL, "angular -l 2 --sampler white-sphere -n 8 -m 700 --tol 1e-5 --engine sphere_direct",
        three_ranges);
    check_ranges(NULL,
                 "pairs -l 2 --sampler white-sphere -n 8 -m 700 --tol 1e-5 --engine pairs_direct",
                 late_ranges);
    answers_close_device();
}

/* ---- what is refused ------------------------------------------------------------------------- */

#define RANGED "power --sampler white -n 4 -m 300 -k 1 --engine host_direct"

/* Two ranges, and what is said of them in either order. */
static void check_ranges_refused(const char *a, const char *b, const char *part) {
    ps_answer parts[] = {answers_ask(NULL, 0, 0, a), answers_ask(NULL, 0, 0, b)};
    for (int first = 0; first < 2; first++) {
        const ps_table *const tables[] = {parts[first].table, parts[1 - first].table};
        ps_answer merged;
        ps_error error = {0};
        assert_int_equal(answers_try_merge(&merged, 2, tables, &error), PSPEC_ERROR_INPUT);
        if (strstr(error.message, part) == NULL) {
            fail_msg("\"%s\" is not in \"%s\"", part, error.message);
        }
        ps_answer_free(&merged);
    }
    ps_answer_free(&parts[0]);
    ps_answer_free(&parts[1]);
}

static void ranges_that_do_not_fit_are_refused(void **state) {
    (void)state;
    static const char first[] = RANGED " --range 0:128";
    check_ranges_refused(first, first, "those up to 128 are of");
    check_ranges_refused(first, RANGED " --range 0:256", "they overlap");
    check_ranges_refused(first, RANGED " --range 256:300", "realizations 128:256 are missing");
    check_ranges_refused(first, RANGED, "is of a range of the realizations of a job");
    check_ranges_refused(first, RANGED " --range 128:256 --seed 2", "its seed is");
    check_ranges_refused(first, RANGED " --range 128:256 --tol 1e-5", "its tolerance is");
    check_ranges_refused(first, RANGED " --range 128:256 -n 5", "its command is");
    check_ranges_refused(first, RANGED " --range 128:256 -m 400", "its command is");
}

/* A forged error is that of powers which need another plan; only the whole job is refused. */
static void powers_of_all_ranges_decide(void **state) {
    (void)state;
    enum { PLACE_OF_ERROR = 6 }; /* spectrum_state_places.h */
    ps_answer parts[] = {answers_ask(NULL, 0, 0, RANGED " --range 0:128"),
                         answers_ask(NULL, 0, 0, RANGED " --range 128:256"),
                         answers_ask(NULL, 0, 0, RANGED " --range 256:300")};
    const ps_table *const tables[] = {parts[0].table, parts[1].table, parts[2].table};
    ps_answer merged;
    ps_error error = {0};
    ps_table_find_array(parts[1].table, "state_totals")->data[PLACE_OF_ERROR] = 1e-3;
    assert_int_equal(answers_try_merge(&merged, 2, tables, &error), PSPEC_OK);
    assert_string_equal(ps_table_find_meta(merged.table, "range").text, "0:256 of 300");
    ps_answer_free(&merged);
    assert_int_equal(answers_try_merge(&merged, 3, tables, &error), PSPEC_ERROR_TOLERANCE);
    assert_non_null(strstr(error.message, "0.001, above the tolerance 1e-06"));
    ps_answer_free(&merged);
    for (int i = 0; i < NUM_PARTS; i++) {
        ps_answer_free(&parts[i]);
    }
}

/* Numbers that no range has. */
static void hostile_ranges_are_refused(void **state) {
    (void)state;
    static const char *const names[] = {"state_range", "state_parts"};
    static const size_t numbers_of[] = {8, 2}; /* behind them sums, which may be any */
    static const double numbers[] = {NAN, -128, 0.5, 2, 640, 1e300};
    ps_answer answer = answers_ask(NULL, 0, 0, RANGED " --range 128:300");
    const ps_table *const table = answer.table;
    for (size_t n = 0; n < sizeof names / sizeof names[0]; n++) {
        const ps_npy_array *const array = ps_table_find_array(table, names[n]);
        for (size_t i = 0; i < numbers_of[n]; i++) {
            for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
                const bool is_possible =
                    n == 0 && ((i == 2 && numbers[k] == 640) || (i >= 5 && numbers[k] > 0));
                const double before = array->data[i];
                ps_answer merged;
                ps_error error = {0};
                array->data[i] = numbers[k];
                const pspec_status status = answers_try_merge(&merged, 1, &table, &error);
                if (status != PSPEC_ERROR_INPUT && !is_possible) {
                    fail_msg("%s[%zu] = %g was taken", names[n], i, numbers[k]);
                }
                ps_answer_free(&merged);
                array->data[i] = before;
            }
        }
    }
    ps_answer_free(&answer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(ranges_are_the_job, test_folder_create, test_folder_remove),
        cmocka_unit_test_setup_teardown(ranges_have_the_engine_of_the_job, test_folder_create,
                                        test_folder_remove),
        cmocka_unit_test(ranges_of_devices_are_the_job),
        cmocka_unit_test(ranges_that_do_not_fit_are_refused),
        cmocka_unit_test(powers_of_all_ranges_decide),
        cmocka_unit_test(hostile_ranges_are_refused),
    };
    return cmocka_run_group_tests_name("ranges", tests, NULL, NULL);
}
