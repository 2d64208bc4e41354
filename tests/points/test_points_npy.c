/* NPY arrays of points: every layout that is read, and what is refused. */
#include <math.h>
#include "points/points.h"
#include "harness_points.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { MAX_BYTES = 1 << 16 };

typedef struct bytes {
    unsigned char data[MAX_BYTES];
    size_t length;
} bytes;

static void append(bytes *out, const void *data, size_t length) {
    memcpy(out->data + out->length, data, length);
    out->length += length;
}

/* Magic and dictionary; version 1 or 2. */
static void append_header(bytes *out, int version, const char *dictionary) {
    const size_t length = strlen(dictionary);
    const unsigned char start[] = {0x93,
                                   'N',
                                   'U',
                                   'M',
                                   'P',
                                   'Y',
                                   (unsigned char)version,
                                   0,
                                   (unsigned char)(length & 0xff),
                                   (unsigned char)(length >> 8),
                                   0,
                                   0};
    out->length = 0;
    append(out, start, version == 1 ? 10 : 12);
    append(out, dictionary, length);
}

static void append_element(bytes *out, double value, size_t element_bytes, bool is_little) {
    const float narrow = (float)value;
    unsigned char raw[8];
    memcpy(raw, element_bytes == 4 ? (const void *)&narrow : (const void *)&value, element_bytes);
    for (size_t i = 0; i < element_bytes; i++) { /* this machine is little-endian */
        out->data[out->length++] = raw[is_little ? i : element_bytes - 1 - i];
    }
}

static pspec_status open_bytes(void **state, const bytes *in, const ps_point_options *options,
                               ps_point_reader **reader, ps_error *error) {
    char path[TEST_PATH_BYTES];
    assert_true(test_write_file(test_path(*state, "points.npy", path), in->data, in->length));
    return ps_points_open(reader, path, options, error);
}

/* A multiple of 2^-12 that names the place; float32 holds it. */
static double value_at(size_t set, size_t point, size_t column) {
    return (double)(1 + set * 100 + point * 10 + column) / 4096;
}

/* Writes and reads an array of the layout. With rank < 3 there is one set, with rank 1 one column.
 */
static void check_layout(void **state, unsigned rank, size_t element_bytes, bool is_little,
                         bool is_fortran, bool has_weights) {
    const size_t num_sets = rank == 3 ? 3 : 1;
    const size_t num_points = 5;
    const size_t columns = rank == 1 ? 1 : 3;
    bytes file;
    char dictionary[256];
    const char *const shapes[] = {"", "(5,)", "(5, 3)", "(3, 5, 3)"};
    snprintf(dictionary, sizeof dictionary,
             "{'descr': '%cf%zu', 'fortran_order': %s, 'shape': %s, }     \n",
             is_little ? '<' : '>', element_bytes, is_fortran ? "True" : "False", shapes[rank]);
    append_header(&file, is_fortran ? 2 : 1, dictionary);
    for (size_t i = 0; i < num_sets * num_points * columns; i++) {
        const size_t set = is_fortran ? i % num_sets : i / (num_points * columns);
        const size_t point = is_fortran ? i / num_sets % num_points : i / columns % num_points;
        const size_t column = is_fortran ? i / (num_sets * num_points) : i % columns;
        append_element(&file, value_at(set, point, column), element_bytes, is_little);
    }
    const ps_point_options options = {.weight_column = has_weights};
    ps_error error = {0};
    ps_point_reader *reader = NULL;
    ps_point_set set = {0};
    bool has_set = false;
    const unsigned d = (unsigned)columns - has_weights;
    assert_int_equal(open_bytes(state, &file, &options, &reader, &error), PSPEC_OK);
    assert_string_equal(ps_points_format(reader), "npy");
    for (size_t m = 0; m < num_sets; m++) {
        assert_int_equal(test_points_next(reader, &set, &has_set, &error), PSPEC_OK);
        assert_true(has_set && set.num_points == num_points && set.dimension == d);
        for (size_t i = 0; i < num_points; i++) {
            for (unsigned j = 0; j < d; j++) {
                assert_true(set.points[i * d + j] == value_at(m, i, j));
            }
            assert_true(!has_weights || set.weights[i] == value_at(m, i, d));
        }
    }
    assert_int_equal(test_points_next(reader, &set, &has_set, &error), PSPEC_OK);
    assert_false(has_set);
    ps_point_set_free(&set);
    ps_points_close(reader);
}

