/* Tables that answers come as, options that they take, and nonsense, which one clear sentence
 * refuses. */
#include "harness_public.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define COUNT(options) (sizeof(options) / sizeof(options)[0])

static char folder[] = "/tmp/test_tables_XXXXXX";

static pspec_table *ask_library(pspec_context *context, const char *kind,
                                const pspec_option *options, size_t num) {
    pspec_table *table = NULL;
    if (pspec_answer(&table, context, kind, options, num) != PSPEC_OK) {
        fail_msg("%s: %s", kind, pspec_context_message(context));
    }
    assert_non_null(table);
    assert_string_equal(pspec_table_name(table), kind);
    return table;
}

/* ---- objects --------------------------------------------------------------------------------- */

static void tables_are_read(void **state) {
    (void)state;
    pspec_context *const context = test_public_context();
    const pspec_option options[] = {{"sampler", "jittered"},
                                    {"points", "64"},
                                    {"max-frequency", "3"},
                                    {"engine", "host_direct"}};
    pspec_table *const table = ask_library(context, "power", options, COUNT(options));
    double powers[3];
    const char *key = NULL;
    assert_int_equal(pspec_table_num_rows(table), COUNT(powers));
    const size_t column = pspec_table_find_column(table, "power");
    assert_string_equal(pspec_table_column_name(table, column), "power");
    pspec_table_numbers(table, column, powers);
    for (size_t row = 0; row < COUNT(powers); row++) {
        const pspec_cell bin = pspec_table_cell(table, row, 0);
        assert_int_equal(bin.kind, PSPEC_CELL_INTEGER);
        assert_int_equal(bin.integer, row + 1);
        assert_true(bin.number == (double)row + 1);
        assert_true(powers[row] == pspec_table_cell(table, row, column).number);
    }
    /* one realization has no standard error */
    const size_t errors = pspec_table_find_column(table, "standard_error");
    assert_int_equal(pspec_table_cell(table, 0, errors).kind, PSPEC_CELL_MISSING);
    assert_true(isnan(pspec_table_cell(table, 0, errors).number));
    assert_string_equal(pspec_table_find_entry(table, "sampler").text, "jittered");
    assert_int_equal(pspec_table_find_entry(table, "points").integer, 64);
    assert_string_equal(pspec_table_entry(table, 0, &key).text, pspec_version());
    assert_string_equal(key, "pointspec_version");
    /* what is not there */
    const size_t none = pspec_table_num_columns(table);
    assert_int_equal(pspec_table_find_column(table, "pwer"), none);
    assert_int_equal(pspec_table_find_column(table, NULL), none);
    assert_null(pspec_table_column_name(table, none));
    assert_int_equal(pspec_table_cell(table, 0, none).kind, PSPEC_CELL_MISSING);
    assert_int_equal(pspec_table_cell(table, COUNT(powers), 0).kind, PSPEC_CELL_MISSING);
    pspec_table_numbers(table, none, powers);
    assert_true(isnan(powers[0]));
    assert_int_equal(pspec_table_find_entry(table, "nobody").kind, PSPEC_CELL_MISSING);
    assert_int_equal(pspec_table_entry(table, 1000, &key).kind, PSPEC_CELL_MISSING);
    assert_null(key);
    pspec_table_destroy(table);
    pspec_context_destroy(context);
}

static bool is_one_of(const char *name, const char *const *names) {
    while (*names != NULL && strcmp(name, *names) != 0) {
        names++;
    }
    return *names != NULL;
}

