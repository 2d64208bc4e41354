/* Saved spectra: what a table must have to be one, and bins that the other side has not. */
#include "answers/check/check_sides.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* In place of the entry of its key, or of the cell of that row and column. */
typedef struct change {
    const char *key;
    ps_cell value;
    int row; /* from 1 on; 0: an entry */
    const char *sentence;
} change;

static const char *const columns[] = {"bin", "frequency", "count", "power", "standard_error"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0], NUM_ROWS = 3 };

/* Three rings, as `power` writes them, but for what is changed, and one that is left out. */
static ps_table *make_table(const char *command, const char *const *names, const change *changed,
                            int left_out) {
    const ps_meta entries[] = {{"realizations", PS_INTEGER(9)},
                               {"points", PS_INTEGER(8)},
                               {"normalization", PS_TEXT("power: S")},
                               {"dimension", PS_INTEGER(2)},
                               {"max_frequency", PS_INTEGER(3)},
                               {"predicted_error", PS_NUMBER(1e-6)},
                               {"seed", PS_INTEGER(4)},
                               {"points_smallest", PS_MISSING},
                               {"points_largest", PS_MISSING},
                               {"per_ring", PS_MISSING},
                               {"bins", PS_MISSING}};
    ps_table *table = NULL;
    ps_error error = {0};
    assert_int_equal(ps_table_create(&table, command, names, NUM_COLUMNS, &error), PSPEC_OK);
    for (size_t i = 0; i < sizeof entries / sizeof entries[0]; i++) {
        const bool is_changed = changed->row == 0 && strcmp(entries[i].key, changed->key) == 0;
        assert_int_equal(ps_table_add_meta(table, entries[i].key,
                                           is_changed ? changed->value : entries[i].value, &error),
                         PSPEC_OK);
    }
    for (int row = 1; row <= NUM_ROWS; row++) {
        ps_cell cells[] = {PS_INTEGER(row), PS_NUMBER(row + 0.125), PS_INTEGER(8), PS_NUMBER(0.5),
                           PS_NUMBER(0.25)};
        for (size_t i = 0; i < NUM_COLUMNS; i++) {
            if (changed->row == row && strcmp(changed->key, columns[i]) == 0) {
                cells[i] = changed->value;
            }
        }
        if (row != left_out) {
            assert_int_equal(ps_table_add_row(table, cells, &error), PSPEC_OK);
        }
    }
    return table;
}

static const change nothing = {"", {0}, 0, ""};

static void check_taken(ps_table *table, const char *sentence) {
    ps_saved_spectrum saved = {0};
    ps_error error = {0};
    const pspec_status status = ps_saved_table_take(&saved, table, "saved.npz", &error);
    assert_int_equal(status, sentence == NULL ? PSPEC_OK : PSPEC_ERROR_INPUT);
    if (sentence != NULL && strstr(error.message, sentence) == NULL) {
        fail_msg("not \"%s\": %s", sentence, error.message);
    }
    ps_saved_spectrum_free(&saved);
    ps_table_destroy(table);
}

static void every_value_is_looked_at(void **state) {
    (void)state;
    static const char range[] = "not in their range";
    const change changes[] = {
        {"realizations", PS_INTEGER(0), 0, "\"realizations\" of its header is not a whole number"},
        {"points", PS_NUMBER(64.5), 0, "\"points\""},
        {"points_smallest", PS_INTEGER(7), 0, "\"points_largest\""},
        {"points_smallest", PS_NUMBER(0.5), 0, "\"points_smallest\""},
        {"dimension", PS_INTEGER(7), 0, "\"dimension\""},
        {"max_frequency", PS_MISSING, 0, "\"max_frequency\""},
        {"normalization", PS_TEXT("pairs: R"), 0, "none of power, effective, integral"},
        {"bins", PS_TEXT("squares"), 0, "\"bins\""},
        {"predicted_error", PS_NUMBER(INFINITY), 0, "\"predicted_error\""},
        {"predicted_error", PS_NUMBER(-1), 0, "\"predicted_error\""},
        {"bin", PS_NUMBER(3.5), 3, "row 3 is not"},
        {"bin", PS_INTEGER(2), 3, "row 3 is not"},
        {"frequency", PS_MISSING, 1, "row 1 is not"},
        {"count", PS_INTEGER(0), 1, "row 1 is not"},
        {"power", PS_NUMBER(-0.5), 3, "row 3 is not"},
        {"power", PS_TEXT("0.5"), 3, "row 3 is not"},
        {"standard_error", PS_NUMBER(1e200), 1, "row 1 is not"},
        {"standard_error", PS_MISSING, 2, "row 2 is not"}};
    const struct {
        int64_t least, most;
        double mean;
    } ranges[] = {{9, 10, 8}, {5, 7, 8}, {9, 7, 8}, {7, 9, NAN}};
    check_taken(make_table("power", columns, &nothing, 0), NULL);
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        check_taken(make_table("power", columns, &changes[i], 0), changes[i].sentence);
    }
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        const change mean = {"points", PS_NUMBER(ranges[i].mean), 0, NULL};
        ps_table *const table = make_table("power", columns, &mean, 0);
        ps_error error = {0};
        assert_int_equal(
            ps_table_set_meta(table, "points_smallest", PS_INTEGER(ranges[i].least), &error),
            PSPEC_OK);
        assert_int_equal(
            ps_table_set_meta(table, "points_largest", PS_INTEGER(ranges[i].most), &error),
            PSPEC_OK);
        check_taken(table, range);
    }
}

