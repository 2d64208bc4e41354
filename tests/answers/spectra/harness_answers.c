#include "harness_answers.h"

#include "answers/checkpoints.h"

#include <math.h>
#include <stdarg.h>

enum { LEAST_POINTS = 7, MOST_MORE = 8 };

/* ---- sets ------------------------------------------------------------------------------------ */

static double next_number(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) * 0x1p-53;
}

void answers_write_sets(const test_folder *folder, int part, int num, unsigned columns,
                        bool varies) {
    char name[16];
    char path[TEST_PATH_BYTES];
    uint64_t state = 1 + (uint64_t)part;
    snprintf(name, sizeof name, "%d.txt", part);
    FILE *const file = fopen(test_path(folder, name, path), "w");
    assert_non_null(file);
    for (int set = 0; set < num; set++) {
        fputs(set > 0 ? "#\n" : "", file);
        for (int i = 0; i < LEAST_POINTS + (varies ? (set + part) % MOST_MORE : 0); i++) {
            for (unsigned k = 0; k < columns; k++) {
                fprintf(file, "%.17g ", next_number(&state));
            }
            fprintf(file, "%.17g\n", 0.5 + next_number(&state));
        }
    }
    assert_int_equal(fclose(file), 0);
}

/* ---- answers --------------------------------------------------------------------------------- */

static ps_device *device; /* for those that need one */

ps_device *answers_open_device(void) {
    device = test_open_device();
    return device;
}

void answers_close_device(void) {
    ps_device_close(device);
    device = NULL;
}

static const ps_kind *find_kind(const char *name) {
    size_t i = 0;
    while (strcmp(ps_kinds[i]->name, name) != 0) {
        i++;
    }
    return ps_kinds[i];
}

static ps_option_id find_option(const char *word) {
    int id = 0;
    while (word[1] == '-' ? strcmp(ps_options[id].name, word + 2) != 0
                          : ps_options[id].letter != word[1]) {
        id++;
    }
    return (ps_option_id)id;
}

/* The options of a command line, cut into words. */
static void take_options(ps_request *request, const ps_kind *kind, char *line) {
    for (char *word = strtok(line, " "); word != NULL; word = strtok(NULL, " ")) {
        const ps_option_id id = find_option(word);
        const bool is_flag = ps_options[id].metavar == NULL;
        request->is_given[id] = true;
        assert_ok(ps_option_set(request, id, ps_command_words(kind, id),
                                is_flag ? NULL : strtok(NULL, " "), error));
    }
}

/* As ps_answer_produce does, but for what is written. */
static pspec_status answer(ps_answer *out, const ps_kind *kind, ps_request *request,
                           const ps_answer_hooks *hooks, ps_error *error) {
    ps_text key = {0};
    pspec_status status = ps_answer_begin_checkpoints(request, kind, &key, hooks, error);
    if (status == PSPEC_OK) {
        status = ps_answer_make(out, kind, request, hooks, error);
    }
    if (status == PSPEC_OK) {
        ps_answer_end_checkpoints(request);
    }
    ps_text_free(&key);
    return status;
}

pspec_status answers_try(ps_answer *out, const test_folder *folder, int first, int last,
                         const char *text, const ps_watch *watch, ps_error *error) {
    char line[ANSWERS_LINE];
    char paths[ANSWERS_PARTS][TEST_PATH_BYTES];
    const char *files[ANSWERS_PARTS];
    ps_request request = ps_request_default;
    const ps_answer_hooks hooks = {.device = device, .watch = *watch};
    const size_t length = strcspn(text, " ");
    snprintf(line, sizeof line, "%.*s", (int)length, text);
    const ps_kind *const kind = find_kind(line);
    snprintf(line, sizeof line, "%s", text + length);
    take_options(&request, kind, line);
    for (int part = first; folder != NULL && part <= last; part++) {
        char name[16];
        snprintf(name, sizeof name, "%d.txt", part);
        files[request.num_files++] = test_path(folder, name, paths[part]);
    }
    request.files = files;
    request.command_line = text;
    request.wants_state = true;
    return answer(out, kind, &request, &hooks, error);
}