static void check_facts(const pspec_table *table, size_t row, const char *kind) {
    static const char *const types[] = {"flag", "integer", "integers", "number",
                                        "word", "text",    NULL};
    static const struct {
        const char *option, *column, *text;
    } known[] = {
        {"points", "type", "integers"},
        {"points", "default", "1024"},
        {"memory", "unit", "bytes"},
        {"memory", "default", "POINTSPEC_MEMORY, else what is free, which chooses nothing"},
        {"sampler", "repeated", "yes"},
        {"full", "file", "written"},
        {"frequencies", "file", "read"},
        {"normalize", "type", "word"},
        {"weights", "type", "text"},
        {"full", "kinds", "power"},
        {"homogenize", "type", "flag"},
        {"tol", "default", "1e-6"}};
    const char *const option = pspec_table_cell(table, row, 0).text;
    const pspec_cell type = pspec_table_cell(table, row, pspec_table_find_column(table, "type"));
    const pspec_cell kinds = pspec_table_cell(table, row, pspec_table_find_column(table, "kinds"));
    assert_true(is_one_of(type.text, types));
    assert_non_null(strstr(kinds.text, kind));
    for (size_t i = 0; strcmp(kind, "power") == 0 && i < COUNT(known); i++) {
        const size_t column = pspec_table_find_column(table, known[i].column);
        if (strcmp(option, known[i].option) == 0) {
            assert_string_equal(pspec_table_cell(table, row, column).text, known[i].text);
        }
    }
}

/* Every kind is found, and every option that it says it takes. */
static void options_are_listed(void **state) {
    (void)state;
    static const char *const last_ones[] = {"plot-points", "plot-range", "format", NULL};
    static const char *const have_points[] = {"power", "angular", NULL};
    pspec_context *const context = pspec_context_create();
    size_t num = 0;
    for (; pspec_answer_kind(num) != NULL; num++) {
        pspec_table *table = NULL;
        const char *const kind = pspec_answer_kind(num);
        assert_int_equal(pspec_options_table(&table, context, kind), PSPEC_OK);
        const size_t rows = pspec_table_num_rows(table);
        assert_true(rows > 3);
        for (size_t row = 0; row < rows; row++) {
            check_facts(table, row, kind);
        }
        const size_t last = is_one_of(kind, have_points) ? 0 : strcmp(kind, "check") == 0 ? 2 : 1;
        assert_string_equal(pspec_table_cell(table, rows - 1, 0).text, last_ones[last]);
        pspec_table_destroy(table);
    }
    assert_true(num >= 6);
    assert_null(pspec_answer_kind(num + 1));
    pspec_context_destroy(context);
}

/* ---- nonsense -------------------------------------------------------------------------------- */

static void refuse(const char *kind, const pspec_option *options, size_t num, pspec_status expected,
                   const char *part) {
    pspec_context *const context = test_public_context();
    pspec_table *table = (pspec_table *)context; /* so that NULL is seen to be set */
    const pspec_status status = pspec_answer(&table, context, kind, options, num);
    if (status != expected || strstr(pspec_context_message(context), part) == NULL) {
        fail_msg("%d instead of %d with \"%s\" in: %s", (int)status, (int)expected, part,
                 pspec_context_message(context));
    }
    assert_null(table);
    pspec_context_destroy(context);
}

