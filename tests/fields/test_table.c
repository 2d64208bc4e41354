/* Result tables in their formats. */
#include "base/text.h"
#include "files/input_file.h"
#include "fields/table.h"
#include "test_folder.h"

#include <cJSON.h>
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static const char *const columns[] = {"sampler", "bin", "power"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };

static ps_table *make_table(void) {
    ps_table *table = NULL;
    ps_error error = {0};
    assert_int_equal(ps_table_create(&table, "power", columns, NUM_COLUMNS, &error), PSPEC_OK);
    const struct {
        const char *key;
        ps_cell value;
    } meta[] = {{"seed", PS_INTEGER(INT64_MAX)}, {"file", PS_TEXT("a,b \"c\"\nd")},
                {"tolerance", PS_NUMBER(0.1)},   {"skipped", PS_TEXT("first")},
                {"empty", PS_MISSING},           {"skipped", PS_TEXT("second")}};
    for (size_t i = 0; i < sizeof meta / sizeof meta[0]; i++) {
        assert_int_equal(ps_table_add_meta(table, meta[i].key, meta[i].value, &error), PSPEC_OK);
    }
    char text[] = "white";
    const ps_cell rows[][NUM_COLUMNS] = {
        {PS_TEXT(text), PS_INTEGER(1), PS_NUMBER(1.0 / 3)},
        {PS_TEXT("halton:base=2,3"), PS_INTEGER(-2), PS_MISSING},
        {PS_TEXT("say \"hi\""), PS_INTEGER(3), PS_NUMBER((double)NAN)},
        {PS_TEXT("#x\r\ny"), PS_MISSING, PS_NUMBER(-(double)INFINITY)}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        assert_int_equal(ps_table_add_row(table, rows[i], &error), PSPEC_OK);
        text[0] = 'X'; /* the table has its own copy */
    }
    return table;
}