static void reads_every_layout(void **state) {
    for (unsigned layout = 0; layout < 48; layout++) {
        const unsigned rank = 1 + layout % 3;
        const bool has_weights = (layout / 24 % 2) != 0 && rank > 1;
        check_layout(state, rank, (layout / 3 % 2) != 0 ? 8 : 4, (layout / 6 % 2) != 0,
                     (layout / 12 % 2) != 0, has_weights);
    }
}

/* Four numbers of each type, in either byte order; whole ones in a box. */
static void reads_every_type(void **state) {
    static const struct {
        const char *type;
        size_t num_bytes;
        unsigned char numbers[4][8]; /* the highest byte first */
        double expected[4];
        double high; /* of the box; 0: none */
    } cases[] = {
        {"f2",
         2,
         {{0x38, 0x00}, {0x00, 0x01}, {0x3b, 0xff}, {0x2e, 0x66}},
         {0.5, 0x1p-24, 0.99951171875, 0.0999755859375},
         0},
        {"i1", 1, {{0}, {64}, {127}, {1}}, {0, 0.5, 0.9921875, 0.0078125}, 128},
        {"u1", 1, {{0}, {128}, {255}, {1}}, {0, 0.5, 0.99609375, 0.00390625}, 256},
        {"i2", 2, {{0, 0}, {0x40, 0}, {0x7f, 0xff}, {0, 1}}, {0, 0.5, 1 - 0x1p-15, 0x1p-15}, 32768},
        {"u2", 2, {{0, 0}, {0x80, 0}, {0xff, 0xff}, {0, 1}}, {0, 0.5, 1 - 0x1p-16, 0x1p-16}, 65536},
        {"i4", 4, {{0}, {0, 1}, {0, 0, 1}, {0, 0, 0, 1}}, {0, 0.5, 0x1p-9, 0x1p-17}, 131072},
        {"u8",
         8,
         {{0}, {0, 0, 0, 0, 0, 1}, {0, 0, 0, 0, 0, 0, 1}, {0, 0, 0, 0, 0, 0, 0, 1}},
         {0, 0.5, 0x1p-9, 0x1p-17},
         131072}};
    for (size_t i = 0; i < 2 * sizeof cases / sizeof cases[0]; i++) {
        bytes file;
        char dictionary[256];
        const bool is_little = i % 2 != 0;
        const size_t num_bytes = cases[i / 2].num_bytes;
        const ps_point_options options = {
            .format = "npy",
            .box = {.num_axes = cases[i / 2].high > 0, .high = {cases[i / 2].high}}};
        ps_error error = {0};
        ps_point_reader *reader = NULL;
        ps_point_set set = {0};
        bool has_set = false;
        snprintf(dictionary, sizeof dictionary,
                 "{'descr': '%c%s', 'fortran_order': False, 'shape': (2, 2), }\n",
                 num_bytes == 1 ? '|'
                 : is_little    ? '<'
                                : '>',
                 cases[i / 2].type);
        append_header(&file, 1, dictionary);
        for (size_t j = 0; j < 4; j++) {
            for (size_t b = 0; b < num_bytes; b++) {
                const size_t place = is_little ? num_bytes - 1 - b : b;
                append(&file, &cases[i / 2].numbers[j][place], 1);
            }
        }
        assert_int_equal(open_bytes(state, &file, &options, &reader, &error), PSPEC_OK);
        assert_int_equal(test_points_next(reader, &set, &has_set, &error), PSPEC_OK);
        for (size_t j = 0; j < 4; j++) {
            if (set.points[j] != cases[i / 2].expected[j]) {
                fail_msg("%s: %.17g, not %.17g", cases[i / 2].type, set.points[j],
                         cases[i / 2].expected[j]);
            }
        }
        ps_point_set_free(&set);
        ps_points_close(reader);
    }
}

