/* Answers of the library are those of the program, byte for byte: the same options, by names to one
 * and as words to the other, give the same files. */
#include "harness_program.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { TEXT = 4096, EXIT_CHECK = 3 };

static char folder[] = "/tmp/test_answers_XXXXXX";

/* ---- the library ----------------------------------------------------------------------------- */

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

/* Both write the files named, the program first; the table is the option "output", which is
 * files[0]. */
static void compare(const char *kind, const pspec_option *options, size_t num,
                    const char *const *files, size_t num_files) {
    pspec_context *const context = test_public_context();
    char expected[TEXT];
    assert_int_equal(test_ask_program(kind, options, num), 0);
    for (size_t i = 0; i < num_files; i++) {
        snprintf(expected, sizeof expected, "expected_%s", files[i]);
        assert_int_equal(rename(files[i], expected), 0);
    }
    pspec_table *const table = ask_library(context, kind, options, num);
    assert_string_equal(pspec_table_verdict(table), "");
    for (size_t i = 0; i < num_files; i++) {
        snprintf(expected, sizeof expected, "expected_%s", files[i]);
        test_assert_same_file(files[i], expected);
    }
    /* and from the object */
    snprintf(expected, sizeof expected, "again_%s", files[0]);
    assert_int_equal(pspec_table_write(table, context, expected, NULL), PSPEC_OK);
    test_assert_same_file(expected, files[0]);
    pspec_table_destroy(table);
    pspec_context_destroy(context);
}

#define COMPARE(kind, options, ...)                                                                \
    compare(kind, options, COUNT(options), (const char *const[]){__VA_ARGS__},                     \
            sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *))

/* ---- kinds ----------------------------------------------------------------------------------- */

static void power(void **state) {
    (void)state;
    const pspec_option two[] = {{"sampler", "jittered"}, {"sampler", "white"},
                                {"points", "64"},        {"realizations", "3"},
                                {"bins", "shells"},      {"max-frequency", "6"},
                                {"output", "two.csv"}};
    COMPARE("power", two, "two.csv");
    const pspec_option sizes[] = {{"sampler", "jittered"},
                                  {"points", "16..64,100"},
                                  {"realizations", "3"},
                                  {"max-frequency", "6"},
                                  {"output", "sizes.npy"}};
    COMPARE("power", sizes, "sizes.npy", "sizes.json");
    const pspec_option whole[] = {{"sampler", "halton"},  {"points", "50"},
                                  {"full", "full.npy"},   {"tol", "1e-9"},
                                  {"max-frequency", "5"}, {"output", "h.npy"}};
    COMPARE("power", whole, "h.npy", "h.json", "full.npy", "full.standard_error.npy");
    const pspec_option of_files[] = {{"files", "sets.txt"},      {"files", "more.txt"},
                                     {"weights", "weights.txt"}, {"normalize", "effective"},
                                     {"max-frequency", "4"},     {"output", "files.json"}};
    COMPARE("power", of_files, "files.json");
    const pspec_option by_format[] = {{"sampler", "white"},
                                      {"points", "32"},
                                      {"format", "json"},
                                      {"max-frequency", "3"},
                                      {"output", "odd.csv"}};
    pspec_context *const context = test_public_context();
    assert_int_equal(test_ask_program("power", by_format, COUNT(by_format)), 0);
    assert_int_equal(rename("odd.csv", "expected_odd.csv"), 0);
    pspec_table_destroy(ask_library(context, "power", by_format, COUNT(by_format)));
    test_assert_same_file("odd.csv", "expected_odd.csv");
    pspec_context_destroy(context);
}

static void angular(void **state) {
    (void)state;
    const pspec_option many[] = {
        {"sampler", "white-sphere"}, {"points", "40"}, {"realizations", "4"},
        {"max-degree", "7"},         {"seed", "9"},    {"output", "angular.json"}};
    COMPARE("angular", many, "angular.json");
    const pspec_option one[] = {{"sampler", "fibonacci-hemisphere"},
                                {"points", "30"},
                                {"hemisphere", NULL},
                                {"max-degree", "6"},
                                {"coefficients", "c.npy"},
                                {"output", "one.csv"}};
    COMPARE("angular", one, "one.csv", "c.npy");
}

