#include "harness_program.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>

enum { TEXT = 4096 };

/* ---- the program ------------------------------------------------------------------------- */

/* "--points 64 ... a.txt": as the library says the command line, files behind the rest. */
static void append_words(char *line, size_t size, const pspec_option *options, size_t num) {
    for (int want_files = 0; want_files < 2; want_files++) {
        for (size_t i = 0; i < num; i++) {
            const size_t length = strlen(line);
            const bool is_file = strcmp(options[i].name, "files") == 0;
            const char *const value = options[i].value != NULL ? options[i].value : "";
            if (is_file == (want_files != 0)) {
                snprintf(line + length, size - length, is_file ? "%.0s %s" : " --%s %s",
                         options[i].name, value);
            }
        }
    }
}

int test_ask_program(const char *command, const pspec_option *options, size_t num) {
    char line[TEXT];
    snprintf(line, sizeof line, "'%s' %s", TEST_PROGRAM, command);
    append_words(line, sizeof line, options, num);
    strncat(line, " >printed 2>said", sizeof line - strlen(line) - 1);
    const int status = system(line);
    assert_true(status != -1 && WIFEXITED(status));
    return WEXITSTATUS(status);
}

/* ---- files --------------------------------------------------------------------------------- */

char *test_read_whole(const char *path, size_t *num) {
    FILE *const file = fopen(path, "rb");
    struct stat facts;
    if (file == NULL) {
        fail_msg("there is no %s", path);
    }
    assert_int_equal(stat(path, &facts), 0);
    char *const bytes = calloc((size_t)facts.st_size + 1, 1);
    *num = fread(bytes, 1, (size_t)facts.st_size, file);
    assert_int_equal(*num, facts.st_size);
    fclose(file);
    return bytes;
}

void test_assert_same_file(const char *path, const char *expected) {
    size_t num = 0;
    size_t num_expected = 0;
    char *const bytes = test_read_whole(path, &num);
    char *const other = test_read_whole(expected, &num_expected);
    if (num != num_expected || memcmp(bytes, other, num) != 0) {
        fail_msg("%s, which the library wrote:\n%s\n%s, which the program wrote:\n%s", path, bytes,
                 expected, other);
    }
    free(bytes);
    free(other);
}
