/* Answers of command lines, and what is merged of them. */
#ifndef PS_TESTS_HARNESS_ANSWERS_H
#define PS_TESTS_HARNESS_ANSWERS_H

#include "answers/kind.h"
#include "harness.h"
#include "test_folder.h"

enum { ANSWERS_LINE = 1024, ANSWERS_PARTS = 3 };

/* The file PART.txt of num sets of N = 7, or with varies 7 to 14, each in numbers of [0,1) and a
 * weight. */
void answers_write_sets(const test_folder *folder, int part, int num, unsigned columns,
                        bool varies);

/* The device of what follows, until it is closed; without one engines of the host answer. */
ps_device *answers_open_device(void);
void answers_close_device(void);
/* Answers the command line; parts from first to last are its files where there is a folder. */
ps_answer answers_ask(const test_folder *folder, int first, int last, const char *text);

/* The same where it may fail, or be cancelled. */
pspec_status answers_try(ps_answer *out, const test_folder *folder, int first, int last,
                         const char *text, const ps_watch *watch, ps_error *error);

/* Called "the first" and so on. */
pspec_status answers_try_merge(ps_answer *out, size_t num, const ps_table *const *tables,
                               ps_error *error);
/* Of num pointers to answers. */
ps_answer answers_merge(size_t num, ...);

bool answers_are_near(ps_cell a, ps_cell b, double tolerance);
/* Cells and header, but for what is of single jobs. */
void answers_assert_near(const ps_table *a, const ps_table *b, double tolerance, const char *what);
void answers_assert_same_arrays(const ps_table *a, const ps_table *b);

#endif