static void pairs(void **state) {
    (void)state;
    const pspec_option options[] = {{"sampler", "white-sphere"},
                                    {"points", "40"},
                                    {"realizations", "2"},
                                    {"max-degree", "5"},
                                    {"output", "pairs.npy"}};
    COMPARE("pairs", options, "pairs.npy", "pairs.json");
}

static void quadrature(void **state) {
    (void)state;
    const pspec_option equal[] = {{"brdf", "diffuse"},
                                  {"sampler", "fibonacci-hemisphere:morph=diffuse"},
                                  {"points", "48"},
                                  {"max-degree", "6"},
                                  {"output", "rule.csv"}};
    COMPARE("quadrature", equal, "rule.csv");
    const pspec_option sizes[] = {{"brdf", "diffuse"},
                                  {"sampler", "white-hemisphere"},
                                  {"sampler", "fibonacci-hemisphere"},
                                  {"points", "16,48"},
                                  {"max-degree", "6"},
                                  {"output", "sizes.json"}};
    COMPARE("quadrature", sizes, "sizes.json");
    const pspec_option optimal[] = {{"brdf", "glossy:n=8"}, {"sampler", "fibonacci-hemisphere"},
                                    {"points", "40"},       {"weights", "optimal"},
                                    {"smoothness", "1.25"}, {"output", "optimal.json"}};
    COMPARE("quadrature", optimal, "optimal.json");
}

static void truncation(void **state) {
    (void)state;
    const pspec_option options[] = {
        {"brdf", "phong:n=8"}, {"max-degree", "5"}, {"output", "truncation.csv"}};
    COMPARE("truncation", options, "truncation.csv");
}

/* The program's exit status 3 is a verdict here, with the same sentence. */
static void compare_verdict(const char *kind, const pspec_option *options, size_t num,
                            const char *file) {
    pspec_context *const context = test_public_context();
    char expected[2 * TEXT];
    size_t num_bytes = 0;
    assert_int_equal(test_ask_program(kind, options, num), EXIT_CHECK);
    snprintf(expected, sizeof expected, "expected_%s", file);
    assert_int_equal(rename(file, expected), 0);
    pspec_table *const table = ask_library(context, kind, options, num);
    test_assert_same_file(file, expected);
    char *const said = test_read_whole("said", &num_bytes);
    snprintf(expected, sizeof expected, "pointspec %s: %s\n", kind, pspec_table_verdict(table));
    assert_string_equal(said, expected);
    free(said);
    pspec_table_destroy(table);
    pspec_context_destroy(context);
}

static void check(void **state) {
    (void)state;
    pspec_context *const context = test_public_context();
    const pspec_option saved[] = {{"sampler", "jittered"},
                                  {"points", "64"},
                                  {"realizations", "8"},
                                  {"max-frequency", "8"},
                                  {"output", "saved.npz"}};
    pspec_table_destroy(ask_library(context, "power", saved, COUNT(saved)));
    const pspec_option same[] = {
        {"against", "saved.npz"}, {"sampler", "jittered"}, {"seed", "2"}, {"output", "same.csv"}};
    COMPARE("check", same, "same.csv");
    const pspec_option other[] = {
        {"against", "saved.npz"}, {"sampler", "white"}, {"seed", "2"}, {"output", "other.csv"}};
    compare_verdict("check", other, COUNT(other), "other.csv");
    pspec_table *const table = ask_library(context, "check", other, COUNT(other));
    assert_string_equal(pspec_table_find_entry(table, "verdict").text, "different");
    pspec_table_destroy(table);
    pspec_context_destroy(context);
}

