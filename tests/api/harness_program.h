/* The program beside the library: the same options to both, and the files that come of it. */
#ifndef TESTS_HARNESS_PROGRAM_H
#define TESTS_HARNESS_PROGRAM_H

#include "harness_public.h"

/* Runs the program in this folder with a question as of test_public_question; before: "", or "plan ".
 * Returns its exit status. What it prints is in the file "printed", what it says on standard error
 * in "said". */
int test_ask_program(const char *before, const char *line);

/* The bytes of a file, with a zero behind them; freed by the caller. */
char *test_read_whole(const char *path, size_t *num);
/* The test fails where the files differ, and shows both. */
void test_assert_same_file(const char *path, const char *expected);

#endif
