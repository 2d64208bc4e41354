/* Tables in NPZ files and back, reading them cell by cell, and files that are no table. */
#include "fields/table.h"
#include "test_folder.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { NUM_COLUMNS = 3, NUM_ROWS = 9, NUM_META = 7 };

static const double values[NUM_ROWS] = {0.1,      -0.0,     DBL_MAX,   4.9e-324, 1.0 / 3,
                                        -DBL_MIN, INFINITY, -INFINITY, 0};
static const int64_t integers[NUM_ROWS] = {0,  INT64_MIN, INT64_MAX, -1,  1,
                                           42, 1LL << 53, 256,       -256};

/* From names that are gone when the table is used. */
static ps_table *make_table(void) {
    char names[NUM_COLUMNS][8] = {"sampler", "bin", "power"};
    const char *columns[NUM_COLUMNS] = {names[0], names[1], names[2]};
    ps_table *table = NULL;
    ps_error error = {0};
    assert_int_equal(ps_table_create(&table, "power", columns, NUM_COLUMNS, &error), PSPEC_OK);
    memset(names, 'x', sizeof names);
    const struct {
        const char *key;
        ps_cell value;
    } meta[NUM_META] = {{"seed", PS_INTEGER(INT64_MAX)},
                        {"skipped", PS_TEXT("first")},
                        {"tolerance", PS_NUMBER(1e-6)},
                        {"skipped", PS_TEXT("second")},
                        {"empty", PS_MISSING},
                        {"", PS_TEXT("")},
                        {"skipped", PS_TEXT("a \"b\"\n\xff\x01")}};
    for (size_t i = 0; i < NUM_META; i++) {
        assert_int_equal(ps_table_add_meta(table, meta[i].key, meta[i].value, &error), PSPEC_OK);
    }
    for (size_t i = 0; i < NUM_ROWS; i++) {
        const ps_cell row[NUM_COLUMNS] = {i % 3 == 0 ? PS_TEXT("white:x=1,2") : PS_MISSING,
                                          PS_INTEGER(integers[i]), PS_NUMBER(values[i])};
        assert_int_equal(ps_table_add_row(table, row, &error), PSPEC_OK);
    }
    for (int is_state = 0; is_state < 2; is_state++) {
        const size_t shape[] = {2, NUM_ROWS};
        ps_npy_array array;
        assert_int_equal(ps_npy_make_array(&array, 2 - (unsigned)is_state, shape + is_state,
                                           is_state == 0, &error),
                         PSPEC_OK);
        memcpy(array.data, values, sizeof values);
        assert_int_equal(
            ps_table_add_array(table, is_state != 0 ? "sums" : "full", is_state, &array, &error),
            PSPEC_OK);
    }
    return table;
}

static void check_cell(ps_cell a, ps_cell b) {
    assert_int_equal(a.kind, b.kind);
    assert_memory_equal(&a.number, &b.number, sizeof a.number);
    assert_int_equal(a.integer, b.integer);
    assert_int_equal(a.text == NULL, b.text == NULL);
    if (a.text != NULL) {
        assert_string_equal(a.text, b.text);
        assert_ptr_not_equal(a.text, b.text);
    }
}

static void check_arrays(const ps_table *a, const ps_table *b) {
    assert_int_equal(ps_table_num_arrays(a), ps_table_num_arrays(b));
    for (size_t i = 0; i < ps_table_num_arrays(a); i++) {
        const char *names[2] = {NULL};
        bool are_states[2];
        const ps_npy_array *const x = ps_table_array(a, i, &names[0], &are_states[0]);
        const ps_npy_array *const y = ps_table_array(b, i, &names[1], &are_states[1]);
        assert_string_equal(names[0], names[1]);
        assert_int_equal(are_states[0], are_states[1]);
        assert_int_equal(x->rank, y->rank);
        assert_int_equal(x->is_complex, y->is_complex);
        assert_memory_equal(x->shape, y->shape, x->rank * sizeof *x->shape);
        assert_memory_equal(x->data, y->data, ps_npy_num_doubles(x) * sizeof *x->data);
        assert_ptr_equal(ps_table_find_array(b, names[0]), y);
    }
    assert_null(ps_table_find_array(a, "power"));
}

static void check_equal(const ps_table *a, const ps_table *b) {
    assert_string_equal(ps_table_command(a), ps_table_command(b));
    assert_int_equal(ps_table_num_columns(a), ps_table_num_columns(b));
    assert_int_equal(ps_table_num_meta(a), ps_table_num_meta(b));
    assert_int_equal(ps_table_num_rows(a), ps_table_num_rows(b));
    for (size_t i = 0; i < ps_table_num_columns(a); i++) {
        assert_string_equal(ps_table_column_name(a, i), ps_table_column_name(b, i));
    }
    for (size_t i = 0; i < ps_table_num_meta(a); i++) {
        const char *keys[2] = {NULL};
        check_cell(ps_table_meta(a, i, &keys[0]), ps_table_meta(b, i, &keys[1]));
        assert_string_equal(keys[0], keys[1]);
    }
    for (size_t row = 0; row < ps_table_num_rows(a); row++) {
        for (size_t i = 0; i < ps_table_num_columns(a); i++) {
            check_cell(ps_table_cell(a, row, i), ps_table_cell(b, row, i));
        }
    }
    check_arrays(a, b);
}