static void variance(void **state) {
    (void)state;
    const pspec_option many[] = {{"sampler", "jittered"},
                                 {"sampler", "white"},
                                 {"integrand", "disk:radius=0.25"},
                                 {"integrand", "coefficients:file=own.txt"},
                                 {"points", "16..64"},
                                 {"realizations", "20"},
                                 {"shifts", "2"},
                                 {"max-frequency", "8"},
                                 {"output", "variance.csv"}};
    COMPARE("variance", many, "variance.csv");
    const pspec_option of_files[] = {{"files", "sets.txt"},       {"files", "more.txt"},
                                     {"weights", "weights.txt"},  {"integrand", "gaussian"},
                                     {"output", "measured.json"}, {"max-frequency", "6"}};
    COMPARE("variance", of_files, "measured.json");
    const pspec_option round[] = {{"sampler", "fibonacci-hemisphere"},
                                  {"points", "30"},
                                  {"realizations", "3"},
                                  {"integrand", "square"},

                                  {"max-degree", "8"},
                                  {"output", "round.npy"}};
    COMPARE("variance", round, "round.npy", "round.json");
    const pspec_option cut[] = {
        {"sampler", "jittered"}, {"points", "16"}, {"realizations", "4"}, {"integrand", "disk"},
        {"shifts", "0"},         {"tail", "1e-3"}, {"output", "cut.csv"}, {"max-frequency", "4"}};
    compare_verdict("variance", cut, COUNT(cut), "cut.csv");
    const pspec_option crossed[] = {
        {"sampler", "jittered"}, {"integrand", "disk"}, {"bounds", "1,0.5,2..0.5,0.5,2"}};
    pspec_context *const context = test_public_context();
    pspec_table *table = NULL;
    assert_int_equal(pspec_answer(&table, context, "variance", crossed, COUNT(crossed)),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(pspec_context_message(context), "profile below, which comes first,"));
    pspec_context_destroy(context);
}

/* The limit of a context is POINTSPEC_MEMORY of the program. */
static void memory_limits(void **state) {
    (void)state;
    pspec_context *const context = test_public_context();
    const pspec_option options[] = {
        {"sampler", "white"}, {"points", "64"}, {"max-frequency", "4"}, {"output", "limited.csv"}};
    assert_int_equal(setenv("POINTSPEC_MEMORY", "268435456", 1), 0);
    assert_int_equal(test_ask_program("power", options, COUNT(options)), 0);
    assert_int_equal(unsetenv("POINTSPEC_MEMORY"), 0);
    assert_int_equal(rename("limited.csv", "expected_limited.csv"), 0);
    pspec_context_set_memory_limit(context, (uint64_t)1 << 28);
    pspec_table_destroy(ask_library(context, "power", options, COUNT(options)));
    test_assert_same_file("limited.csv", "expected_limited.csv");
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

static void write_text(const char *path, const char *text) {
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static int make_folder(void **state) {
    (void)state;
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    write_points("sets.txt", 1);
    write_points("more.txt", 2);
    FILE *const file = fopen("weights.txt", "w");
    assert_non_null(file);
    for (int j = 0; j < 30; j++) {
        fprintf(file, "%d\n", 1 + j % 4);
    }
    fclose(file);
    write_text("own.txt", "0 0 1 0\n1 2 .5 .25\n-1 -2 .5 -.25\n");
    unsetenv("POINTSPEC_MEMORY");
    return setenv("POINTSPEC_CACHE_DIR", folder, 1);
}

static int remove_folder(void **state) {
    (void)state;
    char command[TEXT];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(power),
        cmocka_unit_test(angular),
        cmocka_unit_test(pairs),
        cmocka_unit_test(quadrature),
        cmocka_unit_test(truncation),
        cmocka_unit_test(check),
        cmocka_unit_test(variance),
        cmocka_unit_test(memory_limits),
        cmocka_unit_test(test_gsl_is_left_alone),
    };
    test_watch_gsl();
    ps_device_close(test_open_device()); /* ends as skipped when there is none */
    return cmocka_run_group_tests_name("answers", tests, make_folder, remove_folder);
}