/* The subset is drawn by a seed that is known. */
static void a_subset_needs_its_seed(void **state) {
    (void)state;
    ps_error error = {0};
    const change subset = {"per_ring", PS_INTEGER(2), 0, NULL};
    check_taken(make_table("power", columns, &subset, 0), NULL);
    ps_table *const table = make_table("power", columns, &subset, 0);
    assert_int_equal(ps_table_set_meta(table, "seed", PS_INTEGER(-1), &error), PSPEC_OK);
    check_taken(table, "random subset");
}

static void other_tables_are_refused(void **state) {
    (void)state;
    static const char *const several[] = {"sampler", "frequency", "count", "power",
                                          "standard_error"};
    static const char *const list[] = {"k1", "frequency", "count", "power", "standard_error"};
    static const char *const without[] = {"bin", "norm", "count", "power", "standard_error"};
    check_taken(make_table("pairs", columns, &nothing, 0), "table of another command");
    check_taken(make_table("angular", columns, &nothing, 0), "\"max_degree\"");
    check_taken(make_table("power", several, &nothing, 0), "several samplers");
    check_taken(make_table("power", list, &nothing, 0), "list of frequencies");
    check_taken(make_table("power", without, &nothing, 0), "columns");
}

/* path NULL: the other side was measured. */
static void check_compared(const change *changed, int left_out, const char *path,
                           const char *sentence) {
    ps_saved_spectrum sides[2] = {{0}};
    ps_comparison rows[NUM_ROWS];
    ps_error error = {0};
    ps_table *const tables[] = {make_table("power", columns, changed, left_out),
                                make_table("power", columns, &nothing, 0)};
    for (size_t i = 0; i < 2; i++) {
        assert_int_equal(ps_saved_table_take(&sides[i], tables[i], "saved.npz", &error), PSPEC_OK);
        ps_table_destroy(tables[i]);
    }
    sides[0].modes = sides[1].modes = 24;
    const ps_check_side saved = {&sides[0], "saved.npz"};
    const ps_check_side other = {&sides[1], path};
    assert_int_equal(ps_check_compare(rows, &saved, &other, 0.001, &error),
                     sentence == NULL ? PSPEC_OK : PSPEC_ERROR_INPUT);
    if (sentence != NULL && strstr(error.message, sentence) == NULL) {
        fail_msg("not \"%s\": %s", sentence, error.message);
    }
    ps_saved_spectrum_free(&sides[0]);
    ps_saved_spectrum_free(&sides[1]);
}

static void both_sides_have_the_same_bins(void **state) {
    (void)state;
    const change frequency = {"frequency", PS_NUMBER(2.5), 2, NULL};
    const change count = {"count", PS_INTEGER(7), 1, NULL};
    const change key = {"bin", PS_INTEGER(4), 3, NULL};
    check_compared(&nothing, 0, NULL, NULL);
    check_compared(&frequency, 0, NULL,
                   "ring 2 has the frequency 2.5, which cannot be: it is 2.125");
    check_compared(&count, 0, NULL,
                   "ring 1 has the count 7, which cannot be: there are 8 frequencies");
    check_compared(&key, 0, NULL, "lacks ring 3");
    check_compared(&nothing, 2, NULL, "lacks ring 2");
    check_compared(&nothing, 3, NULL, "lacks ring 3");
    check_compared(&nothing, 2, "again.npz",
                   "\"again.npz\" and \"saved.npz\" do not have the same rings: the first that "
                   "differs is number 2, of 3 and 2");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_value_is_looked_at),
        cmocka_unit_test(a_subset_needs_its_seed),
        cmocka_unit_test(other_tables_are_refused),
        cmocka_unit_test(both_sides_have_the_same_bins),
    };
    return cmocka_run_group_tests_name("saved_spectrum", tests, NULL, NULL);
}
