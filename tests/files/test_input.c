/* Inputs: files, pipes, gzip; and rows of numbers parsed by several threads. */
#include "base/workers.h"
#include "files/text_rows.h"
#include "harness_points.h"

#include <setjmp.h>
#include <stdarg.h>
#include <zlib.h>

#include <cmocka.h>

/* ---- gzip -------------------------------------------------------------------------------- */

static void write_gzip(const char *path, const char *mode, const void *bytes, unsigned num_bytes) {
    const gzFile file = gzopen(path, mode);
    assert_non_null(file);
    assert_int_equal(gzwrite(file, bytes, num_bytes), num_bytes);
    assert_int_equal(gzclose(file), Z_OK);
}

enum { NUM_POINTS = 30000 };

static char *make_text(size_t *length) {
    char *const text = malloc(NUM_POINTS * 64);
    uint64_t random = 1;
    *length = 0;
    for (size_t i = 0; i < NUM_POINTS; i++) {
        random = random * 6364136223846793005U + 1442695040888963407U;
        const double x = (double)(random >> 11) * 0x1p-53;
        *length += (size_t)sprintf(text + *length, "%.17g %.*g\n", x, (int)(i % 17) + 1, x / 2);
        if (i % 7000 == 6999) {
            *length += (size_t)sprintf(text + *length, "#\n");
        }
    }
    return text;
}

/* Compressed at once, and as two members one after the other, it is the same points. */
static void reads_gzip(void **state) {
    size_t length = 0;
    char plain_path[TEST_PATH_BYTES];
    char path[TEST_PATH_BYTES];
    char *const text = make_text(&length);
    const ps_point_options options = {0};
    ps_error error = {0};
    test_points plain;
    assert_true(test_write_file(test_path(*state, "a.txt", plain_path), text, length));
    assert_int_equal(test_points_read(&plain, plain_path, &options, &error), PSPEC_OK);
    assert_int_equal(plain.num_points, NUM_POINTS);
    for (int members = 1; members <= 2; members++) {
        const unsigned first = (unsigned)length / (unsigned)members;
        test_points packed;
        write_gzip(test_path(*state, "a.txt.gz", path), "wb", text, first);
        if (members == 2) {
            write_gzip(path, "ab", text + first, (unsigned)length - first);
        }
        assert_int_equal(test_points_read(&packed, path, &options, &error), PSPEC_OK);
        assert_int_equal(packed.num_sets, plain.num_sets);
        assert_int_equal(packed.num_points, plain.num_points);
        assert_memory_equal(packed.points, plain.points,
                            plain.num_points * plain.dimension * sizeof(double));
        test_points_free(&packed);
    }
    test_points_free(&plain);
    free(text);
}

/* The name in front of .gz still tells the format. */
static void knows_compressed_formats(void **state) {
    static const float floats[] = {0.5F, 0.25F};
    char path[TEST_PATH_BYTES];
    const ps_point_options options = {0};
    ps_error error = {0};
    test_points all;
    write_gzip(test_path(*state, "a.rps.gz", path), "wb", floats, sizeof floats);
    assert_int_equal(test_points_read(&all, path, &options, &error), PSPEC_OK);
    assert_string_equal(all.format, "rps");
    assert_int_equal(all.num_points, 1);
    test_points_free(&all);
}

static void refuses_damaged_gzip(void **state) {
    char path[TEST_PATH_BYTES];
    const char text[] = "0.5 0.25\n0.125 0.75\n";
    size_t length = 0;
    const ps_point_options options = {0};
    write_gzip(test_path(*state, "a.gz", path), "wb", text, sizeof text - 1);
    char *const good = test_read_file(path, &length);
    for (size_t i = 2; i < length; i++) { /* cut at every byte, then every byte changed */
        for (int change = 0; change < 2; change++) {
            ps_error error = {0};
            test_points all;
            good[i] = (char)(good[i] ^ (change ? 0x55 : 0));
            assert_true(test_write_file(path, good, change ? length : i));
            const pspec_status status = test_points_read(&all, path, &options, &error);
            good[i] = (char)(good[i] ^ (change ? 0x55 : 0));
            const bool is_comment = change && i < 10; /* time, flags and system of the header */
            assert_true(status == PSPEC_ERROR_INPUT || is_comment);
            assert_true(status == PSPEC_OK || strstr(error.message, "a.gz") != NULL);
            test_points_free(&all);
        }
    }
    free(good);
}

static void refuses_an_empty_gzip(void **state) {
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    test_points all;
    const ps_point_options options = {0};
    write_gzip(test_path(*state, "a.gz", path), "wb", "", 0);
    assert_int_equal(test_points_read(&all, path, &options, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "a.gz holds no points"));
    test_points_free(&all);
}

/* ---- several threads --------------------------------------------------------------------- */

