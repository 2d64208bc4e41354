#include "harness_program.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>

enum { TEXT = 4096 };

/* ---- the program ------------------------------------------------------------------------- */

/* "power points=64 files=a.txt" as "power --points 64 a.txt", files behind the rest, as the library
 * says the command line. */
static void append_words(char *command, size_t size, const char *line) {
    for (int want_files = 0; want_files < 2; want_files++) {
        char words[TEXT];
        char *rest = NULL;
        snprintf(words, sizeof words, "%s", line);
        char *word = strtok_r(words, " ", &rest);
        while ((word = strtok_r(NULL, " ", &rest)) != NULL) {
            static const char files[] = "files=";
            const bool is_file = strncmp(word, files, sizeof files - 1) == 0;
            const size_t length = strlen(command);
            char *const equals = strchr(word, '=');
            if (is_file == (want_files != 0)) {
                if (equals != NULL) {
                    *equals = '\0';
                }
                snprintf(command + length, size - length, is_file ? "%.0s %s" : " --%s %s", word,
                         equals != NULL ? equals + 1 : "");
            }
        }
    }
}

int test_ask_program(const char *before, const char *line) {
    char command[2 * TEXT];
    snprintf(command, sizeof command, "'%s' %s%.*s", TEST_PROGRAM, before, (int)strcspn(line, " "),
             line);
    append_words(command, sizeof command, line);
    strncat(command, " >printed 2>said", sizeof command - strlen(command) - 1);
    const int status = system(command);
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