static void refuses_bad_arrays(void **state) {
    const ps_point_options defaults = {.format = "npy"};
    const ps_point_options plane = {.dimension = 2};
    const ps_point_options weighted = {.format = "npy", .weight_column = true};
    static const char two_by_two[] = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }";
    const struct {
        const char *dictionary;
        size_t num_elements;
        double value; /* of the last element */
        const ps_point_options *options;
        const char *message;
    } cases[] = {
        {two_by_two, 3, 0, &defaults,
         "is truncated: its header promises 32 bytes of data, there are 24"},
        {two_by_two, 5, 0, &defaults, "has 8 bytes after its array"},
        {two_by_two, 4, (double)NAN, &defaults, "set 1, row 2: coordinate nan is not a finite"},
        {two_by_two, 4, -(double)INFINITY, &defaults, "set 1, row 2: coordinate -inf is not"},
        {two_by_two, 4, 1, &defaults, "set 1, row 2: coordinate 1 is outside [0,1)"},
        {two_by_two, 4, (double)NAN, &weighted, "set 1, row 2: weight nan is not a finite"},
        {"{'descr': '<i8', 'fortran_order': False, 'shape': (2, 2), }", 4, 1, &defaults,
         "is outside [0,1); in other units? --box X0,X1"},
        {"{'descr': '<f1', 'fortran_order': False, 'shape': (2, 2), }", 4, 0, &defaults,
         "element type '<f1' cannot be read"},
        {"{'descr': '<i3', 'fortran_order': False, 'shape': (2, 2), }", 4, 0, &defaults,
         "element type '<i3' cannot be read"},
        {"{'descr': '|O', 'fortran_order': False, 'shape': (2, 2), }", 4, 0, &defaults,
         "element type '|O' cannot be read"},
        {"{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (2, 2), }", 4, 0, &defaults,
         "element type [('x' cannot be read"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (2, 7), }", 14, 0, &defaults,
         "7 columns; at most 6 dimensions are read"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }", 6, 0, &plane,
         "3 columns, but the dimension asked for is 2"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }", 2, 0, &weighted,
         "1 column; with a weight column"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (), }", 1, 0, &defaults,
         "an array of shape ()"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1, 1, 2), }", 2, 0, &defaults,
         "an array of shape (1, 1, 1, 2): points are (N, d), (M, N, d) or (N)"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (0, 2), }", 0, 0, &defaults,
         "holds no points"},
        {"{'descr': '<f8', 'fortran_order': False, }", 0, 0, &defaults, "cannot be understood"},
        {"{'descr': '<f8', 'fortran_order': Maybe, 'shape': (1,)}", 1, 0, &defaults,
         "cannot be understood at \"Maybe"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (-1,)}", 1, 0, &defaults,
         "cannot be understood at \"(-1,)}"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (9999999999999999999, 9)}", 1, 0,
         &defaults, "the shape in its NPY header is too large"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (1,1,1,1,1,1,1,1,1)}", 1, 0, &defaults,
         "cannot be understood"},
        {"", 0, 0, &defaults, "cannot be understood"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        bytes file;
        append_header(&file, 1, cases[i].dictionary);
        for (size_t j = 0; j < cases[i].num_elements; j++) {
            append_element(&file, j + 1 == cases[i].num_elements ? cases[i].value : 0, 8, true);
        }
        ps_error error = {0};
        ps_point_reader *reader = NULL;
        ps_point_set set = {0};
        bool has_set = false;
        pspec_status status = open_bytes(state, &file, cases[i].options, &reader, &error);
        if (status == PSPEC_OK) {
            status = test_points_next(reader, &set, &has_set, &error);
        }
        ps_point_set_free(&set);
        ps_points_close(reader);
        if (status != PSPEC_ERROR_INPUT || strstr(error.message, cases[i].message) == NULL ||
            strstr(error.message, "points.npy") == NULL) {
            fail_msg("%s: status %d, \"%s\", expected \"%s\"", cases[i].dictionary, (int)status,
                     error.message, cases[i].message);
        }
    }
}

/* Damage at any byte of a good file is an error or harmless, never a crash; the sanitizers look. */
static void survives_truncation_and_damage(void **state) {
    const ps_point_options wrapping = {.wrap = true};
    bytes good;
    append_header(&good, 1, "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }");
    for (size_t j = 0; j < 4; j++) {
        append_element(&good, 0.25, 8, true);
    }
    for (size_t i = 0; i < 2 * good.length; i++) {
        bytes file = good;
        if (i < good.length) {
            file.length = i;
        } else {
            file.data[i - good.length] ^= 0x15;
        }
        ps_error error = {0};
        ps_point_reader *reader = NULL;
        ps_point_set set = {0};
        bool has_set = false;
        pspec_status status = open_bytes(state, &file, &wrapping, &reader, &error);
        if (status == PSPEC_OK) {
            status = test_points_next(reader, &set, &has_set, &error);
        }
        assert_true(i >= good.length || status == PSPEC_ERROR_INPUT);
        ps_point_set_free(&set);
        ps_points_close(reader);
    }
}