ps_answer answers_ask(const test_folder *folder, int first, int last, const char *text) {
    const ps_watch nobody = {0};
    ps_answer out;
    assert_ok(answers_try(&out, folder, first, last, text, &nobody, error));
    return out;
}

pspec_status answers_try_merge(ps_answer *out, size_t num, const ps_table *const *tables,
                               ps_error *error) {
    static const char *const names[] = {"the first", "the second", "the third"};
    const ps_parts parts = {.tables = tables, .names = names, .num = num, .command_line = "merge"};
    return ps_answer_merge(out, &parts, error);
}

ps_answer answers_merge(size_t num, ...) {
    const ps_table *tables[ANSWERS_PARTS];
    ps_answer out;
    va_list list;
    va_start(list, num);
    for (size_t i = 0; i < num; i++) {
        tables[i] = va_arg(list, const ps_answer *)->table;
    }
    va_end(list);
    assert_ok(answers_try_merge(&out, num, tables, error));
    return out;
}

/* ---- comparison ------------------------------------------------------------------------------ */

bool answers_are_near(ps_cell a, ps_cell b, double tolerance) {
    return a.kind == b.kind && a.integer == b.integer &&
           (a.kind != PS_CELL_TEXT || strcmp(a.text, b.text) == 0) &&
           (a.kind != PS_CELL_NUMBER || a.number == b.number ||
            fabs(a.number - b.number) <= tolerance * fmax(1, fabs(b.number)));
}

/* What is of single jobs. */
static bool is_told(const char *key) {
    static const char *const keys[] = {"command", "merged", "input", "self_check", "engine"};
    size_t i = 0;
    while (i < sizeof keys / sizeof keys[0] && strcmp(keys[i], key) != 0) {
        i++;
    }
    return i < sizeof keys / sizeof keys[0];
}

/* What b has for entry i of a: the same key, after as many others of that key. */
static ps_cell find_same(const ps_table *a, size_t i, const ps_table *b) {
    const char *key = NULL;
    const char *name = NULL;
    size_t before = 0;
    (void)ps_table_meta(a, i, &key);
    while (i-- > 0) {
        (void)ps_table_meta(a, i, &name);
        before += strcmp(name, key) == 0;
    }
    for (size_t k = 0; k < ps_table_num_meta(b); k++) {
        const ps_cell cell = ps_table_meta(b, k, &name);
        if (strcmp(name, key) == 0 && before-- == 0) {
            return cell;
        }
    }
    return PS_MISSING;
}

void answers_assert_near(const ps_table *a, const ps_table *b, double tolerance, const char *what) {
    assert_int_equal(ps_table_num_columns(a), ps_table_num_columns(b));
    assert_int_equal(ps_table_num_rows(a), ps_table_num_rows(b));
    for (size_t row = 0; row < ps_table_num_rows(a); row++) {
        for (size_t column = 0; column < ps_table_num_columns(a); column++) {
            const ps_cell cells[] = {ps_table_cell(a, row, column), ps_table_cell(b, row, column)};
            if (!answers_are_near(cells[0], cells[1], tolerance)) {
                fail_msg("%s: %s of row %zu: %.17g, %.17g", what, ps_table_column_name(a, column),
                         row, cells[0].number, cells[1].number);
            }
        }
    }
    for (size_t i = 0; i < ps_table_num_meta(a); i++) {
        const char *key = NULL;
        const ps_cell cell = ps_table_meta(a, i, &key);
        if (!is_told(key) && !answers_are_near(cell, find_same(a, i, b), tolerance)) {
            fail_msg("%s: %s", what, key);
        }
    }
}

void answers_assert_same_arrays(const ps_table *a, const ps_table *b) {
    assert_int_equal(ps_table_num_arrays(a), ps_table_num_arrays(b));
    for (size_t i = 0; i < ps_table_num_arrays(a); i++) {
        const char *name = NULL;
        bool is_state = false;
        const ps_npy_array *const array = ps_table_array(a, i, &name, &is_state);
        const ps_npy_array *const other = ps_table_find_array(b, name);
        assert_non_null(other);
        assert_int_equal(array->num, other->num);
        assert_memory_equal(array->data, other->data, array->num * sizeof *array->data);
    }
}