typedef struct count_task {
    unsigned calls[PS_MOST_PARSERS];
} count_task;

static void count_call(void *payload, unsigned index) {
    ((count_task *)payload)->calls[index]++;
}

static void workers_do_every_part_once(void **state) {
    (void)state;
    ps_workers *const workers = ps_workers_create(PS_MOST_PARSERS);
    const unsigned count = ps_workers_count(workers);
    assert_in_range(count, 1, PS_MOST_PARSERS);
    count_task task = {{0}};
    enum { ROUNDS = 1000 };
    for (unsigned round = 0; round < ROUNDS; round++) {
        ps_workers_run(workers, count_call, &task);
    }
    for (unsigned i = 0; i < PS_MOST_PARSERS; i++) {
        assert_int_equal(task.calls[i], i < count ? ROUNDS : 0);
    }
    ps_workers_destroy(workers);
    ps_workers_destroy(NULL);
    assert_null(ps_workers_create(1));
}

/* A long text of rows gives the rows that one thread finds, for every room and bad line. */
static void threads_find_the_same_rows(void **state) {
    (void)state;
    enum { NUM_ROWS = 40000, COLUMNS = 2 };
    char *const text = malloc(NUM_ROWS * 48 + 16);
    double *const expected = malloc(NUM_ROWS * COLUMNS * sizeof(double));
    double *const rows = malloc(NUM_ROWS * COLUMNS * sizeof(double));
    uint64_t random = 7;
    size_t length = 0;
    for (size_t i = 0; i < NUM_ROWS; i++) {
        random = random * 6364136223846793005U + 1442695040888963407U;
        expected[2 * i] = (double)(random >> 11) * 0x1p-53;
        expected[2 * i + 1] = (double)(random >> 40);
        length +=
            (size_t)sprintf(text + length, "%.17g %.17g\n", expected[2 * i], expected[2 * i + 1]);
    }
    ps_row_parser parser = {.separator = ' ', .columns = COLUMNS};
    static const size_t rooms[] = {NUM_ROWS, NUM_ROWS - 1, NUM_ROWS / 2, 20000, 17000, NUM_ROWS};
    for (size_t i = 0; i < sizeof rooms / sizeof rooms[0]; i++) {
        const char *at = text;
        size_t total = 0;
        while (at < text + length && total < rooms[i]) {
            size_t num = 0;
            at = ps_rows_parse(&parser, at, text + length, rows + total * COLUMNS, rooms[i] - total,
                               &num);
            assert_in_range(num, 1, rooms[i] - total);
            total += num;
        }
        assert_int_equal(total, rooms[i]);
        assert_memory_equal(rows, expected, total * COLUMNS * sizeof(double));
    }
    text[length / 3] = 'x'; /* a line that is no row stops everything behind it */
    const char *at = text;
    size_t num = 1;
    while (num > 0) {
        at = ps_rows_parse(&parser, at, text + length, rows, NUM_ROWS, &num);
    }
    assert_in_range(text + length / 3 - at, 0, 48);
    ps_row_parser_free(&parser);
    free(rows);
    free(expected);
    free(text);
}

/* Every thing once, whatever the number of threads: one more than a multiple of many of them, and
 * few. */
typedef struct counted {
    size_t num;
    unsigned char *times;
} counted;

static void count_some(void *payload, unsigned index, unsigned count) {
    const counted *counts = payload;
    const size_t end = ps_share_begin(counts->num, index + 1, count);
    for (size_t i = ps_share_begin(counts->num, index, count); i < end; i++) {
        counts->times[i]++;
    }
}

static void every_thing_once(void **state) {
    (void)state;
    static const size_t nums[] = {0, 1, 5, 100, (1 << 17) - 1, 720721};
    for (size_t i = 0; i < sizeof nums / sizeof nums[0]; i++) {
        counted counts = {nums[i], calloc(nums[i] + 1, 1)};
        ps_workers_share(nums[i], count_some, &counts);
        for (size_t j = 0; j <= nums[i]; j++) {
            assert_int_equal(counts.times[j], j < nums[i] ? 1 : 0);
        }
        for (unsigned count = 1; count < 20; count++) {
            assert_int_equal(ps_share_begin(nums[i], 0, count), 0);
            assert_int_equal(ps_share_begin(nums[i], count, count), nums[i]);
        }
        free(counts.times);
    }
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(reads_gzip),
        IN_FOLDER(knows_compressed_formats),
        IN_FOLDER(refuses_damaged_gzip),
        IN_FOLDER(refuses_an_empty_gzip),
        cmocka_unit_test(every_thing_once),
        cmocka_unit_test(workers_do_every_part_once),
        cmocka_unit_test(threads_find_the_same_rows),
    };
    return cmocka_run_group_tests_name("input", tests, NULL, NULL);
}