static void is_read_cell_by_cell(void **state) {
    (void)state;
    ps_table *const table = make_table();
    size_t column = 7;
    const char *key = NULL;
    assert_string_equal(ps_table_command(table), "power");
    assert_int_equal(ps_table_num_columns(table), NUM_COLUMNS);
    assert_int_equal(ps_table_num_rows(table), NUM_ROWS);
    assert_int_equal(ps_table_num_meta(table), NUM_META);
    assert_string_equal(ps_table_column_name(table, 2), "power");
    assert_true(ps_table_find_column(table, "bin", &column));
    assert_int_equal(column, 1);
    assert_false(ps_table_find_column(table, "bins", &column));
    assert_int_equal(ps_table_cell(table, 2, 1).integer, INT64_MAX);
    assert_true(ps_table_cell(table, 2, 2).number == DBL_MAX);
    assert_string_equal(ps_table_cell(table, 3, 0).text, "white:x=1,2");
    assert_int_equal(ps_table_cell(table, 4, 0).kind, PS_CELL_MISSING);
    assert_string_equal(ps_table_meta(table, 3, &key).text, "second");
    assert_string_equal(key, "skipped");
    ps_table_destroy(table);
}

/* Written and read; the table that came back makes the same bytes. */
static ps_table *write_and_read(void **state, const ps_table *table) {
    char path[TEST_PATH_BYTES];
    ps_table *again = NULL;
    ps_error error = {0};
    size_t num = 0;
    size_t num_again = 0;
    test_path(*state, "table.npz", path);
    assert_int_equal(ps_table_write(table, path, PS_FORMAT_NPZ, &error), PSPEC_OK);
    char *const bytes = test_read_file(path, &num);
    if (ps_table_read_npz(&again, path, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
    assert_int_equal(ps_table_write(again, path, PS_FORMAT_NPZ, &error), PSPEC_OK);
    char *const bytes_again = test_read_file(path, &num_again);
    assert_int_equal(num, num_again);
    assert_memory_equal(bytes, bytes_again, num);
    free(bytes);
    free(bytes_again);
    return again;
}

/* The table that came back takes more, like any other. */
static void comes_back_to_the_bit(void **state) {
    ps_table *const table = make_table();
    ps_error error = {0};
    ps_table_set_repeated(table, "skipped");
    ps_table_set_blocks(table);
    ps_table *const again = write_and_read(state, table);
    check_equal(table, again);
    const ps_cell row[NUM_COLUMNS] = {PS_TEXT("new"), PS_INTEGER(1), PS_NUMBER(NAN)};
    assert_int_equal(ps_table_add_row(again, row, &error), PSPEC_OK);
    assert_int_equal(ps_table_add_row(table, row, &error), PSPEC_OK);
    assert_int_equal(ps_table_add_meta(again, "more", PS_TEXT("text"), &error), PSPEC_OK);
    assert_int_equal(ps_table_add_meta(table, "more", PS_TEXT("text"), &error), PSPEC_OK);
    check_equal(table, again);
    ps_table_destroy(again);
    ps_table_destroy(table);
}

/* Columns of one kind of cells, and of two: integers that no double has beside what is missing;
 * numbers, and all lengths of UTF-8 and bytes that are none, beside texts. */
static void mixed_columns_come_back(void **state) {
    const ps_cell cells[] = {PS_INTEGER(3),
                             PS_MISSING,
                             PS_NUMBER(0.1),
                             PS_INTEGER(INT64_MAX),
                             PS_NUMBER(-INFINITY),
                             PS_NUMBER(-0.0),
                             PS_TEXT(""),
                             PS_TEXT("1"),
                             PS_TEXT("a\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\xff\x80\xed\xb2\x80")};
    enum { NUM = sizeof cells / sizeof cells[0], ALL = NUM * NUM };
    char names[ALL][4];
    const char *columns[ALL];
    ps_cell rows[2][ALL];
    ps_table *table = NULL;
    ps_error error = {0};
    for (unsigned i = 0; i < ALL; i++) {
        snprintf(names[i], sizeof names[i], "%02u", i);
        columns[i] = names[i];
        rows[0][i] = cells[i / NUM];
        rows[1][i] = cells[i % NUM];
    }
    assert_int_equal(ps_table_create(&table, "c", columns, ALL, &error), PSPEC_OK);
    for (size_t i = 0; i < NUM; i++) {
        assert_int_equal(ps_table_add_meta(table, "value", cells[i], &error), PSPEC_OK);
    }
    assert_int_equal(ps_table_add_row(table, rows[0], &error), PSPEC_OK);
    assert_int_equal(ps_table_add_row(table, rows[1], &error), PSPEC_OK);
    ps_table *const again = write_and_read(state, table);
    check_equal(table, again);
    ps_table_destroy(again);
    ps_table_destroy(table);
}

static void empty_tables_come_back(void **state) {
    for (size_t num_columns = 0; num_columns < 2; num_columns++) {
        static const char *const columns[] = {"x"};
        ps_table *table = NULL;
        ps_error error = {0};
        assert_int_equal(ps_table_create(&table, NULL, columns, num_columns, &error), PSPEC_OK);
        ps_table *const again = write_and_read(state, table);
        check_equal(table, again);
        ps_table_destroy(again);
        ps_table_destroy(table);
    }
}

static void check_refused(const char *path, const void *bytes, size_t num) {
    ps_table *table = NULL;
    ps_error error = {0};
    assert_true(test_write_file(path, bytes, num));
    assert_int_equal(ps_table_read_npz(&table, path, &error), PSPEC_ERROR_INPUT);
    assert_null(table);
    assert_non_null(strstr(error.message, path));
}

/* Whatever is cut off, added or changed. */
static void other_bytes_are_refused(void **state) {
    char path[TEST_PATH_BYTES];
    ps_table *const table = make_table();
    ps_error error = {0};
    size_t num = 0;
    test_path(*state, "table.npz", path);
    assert_int_equal(ps_table_write(table, path, PS_FORMAT_NPZ, &error), PSPEC_OK);
    ps_table_destroy(table);
    char *const bytes = test_read_file(path, &num); /* and a NUL behind them */
    for (size_t i = 0; i < num; i += 16) {          /* result_cache_broken has all of them */
        bytes[i] = (char)(bytes[i] ^ (1 << i / 16 % 8));
        check_refused(path, bytes, num);
        bytes[i] = (char)(bytes[i] ^ (1 << i / 16 % 8));
        check_refused(path, bytes, i);
    }
    check_refused(path, bytes, num + 1);
    assert_true(test_write_file(path, bytes, num));
    ps_table *again = NULL;
    assert_int_equal(ps_table_read_npz(&again, path, &error), PSPEC_OK);
    ps_table_destroy(again);
    free(bytes);
}

/* Sound archives that are no tables: each has one array more, or another. */
static void archives_that_are_no_tables_are_refused(void **state) {
    static const size_t one[] = {1, 1};
    static const double number = 1.5;
    static const char fields[] = "1\0c\0cx\0", kinds[] = {PS_CELL_NUMBER, PS_CELL_TEXT, 7};
    static const size_t num_fields[] = {sizeof fields - 1, sizeof fields - 3};
    const ps_npz_array good[] = {{"fields", 'u', 1, 1, num_fields, fields},
                                 {"cell_kinds", 'u', 1, 2, one, kinds},
                                 {"x", 'f', sizeof number, 1, one, &number}};
    const ps_npz_array bad[] = {{"fields", 'u', 1, 1, &num_fields[1], fields},
                                {"fields", 'u', 1, 1, num_fields, "2\0c\0cx\0"},
                                {"fields", 'u', 1, 1, num_fields, "1\0c\0?x\0"},
                                {"fields", 'u', 1, 1, num_fields, "1\0c\0cy\0"},
                                {"other", 'u', 1, 1, num_fields, fields},
                                {"cell_kinds", 'u', 1, 2, one, kinds + 1},
                                {"cell_kinds", 'u', 1, 2, one, kinds + 2},
                                {"cell_kinds", 'u', 1, 1, one, kinds},
                                {"x", 'i', sizeof number, 1, one, &number},
                                {"x", 'f', sizeof number, 0, NULL, &number}};
    enum { NUM = 3, NUM_BAD = sizeof bad / sizeof bad[0] };
    char path[TEST_PATH_BYTES];
    test_path(*state, "no.npz", path);
    for (size_t i = 0; i <= NUM_BAD; i++) {
        ps_npz *npz = NULL;
        ps_table *table = NULL;
        ps_error error = {0};
        const size_t place = i < 5 ? 0 : i < 8 ? 1 : i < NUM_BAD ? 2 : NUM;
        assert_int_equal(ps_npz_open(&npz, path, PS_NPZ_LIMIT, &error), PSPEC_OK);
        for (size_t j = 0; j < NUM; j++) {
            assert_int_equal(ps_npz_add(npz, j == place ? &bad[i] : &good[j], &error), PSPEC_OK);
        }
        assert_int_equal(ps_npz_commit(&npz, &error), PSPEC_OK);
        assert_int_equal(ps_table_read_npz(&table, path, &error),
                         i < NUM_BAD ? PSPEC_ERROR_INPUT : PSPEC_OK);
        assert_int_equal(i == NUM_BAD, table != NULL);
        ps_table_destroy(table);
    }
}

#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_read_cell_by_cell), IN_FOLDER(comes_back_to_the_bit),
        IN_FOLDER(mixed_columns_come_back),     IN_FOLDER(empty_tables_come_back),
        IN_FOLDER(other_bytes_are_refused),     IN_FOLDER(archives_that_are_no_tables_are_refused),
    };
    return cmocka_run_group_tests_name("table_read", tests, NULL, NULL);
}