static void nonsense(void **state) {
    (void)state;
    const pspec_status bad = PSPEC_ERROR_INVALID_ARGUMENT;
    refuse("powre", NULL, 0, bad, "there is no kind of answer \"powre\"; did you mean power?");
    refuse(NULL, NULL, 0, bad, "no name of a kind");
    refuse("power", NULL, 0, bad, "nothing to take a spectrum of");
    refuse("power", NULL, 2, bad, "2 options at the address NULL");
    refuse("power", &(pspec_option){"pionts", "3"}, 1, bad,
           "power takes no option \"pionts\"; did you mean points?");
    refuse("power", &(pspec_option){"quiet", NULL}, 1, bad, "power takes no option \"quiet\"");
    refuse("power", &(pspec_option){NULL, "3"}, 1, bad, "an option has no name");
    refuse("power", &(pspec_option){"points", NULL}, 1, bad, "points needs a value: N");
    refuse("power", &(pspec_option){"points", "many"}, 1, bad, "points");
    refuse("power", &(pspec_option){"points", "64,,128"}, 1, bad,
           "points: \"64,,128\": a number is missing beside a comma");
    const pspec_option of_file[] = {{"files", "sets.txt"}, {"points", "64,128"}};
    refuse("power", of_file, COUNT(of_file), bad,
           "points names 2 numbers of points, and point files have their own");
    refuse("power", &(pspec_option){"homogenize", "perhaps"}, 1, bad, "true or false");
    refuse("power", &(pspec_option){"files", NULL}, 1, bad, "no name of a file");
    refuse("power", &(pspec_option){"files", "-"}, 1, bad, "- is none");
    refuse("power", &(pspec_option){"output", "-"}, 1, bad, "- is none");
    refuse("power", &(pspec_option){"format", "xml"}, 1, bad, "csv, json, npy");
    refuse("check", &(pspec_option){"format", "npy"}, 1, bad, "csv, json");
    const pspec_option absent[] = {{"files", "nowhere.txt"}, {"max-frequency", "3"}};
    refuse("power", absent, COUNT(absent), PSPEC_ERROR_IO, "nowhere.txt");
    const pspec_option both[] = {{"files", "sets.txt"}, {"sampler", "white"}};
    refuse("power", both, COUNT(both), bad, "points come from one of them");
    const pspec_option own[] = {
        {"files", "sets.txt"}, {"max-frequency", "3"}, {"output", "sets.txt"}};
    refuse("power", own, COUNT(own), bad, "the same file");
    pspec_table *table = NULL;
    assert_int_equal(pspec_answer(&table, NULL, "power", NULL, 0), bad);
    pspec_context *const context = pspec_context_create();
    assert_int_equal(pspec_answer(NULL, context, "power", NULL, 0), bad);
    assert_int_equal(pspec_options_table(&table, context, "check_"), bad);
    assert_int_equal(pspec_table_write(NULL, context, "x.csv", NULL), bad);
    pspec_table_destroy(NULL);
    pspec_context_destroy(context);
}

/* ---- callbacks ------------------------------------------------------------------------------- */

static int stop(const pspec_progress_report *report, void *payload) {
    ++*(int *)payload;
    return report->done > 0;
}

static void count_sentence(const char *sentence, void *payload) {
    assert_non_null(sentence);
    ++*(int *)payload;
}

static void callbacks(void **state) {
    (void)state;
    pspec_context *const context = test_public_context();
    pspec_table *table = NULL;
    int num_warnings = 0;
    int num_reports = 0;
    const pspec_option options[] = {{"sampler", "white"},       {"points", "64"},
                                    {"realizations", "40"},     {"max-frequency", "4"},
                                    {"standard-error", "1e-6"}, {"engine", "host_direct"}};
    pspec_context_set_warnings(context, count_sentence, &num_warnings);
    assert_int_equal(pspec_answer(&table, context, "power", options, COUNT(options)), PSPEC_OK);
    assert_int_equal(num_warnings, 1); /* the standard error was not reached */
    pspec_table_destroy(table);
    pspec_context_set_progress(context, stop, &num_reports);
    assert_int_equal(pspec_answer(&table, context, "power", options, COUNT(options)),
                     PSPEC_ERROR_CANCELLED);
    assert_null(table);
    assert_true(num_reports > 0);
    assert_non_null(strstr(pspec_context_message(context), "interrupted after"));
    pspec_context_destroy(context);
}

/* ---- all ------------------------------------------------------------------------------------- */

static void write_points(const char *path, uint64_t seed) {
    FILE *const file = fopen(path, "w");
    uint64_t state = seed;
    assert_non_null(file);
    for (int j = 0; j < 30; j++) {
        const double x = test_uniform(&state);
        fprintf(file, "%.17g %.17g\n", x, test_uniform(&state));
    }
    assert_int_equal(fclose(file), 0);
}

static int make_folder(void **state) {
    (void)state;
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    write_points("sets.txt", 1);
    unsetenv("POINTSPEC_MEMORY");
    return setenv("POINTSPEC_CACHE_DIR", folder, 1);
}

static int remove_folder(void **state) {
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(tables_are_read),
                                       cmocka_unit_test(options_are_listed),
                                       cmocka_unit_test(nonsense), cmocka_unit_test(callbacks)};
    ps_device_close(test_open_device()); /* ends as skipped when there is none */
    return cmocka_run_group_tests_name("tables_public", tests, make_folder, remove_folder);
}