/* Reads standard input from a pipe that brings these bytes. */
static pspec_status read_pipe(const bytes *in, size_t *num_sets, ps_error *error) {
    const ps_point_options defaults = {0};
    int ends[2];
    const int kept = dup(STDIN_FILENO);
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(write(ends[1], in->data, in->length), in->length);
    close(ends[1]);
    assert_int_equal(dup2(ends[0], STDIN_FILENO), STDIN_FILENO);
    close(ends[0]);
    ps_point_reader *reader = NULL;
    ps_point_set set = {0};
    bool has_set = true;
    *num_sets = 0;
    pspec_status status = ps_points_open(&reader, "-", &defaults, error);
    while (status == PSPEC_OK && has_set) {
        status = test_points_next(reader, &set, &has_set, error);
        *num_sets += status == PSPEC_OK && has_set;
    }
    ps_point_set_free(&set);
    ps_points_close(reader);
    dup2(kept, STDIN_FILENO);
    close(kept);
    return status;
}

/* A pipe has no size, so the truth comes out at its end; huge promises must not claim memory. */
static void reads_pipes(void **state) {
    (void)state;
    static const struct {
        const char *shape;
        size_t num_elements, num_sets;
        const char *message; /* NULL: good */
    } cases[] = {
        {"(2, 2, 2)", 8, 2, NULL},
        {"(2, 2, 2)", 7, 1, "standard input is truncated"},
        {"(2, 2, 2)", 9, 1, "standard input goes on after its array"},
        {"(1000000000000, 2)", 8, 0, "standard input is truncated"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int is_fortran = 0; is_fortran < 2; is_fortran++) {
            bytes file;
            char dictionary[128];
            size_t num_sets = 0;
            ps_error error = {0};
            snprintf(dictionary, sizeof dictionary,
                     "{'descr': '<f8', 'fortran_order': %s, 'shape': %s}",
                     is_fortran ? "True" : "False", cases[i].shape);
            append_header(&file, 1, dictionary);
            for (size_t j = 0; j < cases[i].num_elements; j++) {
                append_element(&file, 0.5, 8, true);
            }
            if (cases[i].message == NULL) {
                assert_int_equal(read_pipe(&file, &num_sets, &error), PSPEC_OK);
            } else {
                assert_int_equal(read_pipe(&file, &num_sets, &error), PSPEC_ERROR_INPUT);
                assert_true(is_fortran || strstr(error.message, cases[i].message) != NULL);
            }
            assert_true(is_fortran || num_sets == cases[i].num_sets);
        }
    }
}

/* Half of the limit is for sets that are kept: one of them at a time, or no set at all. */
static void fortran_order_within_memory(void **state) {
    enum { SETS = 3, POINTS = 4, COLUMNS = 2, SET_BYTES = POINTS * COLUMNS * 8 };
    const ps_point_options enough = {.memory_limit = 2 * SET_BYTES, .domain = PS_DOMAIN_TORUS};
    const ps_point_options less = {.memory_limit = 2 * SET_BYTES - 1, .domain = PS_DOMAIN_TORUS};
    ps_error error = {0};
    ps_point_reader *reader = NULL;
    ps_point_set set = {0};
    bool has_set = true;
    bytes file;
    append_header(&file, 1, "{'descr': '<f8', 'fortran_order': True, 'shape': (3, 4, 2), }");
    for (size_t i = 0; i < SETS * POINTS * COLUMNS; i++) {
        append_element(&file, value_at(i % SETS, i / SETS % POINTS, i / SETS / POINTS), 8, true);
    }
    assert_int_equal(open_bytes(state, &file, &enough, &reader, &error), PSPEC_OK);
    for (size_t m = 0; m < SETS; m++) {
        assert_int_equal(test_points_next(reader, &set, &has_set, &error), PSPEC_OK);
        assert_true(has_set && set.num_points == POINTS);
        for (size_t i = 0; i < POINTS * COLUMNS; i++) {
            assert_true(set.points[i] == value_at(m, i / COLUMNS, i % COLUMNS));
        }
    }
    ps_points_close(reader);
    assert_int_equal(open_bytes(state, &file, &less, &reader, &error), PSPEC_OK);
    assert_int_equal(test_points_next(reader, &set, &has_set, &error), PSPEC_ERROR_MEMORY);
    assert_non_null(strstr(error.message, "half of 127 at most, the limit of --memory"));
    ps_points_close(reader);
    ps_point_set_free(&set);
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(reads_every_layout), IN_FOLDER(reads_every_type),
        IN_FOLDER(refuses_bad_arrays), IN_FOLDER(survives_truncation_and_damage),
        IN_FOLDER(reads_pipes),        IN_FOLDER(fortran_order_within_memory),
    };
    return cmocka_run_group_tests_name("points_npy", tests, NULL, NULL);
}
