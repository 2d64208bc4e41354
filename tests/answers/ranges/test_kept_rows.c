/* Rows of ranges as state of answers: read again they are what was written; numbers that are not so
 * are refused, whatever they are. */
#include "harness.h"

#include "answers/kept_rows.h"

#include <math.h>
#include <string.h>

enum { ROWS = 5, ROW_BYTES = 12, WHOLE_ROWS = 3, ALL = 20 };

/* A tape of two jobs, of which one is of no realizations; rows begin with byte `first`. */
static void fill(ps_row_tape *tape, uint64_t first) {
    ps_row_track *track = NULL;
    unsigned char rows[ROWS * ROW_BYTES];
    *tape = (ps_row_tape){.range = {first, first + ROWS}, .is_part = true};
    for (size_t i = 0; i < sizeof rows; i++) {
        rows[i] = (unsigned char)(i + first);
    }
    for (unsigned part = 0; part < 2; part++) {
        assert_int_equal(ps_row_tape_track(&track, tape, part, NULL), PSPEC_OK);
        track->is_whole = part == 1;
        track->row_bytes = ROW_BYTES;
        track->all = part == 1 ? WHOLE_ROWS : ALL;
        track->largest[0] = part == 1 ? 0 : (double)(ALL - first);
        assert_int_equal(ps_row_track_add(track, rows, part == 1 ? WHOLE_ROWS : ROWS, NULL),
                         PSPEC_OK);
    }
}

static ps_table *write(uint64_t first) {
    static const char *const columns[] = {"x"};
    ps_row_tape tape;
    ps_request request = ps_request_default;
    ps_table *table = NULL;
    ps_error error;
    fill(&tape, first);
    request.limits.checkpoint.tape = &tape;
    assert_int_equal(ps_table_create(&table, "quadrature", columns, 1, &error), PSPEC_OK);
    assert_int_equal(ps_kept_rows_add(table, &request, &error), PSPEC_OK);
    ps_row_tape_free(&tape);
    return table;
}

static const char *const names[] = {"before", "this"};

static void ranges_are_read_one_behind_the_other(void **state) {
    ps_table *const tables[] = {write(0), write(ROWS)};
    ps_row_tape tape = {0};
    uint64_t all = 0;
    ps_error error;
    (void)state;
    assert_string_equal(ps_cell_text(ps_table_find_meta(tables[1], "range")), "5:10 of 20");
    for (size_t i = 0; i < 2; i++) {
        assert_int_equal(ps_kept_rows_read(&tape, &all, tables[i], names, &error), PSPEC_OK);
    }
    assert_int_equal(all, ALL);
    assert_int_equal(tape.range.first, 0);
    assert_int_equal(tape.range.end, 2 * ROWS);
    assert_int_equal(tape.tracks[0].num, 2 * ROWS);
    assert_int_equal(tape.tracks[1].num, WHOLE_ROWS); /* of the first */
    assert_true(tape.tracks[0].largest[0] == ALL);
    for (size_t i = 0; i < ROWS * ROW_BYTES; i++) {
        assert_int_equal((unsigned char)tape.tracks[0].rows[i], i);
        assert_int_equal((unsigned char)tape.tracks[0].rows[ROWS * ROW_BYTES + i], i + ROWS);
    }
    for (size_t i = 0; i < 2; i++) {
        ps_table_destroy(tables[i]);
    }
    ps_row_tape_free(&tape);
}

static void ranges_that_do_not_follow_are_refused(void **state) {
    static const uint64_t firsts[] = {0, 4, 6};
    ps_table *const first = write(0);
    (void)state;
    for (size_t i = 0; i < sizeof firsts / sizeof *firsts; i++) {
        ps_table *const next = write(firsts[i]);
        ps_row_tape tape = {0};
        uint64_t all = 0;
        ps_error error;
        assert_int_equal(ps_kept_rows_read(&tape, &all, first, names, &error), PSPEC_OK);
        assert_int_equal(ps_kept_rows_read(&tape, &all, next, names, &error), PSPEC_ERROR_INPUT);
        assert_non_null(strstr(error.message, firsts[i] < ROWS ? "overlap" : "are missing"));
        ps_row_tape_free(&tape);
        ps_table_destroy(next);
    }
    ps_table_destroy(first);
}

/* What counts rows, and says where they are. */
static void numbers_that_are_not_so_are_refused(void **state) {
    static const double values[] = {NAN, INFINITY, -1, 0.5, 1e300, 0x1p53, 7, 1e6, 0};
    (void)state;
    for (size_t place = 0; place < 8; place++) {
        for (size_t v = 0; v < sizeof values / sizeof *values; v++) {
            ps_table *const table = write(0);
            ps_row_tape tape = {0};
            uint64_t all = 0;
            ps_error error;
            const char *const name = place < 3 ? "state_range" : "state_track";
            ps_table_find_array(table, name)->data[place < 3 ? place : place - 3] = values[v];
            const pspec_status status = ps_kept_rows_read(&tape, &all, table, names, &error);
            assert_true(status == PSPEC_OK || status == PSPEC_ERROR_INPUT);
            assert_true(v >= 6 || status == PSPEC_ERROR_INPUT); /* the others may be counts */
            ps_row_tape_free(&tape);
            ps_table_destroy(table);
        }
    }
}

static void answers_without_rows_are_refused(void **state) {
    static const char *const columns[] = {"x"};
    ps_table *table = NULL;
    ps_row_tape tape = {0};
    uint64_t all = 0;
    ps_error error;
    (void)state;
    assert_int_equal(ps_table_create(&table, "quadrature", columns, 1, &error), PSPEC_OK);
    assert_int_equal(ps_kept_rows_read(&tape, &all, table, names, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "this is no answer to a range"));
    ps_table_destroy(table);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranges_are_read_one_behind_the_other),
        cmocka_unit_test(ranges_that_do_not_follow_are_refused),
        cmocka_unit_test(numbers_that_are_not_so_are_refused),
        cmocka_unit_test(answers_without_rows_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
