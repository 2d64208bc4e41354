/* Tables as bytes and back, reading them cell by cell, and bytes that are no table. */
#include "tables/table_pack.h"

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

/* The table that came back takes more, like any other. */
static void comes_back_to_the_bit(void **state) {
    (void)state;
    ps_table *const table = make_table();
    ps_table *again = NULL;
    ps_error error = {0};
    void *bytes = NULL;
    size_t num_bytes = 0;
    assert_int_equal(ps_table_pack(table, &bytes, &num_bytes, &error), PSPEC_OK);
    assert_int_equal(ps_table_unpack(&again, bytes, num_bytes, &error), PSPEC_OK);
    free(bytes);
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

static void empty_tables_come_back(void **state) {
    (void)state;
    for (size_t num_columns = 0; num_columns < 2; num_columns++) {
        static const char *const columns[] = {"x"};
        ps_table *table = NULL;
        ps_table *again = NULL;
        ps_error error = {0};
        void *bytes = NULL;
        size_t num_bytes = 0;
        assert_int_equal(ps_table_create(&table, NULL, columns, num_columns, &error), PSPEC_OK);
        assert_int_equal(ps_table_pack(table, &bytes, &num_bytes, &error), PSPEC_OK);
        assert_int_equal(ps_table_unpack(&again, bytes, num_bytes, &error), PSPEC_OK);
        check_equal(table, again);
        free(bytes);
        ps_table_destroy(again);
        ps_table_destroy(table);
    }
}

static bool is_refused(const void *bytes, size_t num_bytes) {
    ps_table *table = NULL;
    ps_error error = {0};
    void *const exact = malloc(num_bytes > 0 ? num_bytes : 1); /* sanitizers see its end */
    assert_non_null(exact);
    memcpy(exact, bytes, num_bytes);
    const pspec_status status = ps_table_unpack(&table, exact, num_bytes, &error);
    assert_true(status == PSPEC_OK || status == PSPEC_ERROR_INPUT);
    assert_int_equal(status == PSPEC_OK, table != NULL);
    assert_true(status == PSPEC_OK || strstr(error.message, "no packed table") != NULL);
    ps_table_destroy(table);
    free(exact);
    return status != PSPEC_OK;
}

static void cut_and_long_bytes_are_refused(void **state) {
    (void)state;
    ps_table *const table = make_table();
    ps_error error = {0};
    void *bytes = NULL;
    size_t num_bytes = 0;
    assert_int_equal(ps_table_pack(table, &bytes, &num_bytes, &error), PSPEC_OK);
    for (size_t i = 0; i < num_bytes; i++) {
        assert_true(is_refused(bytes, i));
    }
    char *const longer = calloc(num_bytes + 1, 1);
    assert_non_null(longer);
    memcpy(longer, bytes, num_bytes);
    assert_false(is_refused(longer, num_bytes));
    assert_true(is_refused(longer, num_bytes + 1));
    free(longer);
    free(bytes);
    ps_table_destroy(table);
}

/* Every byte becomes every other: refused, or another table, which packs to the very bytes it came
 * from. */
static void changed_bytes_are_refused_or_another_table(void **state) {
    (void)state;
    static const char *const columns[] = {"x"};
    const ps_cell row = PS_TEXT("t");
    ps_table *table = NULL;
    ps_error error = {0};
    void *memory = NULL;
    size_t num_bytes = 0;
    size_t num_refused = 0;
    assert_int_equal(ps_table_create(&table, "c", columns, 1, &error), PSPEC_OK);
    assert_int_equal(ps_table_add_meta(table, "k", PS_NUMBER(1.5), &error), PSPEC_OK);
    assert_int_equal(ps_table_add_row(table, &row, &error), PSPEC_OK);
    assert_int_equal(ps_table_pack(table, &memory, &num_bytes, &error), PSPEC_OK);
    ps_table_destroy(table);
    unsigned char *const bytes = memory;
    for (size_t i = 0; i < num_bytes; i++) {
        for (int change = 1; change < 256; change++) {
            void *packed = NULL;
            size_t num_packed = 0;
            bytes[i] ^= (unsigned char)change;
            if (is_refused(bytes, num_bytes)) {
                num_refused++;
            } else {
                assert_int_equal(ps_table_unpack(&table, bytes, num_bytes, &error), PSPEC_OK);
                assert_int_equal(ps_table_pack(table, &packed, &num_packed, &error), PSPEC_OK);
                assert_int_equal(num_packed, num_bytes);
                assert_memory_equal(packed, bytes, num_bytes);
                free(packed);
                ps_table_destroy(table);
            }
            bytes[i] ^= (unsigned char)change;
        }
    }
    /* magic, six lengths and counts, each of 8 bytes, in which at most a smaller number can be
     * meant */
    assert_true(num_refused > 56 * 250);
    free(memory);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_read_cell_by_cell),
        cmocka_unit_test(comes_back_to_the_bit),
        cmocka_unit_test(empty_tables_come_back),
        cmocka_unit_test(cut_and_long_bytes_are_refused),
        cmocka_unit_test(changed_bytes_are_refused_or_another_table),
    };
    return cmocka_run_group_tests_name("table_pack", tests, NULL, NULL);
}
