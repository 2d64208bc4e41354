/* Commands of the shell whose output is read: how they end, what they said last, and that nothing
 * they do makes both sides wait for each other. */
#include "base/process/program.h"

#include "harness.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST = 1 << 16 };

/* Reads to the end, or to the error, in pieces of so many bytes. */
static pspec_status read_output(const char *command, size_t piece, char out[MOST],
                                ps_error *error) {
    ps_program *program = NULL;
    size_t length = 0;
    size_t count = 1;
    pspec_status status = ps_program_start(&program, command, error);
    while (status == PSPEC_OK && count > 0 && length + piece < MOST) {
        status = ps_program_read(program, out + length, piece, &count, error);
        length += count;
    }
    out[length] = '\0';
    ps_program_end(program);
    return status;
}

static void output_comes_whole(void **state) {
    (void)state;
    static char out[MOST];
    ps_error error = {0};
    for (size_t piece = 1; piece < MOST; piece *= 40) {
        assert_int_equal(read_output("echo one; sleep 0.02; echo two; cat", piece, out, &error),
                         PSPEC_OK);
        assert_string_equal(out, "one\ntwo\n");
    }
}

/* More than pipes hold, before there is any output and after it has ended. */
static void complaints_never_block(void **state) {
    (void)state;
    static char out[MOST];
    ps_error error = {0};
    assert_int_equal(read_output("yes | head -c 1000000 >&2; echo done", MOST / 2, out, &error),
                     PSPEC_OK);
    assert_string_equal(out, "done\n");
    assert_int_equal(
        read_output("echo done; exec >&-; yes | head -c 1000000 >&2", MOST / 2, out, &error),
        PSPEC_OK);
    assert_string_equal(out, "done\n");
}

static void failures_have_the_last_line(void **state) {
    (void)state;
    static const struct {
        const char *command, *sentence;
    } cases[] = {
        {"echo a >&2; printf 'b\\n\\n\\n' >&2; exit 7",
         "failed with exit status 7; its last line: b"},
        {"printf 'no end' >&2; exit 1", "failed with exit status 1; its last line: no end"},
        {"printf '%1000s' x >&2; printf '\\nlast\\n' >&2; false", "its last line: last"},
        {"exit 2", "failed with exit status 2, and said nothing"},
        {"kill -TERM $$", "was ended by signal 15"},
        {"/nonexistent", "failed with exit status 127; its last line: "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        static char out[MOST];
        ps_error error = {0};
        assert_int_equal(read_output(cases[i].command, MOST / 2, out, &error), PSPEC_ERROR_INPUT);
        if (strstr(error.message, cases[i].sentence) == NULL) {
            fail_msg("%s: %s", cases[i].command, error.message);
        }
    }
}

/* Nobody may have taken the status of a process that has ended. */
static bool runs(const char *path) {
    char status[8] = "Z";
    FILE *const file = fopen(path, "r");
    if (file == NULL) {
        return false;
    }
    const int num = fscanf(file, "%*d (%*[a-z]) %1s", status);
    fclose(file);
    return num == 1 && status[0] != 'Z' && status[0] != 'X';
}

/* What it has left behind may hold its streams open, and go on talking: it still runs when all has
 * been read. */
static void the_end_is_that_of_the_command(void **state) {
    (void)state;
    static const char *const commands[] = {"sleep 600 >&- & echo $!", "yes >&2 & echo $!"};
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++) {
        static char out[MOST];
        char path[64];
        ps_error error = {0};
        assert_int_equal(read_output(commands[i], MOST / 2, out, &error), PSPEC_OK);
        const long child = strtol(out, NULL, 10);
        snprintf(path, sizeof path, "/proc/%ld/stat", child);
        assert_true(child > 0);
        assert_true(i > 0 || runs(path)); /* `yes` ends with the stream */
        (void)kill((pid_t)child, SIGKILL);
    }
}

/* The whole group: the shell, and what it has started. */
static void what_runs_is_killed(void **state) {
    (void)state;
    char text[32];
    size_t length = 0;
    ps_program *program = NULL;
    ps_error error = {0};
    assert_int_equal(ps_program_start(&program, "sleep 600 & echo $!; wait", &error), PSPEC_OK);
    while (length == 0 || text[length - 1] != '\n') {
        size_t count = 0;
        assert_int_equal(ps_program_read(program, text + length, 1, &count, &error), PSPEC_OK);
        assert_int_equal(count, 1);
        length += count;
    }
    text[length] = '\0';
    ps_program_end(program);
    char path[64];
    snprintf(path, sizeof path, "/proc/%ld/stat", strtol(text, NULL, 10));
    enum { MOST_LOOKS = 10000 };
    const struct timespec pause = {0, 1000000};
    unsigned num_looks = 0;
    while (runs(path) && num_looks < MOST_LOOKS) { /* it ends when the system comes to it */
        nanosleep(&pause, NULL);
        num_looks++;
    }
    assert_true(num_looks < MOST_LOOKS);
}

static void as_much_is_tried_as_tells_draws_apart(void **state) {
    (void)state;
    static const struct {
        const char *command;
        size_t length;
    } cases[] = {{"echo a", 2},
                 {"true", 0},
                 {"yes", PS_PROGRAM_TRIED_BYTES},
                 {"head -c 20000000 /dev/zero", PS_PROGRAM_TRIED_BYTES}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_error error = {0};
        ps_text out = {0};
        assert_int_equal(ps_program_try(&out, cases[i].command, &error), PSPEC_OK);
        assert_int_equal(out.length, cases[i].length);
        ps_text_free(&out);
    }
    ps_error error = {0};
    ps_text out = {0};
    assert_int_equal(ps_program_try(&out, "echo a; false", &error), PSPEC_ERROR_INPUT);
    ps_text_free(&out);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(output_comes_whole),
        cmocka_unit_test(complaints_never_block),
        cmocka_unit_test(failures_have_the_last_line),
        cmocka_unit_test(the_end_is_that_of_the_command),
        cmocka_unit_test(what_runs_is_killed),
        cmocka_unit_test(as_much_is_tried_as_tells_draws_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