/* Writes the table to a file of the name and returns the text of the file. */
static char *write_table(void **state, const ps_table *table, const char *name,
                         ps_table_format format) {
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    if (ps_table_write(table, test_path(*state, name, path), format, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
    char *const text = test_read_file(path, NULL);
    assert_non_null(text);
    return text;
}

static void writes_csv(void **state) {
    ps_table *table = make_table();
    char *const text = write_table(state, table, "t.csv", PS_FORMAT_CSV);
    assert_string_equal(text, "# seed: 9223372036854775807\n"
                              "# file: a,b \"c\"\\nd\n"
                              "# tolerance: 0.1\n"
                              "# skipped: first\n"
                              "# empty: \n"
                              "# skipped: second\n"
                              "sampler,bin,power\n"
                              "white,1,0.3333333333333333\n"
                              "\"halton:base=2,3\",-2,\n"
                              "\"say \"\"hi\"\"\",3,\n"
                              "\"#x\r\ny\",,-inf\n");
    free(text);
    ps_table_destroy(table);
}

static void writes_json(void **state) {
    ps_table *table = make_table();
    ps_table_set_repeated(table, "file"); /* of which there is one */
    char *const text = write_table(state, table, "t.json", PS_FORMAT_JSON);
    assert_non_null(strstr(text, "\"seed\": 9223372036854775807,"));
    cJSON *const json = cJSON_Parse(text);
    assert_non_null(json);
    assert_true(cJSON_GetObjectItem(json, "schema")->valuedouble == 3);
    assert_string_equal(cJSON_GetObjectItem(json, "command")->valuestring, "power");
    const cJSON *const meta = cJSON_GetObjectItem(json, "meta");
    assert_int_equal(cJSON_GetArraySize(meta), 5);
    assert_string_equal(cJSON_GetObjectItem(meta, "file")->child->valuestring, "a,b \"c\"\nd");
    assert_true(cJSON_IsNull(cJSON_GetObjectItem(meta, "empty")));
    const cJSON *const skipped = cJSON_GetObjectItem(meta, "skipped");
    assert_int_equal(cJSON_GetArraySize(skipped), 2);
    assert_string_equal(cJSON_GetArrayItem(skipped, 1)->valuestring, "second");
    assert_string_equal(cJSON_GetArrayItem(cJSON_GetObjectItem(json, "columns"), 2)->valuestring,
                        "power");
    const cJSON *const rows = cJSON_GetObjectItem(json, "rows");
    assert_int_equal(cJSON_GetArraySize(rows), 4);
    const cJSON *const first = cJSON_GetArrayItem(rows, 0);
    assert_string_equal(cJSON_GetObjectItem(first, "sampler")->valuestring, "white");
    assert_true(cJSON_GetObjectItem(first, "power")->valuedouble == 1.0 / 3);
    for (int i = 1; i < 4; i++) { /* missing, nan, -inf */
        assert_true(cJSON_IsNull(cJSON_GetObjectItem(cJSON_GetArrayItem(rows, i), "power")));
    }
    cJSON_Delete(json);
    free(text);
    ps_table_destroy(table);
}

/* A line for the head and one for each row, each of them JSON. */
static void writes_json_lines(void **state) {
    ps_table *table = make_table();
    char *const text = write_table(state, table, "t.jsonl", PS_FORMAT_JSONL);
    char *line = text;
    for (int i = 0; i < 5; i++) {
        char *const end = strchr(line, '\n');
        assert_non_null(end);
        *end = '\0';
        cJSON *const json = cJSON_Parse(line);
        assert_non_null(json);
        assert_true(i == 0 ? cJSON_GetObjectItem(json, "schema")->valuedouble == 3 &&
                                 cJSON_IsObject(cJSON_GetObjectItem(json, "meta"))
                           : cJSON_GetArraySize(json) == 3);
        cJSON_Delete(json);
        line = end + 1;
    }
    assert_int_equal(*line, '\0');
    free(text);
    ps_table_destroy(table);
}

/* The bytes of an array of an NPZ file behind its header, which has `words`. */
static void read_member(void *out, size_t num_bytes, void **state, const char *name,
                        const char *words) {
    char path[TEST_PATH_BYTES];
    char header[129] = "";
    size_t num = 0;
    ps_input input = {0};
    ps_error error = {0};
    assert_int_equal(ps_input_open_array(&input, test_path(*state, "t.npz", path), name, &error),
                     PSPEC_OK);
    assert_int_equal(ps_input_read(&input, header, sizeof header - 1, &num, &error), PSPEC_OK);
    if (strstr(header + 10, words) == NULL) {
        fail_msg("%s is not %s: %s", name, words, header + 10);
    }
    assert_int_equal(ps_input_read(&input, out, num_bytes, &num, &error), PSPEC_OK);
    assert_int_equal(num, num_bytes);
    assert_int_equal(ps_input_read(&input, header, 1, &num, &error), PSPEC_OK);
    assert_int_equal(num, 0);
    ps_input_close(&input);
}

/* Columns to the bit: integers, numbers where one is missing, texts with what stands beside them;
 * and the header, as the file beside NPY has it. */
static void writes_npz(void **state) {
    enum { NUM_ROWS = 3, NUM_KINDS = 4, MOST_META = 1000, WIDTH = 19 };
    static const char *const names[NUM_KINDS] = {"whole", "some", "number", "text"};
    const ps_cell rows[NUM_ROWS][NUM_KINDS] = {
        {PS_INTEGER(INT64_MIN), PS_INTEGER(7), PS_NUMBER(-(double)INFINITY),
         PS_TEXT("\xc3\xa9\xf0\x9f\x98\x80\xff")},
        {PS_INTEGER(INT64_MAX), PS_MISSING, PS_NUMBER(1.0 / 3), PS_INTEGER(INT64_MAX)},
        {PS_INTEGER(0), PS_NUMBER(0.5), PS_NUMBER((double)NAN), PS_MISSING}};
    ps_table *table = NULL;
    ps_error error = {0};
    assert_int_equal(ps_table_create(&table, "power", names, NUM_KINDS, &error), PSPEC_OK);
    assert_int_equal(ps_table_add_meta(table, "file", PS_TEXT("\xc3\xa9\xff"), &error), PSPEC_OK);
    for (size_t i = 0; i < NUM_ROWS; i++) {
        assert_int_equal(ps_table_add_row(table, rows[i], &error), PSPEC_OK);
    }
    free(write_table(state, table, "t.npz", PS_FORMAT_NPZ));
    int64_t whole[NUM_ROWS];
    double number[NUM_ROWS];
    uint32_t text[NUM_ROWS][WIDTH];
    read_member(whole, sizeof whole, state, "whole", "i8', 'fortran_order': False, 'shape': (3,)");
    assert_true(whole[0] == INT64_MIN && whole[1] == INT64_MAX && whole[2] == 0);
    read_member(number, sizeof number, state, "some", "f8', 'fortran_order': False, 'shape': (3,)");
    assert_true(number[0] == 7 && isnan(number[1]) && number[2] == 0.5);
    read_member(number, sizeof number, state, "number", "f8'");
    assert_true(number[0] == -(double)INFINITY && number[1] == 1.0 / 3 && isnan(number[2]));
    read_member(text, sizeof text, state, "text", "U19', 'fortran_order': False, 'shape': (3,)");
    assert_true(text[0][0] == 0xe9 && text[0][1] == 0x1f600 && text[0][2] == 0xdcff &&
                text[0][3] == 0 && text[2][0] == 0);
    for (size_t i = 0; i < WIDTH; i++) {
        assert_int_equal(text[1][i], "9223372036854775807"[i]);
    }
    char *const array = write_table(state, table, "t.json", PS_FORMAT_JSON);
    char *const before_rows = strstr(array, ",\n  \"rows\"");
    const char *at = array;
    uint32_t meta[MOST_META] = {0};
    char words[64];
    memcpy(before_rows, "\n}\n", sizeof "\n}\n");
    const size_t num = strlen(array) - 1; /* one character has two bytes */
    snprintf(words, sizeof words, "U%zu', 'fortran_order': False, 'shape': ()", num);
    read_member(meta, num * sizeof *meta, state, "meta", words);
    for (size_t i = 0; i < num; i++) {
        uint32_t code = 0;
        at += ps_text_decode(&code, at);
        assert_int_equal(meta[i], code);
    }
    assert_int_equal(*at, '\0');
    free(array);
    ps_table_destroy(table);
}

static void json_is_utf8_whatever_the_names_are(void **state) {
    ps_table *table = NULL;
    ps_error error = {0};
    assert_int_equal(ps_table_create(&table, "power", columns, 1, &error), PSPEC_OK);
    const ps_cell cell = PS_TEXT("\xc3\xa9|\xe9|\xed\xa0\x80|\xf0\x9f\x98\x80|\xc0\xaf|\xe2\x82");
    assert_int_equal(ps_table_add_row(table, &cell, &error), PSPEC_OK);
    char *const text = write_table(state, table, "t.json", PS_FORMAT_JSON);
#define BAD "\\ufffd"
    assert_non_null(strstr(text, "\"\xc3\xa9|" BAD "|" BAD BAD BAD "|\xf0\x9f\x98\x80|" BAD BAD
                                 "|" BAD BAD "\""));
    free(text);
    ps_table_destroy(table);
}

static void numbers_survive_the_round_trip(void **state) {
    static const double values[] = {0.1,  1.0 / 3, DBL_MAX, 4.9e-324, 0.30000000000000004,
                                    1e22, -0.0};
    enum { NUM_VALUES = sizeof values / sizeof values[0] };
    static const char *const one_column[] = {"x"};
    ps_table *table = NULL;
    ps_error error = {0};
    assert_int_equal(ps_table_create(&table, "power", one_column, 1, &error), PSPEC_OK);
    for (size_t i = 0; i < NUM_VALUES; i++) {
        const ps_cell cell = PS_NUMBER(values[i]);
        assert_int_equal(ps_table_add_row(table, &cell, &error), PSPEC_OK);
    }
    char *const csv = write_table(state, table, "t.csv", PS_FORMAT_CSV);
    char *const json = write_table(state, table, "t.json", PS_FORMAT_JSON);
    const char *csv_at = strchr(csv, '\n');
    const char *json_at = strchr(strstr(json, "\"rows\"") + 8, '[');
    for (size_t i = 0; i < NUM_VALUES; i++) {
        assert_true(strtod(csv_at + 1, NULL) == values[i]);
        csv_at = strchr(csv_at + 1, '\n');
        json_at = strchr(json_at + 1, ':');
        assert_true(strtod(json_at + 1, NULL) == values[i]);
    }
    free(csv);
    free(json);
    ps_table_destroy(table);
}

static void writes_npy_and_names(void **state) {
    static const char *const names[] = {"a", "b"};
    ps_table *table = NULL;
    ps_error error = {0};
    char path[TEST_PATH_BYTES];
    assert_int_equal(ps_table_create(&table, "power", names, 2, &error), PSPEC_OK);
    assert_int_equal(ps_table_add_meta(table, "seed", PS_INTEGER(1), &error), PSPEC_OK);
    const ps_cell row[] = {PS_INTEGER(7), PS_MISSING};
    assert_int_equal(ps_table_add_row(table, row, &error), PSPEC_OK);
    free(write_table(state, table, "t.npy", PS_FORMAT_NPY));
    size_t length = 0;
    char *const array = test_read_file(test_path(*state, "t.npy", path), &length);
    assert_int_equal(length, 128 + 2 * sizeof(double));
    double values[2];
    memcpy(values, array + 128, sizeof values);
    assert_true(values[0] == 7 && isnan(values[1]));
    array[127] = '\0';
    assert_non_null(strstr(array + 10, "'shape': (1, 2), }"));
    free(array);
    char *const text = test_read_file(test_path(*state, "t.json", path), NULL);
    cJSON *const json = cJSON_Parse(text);
    assert_non_null(json);
    assert_null(cJSON_GetObjectItem(json, "rows"));
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(json, "columns")), 2);
    cJSON_Delete(json);
    free(text);
    assert_int_equal(ps_table_write(table, "-", PS_FORMAT_NPY, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    ps_table_destroy(table);
    table = make_table();
    assert_int_equal(ps_table_write(table, test_path(*state, "u.npy", path), PS_FORMAT_NPY, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "column \"sampler\" holds text"));
    assert_int_equal(access(path, F_OK), -1);
    ps_table_destroy(table);
}

static void chooses_formats(void **state) {
    (void)state;
    static const struct {
        const char *name, *path;
        ps_table_format format;
    } cases[] = {{NULL, "a.csv", PS_FORMAT_CSV},    {NULL, "a.json", PS_FORMAT_JSON},
                 {NULL, "b.NPY", PS_FORMAT_NPY},    {"csv", "a.txt", PS_FORMAT_CSV},
                 {NULL, "b.NPZ", PS_FORMAT_NPZ},    {"npz", "a.txt", PS_FORMAT_NPZ},
                 {NULL, "a", PS_FORMAT_CSV},        {NULL, "a.json/b", PS_FORMAT_CSV},
                 {NULL, "a/.json", PS_FORMAT_CSV},  {NULL, "a.", PS_FORMAT_CSV},
                 {NULL, "-", PS_FORMAT_CSV},        {NULL, NULL, PS_FORMAT_CSV},
                 {"json", "a.csv", PS_FORMAT_JSON}, {"csv", NULL, PS_FORMAT_CSV}};
    ps_error error = {0};
    ps_table_format format = PS_FORMAT_CSV;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(ps_table_choose_format(&format, cases[i].name, cases[i].path, &error),
                         PSPEC_OK);
        assert_int_equal(format, cases[i].format);
    }
    assert_int_equal(ps_table_choose_format(&format, "xml", NULL, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(ps_table_choose_format(&format, NULL, "a.txt", &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "\"a.txt\": the ending .txt is none of .csv, .json"));
    ps_table_destroy(NULL);
}

static void reports_a_full_disk(void **state) {
    (void)state;
    if (access("/dev/full", W_OK) != 0) {
        skip();
    }
    ps_table *table = make_table();
    ps_error error = {0};
    for (int i = 0; i < 5000; i++) { /* more than the buffer of the stream */
        const ps_cell row[NUM_COLUMNS] = {PS_TEXT("white"), PS_INTEGER(i), PS_NUMBER(i / 7.0)};
        assert_int_equal(ps_table_add_row(table, row, &error), PSPEC_OK);
    }
    assert_int_equal(ps_table_write(table, "/dev/full", PS_FORMAT_CSV, &error), PSPEC_ERROR_IO);
    assert_string_equal(error.message, "cannot write /dev/full: No space left on device");
    assert_int_equal(ps_table_write(table, "/dev/full", PS_FORMAT_JSON, &error), PSPEC_ERROR_IO);
    assert_int_equal(ps_table_write(table, "/dev/full", PS_FORMAT_NPZ, &error), PSPEC_ERROR_IO);
    ps_table_destroy(table);
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(writes_csv),
        IN_FOLDER(writes_json),
        IN_FOLDER(writes_json_lines),
        IN_FOLDER(writes_npz),
        IN_FOLDER(json_is_utf8_whatever_the_names_are),
        IN_FOLDER(numbers_survive_the_round_trip),
        IN_FOLDER(writes_npy_and_names),
        cmocka_unit_test(chooses_formats),
        cmocka_unit_test(reports_a_full_disk),
    };
    return cmocka_run_group_tests_name("table", tests, NULL, NULL);
}
